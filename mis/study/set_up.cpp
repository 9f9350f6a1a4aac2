#include "mis/study/set_up.h"

#include "mis/strategy/names.h"
#include "mis/study/count_dependence.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mis {

namespace {

/// Of the time given, for the first samples of all strategies.
constexpr double first_share = 0.6;

/// Of the time given, at most until then: the spread of the samples and the audit are known; the
/// first samples begin.
constexpr double audit_until = 0.5, first_until = 0.9;

/// Rounds of shared directions that must fit into that share of the time.
constexpr double fewest_shared_rounds = 6, shared_share = 0.5;

/// Where directions are shared, own samples tell times and means: so many at first, and that many
/// in a round, which takes about that share of the time.
constexpr int first_samples_apart = 1;
constexpr double round_share = 0.02, fewest_apart = 4, most_apart = 8;

/// One sample of every point that takes more of the time is timed by parts of the tiles.
constexpr double dear_share = 0.01;
constexpr int parts_of_dear = 4;

/// Of strategies whose observations are many samples: so few where there is no time for more.
constexpr int fewest_replicates = 4;

constexpr SharedCounts fewest_counts{.light = 1, .lobe = 1, .cosine = 1};

class Maker {
public:
    Maker(const StudyGround& ground, std::span<const Strategy> strategies, const StudyTime& time,
          const SetUpOptions& options)
        : ground_(ground), strategies_(strategies), time_(time), options_(options),
          cpu_(time.cpu_budget(options.threads))
    {
        made_.costs.resize(strategies.size());
        made_.runs.resize(strategies.size());
        made_.how.rests.assign(strategies.size(), false);
        made_.how.apart.resize(strategies.size());
        made_.how.is_even = time.goal().spp.has_value();
        made_.how.tile_factors.assign(ground.points.shading.tiles.size(), 1.0);
    }

    SetUp make()
    {
        if (ground_.points.figure_lit == 0) {
            for (std::size_t s = 0; s < strategies_.size(); ++s) start_run(s);
            return std::move(made_);
        }
        const bool may_share = options_.shares_samples && !options_.numbers.is_sobol() &&
                               least_shared_seconds() < shared_share * cpu_;
        if (may_share) look_at_costs(first_samples_apart);
        else look_at_costs_of_replicates();
        try {
            for (std::size_t s = 0; s < strategies_.size(); ++s)
                if (made_.costs[s].is_affordable) start_run(s);
            made_.how.weights = rough_weights(ground(first_until));
            if (may_share) share();
            if (!made_.shared) look_ahead();
        } catch (const Stopped&) {
            run_none();
        }
        if (!time_.goal().spp) leave_out_late();
        return std::move(made_);
    }

private:
    /// For work before the first samples, until that share of the time.
    StudyGround ground(double until) const
    {
        StudyGround until_then = ground_;
        until_then.stop = time_.until(until);
        return until_then;
    }

    int per_observation() const { return samples_per_scrambling(options_.numbers); }

    /// Of as many replicates as all strategies have time for: where an observation is many samples,
    /// a few replicates of all tell more than many of a few.
    void look_at_costs_of_replicates()
    {
        if (per_observation() == 1 || time_.goal().spp)
            return look_at_costs(first_samples * per_observation());
        made_.replicates = fewest_replicates;
        look_at_costs(first_samples * per_observation() * fewest_replicates / most_replicates);
        while (made_.replicates < most_replicates && are_all_affordable() &&
               2 * sum_of_costs() <= first_share * cpu_)
            change_replicates(2 * made_.replicates);
    }

    bool are_all_affordable() const
    {
        return std::ranges::all_of(made_.costs, &CostEstimate::is_affordable);
    }

    void change_replicates(int replicates)
    {
        const double factor = static_cast<double>(replicates) / made_.replicates;
        for (CostEstimate& cost : made_.costs) cost.seconds *= factor;
        made_.first_samples = made_.first_samples * replicates / made_.replicates;
        made_.replicates = replicates;
    }

