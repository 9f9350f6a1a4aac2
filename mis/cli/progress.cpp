#include "mis/cli/progress.h"

#include "mis/cli/terminal.h"
#include "mis/io/text_layout.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace mis::cli {

namespace {

/// The first lines of a text, as many as fit, each ended by a line feed; how many they are.
std::string first_lines(const std::string& text, std::size_t most, std::size_t& count)
{
    std::size_t end = 0;
    for (count = 0; count < most && end < text.size(); ++count) end = text.find('\n', end) + 1;
    return text.substr(0, end);
}

/// As many whole words of a line as fit.
std::string first_words(const std::string& line, std::size_t columns)
{
    const std::string lines = fitted(line, columns);
    const std::string first = lines.substr(0, lines.find('\n'));
    return width_of(first) <= columns ? first : "";
}

void draw(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

Progress::Progress(bool is_wanted)
    : is_shown_(is_wanted && is_screen(STDERR_FILENO)), start_(std::chrono::steady_clock::now())
{
}

bool Progress::is_due() const
{
    return is_shown_ && (!is_drawn_ || std::chrono::steady_clock::now() - last_ >=
                                           std::chrono::milliseconds(100));
}

/// To the beginning of what was drawn last, which is wiped.
void Progress::go_back() const
{
    if (lines_above_ > 0) draw(fmt::format("\x1b[{}A", lines_above_));
    draw("\r\x1b[J");
}

void Progress::show(const std::string& what, double done, const std::string& table)
{
    if (!is_due()) return;
    const auto now = last_ = std::chrono::steady_clock::now();
    const double share = std::clamp(done, 0.0, 1.0);
    const double passed = std::chrono::duration<double>(now - start_).count();
    const std::string left =
        share > 0.02 ? fmt::format("{:.0f} s left", passed / share * (1 - share)) : "";
    constexpr std::size_t bar = 24;
    const auto filled = static_cast<std::size_t>(share * bar);
    std::string line =
        fmt::format("[{}{}] {:3.0f} %  {}  {}", std::string(filled, '#'),
                    std::string(bar - filled, '.'), share * 100, left, printable(what));
    const TerminalSize terminal = terminal_size(STDERR_FILENO);
    line = first_words(line, terminal.columns - 1);
    if (is_drawn_) go_back();
    const bool has_room = terminal.rows > 8;
    draw(first_lines(table, has_room ? terminal.rows - 2 : 0, lines_above_) + line);
    std::fflush(stderr);
    is_drawn_ = true;
}

void Progress::clear()
{
    if (!is_drawn_) return;
    go_back();
    std::fflush(stderr);
    is_drawn_ = false;
    lines_above_ = 0;
}

}  // namespace mis::cli
