#include "mis/predict/predict.h"

#include "mis/predict/blockers.h"
#include "mis/predict/integrate.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace mis {

namespace {

/// The integrals of one group over all patches, several times over: first to know the sizes of
/// things, then to tolerances that follow from them.
class GroupPrediction {
public:
    GroupPrediction(const Sky& sky, const Response& response, const Plan& plan, const Group& group,
                    const std::vector<Patch>& patches, double tolerance, double rounding)
        : sky_(sky), response_(response), plan_(plan), group_(group), patches_(patches),
          tolerance_(tolerance), rounding_(rounding), azimuths_(patches.size()),
          empty_(empty_moments(plan, sky.lights))
    {
    }

    /// Figures of the group's strategies, in its order.
    std::vector<MomentFigures> run()
    {
        std::vector<StrategyMoments> moments = pass(false);
        if (shift_by(moments)) moments = pass(false);
        for (int round = 0; round < 3; ++round) {
            const std::vector<MomentFigures> expected = figures(moments);
            set_tolerances(moments, expected);
            moments = pass(true);
            if (!is_much_smaller(figures(moments), expected)) break;
        }
        return figures(moments);
    }

private:
    std::vector<StrategyMoments> pass(bool refine)
    {
        std::vector<StrategyMoments> moments = empty_;
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            const Patch& patch = patches_[p];
            const Tally tally(plan_, group_, patch, empty_);
            Evaluator evaluator(sky_, response_, plan_, group_, patch, tally);
            if (azimuths_[p].empty()) azimuths_[p] = azimuths_of(patch, evaluator, group_);
            const Effort effort{.tolerance = refine ? tolerances_of(tally) : std::vector<double>{}};
            const Integrals found =
                integrate(patch, evaluator, group_, azimuths_[p], tally.size(), effort);
            for (std::size_t i = 0; i < tally.slots().size(); ++i)
                draw_of(moments, tally.slots()[i])
                    .sums.add(&found.value[4 * i], &found.error[4 * i]);
        }
        return moments;
    }

    static DrawMoments& draw_of(std::vector<StrategyMoments>& moments, const Tally::Slot& slot)
    {
        StrategyMoments& of = moments[slot.strategy];
        return slot.light < 0 ? of.bsdf.front() : of.light[static_cast<std::size_t>(slot.light)];
    }

    std::vector<MomentFigures> figures(const std::vector<StrategyMoments>& moments) const
    {
        std::vector<MomentFigures> all;
        for (const std::size_t s : group_.strategies)
            all.push_back(figures_of(moments[s], rounding_));
        return all;
    }

    /// Is some probability positive, and none but where `counts` is true?
    static bool only_where(const std::vector<bool>& counts, const std::vector<double>& probability)
    {
        bool any = false;
        for (std::size_t j = 0; j < counts.size(); ++j) {
            if (probability[j] > 0 && !counts[j]) return false;
            any = any || probability[j] > 0;
        }
        return any;
    }

    /// Takes the means as shifts where every draw counts; false if that is nowhere so.
    bool shift_by(const std::vector<StrategyMoments>& moments)
    {
        bool any = false;
        for (const std::size_t s : group_.strategies) {
            const StrategyPlan& plan = plan_.strategies[s];
            if (plan.density < 0 || plan.is_one_sample) continue;
            const auto [policy, technique] =
                plan_.densities[static_cast<std::size_t>(plan.density)];
            const std::vector<bool> counts = all_draws_count(sky_, plan_.techniques[technique]);
            const std::vector<double>& p = plan_.policies[policy].probability;
            std::vector<DrawMoments>& light = empty_[s].light;
            if (plan.draws_every_light) {
                for (std::size_t j = 0; j < light.size(); ++j)
                    if (counts[j]) light[j].shift = moments[s].light[j].sums.value[0], any = true;
            } else if (only_where(counts, p)) {
                light.front().shift = moments[s].light.front().sums.value[0], any = true;
            }
        }
        return any;
    }

    /// Absolute tolerances of the four moments of each draw, such that the figures meet the
    /// relative one.
    void set_tolerances(const std::vector<StrategyMoments>& moments,
                        const std::vector<MomentFigures>& figures)
    {
        tolerances_ = empty_;
        for (std::size_t i = 0; i < group_.strategies.size(); ++i) {
            const std::size_t s = group_.strategies[i];
            for (std::size_t k = 0; k < moments[s].light.size(); ++k)
                tolerances_[s].light[k].sums.error = tolerance_of(moments[s].light[k], figures[i]);
            for (std::size_t k = 0; k < moments[s].bsdf.size(); ++k)
                tolerances_[s].bsdf[k].sums.error = tolerance_of(moments[s].bsdf[k], figures[i]);
        }
    }

