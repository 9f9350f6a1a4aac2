#include "mis/predict/lobe.h"

#include "mis/predict/circle.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

Lobe lobe_of(const Response& response)
{
    const Vec3<double> n = response.normal(), wo = response.outgoing();
    Lobe lobe{.direction = normalized(n * (2 * dot(n, wo)) - wo)};
    const Polar polar(lobe.direction);
    const Vec3<double> in_plane = dot(cross(n, wo), cross(n, wo)) > 1e-20 ? cross(n, cross(n, wo)) : polar.e1;
    const double phi = polar.azimuth(in_plane);
    for (int quarter = 0; quarter < 4; ++quarter) {
        const Vec3<double> around = polar.around(phi + quarter * pi<double> / 2);
        Profile f, pdf;
        for (int k = 0; k <= halvings; ++k) {
            const double angle = k < halvings ? std::ldexp(1.0, -k) : 0;
            const Reflected r = response.at(lobe.direction + polar.offset(around, angle));
            f[static_cast<std::size_t>(k)] = luminance(r.f), pdf[static_cast<std::size_t>(k)] = r.pdf;
        }
        lobe.width = std::min({lobe.width, width_of(f), width_of(pdf)});
    }
    return lobe;
}

}  // namespace mis
