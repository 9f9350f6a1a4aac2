#pragma once

// GLM's own functions are inlined by force: a copy compiled for one instruction set must never be
// the one that another links to (docs/theory.md, "Instruction sets").
#ifndef GLM_FORCE_INLINE
#define GLM_FORCE_INLINE
#endif
#ifndef GLM_FORCE_XYZW_ONLY
#define GLM_FORCE_XYZW_ONLY
#endif
#include "mis/math/lanes.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace mis {

/// Two or three numbers of type T: float, double, or a SIMD batch of either.
template <class T> using Vec2 = glm::vec<2, T, glm::defaultp>;
template <class T> using Vec3 = glm::vec<3, T, glm::defaultp>;

using glm::cross;
using glm::dot;

/// |v|², in the unit of v squared.
template <class T> MIS_INLINE T length2(const Vec3<T>& v) { return dot(v, v); }

/// |v|.
template <class T> MIS_INLINE T length(const Vec3<T>& v)
{
    using std::sqrt;
    return sqrt(length2(v));
}

/// v / |v|. Precondition: |v| > 0, and |v|² neither overflows nor underflows T.
template <class T> MIS_INLINE Vec3<T> normalized(const Vec3<T>& v)
{
    return v * (T(static_cast<Scalar<T>>(1)) / length(v));  // one division, not three
}

/// A vector of another number type, component by component.
template <class To, class From> MIS_INLINE Vec3<To> vec_cast(const Vec3<From>& v)
{
    return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}

/// Rec. 709 luminance of a linear RGB colour.
template <class T> MIS_INLINE T luminance(const Vec3<T>& rgb)
{
    return T(static_cast<Scalar<T>>(0.2126)) * rgb.x + T(static_cast<Scalar<T>>(0.7152)) * rgb.y +
           T(static_cast<Scalar<T>>(0.0722)) * rgb.z;
}

}  // namespace mis
