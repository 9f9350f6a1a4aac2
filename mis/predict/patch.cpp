#include "mis/predict/patch.h"

#include "mis/predict/crossings.h"
#include "mis/predict/predict.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

constexpr std::size_t no_circle = static_cast<std::size_t>(-1);

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
             const StopToken& stop)
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
    std::vector<int> solid;
    for (std::size_t i = 0; i < walls_.size(); ++i) solid.push_back(-1 - static_cast<int>(i));
    for (std::size_t i = 0; i < circles_.size(); ++i)
        if (i != horizon && sky_->ball(circles_[i].ball).stands == Ball::Stands::apart)
            solid.push_back(static_cast<int>(i));
    for (std::size_t i = 0; i < solid.size(); ++i) {
        stop_.check();
        for (std::size_t k = i + 1; k < solid.size(); ++k) {
            const Ball& a = sky_->ball(ball_of(solid[i]));
            const Ball& b = sky_->ball(ball_of(solid[k]));
            if (!interlock(a, b)) continue;
            const Vec3<double> m = (b.to_center - a.to_center) * 2.0;
            interlocked_.push_back({solid[i], solid[k], m, a.to_center, b.cap.gap2 - a.cap.gap2,
                                    a.cap.gap2, dot(m, polar_.pole),
                                    dot(a.to_center, polar_.pole)});
        }
    }
}

int Patch::ball_of(int circle_or_wall) const
{
    return circle_or_wall < 0 ? walls_[static_cast<std::size_t>(-1 - circle_or_wall)]
                              : circles_[static_cast<std::size_t>(circle_or_wall)].ball;
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
    // Of a point that lies on two circles by construction, these are not asked.
    const auto add_point = [&](const PlanePoint& point, std::size_t on = no_circle,
                               std::size_t and_on = no_circle) {
        if (!std::isfinite(point.phi)) return;
        if (!is_clearly_elsewhere(point, {on, and_on})) add(point.phi);
    };
    const bool looks_from_lobe = pole_is_lobe_ || !lobe_.is_narrower_than(1);
    const double toward = polar_.azimuth(looks_from_lobe ? sky_->n : lobe_.direction);
    for (int quarter = 0; quarter < 4; ++quarter) add(toward + quarter * pi<double> / 2);
    for (std::size_t i = 0; i < circles_.size(); ++i) {
        for (const PlanePoint& point : tangent_points(circles_[i]))
            if (i != own) add_point(point, i);
            else if (std::isfinite(point.phi)) add(point.phi);
        for (std::size_t k = 0; k < i; ++k) {
            stop_.check();
            for (const PlanePoint& point : common_points(circles_[i], circles_[k]))
                add_point(point, i, k);
        }
    }
    const auto add_direction = [&](const Vec3<double>& w) {
        const double half_chord2 = length2(w - polar_.pole) / 4;
        add_point({polar_.azimuth(w), std::sqrt(half_chord2 / (1 - half_chord2))});
    };
    for (const Vec3<double>& turn : lobe_.turns) add_direction(turn);
    for (const Pair& pair : interlocked_)
        for (const auto& [ends, other] :
             {std::array{pair.first, pair.second}, std::array{pair.second, pair.first}})
            if (ends >= 0)
                for (const Vec3<double>& w :
                     rims_in_common(sky_->ball(ball_of(ends)), sky_->ball(ball_of(other))))
                    add_direction(w);
    std::sort(all.begin(), all.end());
    std::vector<double> breaks;
    for (const double phi : all)
        if (breaks.empty() || phi - breaks.back() > 1e-14) breaks.push_back(phi);
    breaks.push_back(breaks.front() + two_pi<double>);
    return breaks;
}

/// Is a point outside this patch, and not just at its rim? It lies on some circles, which may say
/// anything of it: as a line through the pole, one is all of a meridian or nothing.
bool Patch::is_clearly_elsewhere(const PlanePoint& point,
                                 const std::array<std::size_t, 2>& on) const
{
    const double cos_phi = std::cos(point.phi), sin_phi = std::sin(point.phi);
    constexpr double rounding = 1e-6;  // a point too many is harmless
    for (std::size_t i = 0; i < circles_.size(); ++i) {
        if ((i > horizon && !smaller_[i]) || i == on[0] || i == on[1]) continue;
        const Chord chord = circles_[i].chord(cos_phi, sin_phi);
        const bool patch_is_between = (i <= horizon) != chord.inverted;
        const double slack = patch_is_between ? rounding : -rounding;
        const bool is_between =
            point.tau >= chord.low * (1 - slack) && point.tau <= chord.high * (1 + slack);
        if (is_between != patch_is_between) return true;
    }
    return false;
}

}  // namespace mis
