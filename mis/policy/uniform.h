#pragma once

#include "mis/policy/light_choice.h"

namespace mis {

/// Every light alike.
class UniformPolicy {
public:
    static constexpr std::string_view name = "uniform";
    static constexpr std::string_view summary = "alike from all lights, 1/M";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    static constexpr bool draws_every_light = false, reads_all_lights = false;
    static constexpr std::size_t table_bytes(std::size_t) { return 0; }
    static bool keeps_tables(const Light&, const Light&) { return true; }

    explicit UniformPolicy(const Lights& lights) : count_(lights.size()) {}

    template <class T>
    UniformPolicy prepare(const ChoicePoint<Scalar<T>>&, const LightColumns<Scalar<T>>&,
                          Scratch&) const
    {
        return *this;
    }
    Choice choose(std::uint64_t bits) const
    {
        if (count_ == 0) return {no_light, 0};
        __extension__ using Wide = unsigned __int128;
        return {static_cast<LightIndex>(static_cast<Wide>(bits) * count_ >> 64), probability(0)};
    }
    double probability(LightIndex) const { return 1 / static_cast<double>(count_); }

private:
    std::uint64_t count_;
};
static_assert(LightChoice<UniformPolicy, float>);

}  // namespace mis
