#include "mis/study/study.h"

#include "mis/engine/exact.h"
#include "mis/engine/stopwatch.h"
#include "mis/math/limits.h"
#include "mis/stats/exactness.h"
#include "mis/stats/rank.h"
#include "mis/study/affordable.h"
#include "mis/study/reference.h"
#include "mis/study/rounds.h"
#include "mis/study/savings.h"
#include "mis/study/scene_facts.h"
#include "mis/study/study_audit.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace mis {

namespace {

/// Of the time given, for the first samples of all strategies.
constexpr double first_share = 0.6;

/// Of the time given, at most until then: what leaving out effects saves has been measured; the
/// spread of the samples and the audit are known; the first samples begin.
constexpr double savings_until = 0.1, audit_until = 0.5, first_until = 0.9;

/// One study under way.
class Scheduler {
public:
    Scheduler(const LitScene& scene, const std::vector<Strategy>& strategies,
              const StudyOptions& options, const AnyExecutor& executor)
        : scene_(scene), strategies_(strategies), options_(options), goal_(options.goal()),
          points_(std::make_unique<StudyPoints>(
              find_study_points(scene, stoppable(executor, until(1))))),
          ground_{scene, *points_, workspaces_, executor, options.seed, stop_},
          runs_(strategies.size()), costs_(strategies.size()),
          rounds_(ground_, runs_, [this](std::size_t s, double done) { end_turn(s, done); }),
          reference_(
              runs_, *points_, scene.scene().camera.has_value(),
              [this](std::size_t s, const RelativeScale& scale) { return measured(s, scale); })
    {
        how_.rests.assign(strategies.size(), false);
        how_.is_even = options.spp.has_value();
    }

    Study run()
    {
        start_report();
        start_runs();
        if (options_.spp) run_spp();
        else run_time();
        finish();
        return {std::move(report_), std::move(points_), std::move(runs_), reference_.weights()};
    }

private:
    bool is_stopped() const { return stop_.is_up(); }

    /// Up when the study is stopped, and once that share of its time is over.
    StopToken until(double share) const
    {
        if (options_.spp) return stop_;
        return stop_.until(start_ + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(share * goal_.budget())));
    }

    /// For work before the first samples, until `stop` is up.
    StudyGround ground(const StopToken& stop) const
    {
        StudyGround until_then = ground_;
        until_then.stop = stop;
        return until_then;
    }

    std::size_t lit() const { return points_->figure_lit; }
    double elapsed() const { return seconds_since(start_); }

