#include "mis/predict/patch.h"

#include "mis/predict/crossings.h"
#include "mis/predict/predict.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

constexpr std::size_t own = 0, horizon = 1;

/// Close to a cap that is wider than the lobe, the lobe's peak is the better pole.
bool lobe_is_better_pole(const Ball& ball, const Lobe& lobe)
{
    const double half_angle = 2 * std::asin(std::min(1.0, std::sqrt(ball.one_minus_cos / 2)));
    const double away = 2 * std::asin(std::min(1.0, length(lobe.direction - ball.cap.axis) / 2));
    return lobe.is_narrower_than(std::min(half_angle, 0.5)) && away < half_angle + 30 * lobe.width;
}

bool is_smaller(const Ball& a, const Ball& b)
{
    return a.one_minus_cos < b.one_minus_cos ||
           (a.one_minus_cos == b.one_minus_cos && a.light < b.light);
}

/// θ in (0, π) where cos²θ·oo + 2 sin θ cos θ·oe + sin²θ·ee = 0.
void add_roots(double oo, double oe, double ee, std::vector<double>& angles)
{
    const double root2 = oe * oe - oo * ee;
    if (root2 < 0) return;
    const double s = -(oe + std::copysign(std::sqrt(root2), oe));
    for (const double angle : {std::atan2(s, ee), std::atan2(oo, s)}) {  // of tan θ = s/ee and oo/s
        angles.push_back(angle < 0 ? angle + pi<double> : angle);
    }
}

/// What a meridian meets, in order: the nearest light of each stretch and all along it.
std::vector<int> things_of(const Meridian& meridian)
{
    std::vector<int> things;
    for (const Stretch& stretch : meridian.stretches) {
        things.push_back(-1 - stretch.nearest);
        for (std::size_t a = 0; a < stretch.along; ++a)
            things.push_back(meridian.along[stretch.first_along + a]);
    }
    return things;
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

/// Directions from the origin to the points where the surfaces of two spheres meet just where one
/// of them ends for the eye: the curve of equal distance starts there. `ends`: the one that ends.
std::array<Vec3<double>, 2> rims_in_common(const Ball& ends, const Ball& other)
{
    // On the polar plane of the origin, p·c = d² − r², the plane of both spheres, p·m = h, and the
    // sphere.
    const Vec3<double> m = (other.to_center - ends.to_center) * 2.0;
    const double gap = ends.cap.gap2, h = other.cap.gap2 - gap;
    const Vec3<double> along = cross(ends.to_center, m);
    const double size2 = length2(along);
    const Vec3<double> none(std::numeric_limits<double>::quiet_NaN());
    if (!(size2 > 0)) return {none, none};
    const Vec3<double> foot = (cross(m, along) * gap + cross(along, ends.to_center) * h) / size2;
    const Vec3<double> away = foot - ends.to_center;
    const double b = dot(along, away) / size2,
                 c = (length2(away) - ends.radius * ends.radius) / size2;
    if (!(b * b - c >= 0)) return {none, none};
    const double root = std::sqrt(b * b - c);
    return {normalized(foot + along * (root - b)), normalized(foot - along * (root + b))};
}

}  // namespace

Patch::Patch(const Sky& sky, int light, std::span<const int> neighbours, const Lobe& lobe,
             const std::atomic<bool>* stop)
    : sky_(&sky), light_(light), polar_(sky.ball(light).cap.axis), lobe_(lobe), stop_(stop)
{
    const Ball& ball = sky.ball(light);
    pole_is_lobe_ = lobe_is_better_pole(ball, lobe);
    if (pole_is_lobe_) polar_ = Polar(lobe.direction);
    add_circle(light);
    circles_.push_back(Circle::of_half(polar_, sky.n, -1));
    deltas_.push_back(sky.n - polar_.pole);
    local_of_circle_.push_back(-1), smaller_.push_back(false);
    for (const int neighbour : neighbours) add_circle(neighbour);
    add_pairs();
    azimuths_ = all_azimuths();
}

void Patch::add_circle(int index)
{
    const Ball& self = sky_->ball(light_);
    const Ball& ball = sky_->ball(index);
    if (ball.stands == Ball::Stands::around) {
        walls_.push_back(index);
        return;
    }
    const Vec3<double> delta = pole_is_lobe_     ? ball.cap.axis - polar_.pole
                               : index == light_ ? Vec3<double>(0)
                                                 : between_axes(self, ball);
    circles_.push_back(
        ball.stands == Ball::Stands::beneath
            ? Circle::of_half(polar_, ball.cap.axis, index)
            : Circle::of_cap(polar_, delta, ball.one_minus_cos, ball.sin_max, index));
    deltas_.push_back(delta);
    smaller_.push_back(ball.is_light() && index != light_ && is_smaller(ball, self));
    local_of_circle_.push_back(ball.is_light() ? static_cast<int>(lights_.size()) : -1);
    if (ball.is_light()) lights_.push_back(index);
}

