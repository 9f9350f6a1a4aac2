#pragma once

#include "mis/policy/light_choice.h"

#include <memory>

namespace mis {

/// Draws lights in proportion to the power they emit, wherever the point is (Shirley, Wang and
/// Zimmerman 1996).
class PowerPolicy {
public:
    static constexpr std::string_view name = "power";
    static constexpr std::string_view summary = "in proportion to emitted power, blind to distance";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    static constexpr bool draws_every_light = false, reads_all_lights = false;
    static constexpr std::size_t table_bytes(std::size_t) { return 0; }
    static bool keeps_tables(const Light& before, const Light& after)
    {
        return relative_power(before) == relative_power(after);
    }

    explicit PowerPolicy(const Lights& lights)
        : by_power_(std::make_shared<AliasTable>(relative_powers(lights)))
    {
    }

    /// A view of the one table.
    struct Table {
        const AliasTable* by_power;
        Choice choose(std::uint64_t bits) const { return by_power->choose(bits); }
        double probability(LightIndex light) const { return by_power->probability(light); }
    };
    template <class T>
    Table prepare(const ChoicePoint<Scalar<T>>&, const LightColumns<Scalar<T>>&, Scratch&) const
    {
        return {by_power_.get()};
    }

private:
    /// Y(L)·r²; the common factor 4π² is left out.
    static double relative_power(const Light& light)
    {
        return luminance_radius(light) * light.radius;
    }
    static std::vector<double> relative_powers(const Lights& lights)
    {
        std::vector<double> powers;
        powers.reserve(lights.size());
        for (const Light& light : lights) powers.push_back(relative_power(light));
        return powers;
    }
    std::shared_ptr<const AliasTable> by_power_;
};
static_assert(LightChoice<PowerPolicy, float>);

}  // namespace mis
