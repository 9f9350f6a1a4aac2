#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <vector>

namespace mis::cli {

/// Is --help or -h among the words of a command?
bool asks_for_help(std::span<const std::string> words);

/// The command that this word names. Throws UsageError.
CLI::App& command_named(CLI::App& app, const std::string& word);

/// Throws UsageError where the words are not what the command takes: an option that it has not, one
/// without its value or given twice, a word too many, or something that it needs and is not there.
/// What the values mean is for others.
void check_usage(const CLI::App& command, std::span<const std::string> words);

}  // namespace mis::cli
