#include "mis/predict/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {

// What one meridian of a patch meets.

namespace {

/// Adds the θ between two others, in (0, π), where tan θ = rise/run.
class Between {
public:
    Between(double begin, double end, std::vector<double>& angles)
        : cos_begin_(std::cos(begin)), sin_begin_(std::sin(begin)), cos_end_(std::cos(end)),
          sin_end_(std::sin(end)), angles_(angles)
    {
    }
    void add(double rise, double run)
    {
        if (rise < 0) rise = -rise, run = -run;
        if (rise * cos_begin_ > run * sin_begin_ && rise * cos_end_ < run * sin_end_)
            angles_.push_back(std::atan2(rise, run));
    }

private:
    double cos_begin_, sin_begin_, cos_end_, sin_end_;
    std::vector<double>& angles_;
};

/// θ where cos²θ·oo + 2 sin θ cos θ·oe + sin²θ·ee = 0.
void add_roots(double oo, double oe, double ee, Between& between)
{
    const double root2 = oe * oe - oo * ee;
    if (root2 < 0) return;
    const double s = -(oe + std::copysign(std::sqrt(root2), oe));
    between.add(s, ee);
    between.add(oo, s);
}

/// Does `next` meet the same things as the last stretch, and begin where that ends?
bool goes_on(const Meridian& meridian, const Stretch& next)
{
    if (meridian.stretches.empty()) return false;
    const Stretch& last = meridian.stretches.back();
    const auto things = [&](const Stretch& stretch) {
        return std::span(meridian.along).subspan(stretch.first_along, stretch.along);
    };
    return last.end == next.begin && last.nearest == next.nearest &&
           std::ranges::equal(things(last), things(next));
}

}  // namespace

double Patch::distance_to_wall(int index, const Vec3<double>& offset) const
{
    const Ball& ball = sky_->ball(index);
    const Vec3<double> w = polar_.pole + offset;
    const double along = dot(ball.to_center, w), q = length(cross(ball.to_center, w));
    return std::max(0.0, along + std::sqrt(std::max(0.0, (ball.radius - q) * (ball.radius + q))));
}

double Patch::distance_to_cap(std::size_t circle, const Vec3<double>& offset) const
{
    const Ball& ball = sky_->ball(circles_[circle].ball);
    if (ball.stands == Ball::Stands::beneath) return 0;
    const double half_chord2 =
        length2(offset - deltas_[circle]) / 2;  // 1 − cos of the angle to the axis
    const double sin2 = half_chord2 * (2 - half_chord2);
    const double rest = std::sqrt(std::max(0.0, ball.sin_max * ball.sin_max - sin2));
    return ball.cap.gap2 / (ball.cap.distance * (1 - half_chord2 + rest));
}

/// Which circles hold the direction at θ? False if it is not this patch's.
bool Patch::find_held(double theta, const std::vector<Chord>& chords, std::vector<char>& held) const
{
    const double tau = std::tan(theta / 2);
    for (std::size_t i = 0; i < chords.size(); ++i) {
        held[i] = chords[i].holds(tau);
        if (i <= horizon ? !held[i] : held[i] && smaller_[i]) return false;
    }
    return true;
}

/// Where two interlocked balls that both stand there change places (docs/theory-predict.md, P15).
void Patch::add_swaps(const Vec3<double>& around, double begin, double end,
                      const std::vector<char>& held, std::vector<double>& breaks) const
{
    if (interlocked_.empty()) return;
    Between between(begin, end, breaks);
    const auto stands = [&](int which) {
        return which < 0 || held[static_cast<std::size_t>(which)] != 0;
    };
    for (const Pair& p : interlocked_) {
        if (!stands(p.first) || !stands(p.second)) continue;
        const double me = dot(p.m, around), ce = dot(p.center, around);
        add_roots(p.h * p.h - 2 * p.h * p.mo * p.co + p.gap * p.mo * p.mo,
                  -p.h * (p.mo * ce + me * p.co) + p.gap * p.mo * me,
                  p.h * p.h - 2 * p.h * me * ce + p.gap * me * me, between);
        between.add(p.mo, -me);
    }
    std::sort(breaks.begin(), breaks.end());
}