    std::array<double, 4> tolerance_of(const DrawMoments& draw, const MomentFigures& f) const
    {
        const auto& [s1, s2, s3, s4] = draw.sums.value;
        const double floor = std::max(1e-13, 16 * rounding_), c = std::abs(draw.shift);
        const double a1 = std::max(std::abs(s1), std::numeric_limits<double>::min());
        const double share =
            1 / (draw.draws * static_cast<double>(std::clamp<std::size_t>(patches_.size(), 1, 16)));
        const double t2 = std::max(share * tolerance_ * f.variance.value,
                                   floor * (s2 + 2 * c * std::sqrt(std::abs(s2)) + floor * c * c));
        // What rounding of X does to X − c, and so to its powers: no node rule gets below that.
        const double noise = 16 * rounding_ * c, spread = std::sqrt(std::abs(s2));
        const double t1 =
            std::max(std::min(share * tolerance_ * std::abs(f.mean.value), t2 / (2 * a1)),
                     floor * std::abs(s1) + noise);
        const double t4 =
            std::max(share * 10 * tolerance_ * f.fourth.value,
                     floor * s4 + noise * std::pow(std::sqrt(std::abs(s4)) + noise * noise, 1.5));
        const double t3 = std::max(
            t4 / (4 * a1), floor * std::abs(s3) + noise * (spread + noise) * (spread + noise));
        return {t1, t2, t3, t4};
    }

    std::vector<double> tolerances_of(const Tally& tally)
    {
        std::vector<double> all;
        for (const Tally::Slot& slot : tally.slots())
            for (const double t : draw_of(tolerances_, slot).sums.error) all.push_back(t);
        return all;
    }

    static bool is_much_smaller(const std::vector<MomentFigures>& found,
                                const std::vector<MomentFigures>& expected)
    {
        for (std::size_t i = 0; i < found.size(); ++i)
            if (4 * found[i].mean.value < expected[i].mean.value ||
                4 * found[i].variance.value < expected[i].variance.value)
                return true;
        return false;
    }

    const Sky& sky_;
    const Response& response_;
    const Plan& plan_;
    const Group& group_;
    const std::vector<Patch>& patches_;
    double tolerance_, rounding_;
    std::vector<std::vector<double>> azimuths_;  ///< per patch; found by the first pass
    std::vector<StrategyMoments> empty_;         ///< with the shifts
    std::vector<StrategyMoments> tolerances_;    ///< in sums.error
};

/// The patches that can count: of lights not wholly below the horizon.
std::vector<Patch> patches_of(const Sky& sky, const Lobe& lobe, const StopToken& stop)
{
    std::vector<Patch> patches;
    for (std::size_t j = 0; j < sky.lights; ++j)
        if (!is_below(sky.balls[j], sky.n))
            patches.emplace_back(sky, static_cast<int>(j), sky.neighbours[j], lobe, stop);
    return patches;
}

}  // namespace

std::vector<Predicted> predict(const Scene& scene, const Probe& probe,
                               std::span<const Strategy> strategies,
                               const PredictTolerance& tolerance, const PredictRun& run)
{
    std::vector<Predicted> result(strategies.size());
    const Sky sky = sky_of(scene, probe, run.stop);
    if (sky.is_dark || scene.lights.empty() || !(dot(probe.normal, probe.outgoing) > 0))
        return result;
    refuse_blockers(scene, probe, run.stop);
    const Response response(scene.materials[static_cast<std::size_t>(probe.material)], probe.normal,
                            probe.outgoing);
    const Lobe lobe = lobe_of(response);
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * (2 + 1 / lobe.width);
    const Plan plan(scene, probe, strategies);
    run.stop.check();
    const std::vector<Patch> patches = patches_of(sky, lobe, run.stop);
    const auto predict_group = [&](std::size_t g) {
        const Group& group = plan.groups[g];
        const double aim = group.jumps.empty() ? tolerance.smooth : tolerance.jumps;
        const std::vector<MomentFigures> figures =
            GroupPrediction(sky, response, plan, group, patches, aim, rounding).run();
        for (std::size_t i = 0; i < figures.size(); ++i) {
            const MomentFigures& f = figures[i];
            result[group.strategies[i]] = {f.mean.value,     f.mean.error,   f.variance.value,
                                           f.variance.error, f.fourth.value, f.fourth.error};
        }
    };
    if (run.executor != nullptr) run.executor->for_each(plan.groups.size(), predict_group);
    else
        for (std::size_t g = 0; g < plan.groups.size(); ++g) predict_group(g);
    return result;
}

}  // namespace mis
