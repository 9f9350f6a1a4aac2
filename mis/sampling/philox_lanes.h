#pragma once

#include "mis/sampling/random.h"

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

namespace mis {
inline namespace MIS_ISA {

// Philox over columns of counters. Compilers do not find by themselves that a product of the low
// halves of 64-bit lanes is all it takes: the halves above need no clearing between the rounds.

#if defined(__AVX512F__)
struct PhiloxLanes {
    using Lanes = __m512i;
    static constexpr std::size_t count = 8;
    static Lanes all(std::uint64_t x) { return _mm512_set1_epi64(static_cast<long long>(x)); }
    static Lanes load(const std::uint32_t* p)
    {
        return _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
    }
    static void store(std::uint32_t* p, Lanes x)
    {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtepi64_epi32(x));
    }
    static Lanes product_of_low_halves(Lanes a, Lanes b) { return _mm512_mul_epu32(a, b); }
    static Lanes high_half(Lanes x) { return _mm512_srli_epi64(x, 32); }
    static Lanes exclusive_or(Lanes a, Lanes b) { return _mm512_xor_si512(a, b); }
};
#elif defined(__AVX2__)
struct PhiloxLanes {
    using Lanes = __m256i;
    static constexpr std::size_t count = 4;
    static Lanes all(std::uint64_t x) { return _mm256_set1_epi64x(static_cast<long long>(x)); }
    static Lanes load(const std::uint32_t* p)
    {
        return _mm256_cvtepu32_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
    }
    static void store(std::uint32_t* p, Lanes x)
    {
        const Lanes low = _mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 2, 4, 6, 0, 0, 0, 0));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_castsi256_si128(low));
    }
    static Lanes product_of_low_halves(Lanes a, Lanes b) { return _mm256_mul_epu32(a, b); }
    static Lanes high_half(Lanes x) { return _mm256_srli_epi64(x, 32); }
    static Lanes exclusive_or(Lanes a, Lanes b) { return _mm256_xor_si256(a, b); }
};
#else
struct PhiloxLanes {
    using Lanes = std::uint64_t;
    static constexpr std::size_t count = 1;
    static Lanes all(std::uint64_t x) { return x; }
    static Lanes load(const std::uint32_t* p) { return *p; }
    static void store(std::uint32_t* p, Lanes x) { *p = static_cast<std::uint32_t>(x); }
    static Lanes product_of_low_halves(Lanes a, Lanes b)
    {
        return (a & 0xFFFF'FFFFu) * (b & 0xFFFF'FFFFu);
    }
    static Lanes high_half(Lanes x) { return x >> 32; }
    static Lanes exclusive_or(Lanes a, Lanes b) { return a ^ b; }
};
#endif

/// scrambled() of PhiloxLanes::count counters: word k of counter i is words[k][i], before and
/// after.
MIS_INLINE void scramble_lanes(std::uint64_t seed, const std::array<std::uint32_t*, 4>& words)
{
    using P = PhiloxLanes;
    P::Lanes a = P::load(words[0]), b = P::load(words[1]), c = P::load(words[2]),
             d = P::load(words[3]);
    auto key0 = static_cast<std::uint32_t>(seed), key1 = static_cast<std::uint32_t>(seed >> 32);
    for (int round = 0; round < philox::rounds; ++round) {
        const P::Lanes p = P::product_of_low_halves(a, P::all(philox::multiplier0)),
                       q = P::product_of_low_halves(c, P::all(philox::multiplier1));
        a = P::exclusive_or(P::exclusive_or(P::high_half(q), b), P::all(key0));
        c = P::exclusive_or(P::exclusive_or(P::high_half(p), d), P::all(key1));
        b = q, d = p;
        key0 += philox::step0, key1 += philox::step1;
    }
    P::store(words[0], a), P::store(words[1], b), P::store(words[2], c), P::store(words[3], d);
}

}  // namespace MIS_ISA
}  // namespace mis
