#pragma once

#include <functional>
#include <span>
#include <vector>

namespace mis {

/// Where a continuous function crosses some levels: of each level by itself, ascending, to some 14
/// digits. It is looked at in the points xs (ascending); pairs of crossings between two of them are
/// found where the function turns towards a level there. Where it is not finite it crosses nothing.
std::vector<std::vector<double>> crossings(const std::function<double(double)>& f,
                                           std::span<const double> xs,
                                           std::span<const double> levels);

/// Adds the numbers of all lists.
inline void append(std::vector<double>& all, const std::vector<std::vector<double>>& lists)
{
    for (const std::vector<double>& list : lists) all.insert(all.end(), list.begin(), list.end());
}

/// Where what at(x) says changes between neighbours among the points xs (ascending), found by
/// halving.
template <class At> std::vector<double> changes(const At& at, std::span<const double> xs)
{
    std::vector<double> found;
    auto before = at(xs.front());
    for (std::size_t i = 1; i < xs.size(); ++i) {
        const auto after = at(xs[i]);
        double low = xs[i - 1];
        // The first change, then what is left; of what changes all the time, some.
        for (int more = 8; more > 0 && before != after && low < xs[i]; --more) {
            double high = xs[i];
            for (double middle = (low + high) / 2;
                 high - low > 1e-14 && low < middle && middle < high; middle = (low + high) / 2)
                (at(middle) == before ? low : high) = middle;
            found.push_back((low + high) / 2);
            before = at(low = high);
        }
        before = after;
    }
    return found;
}

/// `count` points of the open interval, denser towards both ends.
std::vector<double> looking_points(double begin, double end, int count);

}  // namespace mis
