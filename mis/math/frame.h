#pragma once

#include "mis/math/stable.h"

namespace mis {

/// An orthonormal frame; z is the axis it was built around.
template <class T> struct Frame {
    Vec3<T> x, y, z;

    MIS_INLINE Vec3<T> to_world(const Vec3<T>& v) const { return x * v.x + y * v.y + z * v.z; }
    MIS_INLINE Vec3<T> to_local(const Vec3<T>& v) const
    {
        return {dot(x, v), dot(y, v), dot(z, v)};
    }
};

/// The frame around a unit vector, continuous but at z = 0 and free of branches.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1).
template <class T> MIS_INLINE Frame<T> frame_around(const Vec3<T>& z)
{
    using std::copysign;
    const T sign = copysign(number<T>(1), z.z);
    const T a = number<T>(-1) / (sign + z.z);
    const T b = z.x * z.y * a;
    return {{number<T>(1) + sign * z.x * z.x * a, sign * b, -sign * z.x},
            {b, sign + z.y * z.y * a, -z.y},
            z};
}

}  // namespace mis
