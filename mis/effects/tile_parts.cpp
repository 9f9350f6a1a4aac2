#include "mis/effects/tile_parts.h"

#include <algorithm>

namespace mis {

namespace {

using Points = std::span<Vec3<double>>;

struct Part {
    Points points;
    Vec3<double> low, high;

    explicit Part(Points some) : points(some), low(some[0]), high(some[0])
    {
        for (const Vec3<double>& x : points) low = min(low, x), high = max(high, x);
    }
    double size2() const { return length2(high - low); }
    /// In the middle of the box.
    BoundingBall ball() const
    {
        BoundingBall ball{0.5 * (low + high), 0};
        for (const Vec3<double>& x : points)
            ball.radius = std::max(ball.radius, length(x - ball.center));
        return ball;
    }
    /// Cut across its longest side; how many points go to the first half.
    std::size_t cut() const
    {
        const Vec3<double> extent = high - low;
        const int yz = extent.y >= extent.z ? 1 : 2, axis = extent.x >= extent[yz] ? 0 : yz;
        const double middle = low[axis] + 0.5 * extent[axis];
        const auto second = std::partition(points.begin(), points.end(),
                                           [&](const auto& x) { return x[axis] <= middle; });
        return static_cast<std::size_t>(second - points.begin());
    }
};

}  // namespace

/// The largest is cut in two, as long as there is room.
TileParts::TileParts(std::span<const ShadingPoint> points)
{
    std::vector<Vec3<double>> x;
    for (const ShadingPoint& point : points) x.push_back(point.x);
    std::vector<Part> parts{Part(x)};
    around_ = parts[0].ball();
    while (parts.size() < most) {
        const auto largest =
            std::max_element(parts.begin(), parts.end(),
                             [](const Part& a, const Part& b) { return a.size2() < b.size2(); });
        const Points all = largest->points;
        const std::size_t first = largest->cut();
        if (first == all.size()) break;  // all of them in one place
        *largest = Part(all.first(first));
        parts.insert(largest + 1, Part(all.subspan(first)));  // neighbours stay together
    }
    for (const Part& part : parts) balls_[count_++] = part.ball();
}

}  // namespace mis
