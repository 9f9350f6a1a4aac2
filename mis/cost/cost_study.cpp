#include "mis/cost/cost_study.h"

#include "mis/cost/curve_run.h"
#include "mis/cost/scene_report.h"
#include "mis/cost/stopping.h"
#include "mis/engine/stopwatch.h"
#include "mis/scene/text.h"
#include "mis/study/affordable.h"
#include "mis/study/scene_facts.h"
#include "mis/study/schedule.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace mis {
namespace {

constexpr double reference_share = 0.3;         // of the time, at most
constexpr std::uint64_t reference_factor = 64;  // its samples over the last doubling's, with --spp
constexpr std::size_t levels_before_twins = 3;

/// One study under way.
class CostStudy {
public:
    CostStudy(const LitScene& scene, std::span<const CostChoice> choices,
              const CostOptions& options, const AnyExecutor& executor)
        : options_(options), goal_{options.spp, options.is_sobol},
          points_(find_study_points(scene, stoppable(executor, interrupted_))),
          judged_(cost_points(points_, scene.scene().camera.has_value())),
          ground_{scene, points_, workspaces_, executor, options.seed, until_late()},
          curve_ground_{ground_, judged_, reference_, options.is_sobol},
          curves_(choices.begin(), choices.end())
    {
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
        for (CurveRun& curve : curves_) curve.end(reason::FirstDoublingLate{});
    }

    bool make_ready(CurveRun& curve) const
    {
        return curve.make_ready(curve_ground_, seconds_left(), !options_.spp);
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
        for (const CurveRun& curve : curves_) strategies.push_back(curve.measured.strategy);
        constexpr int first_levels = 1 + 2 + 4;
        const std::vector<CostEstimate> costs =
            estimate_costs(ground_, strategies, replicate_count * first_levels,
                           0.6 * seconds_left() * ground_.executor.threads);
        for (std::size_t c = 0; c < curves_.size(); ++c)
            if (!costs[c].is_affordable) curves_[c].end(why_unaffordable(costs[c]));
    }

    static CostReason why_unaffordable(const CostEstimate& cost)
    {
        if (!cost.is_known) return reason::NoFirstLook{};
        return reason::DoublingsTooDear{cost.seconds};
    }

    bool is_finished() const
    {
        return ground_.is_stopped() ||
               std::ranges::all_of(curves_, [](const CurveRun& curve) { return curve.is_done; });
    }

    /// Every curve that is not done takes `samples` of every point, replicate by replicate.
    void run_level(std::uint64_t samples)
    {
        std::vector<LevelRun> levels(curves_.size());
        for (int r = 0; r < replicate_count; ++r) {
            const std::uint64_t stream = level_ * replicate_count + static_cast<std::uint64_t>(r);
            for (const std::size_t c :
                 round_order(curves_.size(), options_.seed, static_cast<std::uint32_t>(stream))) {
                if (ground_.is_stopped()) return;
                if (is_late()) return end_all();
                if (curves_[c].is_done || !make_ready(curves_[c])) continue;
                levels[c].add_replicate(curves_[c], samples, stream, options_.is_sobol);
                show(1 - seconds_left() / options_.seconds, many(samples, "sample") + " per point");
            }
        }
        end_level(levels, 0, samples);
        ++level_;
        for (CurveRun& curve : curves_) end_if_done(curve, samples);
    }

    /// Of all curves from `first` on that are not done.
    void end_level(std::vector<LevelRun>& levels, std::size_t first, std::uint64_t samples)
    {
        for (std::size_t c = first; c < curves_.size(); ++c)
            if (!curves_[c].is_done) std::move(levels[c]).end(curves_[c], samples);
    }

    void end_if_done(CurveRun& curve, std::uint64_t samples)
    {
        if (curve.is_done) return;
        const double to_come = options_.adds_twins && level_ < levels_before_twins ? 2 : 0;
        const double active =
            to_come + static_cast<double>(std::ranges::count(curves_, false, &CurveRun::is_done));
        curve.is_done = is_curve_done(curve.measured, samples, curve.level_seconds,
                                      seconds_left() / active, goal_, reference_.error);
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
    double log_time_to_compare(const CurveRun& curve) const
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
        for (const CurveRun& curve : curves_)
            if (curve.choice() == choice) return 0;
        CurveRun& curve = curves_.emplace_back(choice);
        constexpr double dearer = 2.5;  // at most, about
        if (!options_.spp && promised + dearer * alike > 0.8 * seconds_left())
            curve.end(reason::NoTimeLeft{});
        return !curve.is_done && make_ready(curve) ? dearer * alike : 0;
    }

    /// Gives the curves from `first` on the levels that the others have, in turns with one of
    /// those, which is timed anew: whatever the machine does, it does to all of them.
    void catch_up(std::size_t beside, std::size_t first)
    {
        for (std::size_t k = 0; k < level_; ++k) {
            const std::uint64_t samples = std::uint64_t{1} << k;
            std::vector<LevelRun> levels(curves_.size());
            for (std::size_t r = 0; r < replicate_count; ++r) {
                const std::uint64_t stream = k * replicate_count + r;
                if (ground_.is_stopped()) return;
                if (is_late()) return end_all();
                curves_[beside].measured.levels[k].seconds[r] =
                    curves_[beside].sampler->run(samples, stream).seconds;
                for (std::size_t c = first; c < curves_.size(); ++c)
                    if (!curves_[c].is_done)
                        levels[c].add_replicate(curves_[c], samples, stream, options_.is_sobol);
            }
            end_level(levels, first, samples);
        }
    }

    CostGround arithmetic_ground() const
    {
        return {points_.figure_lit, ground_.executor.threads, reference_.error};
    }

    /// Is every point of the reference 0, as far as it was seen?
    bool is_black() const
    {
        return !reference_.means.empty() && !interrupted_.is_up() &&
               std::ranges::all_of(reference_.means, [](double mean) { return mean == 0; });
    }

    CostSceneReport report() const
    {
        CostSceneReport report = report_of(curves_, arithmetic_ground(), options_.is_sobol);
        static_cast<SceneFacts&>(report) = facts_of(ground_.scene.scene(), points_);
        report.replicates = replicate_count;
        report.copies = judged_.copies;
        report.is_sobol = options_.is_sobol;
        report.epsilon = reference_.scale.epsilon;
        report.reference = reference_.report;
        report.is_black = is_black();
        report.partial = interrupted_.is_up();
        report.seconds = seconds_since(start_);
        return report;
    }

    const CostOptions& options_;
    const CostGoal goal_;
    StopToken interrupted_{options_.stop};
    Clock::time_point start_ = Clock::now();
    StudyPoints points_;
    CostPoints judged_;
    WorkspacePool<float> workspaces_;
    StudyGround ground_;
    CostReference reference_;
    CurveGround curve_ground_;
    std::vector<CurveRun> curves_;
    std::uint64_t level_ = 0;
};

}  // namespace

CostSceneReport run_cost_study(const LitScene& scene, std::span<const CostChoice> choices,
                               const CostOptions& options, const AnyExecutor& executor)
{
    return CostStudy(scene, choices, options, executor).run();
}

}  // namespace mis