void Patch::add_pairs()
{
    std::vector<int> solid = walls_;
    for (const Circle& circle : circles_)
        if (circle.ball >= 0 && sky_->ball(circle.ball).stands == Ball::Stands::apart)
            solid.push_back(circle.ball);
    for (std::size_t i = 0; i < solid.size(); ++i)
        for (std::size_t k = i + 1; k < solid.size(); ++k)
            if (interlock(sky_->ball(solid[i]), sky_->ball(solid[k])))
                interlocked_.push_back({solid[i], solid[k]});
}

std::vector<double> Patch::all_azimuths() const
{
    std::vector<double> breaks = known_azimuths();
    if (interlocked_.empty()) return breaks;
    // Interlocked spheres make a meridian meet other things than its neighbour does at azimuths of
    // no simple formula.
    Meridian found;
    const auto things_at = [&](double phi) {
        meridian(phi, found);
        return things_of(found);
    };
    for (std::size_t i = 0, known = breaks.size(); i + 1 < known; ++i) {
        const std::vector<double> more =
            changes(things_at, looking_points(breaks[i], breaks[i + 1], 24));
        breaks.insert(breaks.end(), more.begin(), more.end());
    }
    std::sort(breaks.begin(), breaks.end());
    return breaks;  // two may all but agree: the interval between them weighs nothing
}

std::vector<double> Patch::known_azimuths() const
{
    std::vector<double> all;
    const auto add = [&](double phi) { all.push_back(std::remainder(phi, two_pi<double>)); };
    const auto add_point = [&](const PlanePoint& point) {
        if (!std::isfinite(point.phi)) return;
        const Chord chord = circles_[own].chord(point.phi);
        constexpr double rounding = 1e-6;  // a break too many is harmless
        if (chord.inverted ||
            (point.tau > chord.low * (1 - rounding) && point.tau < chord.high * (1 + rounding)))
            add(point.phi);
    };
    const bool looks_from_lobe = pole_is_lobe_ || !lobe_.is_narrower_than(1);
    const double toward = polar_.azimuth(looks_from_lobe ? sky_->n : lobe_.direction);
    for (int quarter = 0; quarter < 4; ++quarter) add(toward + quarter * pi<double> / 2);
    for (std::size_t i = 0; i < circles_.size(); ++i) {
        for (const PlanePoint& point : tangent_points(circles_[i]))
            if (i != own) add_point(point);
            else if (std::isfinite(point.phi)) add(point.phi);
        for (std::size_t k = 0; k < i; ++k)
            for (const PlanePoint& point : common_points(circles_[i], circles_[k]))
                add_point(point);
    }
    const auto add_direction = [&](const Vec3<double>& w) {
        const double half_chord2 = length2(w - polar_.pole) / 4;
        add_point({polar_.azimuth(w), std::sqrt(half_chord2 / (1 - half_chord2))});
    };
    for (const Vec3<double>& turn : lobe_.turns) add_direction(turn);
    for (const auto& [first, second] : interlocked_)
        for (const auto& [ends, other] : {std::array{first, second}, std::array{second, first}})
            if (sky_->ball(ends).stands == Ball::Stands::apart)
                for (const Vec3<double>& w : rims_in_common(sky_->ball(ends), sky_->ball(other)))
                    add_direction(w);
    std::sort(all.begin(), all.end());
    std::vector<double> breaks;
    for (const double phi : all)
        if (breaks.empty() || phi - breaks.back() > 1e-14) breaks.push_back(phi);
    breaks.push_back(breaks.front() + two_pi<double>);
    return breaks;
}

