#pragma once

#include "mis/engine/render.h"
#include "mis/io/layered_image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace mis {

/// The attributes of a picture: `Software`, and all that is ours as "mis:KEY".
class ExrMetadata {
public:
    /// Of every picture: `Software`, mis:command and mis:seed.
    ExrMetadata(const std::string& version, const std::string& command, std::uint64_t seed);
    /// And mis:KEY.
    ExrMetadata& add(const std::string& key, const std::string& value);
    /// By name.
    const std::map<std::string, std::string>& all() const { return all_; }

private:
    std::map<std::string, std::string> all_;
};

/// Writes a picture as OpenEXR: 32-bit float, linear RGB, with `metadata` as attributes. To a
/// temporary name, then renamed. Throws WriteError with the file and the reason.
void write_exr(const std::filesystem::path& file, const Image& image, const ExrMetadata& metadata);

/// The same of named layers.
void write_exr(const std::filesystem::path& file, const LayeredImage& image,
               const ExrMetadata& metadata);

/// A grey picture of 8 bits, row by row from the top, as the bytes of a PNG file. Throws
/// WriteError.
std::string png_bytes(int width, int height, std::span<const std::uint8_t> grey);

}  // namespace mis
