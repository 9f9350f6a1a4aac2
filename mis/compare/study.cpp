#include "mis/compare/study.h"

#include "mis/compare/schedule.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mis {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

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
          reasons_(strategies.size()), estimates_(strategies.size())
    {
        study_.points = std::make_unique<StudyPoints>(find_study_points(scene, executor));
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
    bool is_stopped() const { return options_.stop != nullptr && *options_.stop; }
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
        for (const EffectPlan& plan : explained(scene, scene_.effects()))
            report.effects.push_back(
                {.name = plan.name, .on = plan.on, .share = plan.on ? 1.0 : 0.0, .why = plan.why});
    }

    /// What a first look at the costs allows; a rough picture of the scene, for the weights; and
    /// the audit.
    void start_runs()
    {
        if (points() == 0) {
            for (std::size_t s = 0; s < strategies_.size(); ++s)
                study_.runs[s] = std::make_unique<StrategyRun>(scene_, *study_.points,
                                                               strategies_[s], options_.seed);
            return;
        }
        choose_by_cost();
        if (is_stopped()) return;
        make_pilot();
        run_audit();
    }

    /// CPU seconds that a first round of a strategy takes, without running it: a floor under its
    /// cost.
    double least_seconds(const Strategy& strategy) const
    {
        const double lights = static_cast<double>(scene_.scene().lights.size()),
                     n = static_cast<double>(points());
        if (!strategy.chooses_light()) return 0;
        if (draws_every_light(strategy.policy)) return n * lights * first_samples() * 10e-9;
        return looks_at_point(strategy.policy) ? n * lights * 0.5e-9 : 0;
    }

    int first_samples() const
    {
        return options_.spp ? static_cast<int>(std::min<std::uint64_t>(*options_.spp, 1 << 30))
                            : 32;
    }

    void choose_by_cost()
    {
        const double cpu = options_.spp ? 1e300 : budget() * executor_.threads * 0.6;
        std::vector<std::size_t> order;
        for (std::size_t s = 0; s < strategies_.size(); ++s) {
            estimates_[s] = least_seconds(strategies_[s]);
            if (estimates_[s] <= cpu) {
                study_.runs[s] = std::make_unique<StrategyRun>(scene_, *study_.points,
                                                               strategies_[s], options_.seed);
                if (!options_.spp)
                    estimates_[s] = std::max(estimates_[s], tried_out(*study_.runs[s]));
            }
            order.push_back(s);
        }
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return estimates_[a] < estimates_[b];
        });
        double sum = 0;
        for (const std::size_t s : order) {
            sum += estimates_[s];
            if (sum <= cpu || (s == order.front() && study_.runs[s])) continue;
            reasons_[s] = "past the budget";
            study_.runs[s].reset();
        }
    }

    double tried_out(const StrategyRun& run)
    {
        TimeObservation cost =
            run.try_out(1, 4, workspaces_);  // the first touch of memory is no cost of the strategy
        if (cost.seconds_per_sample < 1e-3) cost = run.try_out(8, 32, workspaces_);
        return static_cast<double>(points()) *
               (first_samples() * cost.seconds_per_sample + cost.seconds_per_point);
    }

    /// A rough picture of the scene, from samples that count for nothing else: weights for the
    /// replicates' relative variances and, where time is the limit, how the samples are best spread
    /// over the tiles.
    void make_pilot()
    {
        constexpr int pilot_samples = 8;
        std::vector<double> benefit(study_.points->figure_tiles);
        const bool is_small =
            static_cast<double>(scene_.scene().lights.size()) * static_cast<double>(points()) < 1e8;
        const Strategy rough =
            parse_strategy(is_small ? "radiant-solid-angle/power" : "power/power");
        StrategyRun pilot(scene_, *study_.points, rough, ~options_.seed);
        pilot.sample_apart(pilot_samples, workspaces_, executor_);
        std::vector<double> means;
        for (const PointResult& result : pilot.results()) means.push_back(result.luminance.mean);
        weights_ = scale_of(means);
        for (double& w : weights_) w = w > 0 ? 1 / w : 0;
        tile_factors_.assign(study_.points->shading.tiles.size(), 1);
        if (options_.spp) return;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (study_.runs[s] && estimates_[s] < 0.05 * budget() * executor_.threads &&
                !is_stopped()) {
                StrategyRun one(scene_, *study_.points, strategies_[s], ~options_.seed);
                one.sample_apart(pilot_samples, workspaces_, executor_);
                add_benefit(benefit, one);
            }
        spread_over_tiles(benefit);
    }

    /// What a tile adds to the squared relative error of a strategy's variance, per sample: Σ μ4
    /// over V².
    void add_benefit(std::vector<double>& benefit, const StrategyRun& run) const
    {
        std::vector<double> fourth(benefit.size());
        double variance = 0;
        for (std::size_t t = 0; t < benefit.size(); ++t) {
            const Tile& tile = study_.points->shading.tiles[t];
            for (const PointResult& result : run.results().subspan(tile.first, tile.count)) {
                variance += result.luminance.variance();
                fourth[t] += result.luminance.m4;
            }
        }
        if (!(variance > 0)) return;
        for (std::size_t t = 0; t < benefit.size(); ++t)
            benefit[t] += fourth[t] / (variance * variance);
    }

    /// Samples in proportion to √(benefit per point), between half and eight times the mean:
    /// stratified sampling (Neyman 1934). The pilot's samples count for nothing else, so no figure
    /// is biased by it.
    void spread_over_tiles(const std::vector<double>& benefit)
    {
        double mean = 0;
        std::vector<double> wanted(benefit.size());
        for (std::size_t t = 0; t < benefit.size(); ++t) {
            const double count = study_.points->shading.tiles[t].count;
            wanted[t] = std::sqrt(benefit[t] / count);
            mean += wanted[t] * count / static_cast<double>(points());
        }
        if (!(mean > 0)) return;
        for (std::size_t t = 0; t < benefit.size(); ++t)
            tile_factors_[t] = std::clamp(wanted[t] / mean, 0.5, 8.0);
    }

    /// `chunk` samples per replicate in the mean, at least two.
    Allocation allocation_of(int chunk) const
    {
        Allocation allocation;
        for (const double factor : tile_factors_)
            allocation.push_back(
                options_.spp ? chunk : std::max(2, static_cast<int>(std::lround(factor * chunk))));
        return allocation;
    }

    /// μ² + ε² of every point; ε is 1 % of the mean over the figures' points, 0 without a camera.
    std::vector<double> scale_of(const std::vector<double>& means)
    {
        double sum = 0;
        for (std::size_t p = 0; p < points(); ++p) sum += means[p];
        const double epsilon = scene_.scene().camera
                                   ? 0.01 * sum / static_cast<double>(study_.points->figure_points)
                                   : 0;
        study_.report.epsilon = epsilon;
        std::vector<double> scale;
        for (const double mean : means) scale.push_back(mean * mean + epsilon * epsilon);
        return scale;
    }

    void run_audit()
    {
        std::size_t prepared = 1;
        for (const Strategy& s : strategies_)
            prepared += s.chooses_light() && looks_at_point(s.policy) ? 1 : 0;
        const std::size_t affordable =
            50'000'000 / (prepared * scene_.scene().lights.size() + 1) + 4;
        audited_ = spread_points(*study_.points, std::min<std::size_t>(1024, affordable));
        std::vector<AuditPoint> at;
        for (const std::size_t p : audited_)
            at.push_back({study_.points->shading.points[p], material_of(p)});
        std::vector<Strategy> run;
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            if (study_.runs[s]) run.push_back(strategies_[s]);
        const std::vector<AuditEstimate> estimates =
            audit(scene_, at, run, options_.seed, executor_);
        audit_.resize(strategies_.size());
        for (std::size_t s = 0, k = 0; s < strategies_.size(); ++s)
            if (study_.runs[s]) audit_[s] = estimates[k++];
    }

    int material_of(std::size_t point) const
    {
        const std::vector<Tile>& tiles = study_.points->shading.tiles;
        const auto after =
            std::upper_bound(tiles.begin(), tiles.end(), point,
                             [](std::size_t p, const Tile& tile) { return p < tile.first; });
        return std::prev(after)->material;
    }

    /// One round: every strategy in turn, in random order. False: stopped before the first
    /// strategy.
    void round(int chunk)
    {
        const Allocation allocation = allocation_of(chunk);
        const std::vector<std::size_t> order =
            round_order(strategies_.size(), options_.seed, rounds_++);
        std::size_t done = 0;
        for (const std::size_t s : order) {
            if (is_stopped()) return;
            if (study_.runs[s])
                study_.runs[s]->sample_round(allocation, plan_.replicates, weights_, workspaces_,
                                             executor_);
            show_progress(static_cast<double>(++done) / static_cast<double>(order.size()));
        }
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
        plan_ = plan_for(*options_.spp);
        if (points() == 0) return;
        for (const int chunk : plan_.chunks) {
            round(chunk);
            if (is_stopped()) return;
        }
        if (plan_.remainder > 0)
            for (auto& run : study_.runs)
                if (run && !is_stopped())
                    run->sample_apart(plan_.remainder, workspaces_, executor_);
    }

    void run_time()
    {
        if (points() == 0) return;
        double samples = 0, last_look = 0, sampling_seconds = 0;
        while (!is_stopped()) {
            const double round_seconds = samples > 0 ? sampling_seconds / samples : 0;
            const int chunk = next_chunk(static_cast<int>(rounds_),
                                         budget() - seconds_since(start_), round_seconds);
            if (chunk == 0) return;
            const Clock::time_point before = Clock::now();
            round(chunk);
            sampling_seconds += seconds_since(before);
            samples += chunk;
            if (is_stopped() || rounds_ < 3 || samples < 1.4 * last_look) continue;
            last_look = samples;
            rank_now(++look_);
            if (is_enough()) return;
        }
    }

    bool is_enough() const
    {
        if (options_.seconds) return false;
        if (!options_.error) return study_.report.settled;
        bool any = false;
        for (const StrategyReport& s : study_.report.strategies) {
            if (s.status != Status::ranked) continue;
            any = true;
            if (s.variance.value > 0 &&
                !(s.variance.high - s.variance.low <= 2 * *options_.error * s.variance.value))
                return false;
        }
        return any;
    }

    /// μ of every point: the strategies' means, each by its samples over its variance.
    std::vector<double> pooled_means() const
    {
        std::vector<double> sums(study_.points->shading.points.size());
        double weights = 0;
        for (const auto& run : study_.runs) {
            if (!run || run->samples() == 0) continue;
            double variance = 0, mean = 0;
            for (const PointResult& result : run->results()) {
                if (result.luminance.count > 1) variance += result.luminance.variance();
                mean += std::abs(result.luminance.mean);
            }
            const double n = std::max<double>(1, static_cast<double>(run->results().size()));
            const double floor = 1e-12 * (mean / n) * (mean / n) + 1e-300;
            const double weight = static_cast<double>(run->samples()) / (variance / n + floor);
            weights += weight;
            for (std::size_t p = 0; p < sums.size(); ++p)
                sums[p] += weight * run->results()[p].luminance.mean;
        }
        for (double& sum : sums) sum = weights > 0 ? sum / weights : 0;
        return sums;
    }

    void rank_now(int look)
    {
        const std::vector<double> scale = scale_of(pooled_means());
        SceneMeasurements scene{study_.points->figure_points, {}};
        for (std::size_t s = 0; s < strategies_.size(); ++s)
            scene.strategies.push_back(measured(s, scale));
        Ranking ranking =
            rank(scene, {.threads = executor_.threads, .at = options_.at, .look = look});
        study_.report.strategies = std::move(ranking.strategies);
        study_.report.pairs = std::move(ranking.pairs);
        study_.report.settled = ranking.settled;
        study_.report.replicates = ranking.replicates;
        study_.report.seconds = seconds_since(start_);
    }

    StrategyMeasurements measured(std::size_t s, const std::vector<double>& scale) const
    {
        if (!study_.runs[s]) {
            StrategyMeasurements m;
            m.strategy = strategies_[s];
            m.was_run = false;
            m.not_run_reason = reasons_[s].empty() ? "stopped before its turn" : reasons_[s];
            m.estimated_seconds = estimates_[s];
            return m;
        }
        StrategyMeasurements m = study_.runs[s]->measurements(scale);
        m.all_samples_equal_reference = is_dark();
        if (s < audit_.size() && audit_[s].available) add_audit(m, s);
        return m;
    }

    /// No light, or no point that can be lit: every sample is 0, as the mean is.
    bool is_dark() const
    {
        const Lights& lights = scene_.scene().lights;
        return points() == 0 || std::all_of(lights.begin(), lights.end(), [](const Light& light) {
                   return light.radiance_radius == Vec3<float>(0.0F);
               });
    }

    void add_audit(StrategyMeasurements& m, std::size_t s) const
    {
        double sum = 0, squares = 0;
        for (const std::size_t p : audited_) {
            const Moments& moments = study_.runs[s]->results()[p].luminance;
            if (moments.count < 2) return;
            sum += moments.variance();
            squares += moments.variance_se() * moments.variance_se();
        }
        const double n = static_cast<double>(audited_.size());
        m.audit = {true, audit_[s].variance, audit_[s].variance_se, sum / n,
                   std::sqrt(squares) / n};
    }

    void finish()
    {
        rank_now(options_.spp || look_ == 0                   ? 0
                 : study_.report.settled && !options_.seconds ? look_
                                                              : look_ + 1);
        study_.report.partial = is_stopped();
    }

    const LitScene& scene_;
    const std::vector<Strategy>& strategies_;
    const StudyOptions& options_;
    const AnyExecutor& executor_;
    Clock::time_point start_ = Clock::now();
    Study study_;
    WorkspacePool<float> workspaces_;
    Plan plan_;
    std::uint32_t rounds_ = 0;
    int look_ = 0;
    std::vector<std::string> reasons_;
    std::vector<double> estimates_, weights_, tile_factors_;
    std::vector<std::size_t> audited_;
    std::vector<AuditEstimate> audit_;
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