    void look_at_costs(int samples)
    {
        made_.first_samples = samples;
        if (!time_.goal().spp)
            made_.costs = estimate_costs(ground(first_share), strategies_, samples,
                                         first_share * cpu_, per_observation());
    }

    /// CPU seconds that some rounds of shared directions take at the very least.
    double least_shared_seconds() const
    {
        double tables = 0;
        for (const Strategy& s : strategies_)
            tables += s.chooses_light() && reads_all_lights(s.policy) ? 1 : 0;
        return fewest_shared_rounds * tables * 0.5e-9 *
               static_cast<double>(ground_.scene.scene().lights.size()) *
               static_cast<double>(ground_.points.figure_lit);
    }

    void start_run(std::size_t s)
    {
        made_.runs[s] = std::make_unique<StrategyRun>(ground_.scene, ground_.points, strategies_[s],
                                                      options_.numbers, time_.until(first_until));
    }

    /// Directions that all strategies share, if there is time for some rounds.
    void share()
    {
        std::vector<Strategy> strategies = that_run_and_can_share();
        if (strategies.empty()) return;
        const auto [counts, rounds_of_turn] = time_.goal().spp
                                                  ? counted(*time_.goal().spp)
                                                  : std::pair(affordable_counts(strategies), 1);
        if (counts.all() == 0) return go_by_own_samples();
        if (!time_.goal().spp) set_samples_apart();
        made_.shared = std::make_unique<SharedTurns>(ground(1), made_.how.weights, strategies,
                                                     counts, rounds_of_turn);
        made_.sharing = std::move(strategies);
    }

    /// Of a round: the usual ones, or as few as there may be; none where there is no time for
    /// either.
    SharedCounts affordable_counts(std::span<const Strategy> strategies) const
    {
        for (const SharedCounts& counts : {SharedCounts(), fewest_counts})
            if (fewest_shared_rounds *
                    SharedTurns::round_seconds(ground(audit_until), strategies, counts) <=
                shared_share * cpu_)
                return counts;
        return {.light = 0, .lobe = 0, .cosine = 0};
    }

    /// Of a round, and rounds of a turn: where so many directions are asked for, in enough rounds
    /// to tell their spread.
    static std::pair<SharedCounts, int> counted(std::uint64_t spp)
    {
        constexpr double wanted_rounds = 9, most_turns = 64;
        const double directions = static_cast<double>(spp);
        SharedCounts counts = fewest_counts;
        counts.light = static_cast<int>(
            std::clamp(directions / (shared_groups * wanted_rounds) - 2, 1.0, 5.0));
        if (directions >= shared_groups * wanted_rounds * SharedCounts().all())
            counts = SharedCounts();
        const double rounds = std::floor(directions / (shared_groups * double(counts.all())));
        return {counts, static_cast<int>(std::max(1.0, std::ceil((rounds - 1) / most_turns)))};
    }

    /// There is no time for shared directions: own samples must do for all.
    void go_by_own_samples()
    {
        const double factor = static_cast<double>(first_samples) / made_.first_samples;
        made_.first_samples = first_samples;
        for (CostEstimate& cost : made_.costs) cost.seconds *= factor;
        keep_affordable(made_.costs, first_share * cpu_);
        drop_unaffordable();
    }

    void drop_unaffordable()
    {
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (!made_.costs[s].is_affordable) made_.runs[s].reset();
    }

    void set_samples_apart()
    {
        const double budget = time_.goal().error ? time_.goal().default_seconds * options_.threads
                                                 : cpu_,
                     turn = round_share * budget / static_cast<double>(strategies_.size());
        for (std::size_t s = 0; s < strategies_.size(); ++s) {
            if (!can_share(strategies_[s])) continue;
            const double of_sample = std::max(made_.costs[s].seconds / made_.first_samples, 1e-12);
            const bool is_dear = of_sample > dear_share * budget;
            const double fewest = is_dear ? 1 : fewest_apart;
            made_.how.apart[s] = {
                .observations = static_cast<int>(std::clamp(turn / of_sample, fewest, most_apart)),
                .parts = is_dear ? parts_of_dear : 1};
        }
    }

