#include "mis/study/at_counts.h"

#include "mis/math/stop_token.h"
#include "mis/stats/at_counts.h"
#include "mis/stats/estimate.h"
#include "mis/study/count_dependence.h"
#include "mis/study/study_time.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mis {
namespace {

NumberSource numbers_of(const StudyOptions& options)
{
    return {options.seed, options.samples_per_scrambling};
}

/// Of the studies of one run.
struct Turn {
    std::size_t number = 0, of = 1;
};

/// The same study with so many samples per observation, in so many seconds at most.
StudyOptions options_for(const StudyOptions& asked, double n, double seconds, const Turn& turn)
{
    StudyOptions options = asked;
    options.at = n;
    if (numbers_of(asked).is_sobol())
        options.samples_per_scrambling = static_cast<std::uint64_t>(n);
    if (asked.seconds) options.seconds = seconds;
    else if (!asked.error) options.default_seconds = seconds;
    if (asked.progress)
        options.progress = [&asked, turn](double done, const SceneReport& so_far) {
            asked.progress((static_cast<double>(turn.number) + std::min(done, 1.0)) /
                               static_cast<double>(turn.of),
                           so_far);
        };
    return options;
}

/// As it is run where a point gets n samples. Draws of `strata` come together: where it was ranked
/// with as many as `at`, with n of them; else with its own number, n or a part of it. Nothing where
/// it cannot be run so.
std::optional<Strategy> at_count_of(const Strategy& s, const StudyOptions& options, double n)
{
    if (s.model != Model::strata) return s;
    const double own = samples_together(s);
    if (own != std::round(options.at))
        return std::fmod(n, own) == 0 ? std::optional(s) : std::nullopt;
    if (n == options.at) return s;
    if (!(n >= 1 && n <= most_strata_draws) || n != std::floor(n)) return std::nullopt;
    const auto draws = static_cast<std::uint64_t>(n);
    if (options.spp && (*options.spp < 4 * draws || *options.spp % draws != 0)) return std::nullopt;
    return strata(static_cast<int>(n));
}

/// Why there is no such strategy.
const Reason cannot_be_run = reason::AsWritten{
    "its draws come together, as many as a point gets: a whole number up to 65536, of which --spp "
    "is a multiple, at least 4 times as many"};

/// Is another run needed for n?
bool needs_run(const StrategyReport& s, const Strategy& at_n, const NumberSource& numbers)
{
    return s.status == Status::ranked && !s.exact && (numbers.is_sobol() || !(at_n == s.strategy));
}

/// Those that are ranked and have to be run again for n samples, as they are then.
std::vector<Strategy> to_run_again(const SceneReport& scene, const StudyOptions& options, double n)
{
    const NumberSource numbers = numbers_of(options);
    std::vector<Strategy> strategies;
    for (const StrategyReport& s : scene.strategies)
        if (const auto at_n = at_count_of(s.strategy, options, n);
            at_n && needs_run(s, *at_n, numbers) && std::ranges::count(strategies, *at_n) == 0)
            strategies.push_back(*at_n);
    return strategies;
}

/// What a strategy came to that was not run at all.
StrategyReport not_run(const Strategy& strategy, const Reason& why)
{
    StrategyReport report;
    report.strategy = strategy;
    report.reason = why;
    const Interval unknown = unknown_interval();
    report.variance = report.relative_variance = report.seconds_per_point =
        report.seconds_per_sample = report.efficiency = unknown;
    return report;
}

/// Their reports at n, in their order.
std::vector<StrategyReport> run_again(const LitScene& scene,
                                      const std::vector<Strategy>& strategies,
                                      const StudyOptions& options, const AnyExecutor& executor)
{
    const auto is_interrupted = [&] { return options.stop && *options.stop; };
    try {
        if (!is_interrupted())
            return run_study(scene, strategies, options, executor).report.strategies;
    } catch (const Stopped&) {  // its time was over before the first point
    }
    const Reason why = is_interrupted() ? Reason(reason::Stopped{}) : Reason(reason::NotReady{});
    std::vector<StrategyReport> reports;
    for (const Strategy& strategy : strategies) reports.push_back(not_run(strategy, why));
    return reports;
}

/// again: what was run for n.
CountFigures figures_at(const StrategyReport& s, const StudyOptions& options, double n,
                        std::span<const StrategyReport> again)
{
    const auto at_n = at_count_of(s.strategy, options, n);
    if (!at_n) return at_count(not_run(s.strategy, cannot_be_run), n, n);
    const auto found = std::ranges::find(again, *at_n, &StrategyReport::strategy);
    return found == again.end() ? at_count(s, options.at, n) : at_count(*found, n, n);
}

void add_count(SceneReport& scene, const StudyOptions& options, double n,
               std::span<const StrategyReport> again)
{
    for (StrategyReport& s : scene.strategies)
        if (s.status == Status::ranked) s.at_counts.push_back(figures_at(s, options, n, again));
}

}  // namespace

Study run_study_at(const LitScene& scene, const std::vector<Strategy>& strategies,
                   const StudyOptions& options, std::span<const double> further,
                   const AnyExecutor& executor)
{
    const StudyTime time(options.goal(), options.stop);
    const NumberSource numbers = numbers_of(options);
    const bool runs_again = std::ranges::any_of(
        strategies, [&](const Strategy& s) { return depends_on_count(s, numbers); });
    const std::size_t runs = runs_again ? 1 + further.size() : 1;
    const auto share = [&](std::size_t number) {
        return std::max(time.left(), 1e-3) / static_cast<double>(runs - number);
    };
    const StudyOptions first = options_for(options, options.at, share(0), {0, runs});
    Study study = run_study(scene, strategies, first, executor);
    add_count(study.report, options, options.at, {});
    for (std::size_t k = 0; k < further.size(); ++k) {
        const std::vector<Strategy> again = to_run_again(study.report, options, further[k]);
        std::vector<StrategyReport> found;
        if (!again.empty())
            found =
                run_again(scene, again,
                          options_for(options, further[k], share(k + 1), {k + 1, runs}), executor);
        add_count(study.report, options, further[k], found);
    }
    if (study.report.seconds > 0 && runs > 1) study.report.seconds = time.elapsed();
    study.report.partial = study.report.partial || (options.stop && *options.stop);
    return study;
}

}  // namespace mis
