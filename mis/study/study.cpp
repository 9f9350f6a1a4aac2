#include "mis/study/study.h"

#include "mis/engine/exact.h"
#include "mis/stats/rank.h"
#include "mis/study/count_dependence.h"
#include "mis/study/measured.h"
#include "mis/study/reference.h"
#include "mis/study/savings.h"
#include "mis/study/scene_facts.h"
#include "mis/study/set_up.h"

#include <algorithm>
#include <set>
#include <utility>

namespace mis {

namespace {

/// Of the time given, at most until then: what leaving out effects saves has been measured.
constexpr double savings_until = 0.1;

/// Rounds of own samples that each strategy takes part in at least, where directions are shared, so
/// that its time has an error.
constexpr std::size_t fewest_timed_rounds = 4;

/// After a round of own samples, turns of shared directions take as long, but no longer than this,
/// seconds.
constexpr double longest_turns = 2;

/// One study under way.
class Scheduler {
public:
    Scheduler(const LitScene& scene, const std::vector<Strategy>& strategies,
              const StudyOptions& options, const AnyExecutor& executor)
        : scene_(scene), strategies_(strategies), options_(options),
          time_(options.goal(), options.stop),
          points_(std::make_unique<StudyPoints>(
              find_study_points(scene, stoppable(executor, time_.until(1))))),
          ground_{scene, *points_, workspaces_, executor, options.seed, time_.stop()},
          ground_until_end_{scene, *points_, workspaces_, executor, options.seed, time_.until(1)}
    {
    }

    Study run()
    {
        start_report();
        set_up_ =
            set_up(ground_, strategies_, time_, {numbers(), !options_.own_samples, threads()});
        measured_.emplace(ground_, strategies_, set_up_, has_closed_form_);
        rounds_.emplace(ground_until_end_, set_up_.runs,
                        [this](std::size_t s, double done) { end_turn(s, done); });
        reference_.emplace(
            set_up_.runs, *points_,
            [this](std::size_t s, const RelativeScale& scale) { return measured_->of(s, scale); },
            [this](std::size_t s) { return measured_->shared_variance(s); });
        if (lit() > 0) {
            if (options_.spp) run_spp();
            else if (set_up_.shared) run_time_sharing();
            else run_time();
        }
        finish();
        std::vector<std::optional<std::size_t>> places(strategies_.size());
        for (std::size_t s = 0; s < strategies_.size(); ++s) places[s] = measured_->shared_place(s);
        return {std::move(report_),    std::move(points_),        std::move(set_up_.runs),
                reference_->weights(), std::move(set_up_.shared), std::move(places)};
    }

private:
    bool is_stopped() const { return time_.is_stopped(); }
    const StudyGoal& goal() const { return time_.goal(); }
    std::size_t lit() const { return points_->figure_lit; }

    void start_report()
    {
        static_cast<SceneFacts&>(report_) = facts_of(scene_.scene(), *points_);
        const GBuffer& shading = points_->shading;
        report_.effects = explained(scene_.scene(), scene_.effects(),
                                    scene_.tiles_that_call(shading).of(shading.tiles.size()));
        prove_closed_form();
        try {
            measure_savings(scene_, spread_tiles(shading, most_tiles_of_savings), report_.effects,
                            time_.until(savings_until));
        } catch (const Stopped&) {  // they stay unmeasured
        }
    }

    /// Asked only where some strategy would be exact then.
    void prove_closed_form()
    {
        const auto would_be_exact = [&](const Strategy& s) {
            return gives_closed_form(scene_.scene(), s);
        };
        has_closed_form_ =
            std::ranges::any_of(strategies_, would_be_exact) &&
            has_closed_form(scene_, points_->shading, points_->figure_tiles, ground_.executor);
    }

    /// Those that find work: no more than tiles.
    int threads() const
    {
        return std::max(
            1, std::min(ground_.executor.threads,
                        static_cast<int>(std::min<std::size_t>(points_->figure_tiles, 1 << 20))));
    }

    NumberSource numbers() const
    {
        NumberSource numbers(options_.seed, options_.samples_per_scrambling);
        numbers.is_asked_for = options_.names_sampler;
        return numbers;
    }

    void end_turn(std::size_t s, double of_round) const
    {
        if (options_.on_invalid && set_up_.runs[s])
            if (const auto found = set_up_.runs[s]->first_invalid())
                options_.on_invalid(strategies_[s], *found, options_.at);
        if (!options_.progress) return;
        const double of_plan =
            (rounds_->count() - 1 + of_round) / static_cast<double>(plan_.chunks.size());
        options_.progress(options_.spp ? of_plan : time_.elapsed() / goal().budget(), report_);
    }

    /// Those of whose samples so many come together take part; the others rest.
    RoundOptions only_those_of(int samples) const
    {
        RoundOptions how = set_up_.how;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            how.rests[s] = how.rests[s] || samples_together(strategies_[s]) != samples;
        return how;
    }

