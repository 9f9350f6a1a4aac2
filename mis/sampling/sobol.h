#pragma once

#include "mis/sampling/number_source.h"
#include "mis/sampling/random.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mis {

// Points of scrambled Sobol' sequences, each found by its number alone, so that any sample can be
// computed anywhere. In integers: the same on every machine. docs/theory.md §24.

/// The dimensions of a sequence. A light draw spends choice, u and v; a BSDF draw u, v and lobe;
/// both of them, where one is drawn at a time, the technique. The halves of a sample are added, so
/// that how one lies to the other does not matter: each has a sequence of its own, scrambled apart,
/// and both spend its best dimensions.
enum class Dimension : std::uint8_t {
    choice = 0,
    light_u = 1,
    light_v = 2,
    bsdf_u = 0,
    bsdf_v = 1,
    lobe = 2,
    technique = 3
};

/// Bit 0 becomes bit 31.
MIS_INLINE constexpr std::uint32_t reversed_bits(std::uint32_t x)
{
    x = x >> 16 | x << 16;
    x = (x >> 8 & 0x00FF'00FFu) | (x & 0x00FF'00FFu) << 8;
    x = (x >> 4 & 0x0F0F'0F0Fu) | (x & 0x0F0F'0F0Fu) << 4;
    x = (x >> 2 & 0x3333'3333u) | (x & 0x3333'3333u) << 2;
    return (x >> 1 & 0x5555'5555u) | (x & 0x5555'5555u) << 1;
}

/// The columns of a dimension's generator matrix, each with its bits reversed: the digit that
/// counts ½ is bit 0. Direction numbers: Joe and Kuo 2008, "Constructing Sobol sequences with
/// better two-dimensional projections", new-joe-kuo-6.21201.
constexpr std::array<std::uint32_t, 32> sobol_columns(Dimension dimension)
{
    struct Polynomial {
        std::size_t degree;
        std::uint32_t inner;             // coefficients but the first and the last
        std::array<std::uint32_t, 3> m;  // the first direction numbers
    };
    constexpr std::array<Polynomial, 4> polynomials{
        {{0, 0, {}}, {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};
    const Polynomial& p = polynomials[static_cast<std::size_t>(dimension)];
    std::array<std::uint32_t, 32> v{};
    for (std::size_t k = 0; k < 32; ++k) {
        if (p.degree == 0) {
            v[k] = 0x8000'0000u >> k;
            continue;
        }
        if (k < p.degree) {
            v[k] = p.m[k] << (31 - k);
            continue;
        }
        v[k] = v[k - p.degree] ^ v[k - p.degree] >> p.degree;
        for (std::size_t i = 1; i < p.degree; ++i)
            if ((p.inner >> (p.degree - 1 - i) & 1) != 0) v[k] ^= v[k - i];
    }
    for (std::uint32_t& column : v) column = reversed_bits(column);
    return v;
}

/// Scrambles the digits of a number in [0, 1): every digit is flipped or not by a hash of the key
/// and of all digits before it (Owen 1995), as Laine and Karras 2011 found to do by additions and
/// multiplications, which carry upwards alone. reversed: the first digit is bit 0; the result is an
/// ordinary number over 2³². Constants: Vegdahl 2021, "Building a Better LK Hash".
MIS_INLINE constexpr std::uint32_t owen_scrambled(std::uint32_t reversed, std::uint32_t key)
{
    reversed ^= reversed * 0x3d20'adeau;
    reversed += key;
    reversed *= key >> 16 | 1u;
    reversed ^= reversed * 0x0552'6c56u;
    reversed ^= reversed * 0x53a2'2864u;
    return reversed_bits(reversed);
}

/// Point `index` of a dimension's sequence, scrambled by `key`, over 2³².
constexpr std::uint32_t sobol_word(Dimension dimension, std::uint32_t index, std::uint32_t key)
{
    const std::array<std::uint32_t, 32> columns = sobol_columns(dimension);
    std::uint32_t word = 0;
    for (std::size_t bit = 0; bit < 32; ++bit) word ^= columns[bit] & (0u - (index >> bit & 1u));
    return owen_scrambled(word, key);
}

/// Which point of which sequence a draw spends.
struct SequencePoint {
    std::uint64_t scrambling;  ///< number of the scrambling at that shading point
    std::uint64_t index;       ///< in the sequence, from 0

    /// Draw `draw` of the `draws` that each sample spends on one sequence, in order.
    MIS_INLINE static SequencePoint of(std::uint64_t samples_per_scrambling, std::uint64_t sample,
                                       std::uint32_t draws, std::uint32_t draw)
    {
        return {sample / samples_per_scrambling, sample % samples_per_scrambling * draws + draw};
    }
};

/// The keys that scramble the dimensions of a block. stream: several sequences of one sample, as
/// one for every light of `all`, have each its own. A sequence ends after 2³² points, and the next
/// ones belong to another.
MIS_INLINE Words scrambling_keys(std::uint64_t seed, std::uint32_t point, const SequencePoint& at,
                                 std::uint32_t stream, Block block)
{
    const std::uint64_t apart = 0x736f'626f'6c00'0000u;  // "sobol": no sample has such numbers
    const std::uint64_t sequence = at.index >> 32;
    return random_words((seed ^ apart) + sequence * 0x9E37'79B9'7F4A'7C15u,
                        {point, at.scrambling, stream}, block);
}

/// Keys by what they are for, in a block's four words.
namespace key_of {
inline constexpr std::size_t choice = 0, light_u = 1, light_v = 2;
inline constexpr std::size_t technique = 0, lobe = 1, bsdf_u = 2, bsdf_v = 3;
}  // namespace key_of

}  // namespace mis
