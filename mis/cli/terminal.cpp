#include "mis/cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace mis::cli {

namespace {

constexpr std::size_t least_columns = 20, most_columns = 1000;

std::string_view variable(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? std::string_view() : value;
}

/// A variable's whole number, or `otherwise`.
std::size_t number_of(const char* name, std::size_t otherwise)
{
    const std::string text(variable(name));
    if (text.empty() || text.size() > 5 || text.find_first_not_of("0123456789") != text.npos)
        return otherwise;
    const auto number = static_cast<std::size_t>(std::atoi(text.c_str()));
    return number > 0 ? number : otherwise;
}

TextLook look_of(int descriptor, bool is_verbose)
{
    TextLook look;
    look.is_verbose = is_verbose;
    if (isatty(descriptor) == 0) return look;
    look.columns = terminal_size(descriptor).columns;
    look.has_style = is_screen(descriptor) && variable("NO_COLOR").empty();
    return look;
}

}  // namespace

TerminalSize terminal_size(int descriptor)
{
    TerminalSize size;
    winsize found{};
    if (ioctl(descriptor, TIOCGWINSZ, &found) == 0 && found.ws_col > 0 && found.ws_row > 0)
        size = {found.ws_col, found.ws_row};
    size = {number_of("COLUMNS", size.columns), number_of("LINES", size.rows)};
    size.columns = std::clamp(size.columns, least_columns, most_columns);
    return size;
}

bool is_screen(int descriptor)
{
    const std::string_view term = variable("TERM");
    return isatty(descriptor) != 0 && !term.empty() && term != "dumb";
}

TextLook look_of_output(bool is_verbose) { return look_of(STDOUT_FILENO, is_verbose); }

TextLook look_of_errors() { return look_of(STDERR_FILENO, false); }

std::string for_errors(const std::string& message)
{
    return isatty(STDERR_FILENO) == 0 ? message : fitted(message, look_of_errors().columns);
}

}  // namespace mis::cli