    /// A fixed number of samples, for those only of whose samples so many come together.
    void run_spp(int together)
    {
        const RoundOptions how = only_those_of(together);
        const int each = together > 1 ? together : samples_per_scrambling(numbers());
        plan_ = plan_for(*options_.spp / static_cast<std::uint64_t>(each));
        double samples = 0, all = 0, last_look = 0;
        for (const int chunk : plan_.chunks) all += chunk;
        for (const int chunk : plan_.chunks) {
            rounds_->take(chunk, plan_, how);
            samples += chunk;
            if (!share_up_to(samples / all) || is_stopped()) return;
            if (!options_.progress || rounds_->count() < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            rank_now(1);  // to be shown; it decides nothing
        }
        if (plan_.remainder == 0) return;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (set_up_.runs[s] && !how.rests[s] && !is_stopped())
                set_up_.runs[s]->sample_apart({plan_.remainder}, workspaces_, ground_.executor,
                                              time_.stop());
    }

    void run_spp()
    {
        std::set<int> kinds;
        for (const Strategy& s : strategies_) kinds.insert(samples_together(s));
        for (const int together : kinds) run_spp(together);
    }

    /// Turns of shared directions, until that share of those that were asked for is drawn. False
    /// where it was stopped.
    bool share_up_to(double share)
    {
        if (!set_up_.shared) return true;
        SharedTurns& shared = *set_up_.shared;
        const auto wanted = static_cast<std::uint64_t>(
            share * static_cast<double>(std::max(*options_.spp, shared.fewest_directions())));
        while (shared.directions_after_next() <= wanted) {
            if (!take_turn()) return false;
            const auto so_far = static_cast<double>(shared.directions());
            measured_->choose_sources(static_cast<double>(*options_.spp) / so_far);
        }
        return true;
    }

    /// The next turn. Weights are found anew once there are four times as many directions; where
    /// directions are counted, once a quarter of many is drawn.
    bool take_turn()
    {
        SharedTurns& shared = *set_up_.shared;
        try {
            if (!shared.take(ground_until_end_)) return false;
        } catch (const Stopped&) {
            return false;
        }
        constexpr std::uint64_t many = 512;
        const bool is_due = options_.spp ? *options_.spp >= many && weighed_at_ == 0 &&
                                               4 * shared.directions() >= *options_.spp
                                         : shared.directions() >= 4 * weighed_at_ &&
                                               time_.left() > 0.5 * time_.elapsed();
        if (shared.is_known() && is_due) {
            weighed_at_ = shared.directions();
            shared.weigh_again();
        }
        return true;
    }

    void run_time()
    {
        plan_.replicates = set_up_.replicates;
        plan_.parts = set_up_.parts;
        double samples = 0, last_look = 0, round_seconds = 0;  // of one sample per replicate
        while (!is_stopped() && does_any_run()) {
            const int chunk = next_chunk(static_cast<int>(rounds_->count()) / plan_.parts,
                                         time_.left(), round_seconds);
            if (chunk == 0) return;
            const Clock::time_point before = Clock::now();
            rounds_->take(chunk, plan_, set_up_.how);
            round_seconds = seconds_since(before) / chunk;
            samples += chunk;
            if (is_stopped() || rounds_->count() < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            if (look()) return;
        }
    }

    /// Own samples, for times and means, and turns of shared directions share the time.
    void run_time_sharing()
    {
        double own_seconds = 0, last_look = 0;
        while (!is_stopped() && does_any_run()) {
            let_dear_rest();
            const bool takes_own = planned_seconds() < time_.left() && !do_all_rest();
            const Clock::time_point before = Clock::now();
            if (takes_own) rounds_->take(2, plan_, set_up_.how);
            if (takes_own) own_seconds = seconds_since(before);
            if (!take_turns(std::min(own_seconds, longest_turns)) && !takes_own) return;
            if (is_stopped() || !set_up_.shared->is_known() || time_.elapsed() < 1.2 * last_look)
                continue;
            last_look = time_.elapsed();
            if (look()) return;
        }
    }

    /// Wall seconds that the next round of own samples will take, by the first look at the costs.
    double planned_seconds() const
    {
        double cpu = 0;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (set_up_.runs[s] && !set_up_.how.rests[s])
                cpu += set_up_.costs[s].seconds / set_up_.first_samples *
                       (measured_->is_own(s) ? 2 * most_replicates
                                             : set_up_.how.apart[s].observations);
        return rounds_->count() == 0 ? 0 : cpu / threads();
    }

    /// For so many seconds, as far as turns fit into the time left; one at least. False where none
    /// did.
    bool take_turns(double seconds)
    {
        const Clock::time_point before = Clock::now();
        bool any = false;
        do {
            if (is_stopped() || set_up_.shared->last_seconds() > time_.left()) return any;
            if (!take_turn()) return any;
            any = true;
            const SharedTurns& shared = *set_up_.shared;
            const double of_turns_so_far =
                shared.last_seconds() * static_cast<double>(shared.count());
            measured_->choose_sources(1 + 0.5 * time_.left() / of_turns_so_far);
        } while (seconds_since(before) < seconds);
        return true;
    }

    bool does_any_run() const
    {
        return std::ranges::any_of(set_up_.runs, [](const auto& run) { return run != nullptr; });
    }

    bool do_all_rest() const
    {
        return std::ranges::all_of(set_up_.how.rests, [](bool rests) { return rests; });
    }

    /// Ranks what was measured so far. Is it enough?
    bool look()
    {
        rank_now(goal().stops_when_settled() ? spending_.spend_at(time_.elapsed() / goal().budget())
                                             : 1);  // no verdict decides to stop
        if (is_enough(report_, goal(), time_.elapsed())) return true;
        let_rest();
        return false;
    }

    void let_rest()
    {
        std::vector<bool>& rests = set_up_.how.rests;
        const std::vector<bool> rested = rests;
        if (goal().stops_when_settled()) rests = resting(report_, goal(), time_.elapsed());
        else if (goal().error && set_up_.shared) rests = is_shared_everywhere();
        if (set_up_.shared)
            for (std::size_t s = 0; s < rests.size(); ++s) rests[s] = rests[s] && is_timed(s);
        if (!set_up_.spreads || rests == rested) return;
        std::vector<Strategy> awake;
        for (std::size_t s = 0; s < rests.size(); ++s)
            if (set_up_.runs[s] && !rests[s]) awake.push_back(strategies_[s]);
        try {
            set_up_.how.tile_factors = best_tile_factors(ground_until_end_, awake);
        } catch (const Stopped&) {  // as before
        }
    }

    bool is_timed(std::size_t s) const
    {
        return !set_up_.runs[s] || set_up_.runs[s]->timed() >= fewest_timed_rounds;
    }

    /// What is dear waits for a first round of all others, is not sampled again before these are
    /// timed, and then only where there is time.
    void let_dear_rest()
    {
        bool are_others_timed = true;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            are_others_timed = are_others_timed && (is_dear(s) || is_timed(s));
        if (are_others_timed && planned_seconds() < time_.left()) return;
        for (std::size_t s = 0; s < strategies_.size(); ++s) {
            if (is_dear(s)) set_up_.how.rests[s] = rounds_->count() == 0 || is_timed(s);
            else if (!are_others_timed) set_up_.how.rests[s] = false;
        }
    }

    bool is_dear(std::size_t s) const { return set_up_.how.apart[s].is_dear(); }

    /// Where a variance is all that is asked for, own samples of those rest.
    std::vector<bool> is_shared_everywhere() const
    {
        std::vector<bool> shared;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            shared.push_back(!measured_->is_own(s));
        return shared;
    }

    /// share: of the probabilities of error that this look spends.
    void rank_now(double share)
    {
        const SceneReport* earlier = goal().stops_when_settled() ? &report_ : nullptr;
        const auto ranked = [&](const SceneMeasurements& scene) {
            return rank(scene, {.threads = ground_.executor.threads,
                                .at = options_.at,
                                .share = share,
                                .earlier = earlier});
        };
        measured_->look();
        Ranking ranking = ranked(reference_->of_resolved());
        const auto is_ranked = [&](std::size_t s) {
            return ranking.strategies[s].status == Status::ranked;
        };
        if (reference_->trust_fewer(is_ranked))  // some were biased
            ranking = ranked(reference_->of_trusted());
        put_ranking(std::move(ranking), time_.elapsed(), report_);
        report_.directions = measured_->is_shared() ? set_up_.shared->directions() : 0;
        report_.epsilon = reference_->epsilon();
        report_.lacks_audit = !set_up_.audit && !measured_->is_dark();
        report_.had_no_time_for_audit = report_.lacks_audit && !numbers().is_sobol();
    }

    void finish()
    {
        if (!goal().stops_when_settled() || !report_.settled) rank_now(spending_.spend_rest());
        report_.partial = is_stopped();
    }

    const LitScene& scene_;
    const std::vector<Strategy>& strategies_;
    const StudyOptions& options_;
    StudyTime time_;
    std::unique_ptr<StudyPoints> points_;
    WorkspacePool<float> workspaces_;
    StudyGround ground_, ground_until_end_;
    SceneReport report_;
    SetUp set_up_;
    SamplePlan plan_;
    std::uint64_t weighed_at_ = 0;  ///< directions, when the weights were last found
    bool has_closed_form_ = false;  ///< at every point of the figures: proved
    std::optional<MeasuredStrategies> measured_;
    std::optional<StudyRounds> rounds_;
    std::optional<StudyReference> reference_;
    ErrorSpending spending_;
};

}  // namespace

Study run_study(const LitScene& scene, const std::vector<Strategy>& strategies,
                const StudyOptions& options, const AnyExecutor& executor)
{
    return Scheduler(scene, strategies, options, executor).run();
}

std::size_t study_bytes(std::size_t points, std::size_t strategies)
{
    // A shading point, its weight and scale, a mean; for each strategy its results, and one copy of
    // its moments at a time.
    return points * (sizeof(ShadingPoint) + 4 * sizeof(double) + strategies * sizeof(PointResult) +
                     sizeof(Moments));
}

}  // namespace mis
