#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mis {

/// Channels of one size, named "layer.R" as OpenEXR has it; a row is made when it is written.
struct LayeredImage {
    int width = 0, height = 0;
    std::vector<std::string> channels;
    /// Fills row y, counted from the top: all channels of its first pixel, then of the next.
    std::function<void(int y, std::span<float> row)> fill_row;
};

}  // namespace mis
