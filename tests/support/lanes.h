#pragma once

#include "mis/math/vec.h"

#include <array>

namespace mis {

#if defined(MIS_WITHOUT_LANES)
template <class T> using TestLanes = T;
#else
/// The lanes that the compiler's flags allow: SSE2 on plain x86-64. Wider ones are tested through
/// the kernels.
template <class T> using TestLanes = xsimd::batch<T>;
#endif

/// One lane of a number.
template <class V> Scalar<V> lane(const V& v, std::size_t i)
{
    std::array<Scalar<V>, lane_count<V>> all;
    store_lanes(all.data(), v);
    return all[i];
}
template <class V> Vec3<Scalar<V>> lane(const Vec3<V>& v, std::size_t i)
{
    return {lane(v.x, i), lane(v.y, i), lane(v.z, i)};
}

/// Lanes filled one by one: f(0), f(1) …
template <class V, class F> V lanes_from(const F& f)
{
    std::array<Scalar<V>, lane_count<V>> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = f(i);
    return load_lanes<V>(all.data());
}
template <class V, class F> Vec3<V> vec_lanes_from(const F& f)
{
    return {lanes_from<V>([&](std::size_t i) { return f(i).x; }),
            lanes_from<V>([&](std::size_t i) { return f(i).y; }),
            lanes_from<V>([&](std::size_t i) { return f(i).z; })};
}

/// Numbers that double, float and lanes are to agree on, as types.
template <class T>
inline constexpr double ulp_of = static_cast<double>(std::numeric_limits<Scalar<T>>::epsilon());

}  // namespace mis
