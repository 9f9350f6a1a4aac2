#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#if !defined(MIS_WITHOUT_LANES)
#include <xsimd/xsimd.hpp>

/// GLM's vectors ask for these of their number type.
template <class T, class A>
struct std::numeric_limits<xsimd::batch<T, A>> : std::numeric_limits<T> {
};
#endif

// All that kernels call is inlined by force, but what is too large for that, of which each source
// has a copy of its own (docs/theory.md, "Instruction sets").
#define MIS_INLINE [[gnu::always_inline]] inline
#define MIS_OWN_COPY [[gnu::noinline]] static

namespace mis {

// A kernel is written once, over a number type T that is a float, a double, or a SIMD batch of
// either. What such a text needs beyond arithmetic and <cmath> by argument-dependent lookup stands
// here.

namespace detail {
template <class T> struct LaneTraits {
    using Scalar = T;
    static constexpr std::size_t count = 1;
};
#if !defined(MIS_WITHOUT_LANES)
template <class T, class A> struct LaneTraits<xsimd::batch<T, A>> {
    using Scalar = T;
    static constexpr std::size_t count = xsimd::batch<T, A>::size;
};
#endif
}  // namespace detail

/// float of float, and of a batch of floats.
template <class T> using Scalar = typename detail::LaneTraits<T>::Scalar;

/// How many numbers a T holds: 1 unless it is a batch.
template <class T> inline constexpr std::size_t lane_count = detail::LaneTraits<T>::count;

/// Numbers `p[0] … p[lane_count − 1]`; p needs no alignment.
template <class T> MIS_INLINE T load_lanes(const Scalar<T>* p)
{
    if constexpr (lane_count<T> == 1) return *p;
    else return T::load_unaligned(p);
}

template <class T> MIS_INLINE void store_lanes(Scalar<T>* p, const T& value)
{
    if constexpr (lane_count<T> == 1) *p = value;
    else value.store_unaligned(p);
}

/// n numbers of type S that the compiler itself keeps in lanes, whatever the processor has: to
/// convert between number types.
template <class S, std::size_t n> struct CompilerLanes {
    using Type [[gnu::vector_size(n * sizeof(S))]] = S;
};

/// `condition ? a : b`, lane by lane; both sides are evaluated. For batches xsimd brings it.
template <class T> MIS_INLINE T select(bool condition, const T& a, const T& b)
{
    return condition ? a : b;
}
/// Does a condition hold in any lane? To leave out what no lane needs.
MIS_INLINE bool any_lane(bool condition) { return condition; }
#if !defined(MIS_WITHOUT_LANES)
template <class T, class A> MIS_INLINE bool any_lane(const xsimd::batch_bool<T, A>& condition)
{
    return xsimd::any(condition);
}
#endif

/// Σ over all lanes, in their own precision.
template <class T> MIS_INLINE T sum_of_lanes(const T& number) { return number; }
#if !defined(MIS_WITHOUT_LANES)
template <class T, class A> MIS_INLINE T sum_of_lanes(const xsimd::batch<T, A>& lanes)
{
#if XSIMD_VERSION_MAJOR >= 9
    return xsimd::reduce_add(lanes);
#else
    return xsimd::hadd(lanes);
#endif
}
#endif

/// The larger and the smaller number, lane by lane. A NaN in `a` gives b: a bound also cleans.
template <class T> MIS_INLINE T max_of(const T& a, const T& b) { return select(a > b, a, b); }
template <class T> MIS_INLINE T min_of(const T& a, const T& b) { return select(a < b, a, b); }

}  // namespace mis
