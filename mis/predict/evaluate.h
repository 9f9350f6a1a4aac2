#pragma once

#include "mis/predict/patch.h"
#include "mis/predict/plan.h"
#include "mis/predict/response.h"

namespace mis {

/// The nodes of one stretch of a meridian, and what does not depend on a strategy there.
struct Nodes {
    NodeColumn theta{};
    NodeColumn kronrod{}, gauss{};  ///< weights, sin θ · dθ included
    NodeColumn value{};             ///< F: luminance of f cos θ L, nearest light
    NodeColumn bsdf_pdf{}, cos_theta{};
    std::array<Vec3<double>, Rule::padded> wi_local{};

    void place(double begin, double end);
};

/// What a group of strategies adds up over a patch: four moments for each of its draws. Numbers in
/// one array.
class Tally {
public:
    /// A draw of a strategy, as the patch sees it.
    struct Slot {
        std::size_t strategy;
        int light;  ///< number in StrategyMoments::light; −1: the BSDF draw
        double shift;
    };
    Tally(const Plan& plan, const Group& group, const Patch& patch,
          const std::vector<StrategyMoments>& shifts);

    std::size_t size() const { return 4 * slots_.size(); }
    const std::vector<Slot>& slots() const { return slots_; }
    /// Where the slots of group.strategies[i] begin: light draws, then the BSDF's.
    std::size_t first_slot(std::size_t i) const { return first_[i]; }

private:
    std::vector<Slot> slots_;
    std::vector<std::size_t> first_;
};

/// Evaluates a group of strategies on a patch.
class Evaluator {
public:
    Evaluator(const Sky& sky, const Response& response, const Plan& plan, const Group& group,
              const Patch& patch, const Tally& tally);

    /// Fills value, bsdf_pdf, cos_theta, wi_local at the nodes' θ.
    void look(const Vec3<double>& around, int nearest, Nodes& nodes) const;

    /// Adds the moments of a stretch: Kronrod's sums and Gauss's.
    void add(const Nodes& nodes, const Stretch& stretch, const Meridian& meridian,
             std::span<double> kronrod, std::span<double> gauss);

    /// BSDF density over the group's light density, at one θ; counts left out.
    double ratio(const Vec3<double>& around, double theta, const Stretch& stretch,
                 const Meridian& meridian) const;

private:
    void price(const Nodes& nodes, const Stretch& stretch, const Meridian& meridian);
    void add_strategy(std::size_t i, const Nodes& nodes, const Stretch& stretch,
                      const Meridian& meridian, std::span<double> kronrod, std::span<double> gauss);

    const Sky* sky_;
    const Response* response_;
    const Plan* plan_;
    const Group* group_;
    const Patch* patch_;
    const Tally* tally_;
    std::vector<NodeColumn> cap_pdf_;  ///< per technique and light along the stretch
    std::vector<NodeColumn> density_;  ///< per Plan::densities
    std::vector<bool> density_used_, technique_used_;
};

}  // namespace mis
