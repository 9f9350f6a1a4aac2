#include "mis/compare/cost_study.h"

#include "mis/compare/affordable.h"
#include "mis/compare/cost_crossings.h"
#include "mis/compare/cost_sampler.h"
#include "mis/compare/schedule.h"
#include "mis/compare/words.h"
#include "mis/engine/stopwatch.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mis {
namespace {

constexpr int replicate_count = 8;
constexpr double reference_share = 0.3;         // of the time, at most
constexpr std::uint64_t reference_factor = 64;  // its samples over the last doubling's, with --spp
constexpr std::size_t levels_before_twins = 3;
constexpr std::uint64_t most_samples = std::uint64_t{1} << 24;
constexpr std::uint64_t most_samples_of_gain = 256;
constexpr std::uint64_t apart = std::uint64_t{1} << 20;  // a stream that no replicate has

/// One curve under way.
struct Curve {
    CostMeasurements measured;
    std::unique_ptr<CostSampler> sampler;
    double level_seconds = 0, all_seconds = 0;  ///< wall, of the last level and of all
    bool is_done = false;
};

/// One study under way.
class CostStudy {
public:
    CostStudy(const LitScene& scene, std::span<const CostChoice> choices,
              const CostOptions& options, const AnyExecutor& executor)
        : options_(options), points_(find_study_points(scene, stoppable(executor, interrupted_))),
          judged_(cost_points(points_, scene.scene().camera.has_value())),
          ground_{scene, points_, workspaces_, executor, options.seed, until_late()}
    {
        for (const CostChoice& choice : choices) add_curve(choice);
    }

    CostSceneReport run()
    {
        try {
            if (points_.figure_lit > 0) run_levels();
        } catch (const Stopped&) {  // what is complete counts
            if (!interrupted_.is_up()) end_all();
        }
        return report();
    }

private:
    void run_levels()
    {
        show(0, "finding the reference");
        find_reference();
        leave_out_unaffordable();
        for (std::uint64_t samples = 1; !is_finished(); samples *= 2) {
            if (options_.adds_twins && level_ == levels_before_twins) add_twins();
            run_level(samples);
        }
    }

    /// Up when the study is stopped, and where it is late.
    StopToken until_late() const
    {
        if (options_.spp) return interrupted_;
        return interrupted_.until(start_ +
                                  std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(1.1 * options_.seconds)));
    }

    void show(double done, const std::string& doing) const
    {
        if (options_.progress) options_.progress(done, doing);
    }

    double seconds_left() const { return options_.seconds - seconds_since(start_); }

    /// So far past the time that the level at hand is given up.
    bool is_late() const { return !options_.spp && seconds_left() < -0.1 * options_.seconds; }

    void end_all()
    {
        for (Curve& curve : curves_) {
            curve.is_done = true;
            if (curve.measured.levels.empty() && curve.measured.reason.empty())
                curve.measured.reason = "past the budget: the first doubling was not done in time";
        }
    }

    void add_curve(const CostChoice& choice)
    {
        curves_.emplace_back();
        curves_.back().measured.strategy = choice.strategy;
        curves_.back().measured.precision = choice.precision;
    }

    void find_reference()
    {
        std::optional<CostReference> exact = exact_reference(ground_);
        ReferenceLimit limit{.seconds = reference_share * options_.seconds};
        if (options_.spp) limit.samples = reference_factor * *options_.spp;
        reference_ = exact ? std::move(*exact) : pooled_reference(ground_, limit);
    }

    /// Not even the first doublings within the time.
    void leave_out_unaffordable()
    {
        if (options_.spp) return;
        std::vector<Strategy> strategies;
        for (const Curve& curve : curves_) strategies.push_back(curve.measured.strategy);
        constexpr int first_levels = 1 + 2 + 4;
        const std::vector<CostEstimate> costs =
            estimate_costs(ground_, strategies, replicate_count * first_levels,
                           0.6 * seconds_left() * ground_.executor.threads);
        for (std::size_t c = 0; c < curves_.size(); ++c) {
            if (costs[c].is_affordable) continue;
            curves_[c].measured.reason =
                costs[c].is_known ? "past the budget: about " + duration(costs[c].seconds) +
                                        " of CPU time for the first three doublings"
                                  : "past the budget: there was no time for a first sample";
            curves_[c].is_done = true;
        }
    }

    bool is_finished() const
    {
        return ground_.is_stopped() ||
               std::all_of(curves_.begin(), curves_.end(),
                           [](const Curve& curve) { return curve.is_done; });
    }

