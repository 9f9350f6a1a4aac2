#pragma once

#include "mis/report/maps.h"
#include "mis/report/report.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mis {

/// A scene's maps as a page takes them: what they are, as JSON, and pictures that it refers to by
/// id, as base64 of PNG.
///
/// A picture holds numbers as planes of bytes, one under another (or beside, for `columns` > 1).
/// Means and variances are 16-bit steps of their logarithm, high byte and low byte: 0 is 0, 65535
/// no number, any other k is 2^(low + (k − 1)·step).
struct PagePictures {
    std::string json;
    std::vector<std::pair<std::string, std::string>> pictures;  ///< id → base64
};

/// A mean is kept to 0.2 %, a variance to 0.7 %.
inline constexpr double mean_step = 0.005, variance_step = 0.02;

/// Pixels × strategies that all pictures of a page may have together, about a byte or two each.
inline constexpr double most_page_values = 9e6;

/// How many pixels of the maps, across and down, are one of the page: so that pixels × strategies
/// are at most `most_values` and neither side is above 2048.
int page_scale(int width, int height, std::size_t strategies, double most_values);

/// The maps, at `page_scale` to one: means and variances averaged, winners and lights those of each
/// block's first pixel. prefix: of the pictures' ids. Throws WriteError.
PagePictures page_pictures(const Maps& maps, double most_values, const std::string& prefix);

}  // namespace mis
