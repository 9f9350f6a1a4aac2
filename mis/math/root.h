#pragma once

#include "mis/math/lanes.h"

#include <bit>
#include <cstdint>

namespace mis {

namespace detail {

/// The largest power of two that is not above x, and one over it.
template <class T> struct Binade {
    T floor, inverse;
};
template <class S> struct ExponentBits;
template <> struct ExponentBits<float> {
    using Bits = std::uint32_t;
    static constexpr Bits mask = 0x7f800000, of_one_twice = 0x7f000000;
};
template <> struct ExponentBits<double> {
    using Bits = std::uint64_t;
    static constexpr Bits mask = 0x7ff0000000000000, of_one_twice = 0x7fe0000000000000;
};

template <class T> MIS_INLINE Binade<T> binade_of(const T& x)
{
    using E = ExponentBits<T>;
    const typename E::Bits bits = std::bit_cast<typename E::Bits>(x) & E::mask;
    return {std::bit_cast<T>(bits),
            std::bit_cast<T>(static_cast<typename E::Bits>(E::of_one_twice - bits))};
}
#if !defined(MIS_WITHOUT_LANES)
template <class S, class A>
MIS_INLINE Binade<xsimd::batch<S, A>> binade_of(const xsimd::batch<S, A>& x)
{
    using E = ExponentBits<S>;
    using Floats = xsimd::batch<S, A>;
    using Bits = xsimd::batch<typename E::Bits, A>;
    const Bits bits = xsimd::bitwise_cast<Bits>(x) & Bits(E::mask);
    return {xsimd::bitwise_cast<Floats>(bits),
            xsimd::bitwise_cast<Floats>(Bits(Bits(E::of_one_twice) - bits))};
}
#endif

}  // namespace detail

/// √(a b) by one root, where a b may be no number. Precondition: 0 ≤ b ≤ a, a a normal number below
/// half the largest.
template <class T> MIS_INLINE T root_of_product(const T& a, const T& b)
{
    using std::sqrt;
    const detail::Binade<T> unit = detail::binade_of(a);
    return sqrt(T(a * unit.inverse) * T(b * unit.inverse)) * unit.floor;
}

}  // namespace mis
