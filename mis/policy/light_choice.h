#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/sampling/discrete.h"
#include "mis/scene/light.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
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

}  // namespace mis
