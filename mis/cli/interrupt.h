#pragma once

#include <atomic>

namespace mis::cli {

/// Set by Ctrl-C (SIGINT) and SIGTERM once watch_for_interrupt() was called; a second one ends the
/// program at once.
const std::atomic<bool>& interrupt_flag();
void watch_for_interrupt();

}  // namespace mis::cli
