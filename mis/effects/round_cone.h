#pragma once

#include "mis/math/vec.h"

#include <cmath>

namespace mis {

/// The convex hull of two balls: all that lies between points of the one and points of the other.
class RoundCone {
public:
    /// Centres in scene units, radii ≥ 0.
    RoundCone(const Vec3<double>& from, double from_radius, const Vec3<double>& to,
              double to_radius)
        : from_(from), to_(to), from_radius_(from_radius), to_radius_(to_radius),
          length_(length(to - from))
    {
        if (!(std::abs(from_radius - to_radius) < length_)) return;  // one ball holds the other
        is_cone_ = true;
        sine_ = (from_radius - to_radius) / length_;
        axis_ = (to - from) / length_;
        cosine_ = std::sqrt((1 - sine_) * (1 + sine_));
    }

    /// How far p is outside it; negative inside. In the plane of p and the axis the side is a
    /// straight line, whose normal leans by the arc of `sine_` (the sides are tangent to both
    /// balls).
    double distance(const Vec3<double>& p) const
    {
        if (!is_cone_)
            return from_radius_ > to_radius_ ? length(p - from_) - from_radius_
                                             : length(p - to_) - to_radius_;
        const Vec3<double> to_p = p - from_;
        const double along = dot(to_p, axis_), across = length(to_p - axis_ * along);
        const double foot = along * cosine_ - across * sine_;  // of p on the axis, times the cosine
        if (foot <= 0) return length(to_p) - from_radius_;
        if (foot >= length_ * cosine_) return length(p - to_) - to_radius_;
        return across * cosine_ + along * sine_ - from_radius_;
    }

private:
    Vec3<double> from_, to_, axis_{0};
    double from_radius_, to_radius_, length_, sine_ = 0, cosine_ = 1;
    bool is_cone_ = false;
};

}  // namespace mis
