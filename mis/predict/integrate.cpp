#include "mis/predict/integrate.h"

#include "mis/predict/crossings.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

/// Rounding of a sum of positive terms.
constexpr double sum_rounding = 4 * std::numeric_limits<double>::epsilon();

class PatchIntegral {
public:
    PatchIntegral(const Patch& patch, Evaluator& evaluator, const Group& group,
                  std::size_t size = 0, const Effort& effort = {})
        : patch_(patch), evaluator_(evaluator), group_(group), effort_(effort),
          size_(size), total_{std::vector<double>(size), std::vector<double>(size)}
    {
        for (const double jump : group.jumps) levels_.push_back(std::log(jump));
    }

    std::vector<double> azimuths()
    {
        return group_.jumps.empty() ? patch_.azimuths() : cut_by_jumps(patch_.azimuths());
    }

    Integrals run(std::span<const double> azimuths)
    {
        for (std::size_t i = 0; i + 1 < azimuths.size(); ++i)
            around(azimuths[i], azimuths[i + 1], -1, 1, 0);
        return std::move(total_);
    }

private:
    /// Room for one level of a recursion.
    struct Room {
        std::vector<double> kronrod, gauss, error;
        void clear(std::size_t size)
        {
            kronrod.assign(size, 0), gauss.assign(size, 0), error.assign(size, 0);
        }
    };

