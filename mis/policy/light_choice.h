#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/math/irradiance.h"
#include "mis/math/root.h"
#include "mis/sampling/discrete.h"
#include "mis/scene/light.h"

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>

namespace mis {

/// The lights as one array per field, relative to an origin near the points at hand: what a loop
/// over all lights reads. Padded with lights of radius 0 at a distance, so that lanes need no
/// remainder.
template <class T> struct LightColumns {
    std::size_t count = 0;                ///< without the padding
    std::span<const T> x;                 ///< of the centre, scene units
    std::span<const T> y;                 ///< of the centre
    std::span<const T> z;                 ///< of the centre
    std::span<const T> radius;            ///< scene units
    std::span<const T> luminance_radius;  ///< Y(L)·r
    T inverse_largest_radius = 1;         ///< of all lights
};

/// A shading point as policies see it.
template <class T> struct ChoicePoint {
    Vec3<T> x;               ///< relative to the origin of the columns
    Vec3<T> n;               ///< unit normal
    Vec3<T> wo{0, 0, 1};     ///< unit, to the viewer, in the shading frame about n
    AnyBsdf bsdf{};          ///< of the surface; a policy that is not told takes it for Lambertian
    Vec3<double> origin{0};  ///< what x is relative to; for policies that keep the lights' places
};

/// Room for the tables of some points; handed out from the front, and all taken back at once.
class Scratch {
public:
    /// Allocates; take() does not.
    explicit Scratch(std::size_t bytes) : storage_(bytes), size_(bytes) {}
    /// Takes all back.
    void clear() { used_ = 0; }
    /// Bytes in all.
    std::size_t size() const { return size_; }
    /// Bytes that are not handed out.
    std::size_t left() const { return size_ - used_; }

