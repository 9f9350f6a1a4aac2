#include "mis/effects/shaft.h"

#include <algorithm>
#include <limits>

namespace mis {

namespace {

/// The point of the shaft that lies furthest along the unit direction d.
Vec3<double> furthest(const Shaft& shaft, const Vec3<double>& d)
{
    Vec3<double> corner;
    for (int axis = 0; axis < 3; ++axis)
        corner[axis] = d[axis] > 0 ? shaft.high[axis] : shaft.low[axis];
    const Vec3<double> on_ball = shaft.center + d * shaft.radius;
    return dot(corner, d) > dot(on_ball, d) ? corner : on_ball;
}

/// furthest_back(d): the point of the other body that lies least far along the unit direction d;
/// start: from a point of the shaft to one of that body.
template <class FurthestBack>
bool is_apart(const Shaft& shaft, const Vec3<double>& start, double margin,
              const FurthestBack& furthest_back)
{
    constexpr int most_steps = 24;
    Vec3<double> nearest = start;  // of the difference's points so far, to 0
    for (int step = 0; step < most_steps; ++step) {
        const double distance = length(nearest);
        if (!(distance > margin)) return false;
        const Vec3<double> d = nearest / distance;
        const Vec3<double> corner = furthest_back(d) - furthest(shaft, d);
        if (dot(corner, d) > margin) return true;
        const Vec3<double> edge = corner - nearest;
        const double edge2 = length2(edge);
        if (!(edge2 > 0)) return false;
        nearest += edge * std::clamp(-dot(nearest, edge) / edge2, 0.0, 1.0);
    }
    return false;
}

}  // namespace

bool is_clear_of(const Shaft& shaft, std::span<const Vec3<double>> hull, double margin)
{
    Vec3<double> middle(0);
    for (const Vec3<double>& p : hull) middle += p / static_cast<double>(hull.size());
    return is_apart(shaft, middle - shaft.middle(), margin, [&](const Vec3<double>& d) {
        return *std::min_element(hull.begin(), hull.end(), [&](const auto& a, const auto& b) {
            return dot(a, d) < dot(b, d);
        });
    });
}

bool is_clear_of(const Shaft& shaft, const Vec3<double>& center, double radius, double margin)
{
    return is_apart(shaft, center - shaft.middle(), margin,
                    [&](const Vec3<double>& d) { return center - d * radius; });
}

}  // namespace mis
