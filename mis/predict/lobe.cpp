#include "mis/predict/lobe.h"

#include "mis/predict/circle.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>

namespace mis {

namespace {

constexpr int halvings = 40;
using Profile = std::array<double, halvings + 1>;  ///< at the angles 1, ½, ¼, … and 0

/// The largest angle of the profile's list at which it is still near its value at 0.
double width_of(const Profile& profile)
{
    const double peak = profile[halvings], low = *std::min_element(profile.begin(), profile.end());
    if (!(peak - low > 1e-9 * peak)) return 4;
    for (int k = halvings - 1; k >= 0; --k)
        if (profile[static_cast<std::size_t>(k)] < (peak + low) / 2) return std::ldexp(1.0, -k);
    return 4;
}

/// A unit tangent at n in the plane of incidence; any, where wo = n.
Vec3<double> tangent_of_incidence(const Response& response)
{
    const Vec3<double> across = cross(response.normal(), response.outgoing());
    return length2(across) > 1e-20 ? normalized(cross(across, response.normal()))
                                   : Polar(response.normal()).e1;
}

/// Angles from n along the plane of incidence to look at: evenly, and in ever smaller steps towards
/// the lobe.
std::vector<double> angles_of_incidence(double lobe_angle, double width)
{
    constexpr int even = 256;
    const double limit = pi<double> / 2 * (1 - 1e-9);
    std::vector<double> angles;
    for (int i = -even; i <= even; ++i) angles.push_back(limit * i / even);
    for (double step = width / 8; step < 0.1; step *= 1.5)
        for (const double angle : {lobe_angle - step, lobe_angle + step})
            if (std::abs(angle) < limit) angles.push_back(angle);
    angles.push_back(lobe_angle);
    std::sort(angles.begin(), angles.end());
    return angles;
}

/// The directions at which value(reflected) turns.
template <class Value>
void add_turns(const Response& response, const std::vector<double>& angles, const Value& value,
               std::vector<Vec3<double>>& turns)
{
    const Vec3<double> n = response.normal(), t = tangent_of_incidence(response);
    const auto direction = [&](double angle) { return n * std::cos(angle) + t * std::sin(angle); };
    const auto at = [&](double angle) { return value(response.at(direction(angle))); };
    for (std::size_t i = 1; i + 1 < angles.size(); ++i) {
        const double a = at(angles[i - 1]), b = at(angles[i]), c = at(angles[i + 1]);
        const bool turns_here = (b > a && b > c) || (b < a && b < c);
        if (!turns_here || std::min(std::abs(b - a), std::abs(b - c)) < 1e-9 * std::abs(b))
            continue;  // but rounding
        std::uintmax_t rounds = 50;
        const double side = b > a ? -1 : 1;
        const auto found =
            boost::math::tools::brent_find_minima([&](double angle) { return side * at(angle); },
                                                  angles[i - 1], angles[i + 1], 26, rounds);
        turns.push_back(direction(found.first));
    }
}

}  // namespace

Lobe lobe_of(const Response& response)
{
    const Vec3<double> n = response.normal(), wo = response.outgoing();
    Lobe lobe{.direction = normalized(n * (2 * dot(n, wo)) - wo)};
    const Polar polar(lobe.direction);
    const Vec3<double> t = tangent_of_incidence(response);
    const double phi =
        polar.azimuth(n * dot(t, wo) - t * dot(n, wo));  // along the plane of incidence
    for (int quarter = 0; quarter < 4; ++quarter) {
        const Vec3<double> around = polar.around(phi + quarter * pi<double> / 2);
        Profile f, pdf;
        for (int k = 0; k <= halvings; ++k) {
            const double angle = k < halvings ? std::ldexp(1.0, -k) : 0;
            const ResponseValue r = response.at(lobe.direction + polar.offset(around, angle));
            f[static_cast<std::size_t>(k)] = luminance(r.f),
            pdf[static_cast<std::size_t>(k)] = r.pdf;
        }
        lobe.width = std::min({lobe.width, width_of(f), width_of(pdf)});
    }
    const std::vector<double> angles =
        angles_of_incidence(std::atan2(-dot(t, wo), dot(n, wo)), lobe.width);
    add_turns(
        response, angles, [](const ResponseValue& r) { return r.pdf; }, lobe.turns);
    add_turns(
        response, angles, [](const ResponseValue& r) { return r.pdf / r.cos_theta; }, lobe.turns);
    return lobe;
}

}  // namespace mis
