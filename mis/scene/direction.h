#pragma once

#include "mis/math/vec.h"

#include <algorithm>
#include <cmath>

namespace mis {

/// `v` normalised, however long or short it is: no square leaves the range of a double. The zero
/// vector stays as it is, and is a Problem wherever a scene holds one as a direction.
inline Vec3<double> unit_or_zero(const Vec3<double>& v)
{
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? normalized(v / largest) : v;
}

}  // namespace mis
