#include "mis/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace mis::cli {

namespace {

std::size_t terminal_width()
{
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

}  // namespace

Progress::Progress(bool is_wanted)
    : is_shown_(is_wanted && isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now())
{
}

void Progress::show(const std::string& what, double done)
{
    if (!is_shown_) return;
    const auto now = std::chrono::steady_clock::now();
    if (is_drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    const double share = std::clamp(done, 0.0, 1.0);
    const double passed = std::chrono::duration<double>(now - start_).count();
    const std::string left =
        share > 0.02 ? fmt::format("{:.0f} s left", passed / share * (1 - share)) : "";
    constexpr std::size_t bar = 24;
    const auto filled = static_cast<std::size_t>(share * bar);
    std::string line = fmt::format("[{}{}] {:3.0f} %  {}  {}", std::string(filled, '#'),
                                   std::string(bar - filled, '.'), share * 100, left, what);
    line.resize(std::min(line.size(), terminal_width() - 1));
    fmt::print(stderr, "\r\x1b[K{}", line);
    std::fflush(stderr);
    is_drawn_ = true;
}

void Progress::clear()
{
    if (!is_drawn_) return;
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
    is_drawn_ = false;
}

}  // namespace mis::cli