    /// The azimuths from `begin` to `end`, as φ = middle + half · sin(πs/2): at either end a
    /// meridian may touch a circle, where its integral goes as a square root of φ, but smoothly
    /// with s. Here s from `low` to `high`.
    void around(double begin, double end, double low, double high, int depth)
    {
        Room& room = around_room_[static_cast<std::size_t>(depth)];
        room.clear(size_);
        const double middle = (begin + end) / 2, half = (end - begin) / 2;
        for (std::size_t i = 0; i < Rule::nodes; ++i) {
            const double s = (low + high) / 2 + (high - low) / 2 * rule().x[i];
            const double jacobian =
                half * pi<double> / 2 * std::cos(pi<double> / 2 * s) * (high - low) / 2;
            along(middle + half * std::sin(pi<double> / 2 * s));
            const double k = jacobian * rule().kronrod[i], g = jacobian * rule().gauss[i];
            for (std::size_t c = 0; c < size_; ++c) {
                room.kronrod[c] += k * ray_.kronrod[c];
                room.gauss[c] += g * ray_.kronrod[c];
                room.error[c] += k * ray_.error[c];
            }
        }
        if (is_rough(room, 1) && depth < effort_.max_halvings &&
            meridians_ < effort_.max_meridians * std::max<std::size_t>(1, levels_.size())) {
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
            if (std::abs(room.kronrod[c] - room.gauss[c]) > share * effort_.tolerance[c])
                return true;
        return false;
    }

    /// One meridian → ray_.
    void along(double phi)
    {
        ++meridians_;
        ray_.clear(size_);
        patch_.meridian(phi, meridian_);
        for (const Stretch& stretch : meridian_.stretches) {
            double begin = stretch.begin;
            for (const double cut : cuts_of(stretch)) {
                const double rounding = 1e-13 * (stretch.end - stretch.begin);
                if (cut - begin < rounding || stretch.end - cut < rounding) continue;
                along_stretch(stretch, begin, cut, 0);
                begin = cut;
            }
            along_stretch(stretch, begin, stretch.end, 0);
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
            ray_.error[c] += std::abs(room.kronrod[c] - room.gauss[c]) +
                             sum_rounding * std::abs(room.kronrod[c]);
        }
    }

    /// Where to cut a stretch: at the hints, and where the weights jump.
    std::vector<double> cuts_of(const Stretch& stretch)
    {
        std::vector<double> cuts = meridian_.hints;
        if (group_.jumps.empty()) return cuts;
        append(cuts, jumps_along(stretch));
        std::sort(cuts.begin(), cuts.end());
        return cuts;
    }

    /// Where the ratio of the densities crosses each jump of the weights, along a stretch of
    /// meridian_.
    std::vector<std::vector<double>> jumps_along(const Stretch& stretch)
    {
        std::vector<double> looks = looking_points(stretch.begin, stretch.end, 24);
        for (const double hint : meridian_.hints)
            if (hint > looks.front() && hint < looks.back()) looks.push_back(hint);
        std::sort(looks.begin(), looks.end());
        return crossings([&](double theta) { return log_ratio(meridian_, stretch, theta); }, looks,
                         levels_);
    }

    double log_ratio(const Meridian& meridian, const Stretch& stretch, double theta) const
    {
        // At the horizon the BSDF's density may round to 0: far from every jump, and finite.
        return std::clamp(std::log(evaluator_.ratio(meridian.around, theta, stretch, meridian)),
                          -700.0, 700.0);
    }

    /// Adds the azimuths at which a curve of equal ratio leaves a stretch through one of its ends,
    /// or touches a meridian.
    std::vector<double> cut_by_jumps(std::vector<double> azimuths)
    {
        for (std::size_t i = 0, known = azimuths.size(); i + 1 < known; ++i)
            add_leaving(azimuths[i], azimuths[i + 1], azimuths);
        std::sort(azimuths.begin(), azimuths.end());
        const auto counts_at = [&](double phi) {
            patch_.meridian(phi, meridian_);
            std::vector<std::size_t> counts;
            for (const Stretch& stretch : meridian_.stretches)
                for (const auto& of_level : jumps_along(stretch)) counts.push_back(of_level.size());
            return counts;
        };
        for (std::size_t i = 0, known = azimuths.size(); i + 1 < known; ++i) {
            const std::vector<double> more =
                changes(counts_at, looking_points(azimuths[i], azimuths[i + 1], 12));
            azimuths.insert(azimuths.end(), more.begin(), more.end());
        }
        std::sort(azimuths.begin(), azimuths.end());
        const auto same = [](double a, double b) { return b - a < 1e-13; };
        azimuths.erase(std::unique(azimuths.begin(), azimuths.end(), same), azimuths.end());
        return azimuths;
    }

    void add_leaving(double begin, double end, std::vector<double>& azimuths)
    {
        patch_.meridian((begin + end) / 2, meridian_);
        const std::size_t stretches = meridian_.stretches.size();
        if (stretches == 0) return;
        const std::vector<double> looks = looking_points(begin, end, 16);
        std::vector<Meridian> seen(looks.size());  // every end of a stretch is looked at in these
        for (std::size_t i = 0; i < looks.size(); ++i) patch_.meridian(looks[i], seen[i]);
        const auto meridian_at = [&](double phi) -> const Meridian& {
            const auto found = std::lower_bound(looks.begin(), looks.end(), phi);
            if (found != looks.end() && *found == phi)
                return seen[static_cast<std::size_t>(found - looks.begin())];
            patch_.meridian(phi, meridian_);
            return meridian_;
        };
        for (std::size_t k = 0; k < 2 * stretches; ++k) {
            const auto ratio_at_end = [&](double phi) {
                const Meridian& meridian = meridian_at(phi);
                if (meridian.stretches.size() != stretches) return nan;
                const Stretch& stretch = meridian.stretches[k / 2];
                return log_ratio(meridian, stretch, k % 2 == 0 ? stretch.begin : stretch.end);
            };
            append(azimuths, crossings(ratio_at_end, looks, levels_));
        }
    }

    const Patch& patch_;
    Evaluator& evaluator_;
    const Group& group_;
    Effort effort_;
    std::size_t size_;
    Integrals total_;
    std::vector<double> levels_;  ///< of the log ratio
    std::size_t meridians_ = 0;
    Meridian meridian_;
    Nodes nodes_;
    Room ray_;
    std::array<Room, 64> around_room_, along_room_;
};

}  // namespace

Integrals integrate(const Patch& patch, Evaluator& evaluator, const Group& group,
                    std::span<const double> azimuths, std::size_t size, const Effort& effort)
{
    return PatchIntegral(patch, evaluator, group, size, effort).run(azimuths);
}

std::vector<double> azimuths_of(const Patch& patch, Evaluator& evaluator, const Group& group)
{
    return PatchIntegral(patch, evaluator, group).azimuths();
}

}  // namespace mis
