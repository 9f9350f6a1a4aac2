#pragma once

#include "mis/math/stop_token.h"

#include <atomic>

namespace mis::cli {

/// Set by Ctrl-C (SIGINT) and SIGTERM once watch_for_interrupt() was called; a second one ends the
/// program at once.
const std::atomic<bool>& interrupt_flag();
void watch_for_interrupt();

/// Up from then on.
StopToken interrupt_token();

}  // namespace mis::cli
