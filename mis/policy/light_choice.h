#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/math/irradiance.h"
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
/// And draws_go_together: its table has choose_each(), for many draws at once.
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
    T distance;          ///< to the centre, scene units
    T radius;            ///< scene units
    T luminance_radius;  ///< Y(L)·r
    T size;  ///< radius over the largest radius of the scene: its square stays a normal number

    /// Ω/(2π sin θ_max) = sin θ_max/(1 + cos θ_max): times another factor of r it is the solid
    /// angle; apart from it, it does not underflow.
    MIS_INLINE T solid_angle_over_sin() const
    {
        using std::sqrt;
        const T along = sqrt(max_of((distance - radius) * (distance + radius), number<T>(0)));
        return radius / (distance + along);  // over d above and below: one division
    }

    /// Its cap over the surface of normal n. A point that rounding puts into the light is on it.
    MIS_INLINE TiltedCap<T> tilted_cap(const Vec3<T>& n) const
    {
        using std::sqrt;
        const T d = max_of(distance, radius), inverse = number<T>(1) / d;
        return {radius * inverse, sqrt((d - radius) * (d + radius)) * inverse,
                dot(n, to_center) * inverse, length(cross(n, to_center)) * inverse};
    }
};

/// The table of a policy whose weight is a formula per light. weight(seen, n) ≥ 0 and finite; its
/// unit is free.
template <class T, class Weight>
MIS_INLINE RunningSum prepare_by_weight(const Weight& weight, const ChoicePoint<Scalar<T>>& point,
                                        const LightColumns<Scalar<T>>& lights, Scratch& scratch)
{
    const std::span<double> sums = scratch.take<double>(lights.count);
    const std::span<Scalar<T>> weights = scratch.take<Scalar<T>>(lights.x.size());
    const Vec3<T> x{T(point.x.x), T(point.x.y), T(point.x.z)},
        n{T(point.n.x), T(point.n.y), T(point.n.z)};
    for (std::size_t j = 0; j < lights.count; j += lane_count<T>) {
        const Vec3<T> to_center = Vec3<T>{load_lanes<T>(&lights.x[j]), load_lanes<T>(&lights.y[j]),
                                          load_lanes<T>(&lights.z[j])} -
                                  x;
        const T radius = load_lanes<T>(&lights.radius[j]);
        const SeenLight<T> seen{to_center, length(to_center), radius,
                                load_lanes<T>(&lights.luminance_radius[j]),
                                radius * T(lights.inverse_largest_radius)};
        store_lanes(&weights[j], weight(seen, n));
    }
    return RunningSum::over(std::span<const Scalar<T>>(weights.first(lights.count)), sums);
}

/// What prepare_by_weight takes of the scratch, for float or double weights.
constexpr std::size_t weight_table_bytes(std::size_t lights)
{
    return Scratch::bytes_for<double>(lights) + Scratch::bytes_for<double>(lights + 16);
}

}  // namespace mis
