#pragma once

#include <functional>
#include <span>
#include <vector>

namespace mis {

/// Where a continuous function crosses some levels: ascending, each to some 14 digits. It is looked at in the points xs
/// (ascending); pairs of crossings between two of them are found where the function turns towards a level there.
/// Where it is not finite it crosses nothing.
std::vector<double> crossings(const std::function<double(double)>& f, std::span<const double> xs,
                              std::span<const double> levels);

/// `count` points of the open interval, denser towards both ends.
std::vector<double> looking_points(double begin, double end, int count);

}  // namespace mis
