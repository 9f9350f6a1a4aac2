#include "mis/cli/interrupt.h"

#include <csignal>
#include <cstdlib>

namespace mis::cli {

namespace {

std::atomic<bool> flag{false};

void on_signal(int number)
{
    if (flag.exchange(true)) std::_Exit(128 + number);
}

}  // namespace

const std::atomic<bool>& interrupt_flag() { return flag; }

void watch_for_interrupt()
{
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

}  // namespace mis::cli