    /// Which tiles need more samples than others, and the audit, as far as there is time.
    void look_ahead()
    {
        try {
            made_.spreads =
                !time_.goal().spp && 4 * sum_of_costs() < cpu_;  // else rounds are few, of twos
            if (made_.spreads)
                made_.how.tile_factors = best_tile_factors(ground(audit_until), quick());
            if (!options_.numbers.is_sobol())
                made_.audit.emplace(ground(audit_until), made_.how.weights,
                                    that_run_and_can_share());
            if (made_.audit && made_.audit->is_empty()) made_.audit.reset();
        } catch (const Stopped&) {  // all tiles alike; the report says that there is no audit
        }
    }

    std::vector<Strategy> that_run_and_can_share() const
    {
        std::vector<Strategy> strategies = that_run(strategies_, made_);
        std::erase_if(strategies, [](const Strategy& s) { return !can_share(s); });
        return strategies;
    }

    /// Those whose first samples take little of the time.
    std::vector<Strategy> quick() const
    {
        std::vector<Strategy> strategies;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (made_.runs[s] && can_share(strategies_[s]) && made_.costs[s].seconds < 0.05 * cpu_)
                strategies.push_back(strategies_[s]);
        return strategies;
    }

    /// The time was over, or the study stopped, before the first sample.
    void run_none()
    {
        for (std::unique_ptr<StrategyRun>& run : made_.runs) run.reset();
        for (CostEstimate& cost : made_.costs) cost.is_affordable = false, cost.is_known = false;
        made_.shared.reset();
    }

    /// What the set-up has left of the time must do for the first samples.
    void leave_out_late()
    {
        const double left = time_.left() * options_.threads;
        while (per_observation() > 1 && made_.replicates > fewest_replicates &&
               sum_of_costs() > left)
            change_replicates(made_.replicates / 2);
        for (CostEstimate& cost : made_.costs) cost.is_late = cost.is_affordable;
        keep_affordable(made_.costs, left);
        for (CostEstimate& cost : made_.costs) cost.is_late = cost.is_late && !cost.is_affordable;
        drop_unaffordable();
        made_.parts = parts_for(sum_of_costs(), std::max(left, 1e-9));
    }

    /// CPU seconds of the first samples at every point, over the strategies that are run.
    double sum_of_costs() const
    {
        double sum = 0;
        for (const CostEstimate& cost : made_.costs) sum += cost.is_affordable ? cost.seconds : 0;
        return sum;
    }

    const StudyGround& ground_;
    std::span<const Strategy> strategies_;
    const StudyTime& time_;
    const SetUpOptions& options_;
    double cpu_;
    SetUp made_;
};

}  // namespace

SetUp set_up(const StudyGround& ground, std::span<const Strategy> strategies, const StudyTime& time,
             const SetUpOptions& options)
{
    return Maker(ground, strategies, time, options).make();
}

std::vector<Strategy> that_run(std::span<const Strategy> strategies, const SetUp& set_up)
{
    std::vector<Strategy> run;
    for (std::size_t s = 0; s < strategies.size(); ++s)
        if (set_up.runs[s]) run.push_back(strategies[s]);
    return run;
}

Reason why_not_run(const CostEstimate& cost, int samples, bool is_stopped)
{
    if (cost.is_affordable || (!cost.is_known && is_stopped)) return reason::Stopped{};
    if (!cost.is_known) return reason::NotReady{};
    if (cost.is_late) return reason::LateSetUp{};
    return reason::PastBudget{static_cast<double>(samples), first_share};
}

}  // namespace mis
