#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <ranges>
#include <string_view>

namespace mis {

/// What may have to be simulated, in the order in which it is explained.
enum class Effect : std::uint8_t {
    shadows,          ///< surfaces that could hide a light
    light_occlusion,  ///< lights that could hide one another
    horizon,          ///< lights that some point's horizon may cut or hide
    specular,         ///< a lobe beside a material's diffuse part
    choice,           ///< a light is one of several
    colour            ///< lights or materials other than grey
};

/// What they are called, in their order.
inline constexpr std::array effect_names{"shadows",  "light_occlusion", "horizon",
                                         "specular", "choice",          "colour"};
inline constexpr std::size_t effect_count = effect_names.size();
static_assert(effect_count == static_cast<std::size_t>(Effect::colour) + 1);

/// "shadows", …
constexpr const char* name_of(Effect effect)
{
    return effect_names[static_cast<std::size_t>(effect)];
}

/// The effect of that name, where one is called so.
constexpr std::optional<Effect> find_effect(std::string_view name)
{
    for (std::size_t i = 0; i < effect_count; ++i)
        if (name == effect_names[i]) return static_cast<Effect>(i);
    return std::nullopt;
}

/// Some effects: one bit each. A range of them, in their order.
class EffectSet {
public:
    constexpr EffectSet() = default;
    constexpr EffectSet(std::initializer_list<Effect> effects)
    {
        for (const Effect effect : effects) set(effect, true);
    }
    static constexpr EffectSet all() { return of_bits((1U << effect_count) - 1); }
    /// The set whose bits() these are.
    static constexpr EffectSet of_bits(std::size_t bits)
    {
        EffectSet set;
        set.bits_ = static_cast<std::uint8_t>(bits);
        return set;
    }

    constexpr bool has(Effect effect) const { return (bits_ & bit(effect)) != 0; }
    constexpr void set(Effect effect, bool on)
    {
        bits_ = static_cast<std::uint8_t>(on ? bits_ | bit(effect) : bits_ & ~bit(effect));
    }
    /// A number of its own for each set: bit i for the i-th effect.
    constexpr std::size_t bits() const { return bits_; }

    friend constexpr EffectSet operator|(EffectSet a, EffectSet b)
    {
        return of_bits(a.bits() | b.bits());
    }
    friend constexpr EffectSet operator&(EffectSet a, EffectSet b)
    {
        return of_bits(a.bits() & b.bits());
    }
    /// Those of a that are not in b.
    friend constexpr EffectSet operator-(EffectSet a, EffectSet b)
    {
        return of_bits(a.bits() & ~b.bits());
    }
    constexpr bool operator==(const EffectSet&) const = default;

    /// Goes through the effects of a set.
    class Iterator {
    public:
        using value_type = Effect;
        using difference_type = std::ptrdiff_t;
        constexpr Iterator() = default;
        constexpr explicit Iterator(unsigned rest) : rest_(rest) {}
        constexpr Effect operator*() const
        {
            int i = 0;
            while ((rest_ >> i & 1U) == 0) ++i;
            return static_cast<Effect>(i);
        }
        constexpr Iterator& operator++() { return rest_ &= rest_ - 1, *this; }
        constexpr Iterator operator++(int)
        {
            const Iterator before = *this;
            ++*this;
            return before;
        }
        constexpr bool operator==(const Iterator&) const = default;

    private:
        unsigned rest_ = 0;  ///< bits of those that are still to come
    };
    constexpr Iterator begin() const { return Iterator(bits_); }
    constexpr Iterator end() const { return Iterator(0); }

private:
    static constexpr unsigned bit(Effect effect) { return 1U << static_cast<unsigned>(effect); }

    std::uint8_t bits_ = 0;
};
static_assert(std::ranges::forward_range<EffectSet>);

/// Those that each tile says of itself (effects/tile_plan.h); of the others the scene and its
/// materials do.
inline constexpr EffectSet effects_of_tiles{Effect::shadows, Effect::light_occlusion,
                                            Effect::horizon};

}  // namespace mis
