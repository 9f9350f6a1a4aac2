#pragma once

namespace mis::cli {

/// Reads the command line (here alone, by CLI11), runs the command, returns its exit code. Throws
/// as commands.h says.
int run_command_line(int argc, char** argv);

}  // namespace mis::cli