void Patch::add_hints(double high, Meridian& out) const
{
    if (pole_is_lobe_) {
        for (double theta = lobe_.width; theta < high; theta *= 4) out.hints.push_back(theta);
    } else if (lobe_.is_narrower_than(1)) {
        out.hints.push_back(
            std::atan2(dot(lobe_.direction, out.around), dot(lobe_.direction, polar_.pole)));
    }
}

bool Patch::describe(double theta, const std::vector<char>& held, Meridian& out,
                     Stretch& stretch) const
{
    const Vec3<double> offset = polar_.offset(out.around, theta);
    double nearest = std::numeric_limits<double>::infinity();
    stretch.nearest = -1;
    const auto meet = [&](double t, int ball, int local) {
        if (t > nearest || (t == nearest && ball > stretch.nearest)) return;
        nearest = t, stretch.nearest = ball, stretch.nearest_local = local;
    };
    stretch.first_along = out.along.size();
    for (std::size_t i = 0; i < circles_.size(); ++i) {
        if (i == horizon || !held[i]) continue;
        if (local_of_circle_[i] >= 0) out.along.push_back(local_of_circle_[i]);
        meet(distance_to_cap(i, offset), circles_[i].ball, local_of_circle_[i]);
    }
    for (const int wall : walls_) meet(distance_to_wall(wall, offset), wall, -1);
    stretch.along = out.along.size() - stretch.first_along;
    return sky_->ball(stretch.nearest).shines();
}

/// What is met between two ends of chords: the same balls all along, in orders that may change.
void Patch::add_stretches(double begin, double end, const std::vector<char>& held,
                          Meridian& out) const
{
    std::vector<double> breaks{begin};
    add_swaps(out.around, begin, end, held, breaks);
    breaks.push_back(end);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i + 1] - breaks[i] > 1e-15 * end)) continue;
        Stretch stretch{.begin = breaks[i], .end = breaks[i + 1]};
        if (!describe((breaks[i] + breaks[i + 1]) / 2, held, out, stretch)) continue;
        if (goes_on(out, stretch)) out.stretches.back().end = stretch.end;
        else out.stretches.push_back(stretch);
    }
}

void Patch::meridian(double phi, Meridian& out) const
{
    stop_.check();
    const double cos_phi = std::cos(phi), sin_phi = std::sin(phi);
    out.around = polar_.e1 * cos_phi + polar_.e2 * sin_phi;
    out.stretches.clear(), out.along.clear(), out.hints.clear();
    std::vector<Chord> chords(circles_.size());
    for (std::size_t i = 0; i < circles_.size(); ++i)
        chords[i] = circles_[i].chord(cos_phi, sin_phi);
    // Both ends of the own cap; all of it where it holds the antipode of the pole.
    const bool reaches_round = chords[own].inverted;
    const double low = reaches_round ? 0 : 2 * std::atan(std::max(0.0, chords[own].low));
    const double high = reaches_round ? pi<double> : 2 * std::atan(std::max(0.0, chords[own].high));
    if (!(low < high)) return;
    std::vector<double> breaks{low};
    for (const Chord& chord : chords)
        for (const double tau : {chord.low, chord.high})
            if (tau > 0 && (reaches_round || (tau >= chords[own].low && tau <= chords[own].high)))
                if (const double theta = 2 * std::atan(tau); theta > low && theta < high)
                    breaks.push_back(theta);
    std::sort(breaks.begin(), breaks.end());
    breaks.push_back(high);
    std::vector<char> held(circles_.size());
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        if (breaks[i + 1] - breaks[i] > 1e-15 * high &&
            find_held((breaks[i] + breaks[i + 1]) / 2, chords, held))
            add_stretches(breaks[i], breaks[i + 1], held, out);
    add_hints(high, out);
}

}  // namespace mis
