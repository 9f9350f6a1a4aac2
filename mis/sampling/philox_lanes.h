#pragma once

#include "mis/sampling/random.h"

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

namespace mis {
inline namespace MIS_ISA {

// Philox in lanes of 64 bits. Compilers do not find by themselves that a product of the low halves
// is all it takes: the halves above need no clearing between the rounds.

#if defined(__AVX512F__)
struct PhiloxLanes {
    using Lanes = __m512i;
    static constexpr std::size_t count = 8;
    static Lanes all(std::uint64_t x) { return _mm512_set1_epi64(static_cast<long long>(x)); }
    static Lanes load(const std::uint64_t* p) { return _mm512_loadu_si512(p); }
    static void store(std::uint64_t* p, Lanes x) { _mm512_storeu_si512(p, x); }
    static void store_low_halves(std::uint32_t* p, Lanes x)
    {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtepi64_epi32(x));
    }
    static Lanes product_of_low_halves(Lanes a, Lanes b) { return _mm512_mul_epu32(a, b); }
    static Lanes high_half(Lanes x) { return _mm512_srli_epi64(x, 32); }
    static Lanes exclusive_or(Lanes a, Lanes b) { return _mm512_xor_si512(a, b); }
    static Lanes low_halves(Lanes high, Lanes low)
    {
        return _mm512_mask_blend_epi32(0xaaaa, low, _mm512_slli_epi64(high, 32));
    }
};
#elif defined(__AVX2__)
struct PhiloxLanes {
    using Lanes = __m256i;
    static constexpr std::size_t count = 4;
    static Lanes all(std::uint64_t x) { return _mm256_set1_epi64x(static_cast<long long>(x)); }
    static Lanes load(const std::uint64_t* p)
    {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    }
    static void store(std::uint64_t* p, Lanes x)
    {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), x);
    }
    static void store_low_halves(std::uint32_t* p, Lanes x)
    {
        const Lanes low = _mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 2, 4, 6, 0, 0, 0, 0));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_castsi256_si128(low));
    }
    static Lanes product_of_low_halves(Lanes a, Lanes b) { return _mm256_mul_epu32(a, b); }
    static Lanes high_half(Lanes x) { return _mm256_srli_epi64(x, 32); }
    static Lanes exclusive_or(Lanes a, Lanes b) { return _mm256_xor_si256(a, b); }
    static Lanes low_halves(Lanes high, Lanes low)
    {
        return _mm256_blend_epi32(low, _mm256_slli_epi64(high, 32), 0xaa);
    }
};
#else
struct PhiloxLanes {
    using Lanes = std::uint64_t;
    static constexpr std::size_t count = 1;
    static Lanes all(std::uint64_t x) { return x; }
    static Lanes load(const std::uint64_t* p) { return *p; }
    static void store(std::uint64_t* p, Lanes x) { *p = x; }
    static void store_low_halves(std::uint32_t* p, Lanes x) { *p = static_cast<std::uint32_t>(x); }
    static Lanes product_of_low_halves(Lanes a, Lanes b)
    {
        return (a & 0xFFFF'FFFFu) * (b & 0xFFFF'FFFFu);
    }
    static Lanes high_half(Lanes x) { return x >> 32; }
    static Lanes exclusive_or(Lanes a, Lanes b) { return a ^ b; }
    static Lanes low_halves(Lanes high, Lanes low) { return high << 32 | (low & 0xFFFF'FFFFu); }
};
#endif

/// scrambled() of counters that differ in their second word alone, as samples of one point do. What
/// the first three rounds make of the other words is the same for all, and is computed once.
class AlikeCounters {
public:
    using P = PhiloxLanes;
    using Lanes = P::Lanes;

    /// counter: any of them.
    MIS_INLINE AlikeCounters(std::uint64_t seed, const Words& counter)
        : key0_(static_cast<std::uint32_t>(seed)), key1_(static_cast<std::uint32_t>(seed >> 32))
    {
        using philox::multiplier0, philox::multiplier1, philox::step0, philox::step1;
        const auto high = [](std::uint64_t product) {
            return static_cast<std::uint32_t>(product >> 32);
        };
        const std::uint64_t p0 = std::uint64_t{multiplier0} * counter[0],
                            q0 = std::uint64_t{multiplier1} * counter[2];
        const std::uint64_t q1 = std::uint64_t{multiplier1} * (high(p0) ^ counter[3] ^ key1_);
        const std::uint64_t p2 = std::uint64_t{multiplier0} *
                                 (high(q1) ^ static_cast<std::uint32_t>(q0) ^ (key0_ + step0));
        a1_ = P::all(high(q0) ^ key0_);
        c2_ = P::all(static_cast<std::uint32_t>(p0) ^ (key1_ + step1));
        a3_ = P::all(static_cast<std::uint32_t>(q1) ^ (key0_ + 2 * step0));
        c3_ = P::all(high(p2) ^ (key1_ + 2 * step1));
        d3_ = P::all(static_cast<std::uint32_t>(p2));
    }

    struct Four {
        Lanes a, b, c, d;
    };

    /// The random words of the counters whose second words are the low halves here, as low halves.
    MIS_INLINE Four scrambled(Lanes second) const
    {
        const Lanes m0 = P::all(philox::multiplier0), m1 = P::all(philox::multiplier1);
        const Lanes p1 = P::product_of_low_halves(P::exclusive_or(second, a1_), m0);
        const Lanes q2 = P::product_of_low_halves(P::exclusive_or(P::high_half(p1), c2_), m1);
        Lanes a = P::exclusive_or(P::high_half(q2), a3_), b = q2, c = P::exclusive_or(p1, c3_),
              d = d3_;
        std::uint32_t key0 = key0_, key1 = key1_;
        for (int round = 3; round < philox::rounds; ++round) {
            const auto nth = static_cast<std::uint32_t>(round);
            const Lanes p = P::product_of_low_halves(a, m0), q = P::product_of_low_halves(c, m1);
            a = P::exclusive_or(P::exclusive_or(P::high_half(q), b),
                                P::all(key0 + nth * philox::step0));
            c = P::exclusive_or(P::exclusive_or(P::high_half(p), d),
                                P::all(key1 + nth * philox::step1));
            b = q, d = p;
        }
        return {a, b, c, d};
    }

private:
    std::uint32_t key0_, key1_;
    Lanes a1_, c2_, a3_, c3_, d3_;
};

}  // namespace MIS_ISA
}  // namespace mis
