#include "mis/study/mean_checks.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

/// A variance that is known worse, relatively, is no error to go by.
constexpr double worst_known = 0.3;

/// Sums over some of the points.
struct MeanSums {
    double mean = 0, variance = 0, variance_se2 = 0, points = 0;

    void add(const MeanSums& more)
    {
        mean += more.mean, points += more.points;
        variance += more.variance, variance_se2 += more.variance_se2;
    }
    /// The own error is what it may well be, as the variance is an estimate, too. has_own_error: by
    /// own samples, which may tell the mean far better than shared directions do.
    void put_into(MeanCheck& check, double of, bool has_own_error) const
    {
        const double se = std::sqrt(variance_se2);
        check.own = mean / of;
        check.own_se = std::sqrt(std::max(variance, 0.0)) / of;
        check.is_testable = !has_own_error && se <= worst_known * variance;
    }
};

}  // namespace

std::vector<MeanCheck> mean_checks(const StrategyRun& run, const StudyPoints& points,
                                   const SharedTurns& shared, std::optional<std::size_t> place)
{
    std::vector<MeanSums> regions(points.regions);
    MeanSums image;
    for (std::size_t t = 0; t < points.figure_tiles; ++t) {
        const Tile& tile = points.shading.tiles[t];
        MeanSums of_tile;
        for (std::size_t p = tile.first; p < tile.first + tile.count; ++p) {
            const Moments& own = run.results()[p].luminance;
            const auto samples = static_cast<double>(std::max<std::uint64_t>(own.count, 1));
            const ValueAndError variance =
                place ? shared.at(*place, p) : ValueAndError{own.variance(), own.variance_se()};
            of_tile.add(
                {own.mean, variance.value / samples, std::pow(variance.se / samples, 2), 1});
        }
        regions[points.region_of(t)].add(of_tile);
        image.add(of_tile);
    }
    std::vector<MeanCheck> checks = shared.right_means();
    image.put_into(checks.front(), static_cast<double>(points.figure_points), !place);
    for (std::size_t r = 0; r < regions.size(); ++r)
        regions[r].put_into(checks[r + 1], regions[r].points, !place);
    return checks;
}

}  // namespace mis
