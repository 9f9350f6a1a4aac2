#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/engine/scalar_choices.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace mis {

/// Which light a shared direction is drawn towards, at one point, and how likely every policy
/// would have chosen it. A mixture that covers what any of the policies can choose, and that is
/// near what makes the estimates of all their variances least noisy (docs/theory.md §25). Of many
/// lights, policies are mixed that need no look at all of them.
class LightMixture {
public:
    /// policies: that choose one light. draws_every_light: a strategy that does so is estimated,
    /// too. Keeps a reference to the scene. Throws Stopped.
    LightMixture(const LitScene& scene, std::span<const std::string> policies,
                 bool draws_every_light, const StopToken& stop);

    /// Makes all ready for a point. wo: in the shading frame about n.
    void prepare(const Vec3<double>& x, const Vec3<double>& n, const Vec3<double>& wo,
                 int material);

    /// −1 where no light can be chosen.
    LightIndex choose(std::uint64_t bits) const;
    double probability(LightIndex j) const;
    /// Can the policy of that number in the list choose any light here?
    bool chooses(std::size_t policy) const { return tables_[policy]->choose(0).light != no_light; }
    /// By that policy.
    double probability_by(std::size_t policy, LightIndex j) const
    {
        return is_dense_ && policy != walked_
                   ? dense_[policy * lights_ + static_cast<std::size_t>(j)]
                   : tables_[policy]->probability(j);
    }

    /// What of all the light that reaches the point comes from this one, were none hidden: in
    /// round figures.
    double guess(LightIndex j) const { return probability_by(guess_, j); }

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    double policies_that_count() const;
    void mix();

    const LitScene* scene_;
    std::size_t lights_;
    std::size_t listed_;  ///< policies of the list; those that are mixed in beside stand behind
    std::size_t walked_ = none;  ///< a policy of the list that is asked light by light, if one is
    double walked_share_ = 0;    ///< of the mixture
    std::size_t guess_ = 0;  ///< the place of `product`, or where there are many lights of `tree`
    bool draws_every_light_, is_dense_;
    std::vector<ScalarPolicy> policies_;
    std::vector<const ScalarPolicy::Table*> tables_;
    LargeVector<double> columns_;
    std::vector<double> dense_;  ///< [policy][light], where there are not too many lights
    std::vector<double> weights_, sums_;
    RunningSum mixed_;
};

}  // namespace mis
