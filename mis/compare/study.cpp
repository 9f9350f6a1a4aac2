#include "mis/compare/study.h"

#include "mis/compare/affordable.h"
#include "mis/compare/pool.h"
#include "mis/compare/resolved.h"
#include "mis/compare/savings.h"
#include "mis/compare/schedule.h"
#include "mis/compare/study_audit.h"
#include "mis/compare/words.h"
#include "mis/engine/stopwatch.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mis {

namespace {

/// Of the time given, for the first samples of all strategies.
constexpr double first_share = 0.6;

/// Of the time given, at most until then: what leaving out effects saves has
/// been measured; the spread of the samples and the audit are known; the first
/// samples begin.
constexpr double savings_until = 0.1, audit_until = 0.5, first_until = 0.9;

std::size_t triangles_of(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Surface& surface : scene.surfaces)
        if (const auto* mesh = std::get_if<Mesh>(&surface.shape))
            triangles += mesh->triangles.size();
    return triangles;
}

/// One study under way.
class Scheduler {
public:
    Scheduler(const LitScene& scene, const std::vector<Strategy>& strategies,
              const StudyOptions& options, const AnyExecutor& executor)
        : scene_(scene), strategies_(strategies), options_(options), executor_(executor),
          costs_(strategies.size()), rests_(strategies.size(), false)
    {
        study_.points =
            std::make_unique<StudyPoints>(find_study_points(scene, stoppable(executor, until(1))));
        study_.runs.resize(strategies.size());
    }

    Study run()
    {
        start_report();
        start_runs();
        if (options_.spp) run_spp();
        else run_time();
        finish();
        return std::move(study_);
    }

private:
    double budget() const
    {
        return options_.seconds.value_or(options_.error ? 1e7 : options_.default_seconds);
    }
    bool is_stopped() const { return stop_.is_up(); }

