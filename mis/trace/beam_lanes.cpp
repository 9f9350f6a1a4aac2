#include "mis/math/four_floats.h"
#include "mis/trace/beam.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>

namespace mis {

namespace {

// One formula, by four and by eight lanes, of beams or of spheres. In the plane of the sphere's
// centre and the axis, `along` and `across`: the balls' hull is straight there, so a sphere is
// clear of it where across · cos > radius + reach + slope · along, which is squared; or where it
// lies before the first ball or behind the last. NaN rules nothing out.

struct Fours {
    FourFloats x, y, z;
};

/// Bit k: lane k is ruled out.
MIS_INLINE std::uint32_t clear_fours(const Fours& center, FourFloats reach, const Fours& from,
                                     const Fours& axis, FourFloats radius, FourFloats slope,
                                     FourFloats cos2, FourFloats end)
{
    const FourFloats x = center.x - from.x, y = center.y - from.y, z = center.z - from.z;
    const FourFloats along = x * axis.x + y * axis.y + z * axis.z;
    const FourFloats a = y * axis.z - z * axis.y, b = z * axis.x - x * axis.z,
                     c = x * axis.y - y * axis.x;
    const FourFloats across2 = a * a + b * b + c * c, both = radius + reach;
    const FourFloats there = both + slope * along;
    return above(across2 * cos2, there * there) | above(four(0) - both, along) |
           above(along - reach, end);
}

Fours fours_of(const std::array<float, 3>& v) { return {four(v[0]), four(v[1]), four(v[2])}; }
Fours fours_at(const std::array<Beams::Each, 3>& v, std::size_t k)
{
    return {four_of(&v[0][k]), four_of(&v[1][k]), four_of(&v[2][k])};
}

std::size_t meet_by_fours(const Beam& beam, const FloatSpheres& spheres, LightList list,
                          std::uint32_t beams, ListedLight* found)
{
    std::size_t count = 0;
    for (std::size_t g = 0; g < list.size_in_groups(); ++g) {
        const std::uint16_t* lights = list.lights_of(g);
        const std::uint16_t* in = list.beams_of(g);
        for (std::size_t half = 0; half < LightList::group; half += 4) {
            std::array<std::array<float, 4>, 4> of;  // NOLINT: [coordinate][lane], filled here
            std::uint32_t asked = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const std::array<float, 4>& sphere = spheres.sphere[lights[half + k]];
                for (std::size_t c = 0; c < 4; ++c) of[c][k] = sphere[c];
                asked |= (in[half + k] & beams) != 0 ? 1U << k : 0;
            }
            if (asked == 0) continue;
            std::uint32_t met =
                asked &
                ~clear_fours({four_of(of[0].data()), four_of(of[1].data()), four_of(of[2].data())},
                             four_of(of[3].data()), fours_of(beam.from), fours_of(beam.axis),
                             four(beam.radius), four(beam.slope), four(beam.cos2), four(beam.end));
            for (; met != 0; met &= met - 1)
                found[count++] = lights[half + static_cast<std::size_t>(std::countr_zero(met))];
        }
    }
    return count;
}

std::uint32_t meeting_by_fours(const Beams& beams, const std::array<float, 4>& sphere)
{
    const Fours center{four(sphere[0]), four(sphere[1]), four(sphere[2])};
    std::uint32_t clear = 0;
    for (std::size_t k = 0; k < Beams::most; k += 4)
        clear |=
            clear_fours(center, four(sphere[3]), fours_at(beams.from, k), fours_at(beams.axis, k),
                        four_of(&beams.radius[k]), four_of(&beams.slope[k]),
                        four_of(&beams.cos2[k]), four_of(&beams.end[k]))
            << k;
    return ~clear & 0xffffU;
}

#if defined(__x86_64__)
// Functions of their own target: nothing that is compiled here for AVX2 can be linked anywhere
// else.
#define MIS_AVX2 __attribute__((target("avx2,popcnt,bmi")))

struct Eights {
    __m256 x, y, z;
};

/// As clear_fours().
MIS_AVX2 inline std::uint32_t clear_eights(const Eights& center, const __m256& reach,
                                           const Eights& from, const Eights& axis,
                                           const __m256& radius, const __m256& slope,
                                           const __m256& cos2, const __m256& end)
{
    const __m256 x = _mm256_sub_ps(center.x, from.x), y = _mm256_sub_ps(center.y, from.y),
                 z = _mm256_sub_ps(center.z, from.z);
    const __m256 along =
        _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, axis.x), _mm256_mul_ps(y, axis.y)),
                      _mm256_mul_ps(z, axis.z));
    const __m256 a = _mm256_sub_ps(_mm256_mul_ps(y, axis.z), _mm256_mul_ps(z, axis.y)),
                 b = _mm256_sub_ps(_mm256_mul_ps(z, axis.x), _mm256_mul_ps(x, axis.z)),
                 c = _mm256_sub_ps(_mm256_mul_ps(x, axis.y), _mm256_mul_ps(y, axis.x));
    const __m256 across2 =
        _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(a, a), _mm256_mul_ps(b, b)), _mm256_mul_ps(c, c));
    const __m256 both = _mm256_add_ps(radius, reach);
    const __m256 there = _mm256_add_ps(both, _mm256_mul_ps(slope, along));
    const __m256 beside = _mm256_cmp_ps(_mm256_mul_ps(across2, cos2), _mm256_mul_ps(there, there),
                                        _CMP_GT_OQ),
                 before =
                     _mm256_cmp_ps(_mm256_sub_ps(_mm256_setzero_ps(), both), along, _CMP_GT_OQ),
                 behind = _mm256_cmp_ps(_mm256_sub_ps(along, reach), end, _CMP_GT_OQ);
    return static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_or_ps(beside, _mm256_or_ps(before, behind))));
}

