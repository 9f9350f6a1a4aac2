#include "mis/predict/integrate.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

namespace mis {

namespace {

/// Rounding of a sum of positive terms.
constexpr double sum_rounding = 4 * std::numeric_limits<double>::epsilon();

class PatchIntegral {
public:
    PatchIntegral(const Patch& patch, Evaluator& evaluator, const Group& group, std::size_t size, const Effort& effort)
        : patch_(patch), evaluator_(evaluator), group_(group), effort_(effort), size_(size),
          total_{std::vector<double>(size), std::vector<double>(size)}
    {
    }

    Integrals run()
    {
        const std::vector<double> azimuths = patch_.azimuths();
        for (std::size_t i = 0; i + 1 < azimuths.size(); ++i)
            around(azimuths[i], azimuths[i + 1], -1, 1, 0);
        return std::move(total_);
    }

private:
    /// Room for one level of a recursion.
    struct Room {
        std::vector<double> kronrod, gauss, error;
        void clear(std::size_t size) { kronrod.assign(size, 0), gauss.assign(size, 0), error.assign(size, 0); }
    };

    /// The azimuths from `begin` to `end`, as φ = middle + half · sin(πs/2): at either end a meridian may touch a
    /// circle, where its integral goes as a square root of φ, but smoothly with s. Here s from `low` to `high`.
    void around(double begin, double end, double low, double high, int depth)
    {
        Room& room = around_room_[static_cast<std::size_t>(depth)];
        room.clear(size_);
        const double middle = (begin + end) / 2, half = (end - begin) / 2;
        for (std::size_t i = 0; i < Rule::nodes; ++i) {
            const double s = (low + high) / 2 + (high - low) / 2 * rule().x[i];
            const double jacobian = half * pi<double> / 2 * std::cos(pi<double> / 2 * s) * (high - low) / 2;
            along(middle + half * std::sin(pi<double> / 2 * s));
            const double k = jacobian * rule().kronrod[i], g = jacobian * rule().gauss[i];
            for (std::size_t c = 0; c < size_; ++c) {
                room.kronrod[c] += k * ray_.kronrod[c];
                room.gauss[c] += g * ray_.kronrod[c];
                room.error[c] += k * ray_.error[c];
            }
        }
        if (is_rough(room, 1) && depth < effort_.max_halvings && meridians_ < effort_.max_meridians) {
            around(begin, end, low, (low + high) / 2, depth + 1);
            around(begin, end, (low + high) / 2, high, depth + 1);
            return;
        }
        for (std::size_t c = 0; c < size_; ++c) {
            total_.value[c] += room.kronrod[c];
            total_.error[c] += room.error[c] + std::abs(room.kronrod[c] - room.gauss[c]) +
                               sum_rounding * std::abs(room.kronrod[c]);
        }
    }

    bool is_rough(const Room& room, double share) const
    {
        if (effort_.tolerance.empty()) return false;
        for (std::size_t c = 0; c < size_; ++c)
            if (std::abs(room.kronrod[c] - room.gauss[c]) > share * effort_.tolerance[c]) return true;
        return false;
    }

    /// One meridian → ray_.
    void along(double phi)
    {
        ++meridians_;
        ray_.clear(size_);
        patch_.meridian(phi, meridian_);
        for (const Stretch& stretch : meridian_.stretches) {
            if (group_.jumps.empty()) along_stretch(stretch, stretch.begin, stretch.end, 0);
            else along_pieces(stretch);
        }
    }

    void along_stretch(const Stretch& stretch, double begin, double end, int depth)
    {
        Room& room = along_room_[static_cast<std::size_t>(depth)];
        room.clear(size_);
        Nodes& nodes = nodes_;
        nodes.place(begin, end);
        evaluator_.look(meridian_.around, stretch.nearest, nodes);
        evaluator_.add(nodes, stretch, meridian_, room.kronrod, room.gauss);
        if (is_rough(room, 0.05) && depth < effort_.max_halvings) {
            along_stretch(stretch, begin, (begin + end) / 2, depth + 1);
            along_stretch(stretch, (begin + end) / 2, end, depth + 1);
            return;
        }
        for (std::size_t c = 0; c < size_; ++c) {
            ray_.kronrod[c] += room.kronrod[c];
            ray_.error[c] += std::abs(room.kronrod[c] - room.gauss[c]) + sum_rounding * std::abs(room.kronrod[c]);
        }
    }

    /// The same, cut where the ratio of the densities crosses a jump of the weights.
    void along_pieces(const Stretch& stretch)
    {
        const std::vector<double> cuts = crossings(stretch);
        double begin = stretch.begin;
        for (const double cut : cuts) {
            along_stretch(stretch, begin, cut, 0);
            begin = cut;
        }
        along_stretch(stretch, begin, stretch.end, 0);
    }

    std::vector<double> crossings(const Stretch& stretch)
    {
        const auto log_ratio = [&](double theta) {
            return std::log(evaluator_.ratio(meridian_.around, theta, stretch, meridian_));
        };
        constexpr int steps = 24;
        const double length = stretch.end - stretch.begin;
        // Denser towards both ends, where lobes have their peaks.
        const auto theta_of = [&](int i) {
            const double s = std::sin(pi<double> / 2 * i / steps);
            return i == steps ? stretch.end - 1e-12 * length : stretch.begin + length * (1e-12 + s * s * (1 - 2e-12));
        };
        std::vector<double> cuts;
        double theta = theta_of(0), value = log_ratio(theta);
        for (int i = 1; i <= steps; ++i) {
            const double next = theta_of(i), next_value = log_ratio(next);
            for (const double jump : group_.jumps) {
                const double level = std::log(jump);
                if (!(std::isfinite(value) && std::isfinite(next_value)) || (value < level) == (next_value < level)) continue;
                std::uintmax_t rounds = 60;
                const auto [below, above] = boost::math::tools::toms748_solve(
                    [&](double t) { return log_ratio(t) - level; }, theta, next, value - level, next_value - level,
                    boost::math::tools::eps_tolerance<double>(46), rounds);
                const double cut = (below + above) / 2;
                if (cut - stretch.begin > 1e-13 * length && stretch.end - cut > 1e-13 * length) cuts.push_back(cut);
            }
            theta = next, value = next_value;
        }
        std::sort(cuts.begin(), cuts.end());
        return cuts;
    }

    const Patch& patch_;
    Evaluator& evaluator_;
    const Group& group_;
    const Effort& effort_;
    std::size_t size_;
    Integrals total_;
    std::size_t meridians_ = 0;
    Meridian meridian_;
    Nodes nodes_;
    Room ray_;
    std::array<Room, 64> around_room_, along_room_;
};

}  // namespace

Integrals integrate(const Patch& patch, Evaluator& evaluator, const Group& group, std::size_t size,
                    const Effort& effort)
{
    return PatchIntegral(patch, evaluator, group, size, effort).run();
}

}  // namespace mis
