#include "mis/predict/crossings.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace mis {

namespace {

struct Point {
    double x, y;
};

class LevelSearch {
public:
    LevelSearch(const std::function<double(double)>& f, double level) : f_(f), level_(level) {}

    void between(const Point& a, const Point& b)
    {
        const double ya = a.y - level_, yb = b.y - level_;
        if (!std::isfinite(ya) || !std::isfinite(yb) || (ya < 0) == (yb < 0)) return;
        std::uintmax_t rounds = 60;
        const auto [below, above] = boost::math::tools::toms748_solve(
            [this](double x) { return f_(x) - level_; }, a.x, b.x, ya, yb,
            boost::math::tools::eps_tolerance<double>(46), rounds);
        const double x = (below + above) / 2;
        if (x >= a.x && x <= b.x)
            found.push_back(x);  // not so where it met what is not finite on its way
    }

    /// All three on one side, the middle one nearest: the function may turn beyond the level and
    /// come back.
    void around(const Point& a, const Point& b, const Point& c)
    {
        const double ya = a.y - level_, yb = b.y - level_, yc = c.y - level_;
        const bool one_side = (ya < 0) == (yb < 0) && (yb < 0) == (yc < 0);
        const double gap = std::abs(yb), rise = std::abs(ya - yb) + std::abs(yc - yb);
        if (!std::isfinite(ya + yb + yc) || !one_side || gap > std::abs(ya) || gap > std::abs(yc) ||
            gap > rise)
            return;
        const double side = yb < 0 ? -1 : 1;
        std::uintmax_t rounds = 40;
        const auto [x, y] = boost::math::tools::brent_find_minima(
            [&](double at) {
                const double value = side * (f_(at) - level_);
                return std::isfinite(value) ? value : std::abs(ya);
            },
            a.x, c.x, 24, rounds);
        if (y >= 0) return;
        between(a, {x, side * y + level_});
        between({x, side * y + level_}, c);
    }

    std::vector<double> found;

private:
    const std::function<double(double)>& f_;
    double level_;
};

}  // namespace

std::vector<std::vector<double>> crossings(const std::function<double(double)>& f,
                                           std::span<const double> xs,
                                           std::span<const double> levels)
{
    std::vector<Point> points;
    for (const double x : xs) points.push_back({x, f(x)});
    std::vector<std::vector<double>> all;
    for (const double level : levels) {
        LevelSearch search(f, level);
        for (std::size_t i = 1; i < points.size(); ++i) {
            search.between(points[i - 1], points[i]);
            if (i > 1) search.around(points[i - 2], points[i - 1], points[i]);
        }
        std::sort(search.found.begin(), search.found.end());
        all.push_back(std::move(search.found));
    }
    return all;
}

std::vector<double> looking_points(double begin, double end, int count)
{
    static thread_local std::vector<std::vector<double>> shares;  // by count: asked for often
    if (shares.size() <= static_cast<std::size_t>(count))
        shares.resize(static_cast<std::size_t>(count) + 1);
    std::vector<double>& share = shares[static_cast<std::size_t>(count)];
    for (int i = static_cast<int>(share.size()); i < count; ++i) {
        const double s = std::sin(std::numbers::pi / 2 * i / (count - 1));
        share.push_back(1e-12 + s * s * (1 - 2e-12));
    }
    std::vector<double> points;
    points.reserve(share.size());
    for (const double s : share) points.push_back(begin + (end - begin) * s);
    return points;
}

}  // namespace mis
