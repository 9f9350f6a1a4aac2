#pragma once

#include "mis/io/layered_image.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace mis {

// The functions of the module that holds OpenImageIO. It is opened for the first image: the
// libraries that OpenImageIO brings take 0.3 s to load. `reason` says why where something failed,
// else it stays empty.

/// Writes the layers and `metadata` to the file `path`.
using WriteExrLayers = void(const std::string& path, const LayeredImage& image,
                            const std::map<std::string, std::string>& metadata,
                            std::string& reason);

/// A grey picture of 8 bits, row by row from the top, as PNG.
using EncodePng = void(int width, int height, std::span<const std::uint8_t> grey,
                       std::string& bytes, std::string& reason);

}  // namespace mis

extern "C" mis::WriteExrLayers mis_write_exr_layers;
extern "C" mis::EncodePng mis_encode_png;
