#pragma once

#include "mis/math/vec.h"

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace mis {

// Four floats at a time in code that is compiled for every processor, where lanes are chosen by
// none: SSE2, which every x86-64 has; elsewhere plain numbers, which compilers vectorise.

#if defined(__SSE2__)
struct FourFloats {
    __m128 lanes;
};
MIS_INLINE FourFloats four(float x) { return {_mm_set1_ps(x)}; }
MIS_INLINE FourFloats four(float x, float y, float z, float w) { return {_mm_setr_ps(x, y, z, w)}; }
MIS_INLINE FourFloats four_of(const float* from) { return {_mm_loadu_ps(from)}; }
MIS_INLINE FourFloats operator*(FourFloats a, FourFloats b)
{
    return {_mm_mul_ps(a.lanes, b.lanes)};
}
MIS_INLINE FourFloats operator+(FourFloats a, FourFloats b)
{
    return {_mm_add_ps(a.lanes, b.lanes)};
}
MIS_INLINE FourFloats operator-(FourFloats a, FourFloats b)
{
    return {_mm_sub_ps(a.lanes, b.lanes)};
}
MIS_INLINE FourFloats operator/(FourFloats a, FourFloats b)
{
    return {_mm_div_ps(a.lanes, b.lanes)};
}
MIS_INLINE FourFloats magnitude(FourFloats a)
{
    return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.lanes)};
}
MIS_INLINE FourFloats smaller(FourFloats a, FourFloats b) { return {_mm_min_ps(a.lanes, b.lanes)}; }
MIS_INLINE FourFloats larger(FourFloats a, FourFloats b) { return {_mm_max_ps(a.lanes, b.lanes)}; }
MIS_INLINE void put(FourFloats x, float* to) { _mm_storeu_ps(to, x.lanes); }

/// Bit k: a[k] ≤ b[k].
MIS_INLINE std::uint32_t not_above(FourFloats a, FourFloats b)
{
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a.lanes, b.lanes)));
}
/// Bit k: a[k] > b[k].
MIS_INLINE std::uint32_t above(FourFloats a, FourFloats b)
{
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpgt_ps(a.lanes, b.lanes)));
}
#else
struct FourFloats {
    float lanes[4];
};
template <class Of> MIS_INLINE FourFloats each(const Of& of)
{
    return {{of(0), of(1), of(2), of(3)}};
}
MIS_INLINE FourFloats four(float x) { return {{x, x, x, x}}; }
MIS_INLINE FourFloats four(float x, float y, float z, float w) { return {{x, y, z, w}}; }
MIS_INLINE FourFloats four_of(const float* from) { return {{from[0], from[1], from[2], from[3]}}; }
MIS_INLINE FourFloats operator*(FourFloats a, FourFloats b)
{
    return each([&](int k) { return a.lanes[k] * b.lanes[k]; });
}
MIS_INLINE FourFloats operator+(FourFloats a, FourFloats b)
{
    return each([&](int k) { return a.lanes[k] + b.lanes[k]; });
}
MIS_INLINE FourFloats operator-(FourFloats a, FourFloats b)
{
    return each([&](int k) { return a.lanes[k] - b.lanes[k]; });
}
MIS_INLINE FourFloats operator/(FourFloats a, FourFloats b)
{
    return each([&](int k) { return a.lanes[k] / b.lanes[k]; });
}
MIS_INLINE FourFloats magnitude(FourFloats a)
{
    return each([&](int k) { return a.lanes[k] < 0 ? -a.lanes[k] : a.lanes[k]; });
}
MIS_INLINE FourFloats smaller(FourFloats a, FourFloats b)
{
    return each([&](int k) { return a.lanes[k] < b.lanes[k] ? a.lanes[k] : b.lanes[k]; });
}
MIS_INLINE FourFloats larger(FourFloats a, FourFloats b)
{
    return each([&](int k) { return a.lanes[k] > b.lanes[k] ? a.lanes[k] : b.lanes[k]; });
}
MIS_INLINE void put(FourFloats x, float* to)
{
    for (int k = 0; k < 4; ++k) to[k] = x.lanes[k];
}
MIS_INLINE std::uint32_t not_above(FourFloats a, FourFloats b)
{
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits |= a.lanes[k] <= b.lanes[k] ? 1U << k : 0;
    return bits;
}
MIS_INLINE std::uint32_t above(FourFloats a, FourFloats b)
{
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits |= a.lanes[k] > b.lanes[k] ? 1U << k : 0;
    return bits;
}
#endif

struct EightFloats {
    FourFloats a, b;
};

/// Eight bytes as floats.
MIS_INLINE EightFloats eight_of(const std::uint8_t* bytes)
{
#if defined(__SSE2__)
    const __m128i zero = _mm_setzero_si128();
    const __m128i words =
        _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes)), zero);
    return {{_mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero))},
            {_mm_cvtepi32_ps(_mm_unpackhi_epi16(words, zero))}};
#else
    return {each([&](int k) { return static_cast<float>(bytes[k]); }),
            each([&](int k) { return static_cast<float>(bytes[4 + k]); })};
#endif
}

}  // namespace mis
