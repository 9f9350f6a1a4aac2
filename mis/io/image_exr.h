#pragma once

#include "mis/engine/render.h"

#include <filesystem>
#include <map>
#include <string>

namespace mis {

/// Writes a picture as OpenEXR: 32-bit float, linear RGB, with `metadata` as attributes. To a
/// temporary name, then renamed. Throws std::runtime_error with the file and the reason.
void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata);

}  // namespace mis
