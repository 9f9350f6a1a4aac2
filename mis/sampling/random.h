#pragma once

#include "mis/math/lanes.h"

#include <array>
#include <cstdint>

namespace mis {

// Random numbers without state: a number is a function of (seed, point, sample, draw, dimension)
// alone, so any part of the work can run anywhere, in any order, and be merged.

/// Where in a study a random number is spent.
struct Counter {
    std::uint32_t point;   ///< number of the shading point
    std::uint64_t sample;  ///< number of the sample at that point
    std::uint32_t draw;    ///< number of the draw within the sample
};

/// The dimensions of one draw come in two blocks of four 32-bit words.
///   light: choice (2 words, 64 bits), cap u, cap v;   bsdf: technique, lobe, BSDF u, BSDF v.
enum class Block : std::uint32_t { light = 0, bsdf = 1 };

using Words = std::array<std::uint32_t, 4>;

/// Philox-4×32 with the seven rounds that pass BigCrush.
/// Source: Salmon et al. 2011, "Parallel Random Numbers: As Easy as 1, 2, 3", table 2.
namespace philox {
inline constexpr int rounds = 7;
inline constexpr std::uint32_t multiplier0 = 0xD2511F53U, multiplier1 = 0xCD9E8D57U,
                               step0 = 0x9E3779B9U, step1 = 0xBB67AE85U;

MIS_INLINE Words one_round(const Words& c, std::uint32_t key0, std::uint32_t key1)
{
    const std::uint64_t a = std::uint64_t{multiplier0} * c[0],
                        b = std::uint64_t{multiplier1} * c[2];
    return {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ key0, static_cast<std::uint32_t>(b),
            static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ key1, static_cast<std::uint32_t>(a)};
}
}  // namespace philox

/// The counter of a block, as the four words that are scrambled.
MIS_INLINE Words counter_words(const Counter& counter, Block block)
{
    return {
        counter.point, static_cast<std::uint32_t>(counter.sample), counter.draw,
        static_cast<std::uint32_t>(counter.sample >> 32) << 1 | static_cast<std::uint32_t>(block)};
}

/// The random words of a counter.
MIS_INLINE Words scrambled(std::uint64_t seed, Words c)
{
    auto key0 = static_cast<std::uint32_t>(seed), key1 = static_cast<std::uint32_t>(seed >> 32);
    for (int round = 0; round < philox::rounds; ++round) {
        c = philox::one_round(c, key0, key1);
        key0 += philox::step0;
        key1 += philox::step1;
    }
    return c;
}

/// Four random words.
MIS_INLINE Words random_words(std::uint64_t seed, const Counter& counter, Block block)
{
    return scrambled(seed, counter_words(counter, block));
}

/// A word over 2³² as a number in [0, 1). In float it is rounded, and held below 1; small ones keep
/// all of their bits, so that what is rare is drawn as often as it should be.
template <class T> MIS_INLINE T unit_number(std::uint32_t word)
{
    if constexpr (sizeof(T) == 4) {
        const T high = static_cast<T>(static_cast<std::int32_t>(word >> 16)) * T(0x1p-16),
                low = static_cast<T>(static_cast<std::int32_t>(word & 0xFFFFU)) * T(0x1p-32);
        const T number = high + low, below_1 = T(1 - 0x1p-24);
        return number < below_1 ? number : below_1;
    } else {
        return static_cast<T>(word) * T(0x1p-32);
    }
}

/// The 64 bits of a discrete choice.
MIS_INLINE std::uint64_t choice_bits(const Words& light_block)
{
    return std::uint64_t{light_block[0]} << 32 | light_block[1];
}

}  // namespace mis