double Patch::distance(int index, const Vec3<double>& offset) const
{
    const Ball& ball = sky_->ball(index);
    if (ball.stands == Ball::Stands::beneath) return 0;
    if (ball.stands == Ball::Stands::around) {
        const Vec3<double> w = polar_.pole + offset;
        const double along = dot(ball.to_center, w), q = length(cross(ball.to_center, w));
        return std::max(0.0,
                        along + std::sqrt(std::max(0.0, (ball.radius - q) * (ball.radius + q))));
    }
    std::size_t i = own;
    while (circles_[i].ball != index) ++i;
    const double half_chord2 =
        length2(offset - deltas_[i]) / 2;  // 1 − cos of the angle to the axis
    const double sin2 = half_chord2 * (2 - half_chord2);
    const double rest = std::sqrt(std::max(0.0, ball.sin_max * ball.sin_max - sin2));
    return ball.cap.gap2 / (ball.cap.distance * (1 - half_chord2 + rest));
}

void Patch::add_breaks(const std::vector<Chord>& chords, const Vec3<double>& around, double low,
                       double high, std::vector<double>& breaks) const
{
    const auto add = [&](double theta) {
        if (theta > low && theta < high) breaks.push_back(theta);
    };
    for (const Chord& chord : chords)
        for (const double tau : {chord.low, chord.high})
            if (tau > 0) add(2 * std::atan(tau));
    std::vector<double> angles;
    for (const auto& [first, second] : interlocked_) {
        const Ball& a = sky_->ball(first);
        const Ball& b = sky_->ball(second);
        const Vec3<double> m = (b.to_center - a.to_center) * 2.0, o = polar_.pole;
        const double h = b.cap.gap2 - a.cap.gap2, gap = a.cap.gap2;
        const double mo = dot(m, o), me = dot(m, around), co = dot(a.to_center, o),
                     ce = dot(a.to_center, around);
        add_roots(h * h - 2 * h * mo * co + gap * mo * mo, -h * (mo * ce + me * co) + gap * mo * me,
                  h * h - 2 * h * me * ce + gap * me * me, angles);
        angles.push_back(std::atan2(mo, -me) < 0 ? std::atan2(mo, -me) + pi<double>
                                                 : std::atan2(mo, -me));
    }
    for (const double angle : angles) add(angle);
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

bool Patch::describe(double theta, const std::vector<Chord>& chords, const Vec3<double>& around,
                     Meridian& out, Stretch& stretch) const
{
    const double tau = std::tan(theta / 2);
    const Vec3<double> offset = polar_.offset(around, theta);
    if (!chords[own].holds(tau) || !chords[horizon].holds(tau)) return false;
    double nearest = std::numeric_limits<double>::infinity();
    stretch.nearest = -1;
    const auto meet = [&](int ball, int local) {
        const double t = distance(ball, offset);
        if (t > nearest || (t == nearest && ball > stretch.nearest)) return;
        nearest = t, stretch.nearest = ball, stretch.nearest_local = local;
    };
    stretch.first_along = out.along.size();
    for (std::size_t i = 0; i < circles_.size(); ++i) {
        if (i == horizon || !chords[i].holds(tau)) continue;
        if (smaller_[i]) {
            out.along.resize(stretch.first_along);
            return false;
        }
        if (local_of_circle_[i] >= 0) out.along.push_back(local_of_circle_[i]);
        meet(circles_[i].ball, local_of_circle_[i]);
    }
    for (const int wall : walls_) meet(wall, -1);
    stretch.along = out.along.size() - stretch.first_along;
    return sky_->ball(stretch.nearest).shines();
}

void Patch::meridian(double phi, Meridian& out) const
{
    if (stop_ != nullptr && *stop_) throw PredictError("interrupted");
    out.around = polar_.around(phi);
    out.stretches.clear(), out.along.clear(), out.hints.clear();
    std::vector<Chord> chords(circles_.size());
    for (std::size_t i = 0; i < circles_.size(); ++i) chords[i] = circles_[i].chord(phi);
    // Both ends of the own cap; all of it where it holds the antipode of the pole.
    const bool reaches_round = chords[own].inverted;
    const double low = reaches_round ? 0 : 2 * std::atan(std::max(0.0, chords[own].low));
    const double high = reaches_round ? pi<double> : 2 * std::atan(std::max(0.0, chords[own].high));
    if (!(low < high)) return;
    std::vector<double> breaks{low};
    add_breaks(chords, out.around, low, high, breaks);
    breaks.push_back(high);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i + 1] - breaks[i] > 1e-15 * high)) continue;
        Stretch stretch{.begin = breaks[i], .end = breaks[i + 1]};
        if (!describe((breaks[i] + breaks[i + 1]) / 2, chords, out.around, out, stretch)) continue;
        if (goes_on(out, stretch)) out.stretches.back().end = stretch.end;
        else out.stretches.push_back(stretch);
    }
    add_hints(high, out);
}

}  // namespace mis
