#pragma once

#include "mis/policy/light_choice.h"

namespace mis {

/// Every light in turn: one sample is one draw for each (the lecture's "N per source"). Its
/// probability is the expected number of draws of a light per sample, 1.
class AllPolicy {
public:
    static constexpr std::string_view name = "all";
    static constexpr std::string_view summary = "one draw for every light";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    static constexpr bool draws_every_light = true, reads_all_lights = false;
    static constexpr std::size_t table_bytes(std::size_t) { return 0; }
    static bool keeps_tables(const Light&, const Light&) { return true; }

    explicit AllPolicy(const Lights&) {}

    template <class T>
    AllPolicy prepare(const ChoicePoint<Scalar<T>>&, const LightColumns<Scalar<T>>&, Scratch&) const
    {
        return *this;
    }
    Choice choose(std::uint64_t) const { return {no_light, 0}; }
    double probability(LightIndex) const { return 1; }
};
static_assert(LightChoice<AllPolicy, float>);

}  // namespace mis
