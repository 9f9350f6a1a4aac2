#pragma once

#include "mis/scene/light.h"

#include <algorithm>
#include <cmath>

namespace mis {

// Light is linear: all radiances may be multiplied by one number, and what is found divided by it.
// By a power of two, that changes no bit but where numbers leave the range of a float. So the light
// of a very dim scene is lifted to where floats hold it in full, also on processors or in programs
// that take denormal numbers for 0 (docs/theory.md §2).

/// A power of two to multiply radiances by; brightest: radiance · radius over a distance of the
/// brightest light. 1 where that lies between 1e-9 and 1e18. What is dimmer is lifted to 1; what is
/// brighter comes down to 1e18, so that dim lights beside it keep what room there is.
inline double radiance_scale(double brightest)
{
    constexpr int low = -30, high = 60;  // powers of two
    if (!(brightest > 0)) return 1;
    const int size = std::ilogb(brightest);
    if (size < low) return std::ldexp(1.0, -size);
    return size > high ? std::ldexp(1.0, high - size) : 1;
}

/// The same for lights that are seen from about `origin`: from as far as the farthest of them.
inline double radiance_scale(const Lights& lights, const Vec3<double>& origin)
{
    double brightest = 0, farthest = 0;
    for (const Light& light : lights) {
        const Vec3<double> emitted = vec_cast<double>(light.radiance_radius);
        brightest = std::max({brightest, emitted.x, emitted.y, emitted.z});
        farthest = std::max(farthest, length(light.center - origin) + light.radius);
    }
    return farthest > 0 ? radiance_scale(brightest / farthest) : 1;
}

}  // namespace mis
