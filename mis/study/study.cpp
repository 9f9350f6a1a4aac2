#include "mis/study/study.h"

#include "mis/engine/stopwatch.h"
#include "mis/stats/rank.h"
#include "mis/study/affordable.h"
#include "mis/study/reference.h"
#include "mis/study/rounds.h"
#include "mis/study/savings.h"
#include "mis/study/scene_facts.h"
#include "mis/study/study_audit.h"

#include <algorithm>
#include <utility>

namespace mis {

namespace {

/// Of the time given, for the first samples of all strategies.
constexpr double first_share = 0.6;

/// One study under way.
class Scheduler {
public:
    Scheduler(const LitScene& scene, const std::vector<Strategy>& strategies,
              const StudyOptions& options, const AnyExecutor& executor)
        : scene_(scene), strategies_(strategies), options_(options), goal_(options.goal()),
          points_(std::make_unique<StudyPoints>(find_study_points(scene, executor))),
          ground_{scene, *points_, workspaces_, executor, options.seed, options.stop},
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
    bool is_stopped() const { return ground_.is_stopped(); }
    std::size_t lit() const { return points_->figure_lit; }
    double elapsed() const { return seconds_since(start_); }

    void start_report()
    {
        static_cast<SceneFacts&>(report_) = facts_of(scene_.scene(), *points_);
        const GBuffer& shading = points_->shading;
        report_.effects = explained(scene_.scene(), scene_.effects(),
                                    scene_.tiles_that_call(shading).of(shading.tiles.size()));
        measure_savings(scene_, spread_tiles(shading, most_tiles_of_savings), report_.effects);
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
        const double cpu = options_.spp ? 1e300 : goal_.budget() * ground_.executor.threads;
        if (!options_.spp) {
            costs_ = estimate_costs(ground_, strategies_, first_samples * samples_per_observation(),
                                    first_share * cpu);
            plan_.parts = parts_for(sum_of_costs(), cpu);
        }
        std::vector<Strategy> quick;
        for (std::size_t s = 0; s < strategies_.size(); ++s) {
            if (!costs_[s].is_affordable) continue;
            start_run(s);
            if (costs_[s].seconds < 0.05 * cpu) quick.push_back(strategies_[s]);
        }
        if (is_stopped()) return;
        how_.weights = rough_weights(ground_);
        spreads_ = !options_.spp && 4 * sum_of_costs() < cpu;  // else rounds are few, all of twos
        if (spreads_) how_.tile_factors = best_tile_factors(ground_, quick);
        if (!numbers().is_sobol()) audit_.emplace(ground_, how_.weights, that_run());
    }

    NumberSource numbers() const { return {options_.seed, options_.samples_per_scrambling}; }

    int samples_per_observation() const
    {
        return numbers().is_sobol() ? static_cast<int>(options_.samples_per_scrambling) : 1;
    }

    void start_run(std::size_t s)
    {
        runs_[s] = std::make_unique<StrategyRun>(scene_, *points_, strategies_[s], numbers());
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
                    run->sample_apart(plan_.remainder, workspaces_, ground_.executor);
    }

    void run_time()
    {
        if (lit() == 0) return;
        double samples = 0, last_look = 0, round_seconds = 0;  // of one sample per replicate
        while (!is_stopped()) {
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
        how_.tile_factors = best_tile_factors(ground_, awake);
    }

    /// share: of the probabilities of error that this look spends.
    void rank_now(double share)
    {
        const std::vector<PairReport> earlier =
            goal_.stops_when_settled() ? std::move(report_.pairs) : std::vector<PairReport>();
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
        report_.strategies = std::move(ranking.strategies);
        report_.pairs = std::move(ranking.pairs);
        report_.settled = ranking.settled;
        report_.replicates = ranking.replicates;
        report_.epsilon = reference_.epsilon();
        report_.seconds = elapsed();
        report_.lacks_audit = !audit_ && !is_dark();
    }

    StrategyMeasurements measured(std::size_t s, const RelativeScale& scale) const
    {
        if (!runs_[s]) return not_run(s);
        StrategyMeasurements m = runs_[s]->measurements(scale);
        m.all_samples_equal_reference = is_dark();
        if (audit_) audit_->add_to(m, runs_[s]->results());
        return m;
    }

    StrategyMeasurements not_run(std::size_t s) const
    {
        StrategyMeasurements m;
        m.strategy = strategies_[s];
        m.was_run = false;
        m.estimated_seconds = costs_[s].seconds;
        if (costs_[s].is_affordable) m.not_run_reason = reason::Stopped{};
        else
            m.not_run_reason = reason::PastBudget{
                static_cast<double>(first_samples * samples_per_observation()), first_share};
        return m;
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
    bool spreads_ = false;  ///< samples over tiles
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
