#pragma once

#include <functional>
#include <span>
#include <vector>

namespace mis {

/// Where a continuous function crosses some levels: ascending, each to some 14 digits. It is looked
/// at in the points xs (ascending); pairs of crossings between two of them are found where the
/// function turns towards a level there. Where it is not finite it crosses nothing.
std::vector<double> crossings(const std::function<double(double)>& f, std::span<const double> xs,
                              std::span<const double> levels);

/// Where what at(x) says changes between neighbours among the points xs (ascending), found by
/// halving.
template <class At> std::vector<double> changes(const At& at, std::span<const double> xs)
{
    std::vector<double> found;
    auto before = at(xs.front());
    for (std::size_t i = 1; i < xs.size(); ++i) {
        auto after = at(xs[i]);
        if (before != after) {
            double low = xs[i - 1], high = xs[i];
            for (double middle = (low + high) / 2;
                 high - low > 1e-14 && low < middle && middle < high; middle = (low + high) / 2)
                (at(middle) == before ? low : high) = middle;
            found.push_back((low + high) / 2);
        }
        before = std::move(after);
    }
    return found;
}

/// `count` points of the open interval, denser towards both ends.
std::vector<double> looking_points(double begin, double end, int count);

}  // namespace mis
