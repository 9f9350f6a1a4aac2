#pragma once

#include "mis/engine/render.h"

#include <map>
#include <string>

namespace mis {

/// Writes the pixels and `metadata` to the file `path`; gives the reason if that failed, or "".
/// It stands in a module that is opened for the first image: the libraries that OpenImageIO brings
/// take 0.3 s to load.
using WriteExrPixels = std::string(const std::string& path, const Image& image,
                                   const std::map<std::string, std::string>& metadata);

}  // namespace mis

extern "C" mis::WriteExrPixels mis_write_exr_pixels;
