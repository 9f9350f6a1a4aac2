#pragma once

#include "mis/io/text_layout.h"

#include <cstddef>
#include <string>

namespace mis::cli {

struct TerminalSize {
    std::size_t columns = text_columns, rows = 24;
};

/// Of the terminal that this descriptor is, or 80 by 24. COLUMNS and LINES go before what it says.
TerminalSize terminal_size(int descriptor);

/// A terminal that moves its cursor: TERM says so.
bool is_screen(int descriptor);

/// For standard output: as wide as its terminal, with bold and colour; 80 columns and plain text
/// where it is none. NO_COLOR and TERM=dumb leave bold and colour out.
TextLook look_of_output(bool is_verbose = false);

/// For standard error.
TextLook look_of_errors();

/// Messages, broken between words where standard error is a terminal.
std::string for_errors(const std::string& message);

}  // namespace mis::cli
