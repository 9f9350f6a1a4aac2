#include "mis/trace/light_boxes.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>

namespace mis {

namespace {

using Node = LightNode;
constexpr std::size_t width = LightNode::width;

std::uint32_t children_of(const Node& node) { return (1U << (node.nodes + node.lights)) - 1; }
std::uint32_t nodes_of(const Node& node) { return (1U << node.nodes) - 1; }

/// The part of [from, to] that is also between t0 and t1, in either order.
MIS_INLINE void narrow(const FourFloats& t0, const FourFloats& t1, FourFloats& from, FourFloats& to)
{
    from = larger(from, smaller(t0, t1));
    to = smaller(to, larger(t0, t1));
}

std::uint32_t open_by_fours(const BoxRay& ray, const Node& node, float limit, WaitingNodes& stack)
{
    FourFloats from_a = four(0), from_b = four(0), to_a = four(limit), to_b = four(limit);
    for (std::size_t a = 0; a < 3; ++a) {
        const FourFloats step = four(node.step[a] * ray.inverse[a]);
        const FourFloats low = four((node.low_origin[a] - ray.high_origin[a]) * ray.inverse[a]),
                         high = four((node.high_origin[a] - ray.low_origin[a]) * ray.inverse[a]);
        const EightFloats low_steps = eight_of(node.low[a].data()),
                          high_steps = eight_of(node.high[a].data());
        narrow(low_steps.a * step + low, high_steps.a * step + high, from_a, to_a);
        narrow(low_steps.b * step + low, high_steps.b * step + high, from_b, to_b);
    }
    std::array<float, width> near;  // NOLINT
    put(from_a, &near[0]), put(from_b, &near[4]);
    const std::uint32_t met =
        (not_above(from_a, to_a) | not_above(from_b, to_b) << 4) & children_of(node);
    for (std::uint32_t nodes = met & nodes_of(node); nodes != 0; nodes &= nodes - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(nodes));
        stack.node[stack.count] = node.first_node + k;
        stack.near[stack.count++] = near[k];
    }
    return met >> node.nodes;
}

#if defined(__x86_64__)
// The same, operation by operation, eight boxes at once. Functions of their own target: nothing
// that is compiled here for AVX2 can be linked anywhere else.
#define MIS_AVX2 __attribute__((target("avx2,popcnt")))

/// The places of the bits of a byte, in order.
constexpr auto bits_of_byte = [] {
    std::array<std::array<std::uint8_t, width>, 256> places{};
    for (std::size_t byte = 0; byte < 256; ++byte)
        for (std::size_t bit = 0, n = 0; bit < width; ++bit)
            if ((byte >> bit & 1) != 0) places[byte][n++] = static_cast<std::uint8_t>(bit);
    return places;
}();

MIS_AVX2 inline __m256 eight_steps(const std::uint8_t* bytes)
{
    return _mm256_cvtepi32_ps(
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes))));
}

MIS_AVX2 inline void narrow_eight(const Node& node, std::size_t axis, __m256 step, __m256 low,
                                  __m256 high, __m256& from, __m256& to)
{
    const __m256 t0 = _mm256_add_ps(_mm256_mul_ps(eight_steps(node.low[axis].data()), step), low);
    const __m256 t1 = _mm256_add_ps(_mm256_mul_ps(eight_steps(node.high[axis].data()), step), high);
    from = _mm256_max_ps(from, _mm256_min_ps(t0, t1));
    to = _mm256_min_ps(to, _mm256_max_ps(t0, t1));
}

MIS_AVX2 std::uint32_t open_by_eights(const BoxRay& ray, const Node& node, float limit,
                                      WaitingNodes& stack)
{
    // Axes in lanes first; the fourth is not read, and is 0.
    const __m128i axes = _mm_set_epi32(0, -1, -1, -1);
    const __m128 inverse = _mm_load_ps(ray.inverse.data());
    const __m128 steps = _mm_mul_ps(_mm_maskload_ps(node.step.data(), axes), inverse);
    const __m128 low = _mm_mul_ps(_mm_sub_ps(_mm_maskload_ps(node.low_origin.data(), axes),
                                             _mm_load_ps(ray.high_origin.data())),
                                  inverse);
    const __m128 high = _mm_mul_ps(_mm_sub_ps(_mm_maskload_ps(node.high_origin.data(), axes),
                                              _mm_load_ps(ray.low_origin.data())),
                                   inverse);
    __m256 from = _mm256_setzero_ps(), to = _mm256_set1_ps(limit);
#define MIS_AXIS(axis, lane)                                                     \
    narrow_eight(node, axis, _mm256_broadcastss_ps(_mm_permute_ps(steps, lane)), \
                 _mm256_broadcastss_ps(_mm_permute_ps(low, lane)),               \
                 _mm256_broadcastss_ps(_mm_permute_ps(high, lane)), from, to)
    MIS_AXIS(0, 0x00);
    MIS_AXIS(1, 0x55);
    MIS_AXIS(2, 0xaa);
#undef MIS_AXIS
    const std::uint32_t met =
        static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(from, to, _CMP_LE_OS))) &
        children_of(node);
    // All of them at once: a branch for each would often be mispredicted.
    const std::uint32_t nodes = met & nodes_of(node);
    const __m256i places = _mm256_cvtepu8_epi32(
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(bits_of_byte[nodes].data())));
    _mm256_storeu_si256(
        reinterpret_cast<__m256i*>(&stack.node[stack.count]),
        _mm256_add_epi32(places, _mm256_set1_epi32(static_cast<int>(node.first_node))));
    _mm256_storeu_ps(&stack.near[stack.count], _mm256_permutevar8x32_ps(from, places));
    stack.count += static_cast<std::size_t>(std::popcount(nodes));
    return met >> node.nodes;
}
#undef MIS_AVX2
#endif

}  // namespace

const BoxRay::OpenNode BoxRay::open_node = [] {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) return &open_by_eights;
#endif
    return &open_by_fours;
}();

}  // namespace mis
