#pragma once

#include "mis/math/frame.h"
#include "tests/support/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace mis {

/// The directions above the horizon (z > 0), cut into cells about an axis: rings whose widths grow
/// in geometric steps from the axis outwards, each cut into sectors. A histogram for lobes however
/// narrow, and a quadrature rule.
class PolarGrid {
public:
    /// narrowest: angle of the innermost ring, radians.
    PolarGrid(const Vec3<double>& axis, double narrowest, int rings = 24, int sectors = 12)
        : frame_(frame_around(axis)), sectors_(sectors)
    {
        const double growth = std::pow(std::numbers::pi / narrowest, 1.0 / (rings - 1));
        angles_.push_back(0);
        for (int ring = 0; ring < rings; ++ring)
            angles_.push_back(narrowest * std::pow(growth, ring));
        angles_.back() = std::numbers::pi;
    }

    std::size_t size() const { return (angles_.size() - 1) * static_cast<std::size_t>(sectors_); }

    /// The cell that holds a unit direction.
    std::size_t cell(const Vec3<double>& w) const
    {
        const Vec3<double> local = frame_.to_local(w);
        const double angle = std::atan2(std::hypot(local.x, local.y), local.z);
        double phi = std::atan2(local.y, local.x) / (2 * std::numbers::pi);
        phi = phi < 0 ? phi + 1 : phi;
        const auto ring =
            std::upper_bound(angles_.begin() + 1, angles_.end() - 1, angle) - angles_.begin() - 1;
        const int sector = std::min(static_cast<int>(phi * sectors_), sectors_ - 1);
        return static_cast<std::size_t>(ring) * static_cast<std::size_t>(sectors_) +
               static_cast<std::size_t>(sector);
    }

    /// ∫ f(direction) dω over the part of each cell that lies above the horizon.
    template <class F> auto integrals(const F& f) const
    {
        using Value = std::decay_t<decltype(f(Vec3<double>{}))>;
        std::vector<Value> result(size(), Value(0));
        for (std::size_t ring = 0; ring + 1 < angles_.size(); ++ring)
            for (int s = 0; s < sectors_; ++s) {
                const double step = 2 * std::numbers::pi / sectors_;
                // Two halves: the horizon's course through a sector is smooth, but bends.
                Value& sum =
                    result[ring * static_cast<std::size_t>(sectors_) + static_cast<std::size_t>(s)];
                for (int half = 0; half < 2; ++half)
                    sum += integral<6>(
                        (s + 0.5 * half) * step, (s + 0.5 * half + 0.5) * step, [&](double phi) {
                            return along_meridian(angles_[ring], angles_[ring + 1], phi, f);
                        });
            }
        return result;
    }

    template <class F> auto whole(const F& f) const
    {
        const auto cells = integrals(f);
        std::decay_t<decltype(cells[0])> sum(0);
        for (const auto& c : cells) sum += c;
        return sum;
    }

private:
    /// ∫ f sin θ dθ over the part of [low, high] above the horizon, at one azimuth.
    template <class F> auto along_meridian(double low, double high, double phi, const F& f) const
    {
        const Vec3<double> across = frame_.x * std::cos(phi) + frame_.y * std::sin(phi);
        // z = frame_.z.z cos θ + across.z sin θ is positive within π/2 of its peak.
        const double peak = std::atan2(across.z, frame_.z.z), right = std::numbers::pi / 2;
        const double turn = peak + right < 0 ? 2 * std::numbers::pi : 0;
        const double a = std::max(low, peak - right + turn),
                     b = std::min(high, peak + right + turn);
        std::decay_t<decltype(f(across))> none(0);
        if (!(a < b)) return none;
        return integral<10>(a, b, [&](double theta) {
            return f(frame_.z * std::cos(theta) + across * std::sin(theta)) * std::sin(theta);
        });
    }

    Frame<double> frame_;
    int sectors_;
    std::vector<double> angles_;
};

}  // namespace mis