    /// Up when the study is stopped, and once that share of its time is over.
    StopToken until(double share) const
    {
        if (options_.spp) return stop_;
        return stop_.until(start_ + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(share * budget())));
    }
    std::size_t points() const { return study_.points->figure_lit; }

    void start_report()
    {
        SceneReport& report = study_.report;
        const Scene& scene = scene_.scene();
        report.file = scene.file;
        report.name = scene.name;
        report.lights = scene.lights.size();
        report.surfaces = scene.surfaces.size();
        report.triangles = triangles_of(scene);
        report.width = study_.points->shading.width;
        report.height = study_.points->shading.height;
        report.shading_points = study_.points->figure_points;
        report.background_pixels = study_.points->shading.background.size();
        const GBuffer& shading = study_.points->shading;
        report.effects = explained(scene, scene_.effects(),
                                   scene_.tiles_that_call(shading).of(shading.tiles.size()));
        try {
            measure_savings(scene_, spread_tiles(shading, most_tiles_of_savings), report.effects,
                            until(savings_until));
        } catch (const Stopped&) {  // they stay unmeasured
        }
    }

    /// What a first look at the costs allows; a rough picture of the scene, for the weights; how
    /// samples are best spread; and the audit.
    void start_runs()
    {
        tile_factors_.assign(study_.points->shading.tiles.size(), 1.0);
        if (points() == 0) {
            for (std::size_t s = 0; s < strategies_.size(); ++s) start_run(s);
            return;
        }
        const double cpu = options_.spp ? 1e300 : budget() * threads();
        if (!options_.spp)
            costs_ = estimate_costs(ground(until(first_share)), strategies_,
                                    first_samples * samples_per_observation(), first_share * cpu);
        try {
            for (std::size_t s = 0; s < strategies_.size(); ++s)
                if (costs_[s].is_affordable) start_run(s);
            weights_ = rough_weights(ground(until(first_until)));
            look_ahead(cpu);
        } catch (const Stopped&) {
            run_none();
        }
        if (!options_.spp) leave_out_late();
    }

    /// Which tiles need more samples than others, and the audit, as far as there
    /// is time.
    void look_ahead(double cpu)
    {
        try {
            spreads_ = !options_.spp && 4 * sum_of_costs() < cpu;  // else rounds are few, of twos
            if (spreads_) tile_factors_ = best_tile_factors(ground(until(audit_until)), quick(cpu));
            if (!numbers().is_sobol()) audit_.emplace(ground(until(audit_until)), weights_, ran());
            if (audit_ && audit_->is_empty()) audit_.reset();
        } catch (const Stopped&) {  // all tiles alike; the report says that there is no audit
        }
    }

    /// Those whose first samples take little of the time.
    std::vector<Strategy> quick(double cpu) const
    {
        std::vector<Strategy> strategies;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (study_.runs[s] && costs_[s].seconds < 0.05 * cpu)
                strategies.push_back(strategies_[s]);
        return strategies;
    }

    /// The time was over, or the study stopped, before the first sample.
    void run_none()
    {
        for (std::unique_ptr<StrategyRun>& run : study_.runs) run.reset();
        for (CostEstimate& cost : costs_) cost.is_affordable = false, cost.is_known = false;
    }

    /// What the set-up has left of the time must do for the first samples.
    void leave_out_late()
    {
        const double left = (budget() - seconds_since(start_)) * threads();
        keep_affordable(costs_, left);
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (!costs_[s].is_affordable) study_.runs[s].reset();
        plan_.parts = parts_for(sum_of_costs(), std::max(left, 1e-9));
    }

    /// Those that find work: no more than tiles.
    int threads() const
    {
        return std::max(1, std::min(executor_.threads, static_cast<int>(std::min<std::size_t>(
                                                           study_.points->figure_tiles, 1 << 20))));
    }

    /// For work before the first samples, until `stop` is up.
    StudyGround ground(const StopToken& stop)
    {
        return {scene_, *study_.points, workspaces_, executor_, options_.seed, stop};
    }

    NumberSource numbers() const { return {options_.seed, options_.samples_per_scrambling}; }

    int samples_per_observation() const
    {
        return numbers().is_sobol() ? static_cast<int>(options_.samples_per_scrambling) : 1;
    }

    void start_run(std::size_t s)
    {
        study_.runs[s] = std::make_unique<StrategyRun>(scene_, *study_.points, strategies_[s],
                                                       numbers(), until(first_until));
    }

    std::vector<Strategy> ran() const
    {
        std::vector<Strategy> strategies;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (study_.runs[s]) strategies.push_back(strategies_[s]);
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

    /// About `chunk` observations per replicate in the mean, at least two.
    Allocation allocation_of(int chunk) const
    {
        Allocation allocation;
        for (const double factor : tile_factors_)
            allocation.push_back(
                options_.spp ? chunk : std::max(2, static_cast<int>(std::lround(factor * chunk))));
        return allocation;
    }

    /// `chunk` observations for every replicate: in one round, or in several in which they take
    /// turns.
    void rounds(int chunk)
    {
        const Allocation allocation = allocation_of(chunk);
        const int part = plan_.replicates / plan_.parts;
        for (int first = 0; first < plan_.replicates && !is_stopped(); first += part)
            round(allocation, first, first + part);
    }

    /// One round: every strategy in turn that does not rest, in random order. Times are compared
    /// over the rounds that all took part in.
    void round(const Allocation& allocation, int first, int end)
    {
        const bool any_rests = std::find(rests_.begin(), rests_.end(), true) != rests_.end();
        const std::vector<std::size_t> order =
            round_order(strategies_.size(), options_.seed, rounds_++);
        std::size_t done = 0;
        for (const std::size_t s : order) {
            if (is_stopped()) return;
            if (study_.runs[s] && !rests_[s])
                study_.runs[s]->sample_round({allocation, first, end, plan_.replicates, !any_rests},
                                             weights_, workspaces_, executor_, stop_);
            if (options_.traps_invalid) trap(s);
            show_progress(static_cast<double>(++done) / static_cast<double>(order.size()));
        }
    }

    void trap(std::size_t s) const
    {
        if (!study_.runs[s]) return;
        const std::optional<SampleName> found = study_.runs[s]->first_invalid();
        if (found)
            throw std::runtime_error(scene_.scene().file + ": " + name_of(strategies_[s]) +
                                     " gave a sample that is no number; this shows it\n    " +
                                     replay_words(scene_.scene().file, strategies_[s], *found) +
                                     " --seed " + std::to_string(options_.seed) + sampler_words() +
                                     resolution_words());
    }

    /// As `mis replay` takes it.
    std::string sampler_words() const
    {
        if (!numbers().is_sobol()) return "";
        return " --sampler sobol --at " + std::to_string(options_.samples_per_scrambling);
    }

    std::string resolution_words() const
    {
        if (!scene_.scene().camera) return "";
        const auto [width, height] = scene_.scene().camera->resolution;
        return " --resolution " + std::to_string(width) + "x" + std::to_string(height);
    }

    void show_progress(double of_round)
    {
        if (!options_.progress) return;
        const double rounds = static_cast<double>(plan_.chunks.size());
        const double done =
            options_.spp ? (rounds_ - 1 + of_round) / rounds : seconds_since(start_) / budget();
        options_.progress(done, study_.report);
    }

    void run_spp()
    {
        plan_ = plan_for(*options_.spp / static_cast<std::uint64_t>(samples_per_observation()));
        if (points() == 0) return;
        double samples = 0, last_look = 0;
        for (const int chunk : plan_.chunks) {
            rounds(chunk);
            if (is_stopped()) return;
            samples += chunk;
            if (!options_.progress || rounds_ < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            rank_now(1);  // to be shown; it decides nothing
        }
        if (plan_.remainder > 0)
            for (auto& run : study_.runs)
                if (run && !is_stopped())
                    run->sample_apart(plan_.remainder, workspaces_, executor_, stop_);
    }

    void run_time()
    {
        if (points() == 0) return;
        double samples = 0, last_look = 0, round_seconds = 0;  // of one sample per replicate
        while (!is_stopped() && any_runs()) {
            const int chunk = next_chunk(static_cast<int>(rounds_) / plan_.parts,
                                         budget() - seconds_since(start_), round_seconds);
            if (chunk == 0) return;
            const Clock::time_point before = Clock::now();
            rounds(chunk);
            round_seconds = seconds_since(before) / chunk;
            samples += chunk;
            if (is_stopped() || rounds_ < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            rank_now(stops_when_settled() ? spending_.spend_at(seconds_since(start_) / budget())
                                          : 1);  // no verdict decides to stop
            if (is_enough()) return;
            if (stops_when_settled()) let_rest();
        }
    }

    bool any_runs() const
    {
        return std::any_of(study_.runs.begin(), study_.runs.end(),
                           [](const auto& run) { return run != nullptr; });
    }

    /// Not resolved yet, but within the time that is left if all goes on as before.
    bool is_worth_waiting_for(const StrategyReport& strategy) const
    {
        return strategy.status == Status::not_resolved &&
               1.5 * strategy.resolving_factor * seconds_since(start_) < budget();
    }

    /// Whom the next rounds are for: undecided pairs, where their own samples need it; once there
    /// is none, those that may yet be resolved. Else all. The others rest.
    std::vector<bool> resting() const
    {
        std::vector<bool> rests(strategies_.size(), true);
        for (const PairReport& pair : study_.report.pairs)
            if (pair.verdict == Verdict::undecided)
                rests[static_cast<std::size_t>(pair.a)] = rests[static_cast<std::size_t>(pair.b)] =
                    false;
        if (std::find(rests.begin(), rests.end(), false) == rests.end())
            for (std::size_t s = 0; s < rests.size(); ++s)
                rests[s] = !is_worth_waiting_for(study_.report.strategies[s]);
        if (std::find(rests.begin(), rests.end(), false) == rests.end())
            rests.assign(rests.size(), false);
        return rests;
    }

    void let_rest()
    {
        const std::vector<bool> rested = std::exchange(rests_, resting());
        if (!spreads_ || rests_ == rested) return;
        std::vector<Strategy> awake;
        for (std::size_t s = 0; s < rests_.size(); ++s)
            if (study_.runs[s] && !rests_[s]) awake.push_back(strategies_[s]);
        try {
            tile_factors_ = best_tile_factors(ground(until(1)), awake);
        } catch (const Stopped&) {  // as before
        }
    }

    bool stops_when_settled() const
    {
        return !options_.spp && !options_.seconds && !options_.error;
    }

    bool is_enough() const
    {
        const std::vector<StrategyReport>& strategies = study_.report.strategies;
        if (stops_when_settled())
            return study_.report.settled &&
                   std::none_of(strategies.begin(), strategies.end(),
                                [&](const StrategyReport& s) { return is_worth_waiting_for(s); });
        if (!options_.error) return false;
        bool any = false;
        for (const StrategyReport& s : strategies) {
            if (s.status != Status::ranked) continue;
            any = true;
            if (s.variance.value > 0 &&
                !(s.variance.high - s.variance.low <= 2 * *options_.error * s.variance.value))
                return false;
        }
        return any || seconds_since(start_) > options_.default_seconds;  // else without end
    }

    /// share: of the probabilities of error that this look spends.
    void rank_now(double share)
    {
        const std::vector<PairReport> earlier =
            stops_when_settled() ? std::move(study_.report.pairs) : std::vector<PairReport>();
        const auto ranked = [&](const SceneMeasurements& scene) {
            return rank(scene, {.threads = executor_.threads,
                                .at = options_.at,
                                .share = share,
                                .earlier = earlier});
        };
        Ranking ranking = ranked(all_measured());
        const auto is_ranked = [&](std::size_t s) {
            return ranking.strategies[s].status == Status::ranked;
        };
        if (trust_fewer(is_ranked)) ranking = ranked(measured_by_trusted());  // some were biased
        study_.report.strategies = std::move(ranking.strategies);
        study_.report.pairs = std::move(ranking.pairs);
        study_.report.settled = ranking.settled;
        study_.report.replicates = ranking.replicates;
        study_.report.seconds = seconds_since(start_);
        study_.report.lacks_audit = !audit_ && !is_dark();
        study_.report.had_no_time_for_audit = study_.report.lacks_audit && !numbers().is_sobol();
    }

    /// All by one reference, of the means of those that are resolved: first by what takes no
    /// reference, then by the relative variance, too.
    SceneMeasurements all_measured()
    {
        trusted_.assign(strategies_.size(), false);
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            trusted_[s] = study_.runs[s] != nullptr;
        SceneMeasurements scene = measured_by_trusted();
        const auto passes = [&](auto why_not) {
            return
                [&scene, why_not](std::size_t s) { return why_not(scene.strategies[s]).empty(); };
        };
        const bool some_are_blind = trust_fewer(passes(why_blind));
        if (trust_fewer(passes(why_variance_not_resolved)) || some_are_blind)
            scene = measured_by_trusted();
        if (trust_fewer(passes(why_not_resolved))) scene = measured_by_trusted();
        return scene;
    }

    /// Trusts only those of the trusted that pass, if any does. Are they fewer?
    template <class Passes> bool trust_fewer(const Passes& passes)
    {
        std::vector<bool> fewer = trusted_;
        for (std::size_t s = 0; s < fewer.size(); ++s) fewer[s] = trusted_[s] && passes(s);
        const bool is_any_left = std::find(fewer.begin(), fewer.end(), true) != fewer.end();
        if (!is_any_left || fewer == trusted_) return false;
        trusted_ = std::move(fewer);
        return true;
    }

    /// Against the means of those that are trusted.
    SceneMeasurements measured_by_trusted()
    {
        study_.reference_weights = pooling_weights(study_.runs, trusted_);
        PooledMeans means = pooled_means(study_.runs, study_.reference_weights,
                                         study_.points->shading.points.size());
        RelativeScale scale = relative_scale(std::move(means.values), *study_.points,
                                             scene_.scene().camera.has_value());
        scale.mean_errors = std::move(means.errors);
        study_.report.epsilon = scale.epsilon;
        SceneMeasurements scene{points(), {}};
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            scene.strategies.push_back(measured(s, scale));
        return scene;
    }

    StrategyMeasurements measured(std::size_t s, const RelativeScale& scale) const
    {
        if (!study_.runs[s]) {
            StrategyMeasurements m;
            m.strategy = strategies_[s];
            m.was_run = false;
            m.not_run_reason = why_not_run(costs_[s]);
            m.estimated_seconds = costs_[s].seconds;
            return m;
        }
        StrategyMeasurements m = study_.runs[s]->measurements(scale);
        m.all_samples_equal_reference = is_dark();
        if (audit_) audit_->add_to(m, study_.runs[s]->results());
        return m;
    }

    std::string why_not_run(const CostEstimate& cost) const
    {
        if (cost.is_affordable || (!cost.is_known && is_stopped()))
            return "stopped before its turn";
        if (cost.is_known) return "past the budget" + first_look_in_words();
        return "past the budget: its tables and its first samples were not ready "
               "in the time given";
    }

    std::string first_look_in_words() const
    {
        return ": the first " + count(first_samples * samples_per_observation()) +
               " samples of it and of those that cost less would take more than " +
               percent(first_share) + " of the time given";
    }

    /// No light, or no point that can be lit: every sample is 0, as the mean is.
    bool is_dark() const
    {
        const Lights& lights = scene_.scene().lights;
        return points() == 0 || std::all_of(lights.begin(), lights.end(), [](const Light& light) {
                   return light.radiance_radius == Vec3<float>(0.0F);
               });
    }

    void finish()
    {
        if (!stops_when_settled() || !study_.report.settled) rank_now(spending_.spend_rest());
        study_.report.partial = is_stopped();
    }

    const LitScene& scene_;
    const std::vector<Strategy>& strategies_;
    const StudyOptions& options_;
    const AnyExecutor& executor_;
    StopToken stop_{options_.stop};
    Clock::time_point start_ = Clock::now();
    Study study_;
    WorkspacePool<float> workspaces_;
    SamplePlan plan_;
    std::uint32_t rounds_ = 0;
    ErrorSpending spending_;
    std::vector<CostEstimate> costs_;
    std::vector<bool> rests_;
    std::vector<bool> trusted_;  ///< [strategy]: do its means count in the reference?
    bool spreads_ = false;       ///< samples over tiles
    std::vector<double> weights_, tile_factors_;
    std::optional<StudyAudit> audit_;
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
