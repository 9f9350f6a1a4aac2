#pragma once

#include "mis/math/vec.h"
#include "mis/scene/shading_point.h"
#include "mis/trace/beam.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace mis {

/// A ball; scene units.
struct BoundingBall {
    Vec3<double> center{0};
    double radius = 0;
};

/// The points of a tile in up to sixteen balls: what is seen from each of them is much less than
/// what is seen from the ball around them all.
class TileParts {
public:
    static constexpr std::size_t most = Beams::most;

    /// points: at least one.
    explicit TileParts(std::span<const ShadingPoint> points);

    std::span<const BoundingBall> balls() const { return std::span(balls_).first(count_); }
    /// The ball around them all.
    const BoundingBall& around() const { return around_; }

    /// A ball that holds x, looked for at `guess` first; balls().size() where there is none.
    std::size_t holding(const Vec3<double>& x, std::size_t guess) const
    {
        if (guess < count_ && holds(balls_[guess], x)) return guess;
        std::size_t k = 0;
        while (k < count_ && !holds(balls_[k], x)) ++k;
        return k;
    }

private:
    static bool holds(const BoundingBall& ball, const Vec3<double>& x)
    {
        return length(x - ball.center) <= ball.radius;
    }

    std::array<BoundingBall, most> balls_;
    std::size_t count_ = 0;
    BoundingBall around_;
};

}  // namespace mis