MIS_AVX2 inline Eights eights_of(const std::array<float, 3>& v)
{
    return {_mm256_set1_ps(v[0]), _mm256_set1_ps(v[1]), _mm256_set1_ps(v[2])};
}
MIS_AVX2 inline Eights eights_at(const std::array<Beams::Each, 3>& v, std::size_t k)
{
    return {_mm256_loadu_ps(&v[0][k]), _mm256_loadu_ps(&v[1][k]), _mm256_loadu_ps(&v[2][k])};
}

MIS_AVX2 std::size_t meet_by_eights(const Beam& beam, const FloatSpheres& spheres, LightList list,
                                    std::uint32_t beams, ListedLight* found)
{
    const Eights from = eights_of(beam.from), axis = eights_of(beam.axis);
    const __m256 radius = _mm256_set1_ps(beam.radius), slope = _mm256_set1_ps(beam.slope),
                 cos2 = _mm256_set1_ps(beam.cos2), end = _mm256_set1_ps(beam.end);
    const __m128i asked_beams = _mm_set1_epi16(static_cast<short>(beams));
    const std::array<float, 4>* sphere = spheres.sphere.data();
    std::size_t count = 0;
    for (std::size_t g = 0; g < list.size_in_groups(); ++g) {
        const std::uint16_t* lights = list.lights_of(g);
        const __m128i in = _mm_loadu_si128(reinterpret_cast<const __m128i*>(list.beams_of(g)));
        const __m128i idle = _mm_cmpeq_epi16(_mm_and_si128(in, asked_beams), _mm_setzero_si128());
        const auto not_asked = static_cast<std::uint32_t>(
            _mm_movemask_epi8(_mm_packs_epi16(idle, _mm_setzero_si128())));
        if (not_asked == 0xff) continue;
            // Eight spheres, then coordinates in lanes.
#define MIS_PAIR(k)                                                                      \
    _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(sphere[lights[k]].data())), \
                         _mm_loadu_ps(sphere[lights[(k) + 4]].data()), 1)
        const __m256 s0 = MIS_PAIR(0), s1 = MIS_PAIR(1), s2 = MIS_PAIR(2), s3 = MIS_PAIR(3);
#undef MIS_PAIR
        const __m256 xy01 = _mm256_unpacklo_ps(s0, s1), xy23 = _mm256_unpacklo_ps(s2, s3),
                     zr01 = _mm256_unpackhi_ps(s0, s1), zr23 = _mm256_unpackhi_ps(s2, s3);
        const Eights center{_mm256_shuffle_ps(xy01, xy23, 0x44),
                            _mm256_shuffle_ps(xy01, xy23, 0xee),
                            _mm256_shuffle_ps(zr01, zr23, 0x44)};
        const __m256 reach = _mm256_shuffle_ps(zr01, zr23, 0xee);
        std::uint32_t met =
            ~(not_asked | clear_eights(center, reach, from, axis, radius, slope, cos2, end)) & 0xff;
        for (; met != 0; met &= met - 1) found[count++] = lights[std::countr_zero(met)];
    }
    return count;
}

MIS_AVX2 std::uint32_t meeting_by_eights(const Beams& beams, const std::array<float, 4>& sphere)
{
    const Eights center{_mm256_set1_ps(sphere[0]), _mm256_set1_ps(sphere[1]),
                        _mm256_set1_ps(sphere[2])};
    const __m256 reach = _mm256_set1_ps(sphere[3]);
    std::uint32_t clear = 0;
    for (std::size_t k = 0; k < Beams::most; k += 8)
        clear |= clear_eights(center, reach, eights_at(beams.from, k), eights_at(beams.axis, k),
                              _mm256_loadu_ps(&beams.radius[k]), _mm256_loadu_ps(&beams.slope[k]),
                              _mm256_loadu_ps(&beams.cos2[k]), _mm256_loadu_ps(&beams.end[k]))
                 << k;
    return ~clear & 0xffffU;
}
#undef MIS_AVX2
#endif

}  // namespace

const BeamTests BeamTests::by_fours{&meet_by_fours, &meeting_by_fours};

const BeamTests BeamTests::best = [] {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) return BeamTests{&meet_by_eights, &meeting_by_eights};
#endif
    return BeamTests{&meet_by_fours, &meeting_by_fours};
}();

}  // namespace mis
