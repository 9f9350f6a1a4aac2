#pragma once

#include "mis/engine/render.h"

#include <map>
#include <string>

namespace mis {

/// Writes the pixels and `metadata` to the file `path`; `reason` says why if that failed,
/// else it stays empty.
/// It stands in a module that is opened for the first image: the libraries that OpenImageIO brings
/// take 0.3 s to load.
using WriteExrPixels = void(const std::string& path, const Image& image,
                            const std::map<std::string, std::string>& metadata,
                            std::string& reason);

}  // namespace mis

extern "C" mis::WriteExrPixels mis_write_exr_pixels;
