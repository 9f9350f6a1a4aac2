#pragma once

#include <filesystem>

namespace mis {

/// The folder of the project's sources.
std::filesystem::path source_dir();

/// The program mis, as built.
std::filesystem::path program_file();

}  // namespace mis