    /// Every curve that is not done takes `samples` of every point, replicate by replicate.
    void run_level(std::uint64_t samples)
    {
        std::vector<CostLevel> levels(curves_.size());
        std::vector<double> seconds(curves_.size());
        for (int r = 0; r < replicate_count; ++r) {
            const std::uint64_t stream = level_ * replicate_count + static_cast<std::uint64_t>(r);
            for (const std::size_t c :
                 round_order(curves_.size(), options_.seed, static_cast<std::uint32_t>(stream))) {
                if (ground_.is_stopped()) return;
                if (is_late()) return end_all();
                if (curves_[c].is_done || !is_ready(curves_[c])) continue;
                const Clock::time_point start = Clock::now();
                add_replicate(levels[c], curves_[c], samples, stream);
                seconds[c] += seconds_since(start);
                show(1 - seconds_left() / options_.seconds,
                     std::to_string(samples) + " samples per point");
            }
        }
        for (std::size_t c = 0; c < curves_.size(); ++c) {
            if (!curves_[c].is_done)
                end_level(curves_[c], std::move(levels[c]), samples, seconds[c]);
        }
        ++level_;
        for (Curve& curve : curves_) end_if_done(curve, samples);
    }

    static void end_level(Curve& curve, CostLevel level, std::uint64_t samples, double seconds)
    {
        level.samples = samples;
        curve.measured.levels.push_back(std::move(level));
        curve.level_seconds = seconds;
        curve.all_seconds += seconds;
    }

    /// Makes the curve's sampler. The first touch of memory is no cost of the strategy, nor are the
    /// lists that its first draws make for all strategies, so a few samples count for nothing.
    /// False where there is no time for replicates of such samples.
    bool is_ready(Curve& curve)
    {
        if (curve.sampler) return true;
        const CostMeasurements& m = curve.measured;
        curve.sampler =
            make_sampler(ground_, judged_, reference_, m.strategy, m.precision, options_.is_sobol);
        const Clock::time_point start = Clock::now();
        curve.sampler->run(1, apart);
        const double seconds = seconds_since(start);
        constexpr double little = 0.002;  // of the time that is left
        if (seconds < little * seconds_left()) curve.sampler->run(3, apart + 1);
        if (options_.spp || seconds * replicate_count < 0.5 * seconds_left()) return true;
        curve.is_done = true;
        curve.measured.reason = "past the budget: one sample per point takes " + duration(seconds) +
                                ", " + std::to_string(replicate_count) + " times";
        return false;
    }

    void add_replicate(CostLevel& level, Curve& curve, std::uint64_t samples, std::uint64_t stream)
    {
        CostReplicate replicate = curve.sampler->run(samples, stream);
        level.squared_errors.push_back(std::move(replicate.squared_errors));
        if (options_.is_sobol) level.spreads.push_back(std::move(replicate.spreads));
        level.participation.sum_d2 += replicate.participation.sum_d2;
        level.participation.sum_d4 += replicate.participation.sum_d4;
        level.seconds.push_back(replicate.seconds);
        curve.measured.invalid_samples += replicate.invalid;
    }

    void end_if_done(Curve& curve, std::uint64_t samples)
    {
        if (curve.is_done) return;
        if (options_.spp) {
            curve.is_done = 2 * samples > *options_.spp;
            return;
        }
        const double to_come = options_.adds_twins && level_ < levels_before_twins ? 2 : 0;
        const double active =
            to_come + static_cast<double>(std::count_if(curves_.begin(), curves_.end(),
                                                        [](const Curve& c) { return !c.is_done; }));
        const bool fits = 2 * curve.level_seconds <= 0.9 * seconds_left() / active;
        const bool shows_gain = options_.is_sobol && samples < most_samples_of_gain;
        curve.is_done = !fits || 2 * samples > most_samples ||
                        (!shows_gain && tells_no_more(curve.measured, reference_.error));
    }

    void add_twins()
    {
        std::vector<std::pair<double, std::size_t>> by_time;
        for (std::size_t c = 0; c < curves_.size(); ++c)
            if (curves_[c].measured.levels.size() >= levels_before_twins)
                if (const double time = log_time_to_compare(curves_[c]); !std::isnan(time))
                    by_time.emplace_back(time, c);
        if (by_time.empty()) return;
        std::stable_sort(by_time.begin(), by_time.end());
        const std::size_t best = by_time.front().second, count = curves_.size();
        const double alike = curves_[best].all_seconds;
        double promised = alike;  // it is timed anew
        std::vector<Strategy> strategies;
        for (const auto& [_, c] : by_time) strategies.push_back(curves_[c].measured.strategy);
        for (const CostChoice& twin : twins_of(strategies))
            promised += add_late(twin, alike, promised);
        if (promised > alike) catch_up(best, count);
    }

    /// Logarithm of the time to 1 %; of a fixed number of samples, by draws, which no clock
    /// decides.
    double log_time_to_compare(const Curve& curve) const
    {
        const CostModel model = model_of(curve.measured, arithmetic_ground());
        if (std::isnan(model.log_variance.value)) return model.log_variance.value;
        if (!options_.spp) return log_seconds_to(model, 0.01).value;
        return model.log_variance.value +
               std::log(draws_of(curve.measured.strategy, ground_.scene.scene().lights.size()));
    }