    void start_report()
    {
        static_cast<SceneFacts&>(report_) = facts_of(scene_.scene(), *points_);
        const GBuffer& shading = points_->shading;
        report_.effects = explained(scene_.scene(), scene_.effects(),
                                    scene_.tiles_that_call(shading).of(shading.tiles.size()));
        prove_closed_form();
        try {
            measure_savings(scene_, spread_tiles(shading, most_tiles_of_savings), report_.effects,
                            until(savings_until));
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

    /// What a first look at the costs allows; a rough picture of the scene, for the weights; how
    /// samples are best spread; and the audit.
    void start_runs()
    {
        how_.tile_factors.assign(points_->shading.tiles.size(), 1.0);
        if (lit() == 0) {
            for (std::size_t s = 0; s < strategies_.size(); ++s) start_run(s);
            return;
        }
        const double cpu = options_.spp ? 1e300 : goal_.budget() * threads();
        if (!options_.spp)
            costs_ = estimate_costs(ground(until(first_share)), strategies_,
                                    first_samples * samples_per_observation(), first_share * cpu);
        try {
            for (std::size_t s = 0; s < strategies_.size(); ++s)
                if (costs_[s].is_affordable) start_run(s);
            how_.weights = rough_weights(ground(until(first_until)));
            look_ahead(cpu);
        } catch (const Stopped&) {
            run_none();
        }
        if (!options_.spp) leave_out_late();
    }

    /// Which tiles need more samples than others, and the audit, as far as there is time.
    void look_ahead(double cpu)
    {
        try {
            spreads_ = !options_.spp && 4 * sum_of_costs() < cpu;  // else rounds are few, of twos
            if (spreads_)
                how_.tile_factors = best_tile_factors(ground(until(audit_until)), quick(cpu));
            if (!numbers().is_sobol())
                audit_.emplace(ground(until(audit_until)), how_.weights, that_run());
            if (audit_ && audit_->is_empty()) audit_.reset();
        } catch (const Stopped&) {  // all tiles alike; the report says that there is no audit
        }
    }

    /// Those whose first samples take little of the time.
    std::vector<Strategy> quick(double cpu) const
    {
        std::vector<Strategy> strategies;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (runs_[s] && costs_[s].seconds < 0.05 * cpu) strategies.push_back(strategies_[s]);
        return strategies;
    }

    /// The time was over, or the study stopped, before the first sample.
    void run_none()
    {
        for (std::unique_ptr<StrategyRun>& run : runs_) run.reset();
        for (CostEstimate& cost : costs_) cost.is_affordable = false, cost.is_known = false;
    }

    /// What the set-up has left of the time must do for the first samples.
    void leave_out_late()
    {
        const double left = (goal_.budget() - elapsed()) * threads();
        for (CostEstimate& cost : costs_) cost.is_late = cost.is_affordable;
        keep_affordable(costs_, left);
        for (std::size_t s = 0; s < strategies_.size(); ++s) {
            costs_[s].is_late = costs_[s].is_late && !costs_[s].is_affordable;
            if (!costs_[s].is_affordable) runs_[s].reset();
        }
        plan_.parts = parts_for(sum_of_costs(), std::max(left, 1e-9));
    }

    /// Those that find work: no more than tiles.
    int threads() const
    {
        return std::max(
            1, std::min(ground_.executor.threads,
                        static_cast<int>(std::min<std::size_t>(points_->figure_tiles, 1 << 20))));
    }

    NumberSource numbers() const { return {options_.seed, options_.samples_per_scrambling}; }

    int samples_per_observation() const
    {
        return numbers().is_sobol() ? static_cast<int>(options_.samples_per_scrambling) : 1;
    }

    void start_run(std::size_t s)
    {
        runs_[s] = std::make_unique<StrategyRun>(scene_, *points_, strategies_[s], numbers(),
                                                 until(first_until));
    }

    std::vector<Strategy> that_run() const
    {
        std::vector<Strategy> strategies;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (runs_[s]) strategies.push_back(strategies_[s]);
        return strategies;
    }

    /// CPU seconds of `first_samples` observations at every point, over the strategies that are
    /// run.
    double sum_of_costs() const
    {
        double sum = 0;
        for (const CostEstimate& cost : costs_) sum += cost.is_affordable ? cost.seconds : 0;
        return sum;
    }

    void end_turn(std::size_t s, double of_round) const
    {
        if (options_.on_invalid && runs_[s])
            if (const auto found = runs_[s]->first_invalid())
                options_.on_invalid(strategies_[s], *found);
        if (!options_.progress) return;
        const double of_plan =
            (rounds_.count() - 1 + of_round) / static_cast<double>(plan_.chunks.size());
        options_.progress(options_.spp ? of_plan : elapsed() / goal_.budget(), report_);
    }

    void run_spp()
    {
        plan_ = plan_for(*options_.spp / static_cast<std::uint64_t>(samples_per_observation()));
        if (lit() == 0) return;
        double samples = 0, last_look = 0;
        for (const int chunk : plan_.chunks) {
            rounds_.take(chunk, plan_, how_);
            if (is_stopped()) return;
            samples += chunk;
            if (!options_.progress || rounds_.count() < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            rank_now(1);  // to be shown; it decides nothing
        }
        if (plan_.remainder > 0)
            for (auto& run : runs_)
                if (run && !is_stopped())
                    run->sample_apart(plan_.remainder, workspaces_, ground_.executor, stop_);
    }

    void run_time()
    {
        if (lit() == 0) return;
        double samples = 0, last_look = 0, round_seconds = 0;  // of one sample per replicate
        while (!is_stopped() && !that_run().empty()) {
            const int chunk = next_chunk(static_cast<int>(rounds_.count()) / plan_.parts,
                                         goal_.budget() - elapsed(), round_seconds);
            if (chunk == 0) return;
            const Clock::time_point before = Clock::now();
            rounds_.take(chunk, plan_, how_);
            round_seconds = seconds_since(before) / chunk;
            samples += chunk;
            if (is_stopped() || rounds_.count() < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            rank_now(goal_.stops_when_settled() ? spending_.spend_at(elapsed() / goal_.budget())
                                                : 1);  // no verdict decides to stop
            if (is_enough(report_, goal_, elapsed())) return;
            if (goal_.stops_when_settled()) let_rest();
        }
    }

    void let_rest()
    {
        const std::vector<bool> rested =
            std::exchange(how_.rests, resting(report_, goal_, elapsed()));
        if (!spreads_ || how_.rests == rested) return;
        std::vector<Strategy> awake;
        for (std::size_t s = 0; s < how_.rests.size(); ++s)
            if (runs_[s] && !how_.rests[s]) awake.push_back(strategies_[s]);
        try {
            how_.tile_factors = best_tile_factors(ground(until(1)), awake);
        } catch (const Stopped&) {  // as before
        }
    }

    /// share: of the probabilities of error that this look spends.
    void rank_now(double share)
    {
        const SceneReport* earlier = goal_.stops_when_settled() ? &report_ : nullptr;
        const auto ranked = [&](const SceneMeasurements& scene) {
            return rank(scene, {.threads = ground_.executor.threads,
                                .at = options_.at,
                                .share = share,
                                .earlier = earlier});
        };
        Ranking ranking = ranked(reference_.of_resolved());
        const auto is_ranked = [&](std::size_t s) {
            return ranking.strategies[s].status == Status::ranked;
        };
        if (reference_.trust_fewer(is_ranked))  // some were biased
            ranking = ranked(reference_.of_trusted());
        put_ranking(std::move(ranking), elapsed(), report_);
        report_.epsilon = reference_.epsilon();
        report_.lacks_audit = !audit_ && !is_dark();
        report_.had_no_time_for_audit = report_.lacks_audit && !numbers().is_sobol();
    }

    StrategyMeasurements measured(std::size_t s, const RelativeScale& scale) const
    {
        if (!runs_[s]) return not_run(s);
        StrategyMeasurements m = runs_[s]->measurements(scale);
        if (audit_) audit_->add_to(m, runs_[s]->results());
        m.is_proved_exact =
            is_dark() || (has_closed_form_ && gives_closed_form(scene_.scene(), strategies_[s]));
        m.all_samples_equal_reference = exactness_of(m) != Exactness::none;
        return m;
    }

    StrategyMeasurements not_run(std::size_t s) const
    {
        StrategyMeasurements m;
        m.strategy = strategies_[s];
        m.was_run = false;
        m.estimated_seconds = costs_[s].is_known ? costs_[s].seconds : nan;
        m.not_run_reason = why_not_run(costs_[s]);
        return m;
    }

    Reason why_not_run(const CostEstimate& cost) const
    {
        if (cost.is_affordable || (!cost.is_known && is_stopped())) return reason::Stopped{};
        if (!cost.is_known) return reason::NotReady{};
        if (cost.is_late) return reason::LateSetUp{};
        return reason::PastBudget{static_cast<double>(first_samples * samples_per_observation()),
                                  first_share};
    }

    /// No light, or no point that can be lit: every sample is 0, as the mean is.
    bool is_dark() const
    {
        const Lights& lights = scene_.scene().lights;
        return lit() == 0 || std::all_of(lights.begin(), lights.end(), [](const Light& light) {
                   return light.radiance_radius == Vec3<float>(0.0F);
               });
    }

    void finish()
    {
        if (!goal_.stops_when_settled() || !report_.settled) rank_now(spending_.spend_rest());
        report_.partial = is_stopped();
    }

    const LitScene& scene_;
    const std::vector<Strategy>& strategies_;
    const StudyOptions& options_;
    const StudyGoal goal_;
    StopToken stop_{options_.stop};
    Clock::time_point start_ = Clock::now();
    std::unique_ptr<StudyPoints> points_;
    WorkspacePool<float> workspaces_;
    StudyGround ground_;
    SceneReport report_;
    std::vector<std::unique_ptr<StrategyRun>> runs_;  ///< [strategy]
    std::vector<CostEstimate> costs_;                 ///< [strategy]
    std::optional<StudyAudit> audit_;
    SamplePlan plan_;
    RoundOptions how_;
    bool spreads_ = false;          ///< samples over tiles
    bool has_closed_form_ = false;  ///< at every point of the figures: proved
    StudyRounds rounds_;
    StudyReference reference_;
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
