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
    struct sigaction action {};
    action.sa_handler = on_signal;  // without SA_RESTART: it ends the wait for a pipe
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

StopToken interrupt_token() { return StopToken(&flag); }

}  // namespace mis::cli