    /// A curve that begins later than the others; alike: what these took of a strategy that is like
    /// it; promised: seconds that are spoken for. Returns what it may take to catch up; 0: it does
    /// not.
    double add_late(const CostChoice& choice, double alike, double promised)
    {
        for (const Curve& curve : curves_)
            if (curve.measured.strategy == choice.strategy &&
                curve.measured.precision == choice.precision)
                return 0;
        add_curve(choice);
        Curve& curve = curves_.back();
        constexpr double dearer = 2.5;  // at most, about
        if (!options_.spp && promised + dearer * alike > 0.8 * seconds_left()) {
            curve.is_done = true;
            curve.measured.reason = "past the budget: no time is left for another curve";
        }
        return !curve.is_done && is_ready(curve) ? dearer * alike : 0;
    }

    /// Gives the curves from `first` on the levels that the others have, in turns with one of
    /// those, which is timed anew: whatever the machine does, it does to all of them.
    void catch_up(std::size_t beside, std::size_t first)
    {
        for (std::size_t k = 0; k < level_; ++k) {
            const std::uint64_t samples = std::uint64_t{1} << k;
            std::vector<CostLevel> levels(curves_.size());
            std::vector<double> seconds(curves_.size());
            for (std::size_t r = 0; r < replicate_count; ++r) {
                const std::uint64_t stream = k * replicate_count + r;
                if (ground_.is_stopped()) return;
                if (is_late()) return end_all();
                curves_[beside].measured.levels[k].seconds[r] =
                    curves_[beside].sampler->run(samples, stream).seconds;
                for (std::size_t c = first; c < curves_.size(); ++c) {
                    if (curves_[c].is_done) continue;
                    const Clock::time_point start = Clock::now();
                    add_replicate(levels[c], curves_[c], samples, stream);
                    seconds[c] += seconds_since(start);
                }
            }
            for (std::size_t c = first; c < curves_.size(); ++c) {
                if (!curves_[c].is_done)
                    end_level(curves_[c], std::move(levels[c]), samples, seconds[c]);
            }
        }
    }

    CostGround arithmetic_ground() const
    {
        return {points_.figure_lit, ground_.executor.threads, reference_.error};
    }

    /// Number types are compared of one strategy, strategies in one number type.
    static bool are_compared(const CostMeasurements& a, const CostMeasurements& b)
    {
        return a.precision == b.precision || a.strategy == b.strategy;
    }

    CostSceneReport report() const
    {
        const Scene& scene = ground_.scene.scene();
        CostSceneReport report;
        report.file = scene.file;
        report.name = scene.name;
        report.lights = scene.lights.size();
        report.width = points_.shading.width;
        report.height = points_.shading.height;
        report.shading_points = points_.figure_points;
        report.replicates = replicate_count;
        report.copies = judged_.copies;
        report.is_sobol = options_.is_sobol;
        report.epsilon = reference_.scale.epsilon;
        report.reference = reference_.report;
        report.is_black = !reference_.means.empty() && !interrupted_.is_up() &&
                          std::all_of(reference_.means.begin(), reference_.means.end(),
                                      [](double mean) { return mean == 0; });
        report.partial = interrupted_.is_up();
        std::vector<CostModel> models;
        for (const Curve& curve : curves_) {
            report.curves.push_back(curve_report(curve.measured, arithmetic_ground()));
            CostCurveReport& last = report.curves.back();
            if (last.reason.empty() && last.points.empty())
                last.reason = points_.figure_lit == 0 ? "no point can be lit: every estimate is 0"
                                                      : "stopped before its turn";
            models.push_back(model_of(curve.measured, arithmetic_ground()));
            // Sequences have no error² = V/n to go by.
            if (!last.fits || options_.is_sobol) models.back().log_variance.value = std::nan("");
        }
        report.crossings = find_crossings(models);
        std::erase_if(report.crossings, [&](const CrossingReport& crossing) {
            return !are_compared(curves_[static_cast<std::size_t>(crossing.before)].measured,
                                 curves_[static_cast<std::size_t>(crossing.after)].measured);
        });
        report.seconds = seconds_since(start_);
        return report;
    }

    const CostOptions& options_;
    StopToken interrupted_{options_.stop};
    Clock::time_point start_ = Clock::now();
    StudyPoints points_;
    CostPoints judged_;
    WorkspacePool<float> workspaces_;
    StudyGround ground_;
    CostReference reference_;
    std::vector<Curve> curves_;
    std::uint64_t level_ = 0;
};

}  // namespace

CostSceneReport run_cost_study(const LitScene& scene, std::span<const CostChoice> choices,
                               const CostOptions& options, const AnyExecutor& executor)
{
    return CostStudy(scene, choices, options, executor).run();
}

}  // namespace mis