    /// Room for n numbers of type N, on a boundary of 64 bytes. Precondition: bytes_for<N>(n) ≤
    /// left().
    template <class N> MIS_INLINE std::span<N> take(std::size_t n)
    {
        std::byte* start = storage_.data() + used_;
        const auto misaligned = reinterpret_cast<std::uintptr_t>(start) % 64;
        if (misaligned != 0) start += 64 - misaligned;
        used_ += bytes_for<N>(n);
        return {reinterpret_cast<N*>(start), n};
    }
    /// What take<N>(n) takes at most.
    template <class N> static constexpr std::size_t bytes_for(std::size_t n)
    {
        return (n * sizeof(N) + 127) / 64 * 64;
    }

private:
    LargeVector<std::byte> storage_;
    std::size_t size_ = 0, used_ = 0;
};

/// What a policy knows of one shading point. The probabilities of all lights sum to 1, or are all
/// 0; a light that can contribute has a positive one. choose(bits).probability equals
/// probability(choose(bits).light) exactly. bits: 64 random bits; a float number would starve
/// lights where there are millions.
// clang-format off
template <class Table>
concept ChoiceTable = requires(const Table& table, std::uint64_t bits, LightIndex light) {
    { table.choose(bits) } -> std::same_as<Choice>;
    { table.probability(light) } -> std::same_as<double>;
};
// clang-format on

/// The question a light-choice policy answers: which light should a point spend its next draw on?
/// prepare<T>() is called once per shading point (T may be a batch: lanes run over the lights); the
/// point's samples share the table it returns, a small trivially copyable view.
/// table_bytes(lights): the scratch it takes. draws_every_light: one sample is one draw for every
/// light (`all`); choose() is not asked. reads_all_lights: false where prepare() does not look
/// at the columns, which then need not be there: with one table for every point, or a hierarchy.
/// It may have keeps_tables(before, after): does it stay as it is when one light becomes another?
/// And weighs_by_irradiance: on a surface without a lobe, P is in proportion to Y(L)·E, which is a
/// promise that some strategies have no variance. And draws_go_together: its table has
/// choose_each(), for many draws at once.
/// And ranked_by_default(lights, has_lobes): is it ranked where no policy is named, on a scene of
/// so many lights, on whose surfaces some BSDF has a lobe or none has? Left out: never.
// clang-format off
template <class P, class T>
concept LightChoice = std::constructible_from<P, const Lights&> &&
    requires(const P& policy, const ChoicePoint<Scalar<T>>& point,
             const LightColumns<Scalar<T>>& columns, Scratch& scratch) {
    { P::name } -> std::convertible_to<std::string_view>;
    { P::summary } -> std::convertible_to<std::string_view>;
    { P::draws_every_light } -> std::convertible_to<bool>;
    { P::reads_all_lights } -> std::convertible_to<bool>;
    { P::table_bytes(std::size_t{}) } -> std::same_as<std::size_t>;
    { policy.template prepare<T>(point, columns, scratch) } -> ChoiceTable;
};
// clang-format on

/// Does a policy stay as it is when one of its lights becomes another? One that looks at all lights
/// at each point keeps nothing of them.
template <class Policy> bool keeps_tables(const Light& before, const Light& after)
{
    if constexpr (requires { Policy::keeps_tables(before, after); })
        return Policy::keeps_tables(before, after);
    else return Policy::reads_all_lights;
}

/// One light of the columns as seen from a point, or a batch of them.
template <class T> struct SeenLight {
    Vec3<T> to_center;   ///< from the point, scene units
    T distance2;         ///< to the centre, squared
    T radius;            ///< scene units
    T luminance_radius;  ///< Y(L)·r
    T size;  ///< radius over the largest radius of the scene: its square stays a normal number

    /// To the centre, scene units. A point that rounding puts into the light is on it.
    MIS_INLINE T distance() const
    {
        using std::sqrt;
        return max_of(T(sqrt(distance2)), radius);
    }

    /// 1/distance().
    MIS_INLINE T inverse_distance() const { return number<T>(1) / distance(); }

    /// Ω/(2π r) = r/(d² + d √(d² − r²)): times another factor of r it is the solid angle; apart
    /// from it, it does not underflow.
    MIS_INLINE T solid_angle_over_radius() const
    {
        const T r2 = radius * radius,
                d2 = min_of(max_of(distance2, max_of(r2, number<T>(1e-37))), number<T>(1e38));
        return radius / (d2 + root_of_product(d2, T(d2 - r2)));
    }

    /// Its cap over the surface of normal n.
    MIS_INLINE TiltedCap<T> tilted_cap(const Vec3<T>& n) const
    {
        using std::sqrt;
        const T d = distance(), inverse = inverse_distance();
        return {radius * inverse, sqrt((d - radius) * (d + radius)) * inverse,
                dot(n, to_center) * inverse, length(cross(n, to_center)) * inverse};
    }
};

/// A vector in every lane.
template <class T> MIS_INLINE Vec3<T> in_lanes(const Vec3<Scalar<T>>& v)
{
    return {T(v.x), T(v.y), T(v.z)};
}

/// Lights [first, first + lane_count) of the columns.
template <class T>
MIS_INLINE SeenLight<T> seen_light(const LightColumns<Scalar<T>>& lights, std::size_t first,
                                   const Vec3<T>& x)
{
    const Vec3<T> to_center =
        Vec3<T>{load_lanes<T>(&lights.x[first]), load_lanes<T>(&lights.y[first]),
                load_lanes<T>(&lights.z[first])} -
        x;
    const T radius = load_lanes<T>(&lights.radius[first]);
    return {to_center, dot(to_center, to_center), radius,
            load_lanes<T>(&lights.luminance_radius[first]),
            radius * T(lights.inverse_largest_radius)};
}

/// A point and the lights that it sees.
template <class S> struct SeenLights {
    ChoicePoint<S> point;    ///< as policies see it
    LightColumns<S> lights;  ///< all of them
};

namespace detail {

/// The weights of a block of lights; of what is beyond the last light 0.
template <class T, class Weight>
MIS_INLINE void weigh_block(const Weight& weight, const Vec3<T>& x, const Vec3<T>& n,
                            const LightColumns<Scalar<T>>& lights, std::size_t block,
                            Scalar<T>* weights)
{
    const std::size_t first = block * block_size;
    for (std::size_t k = 0; k < block_size; k += lane_count<T>)
        store_lanes(&weights[k], T(weight(seen_light<T>(lights, first + k, x), n)));
    for (std::size_t k = lights.count - first; k < block_size; ++k) weights[k] = 0;
}

/// The same for one block, by the name of the weights.
template <class T, class Weights>
MIS_OWN_COPY void weigh_again(const SeenLights<Scalar<T>>& seen, std::size_t block,
                              Scalar<T>* weights)
{
    Weights::template visit_weight<T>(
        seen.point, [&](const auto& weight) __attribute__((always_inline)) {
            weigh_block<T>(weight, in_lanes<T>(seen.point.x), in_lanes<T>(seen.point.n),
                           seen.lights, block, weights);
        });
}

}  // namespace detail

/// The table of a policy whose weight is a formula per light: of a few lights their running sum; of
/// more, the running sum of blocks of 16. The weights of a block are kept; of many lights, which no
/// cache would hold, they are formed anew when one is asked for, by the same lanes, so to the last
/// bit. Weights: the policy, for its visit_weight<T>(point, use), which calls use(weight);
/// weight(seen light, n) ≥ 0 and finite; its unit is free.
template <class T, class Weights> class WeightTable {
    using S = Scalar<T>;

public:
    /// Up to so many lights each has a sum of its own.
    static constexpr std::size_t most_single = 32;
    /// Up to so many the weights are kept.
    static constexpr std::size_t most_kept = std::size_t{1} << 14;

    /// A table to fill: from the first block on, in as many steps as one likes, of some blocks
    /// each.
    MIS_INLINE static WeightTable begin(const ChoicePoint<S>& point, const LightColumns<S>& lights,
                                        Scratch& scratch)
    {
        WeightTable table;
        const std::size_t count = lights.count;
        if (count <= most_single) {
            table.sums_ = scratch.take<double>(count).data();
        } else {
            table.sums_ = scratch.take<double>(blocks_of(count)).data();
            if (count <= most_kept) {
                table.weights_ = scratch.take<S>(blocks_of(count) * block_size).data();
            } else {
                table.seen_ = scratch.take<Seen>(1).data();
                *table.seen_ = {point, lights};
            }
        }
        return table;
    }
    /// Fills in blocks [first, end); those before are filled in.
    MIS_INLINE void fill(const ChoicePoint<S>& point, const LightColumns<S>& lights,
                         std::size_t first, std::size_t end)
    {
        double sum = first > 0 ? sums_[first - 1] : 0;
        const LightColumns<S> columns = lights;  // nothing else can reach it: it stays in registers
        const Vec3<T> x = in_lanes<T>(point.x), n = in_lanes<T>(point.n);
        Weights::template visit_weight<T>(
            point, [&](const auto& weight) __attribute__((always_inline)) {
                constexpr std::size_t some =
                    8;  // blocks at a time: what is stored now is read later
                alignas(64) std::array<S, some * block_size> room;  // NOLINT: filled by weigh_block
                for (std::size_t b = first; b < end; b += some) {
                    const std::size_t count = std::min(some, end - b);
                    S* weights = weights_ != nullptr ? weights_ + b * block_size : room.data();
                    for (std::size_t k = 0; k < count; ++k)
                        detail::weigh_block<T>(weight, x, n, columns, b + k,
                                               weights + k * block_size);
                    for (std::size_t k = 0; k < count; ++k)
                        sums_[b + k] = sum += sum_of_block(weights + k * block_size);
                }
            });
    }
    /// The same where there are so many lights that no weights are kept.
    MIS_INLINE void fill_more(std::size_t first, std::size_t end)
    {
        fill(seen_->point, seen_->lights, first, end);
    }
    /// All of it, in one step.
    MIS_INLINE static WeightTable over(const ChoicePoint<S>& point, const LightColumns<S>& lights,
                                       Scratch& scratch)
    {
        WeightTable table = begin(point, lights, scratch);
        if (lights.count <= most_single) table.fill_few(point, lights);
        else table.fill(point, lights, 0, blocks_of(lights.count));
        table.end(lights);
        return table;
    }
    /// To be called when all is filled in.
    MIS_INLINE void end(const LightColumns<S>& lights)
    {
        const std::size_t count = lights.count;
        total_ = RunningSum(
            std::span<const double>(sums_, count <= most_single ? count : blocks_of(count)));
    }

    /// A light by 64 random bits; no_light and 0 where all weights are 0.
    MIS_INLINE Choice choose(std::uint64_t bits) const
    {
        if (is_of_few()) return total_.choose(bits);
        if (!(total_.inverse_total() > 0)) return {no_light, 0};
        const auto [block, rest] = total_.find(bits);
        std::array<S, block_size> room;  // NOLINT: filled as it is needed
        const S* weights = weights_of(block, room);
        const std::size_t k = place_in_block(weights, rest);
        return {static_cast<LightIndex>(block * block_size + k),
                static_cast<double>(weights[k]) * total_.inverse_total()};
    }
    /// put(i, choose(bits[i])) for all i; L: lanes of double.
    template <class L, class Put>
    MIS_INLINE void choose_many(std::span<const std::uint64_t> bits, const Put& put) const
    {
        if (is_of_few()) return total_.template choose_many<L>(bits, put);
        for (std::size_t i = 0; i < bits.size(); ++i) put(i, choose(bits[i]));
    }
    /// How likely a light is chosen.
    MIS_INLINE double probability(LightIndex light) const
    {
        if (is_of_few()) return total_.probability(light);
        const auto j = static_cast<std::size_t>(light);
        std::array<S, block_size> room;  // NOLINT: filled as it is needed
        return static_cast<double>(weights_of(j / block_size, room)[j % block_size]) *
               total_.inverse_total();
    }

    /// How many blocks so many lights make.
    static constexpr std::size_t blocks_of(std::size_t lights)
    {
        return (lights + block_size - 1) / block_size;
    }
    /// What it takes of the scratch, for float or double weights.
    static constexpr std::size_t bytes(std::size_t lights)
    {
        if (lights <= most_single) return Scratch::bytes_for<double>(lights);
        const std::size_t blocks = blocks_of(lights);
        return Scratch::bytes_for<double>(blocks) +
               (lights <= most_kept ? Scratch::bytes_for<double>(blocks * block_size)
                                    : Scratch::bytes_for<SeenLights<S>>(1));
    }

private:
    using Seen = SeenLights<S>;

    MIS_INLINE bool is_of_few() const { return weights_ == nullptr && seen_ == nullptr; }

    MIS_INLINE void fill_few(const ChoicePoint<S>& point, const LightColumns<S>& lights)
    {
        Weights::template visit_weight<T>(
            point, [&](const auto& weight) __attribute__((always_inline)) {
                alignas(64) std::array<S, most_single> weights;  // NOLINT: filled as it is read
                for (std::size_t b = 0; b * block_size < lights.count; ++b)
                    detail::weigh_block<T>(weight, in_lanes<T>(point.x), in_lanes<T>(point.n),
                                           lights, b, &weights[b * block_size]);
                RunningSum::over(std::span<const S>(weights).first(lights.count),
                                 std::span<double>(sums_, lights.count));
            });
    }

    MIS_INLINE const S* weights_of(std::size_t block, std::array<S, block_size>& room) const
    {
        if (weights_ != nullptr) return weights_ + block * block_size;
        detail::weigh_again<T, Weights>(*seen_, block, room.data());
        return room.data();
    }

    RunningSum total_;        ///< of lights, or of blocks
    double* sums_ = nullptr;  ///< that it stands on
    S* weights_ = nullptr;    ///< kept
    Seen* seen_ = nullptr;    ///< nullptr where they are
};

/// What the table of a policy takes of the scratch whose weight is a formula per light.
template <class Weights> constexpr std::size_t weight_table_bytes(std::size_t lights)
{
    return WeightTable<double, Weights>::bytes(lights);
}

}  // namespace mis
