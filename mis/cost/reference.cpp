#include "mis/cost/reference.h"

#include "mis/engine/stopwatch.h"
#include "mis/predict/predict.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace mis {
namespace {

double points_of(const StudyGround& ground)
{
    return static_cast<double>(std::max<std::size_t>(ground.points.figure_points, 1));
}

RelativeScale scale_of(const StudyGround& ground, const std::vector<double>& means)
{
    return relative_scale(means, ground.points.figures());
}

/// x over the scale; 0 where both are 0.
double relative(double x, double scale) { return x == 0 ? 0 : x / scale; }

/// The probe of every figure point.
std::vector<std::size_t> probes_of_points(const StudyPoints& points)
{
    std::vector<std::size_t> probes(points.figure_lit);
    for (std::size_t p = 0; p < points.probe_point.size(); ++p)
        if (points.probe_point[p] >= 0) probes[static_cast<std::size_t>(points.probe_point[p])] = p;
    return probes;
}

/// One of the strategies that are pooled.
struct Source {
    StrategyRun run;
    double relative_variance = 0;  ///< of its mean: mean over the points
    double weight = 0;

    double mean(std::size_t point) const { return run.results()[point].luminance.mean; }
    /// Of that mean.
    double variance(std::size_t point) const
    {
        const Moments& m = run.results()[point].luminance;
        return m.m2 > 0 ? m.variance() / static_cast<double>(m.count) : 0;
    }
};

/// Of more lights than that, samples of all of them are fewer.
constexpr std::size_t few_lights = 16;
/// Of more pairs of light and point, not even a few samples of all lights are worth while.
constexpr double most_pairs_to_draw = 3e7, most_pairs_to_weigh = 1e8;
constexpr int check_share = 8;  ///< the best gets so many times the samples of those that check it

std::vector<Strategy> sources_for(const StudyGround& ground)
{
    const std::size_t lights = ground.scene.scene().lights.size();
    const double pairs =
        static_cast<double>(lights) * static_cast<double>(ground.points.figure_lit);
    std::vector<Strategy> sources{parse_strategy("power/power")};
    if (pairs < most_pairs_to_weigh) sources.push_back(parse_strategy("radiant-solid-angle/power"));
    if (pairs < most_pairs_to_draw) sources.push_back(parse_strategy("all/power"));
    if (lights > few_lights) sources.push_back(parse_strategy("tree/power"));
    return sources;
}

/// Samples of a source where `count` are taken of one that draws one light.
int samples_of(const Strategy& strategy, std::size_t lights, int count)
{
    if (!draws_every_light(strategy.policy) || lights <= few_lights) return count;
    const double share = static_cast<double>(few_lights) / static_cast<double>(lights);
    return std::max(2, static_cast<int>(share * count));
}

std::vector<double> pooled_means(std::span<const Source> sources, std::size_t points)
{
    std::vector<double> means(points);
    for (std::size_t p = 0; p < points; ++p)
        for (const Source& source : sources) means[p] += source.weight * source.mean(p);
    return means;
}

/// The source with the least variance for its draws comes first.
void put_best_first(std::span<Source> sources, std::size_t lights)
{
    const auto cost = [&](const Source& source) {
        return source.relative_variance * draws_of(source.run.strategy(), lights);
    };
    const auto best =
        std::min_element(sources.begin(), sources.end(),
                         [&](const Source& a, const Source& b) { return cost(a) < cost(b); });
    std::iter_swap(sources.begin(), best);
}

/// Weights by precision, from the relative variances against equally weighed means.
void weigh(const StudyGround& ground, std::span<Source> sources)
{
    const std::size_t points = ground.points.figure_lit;
    for (Source& source : sources) source.weight = 1 / static_cast<double>(sources.size());
    const std::vector<double> squares = scale_of(ground, pooled_means(sources, points)).squares;
    double sum = 0;
    for (Source& source : sources) {
        source.relative_variance = 0;
        for (std::size_t p = 0; p < points; ++p)
            source.relative_variance += relative(source.variance(p), squares[p]);
        source.relative_variance /= points_of(ground);
        source.weight = 1 / (source.relative_variance + 1e-30);
        sum += source.weight;
    }
    for (Source& source : sources) source.weight /= sum;
}

/// How far the best source is from the others, pooled by their precision, over the scale; and what
/// their noise makes of that.
struct Difference {
    double squared = 0, noise = 0, noise2 = 0;  ///< sums over the points; of the noise's squares
};

Difference difference_of(const StudyGround& ground, std::span<const Source> sources,
                         const std::vector<double>& squares)
{
    Difference found;
    double weights = 0;
    for (const Source& source : sources.subspan(1)) weights += source.weight;
    for (std::size_t p = 0; p < ground.points.figure_lit; ++p) {
        double others = 0, variance = sources[0].variance(p);
        for (const Source& source : sources.subspan(1)) {
            const double share = source.weight / weights;
            others += share * source.mean(p), variance += share * share * source.variance(p);
        }
        const double noise = relative(variance, squares[p]);
        found.squared += relative(std::pow(sources[0].mean(p) - others, 2), squares[p]);
        found.noise += noise, found.noise2 += noise * noise;
    }
    return found;
}

/// The variance of the pooled means; where the best source differs from the others by more than
/// their noise, that counts in what errors are not trusted below.
ReferenceError error_of(const StudyGround& ground, std::span<const Source> sources,
                        const std::vector<double>& squares, bool& agrees)
{
    double sum = 0, sum2 = 0;
    for (std::size_t p = 0; p < ground.points.figure_lit; ++p) {
        double pooled = 0;
        for (const Source& source : sources)
            pooled += source.weight * source.weight * relative(source.variance(p), squares[p]);
        sum += pooled, sum2 += pooled * pooled;
    }
    const double n = points_of(ground);
    ReferenceError error{.squared = sum / n, .se = std::sqrt(2 * sum2) / n, .floor = sum / n};
    agrees = true;
    if (sources.size() < 2) return error;
    const Difference difference = difference_of(ground, sources, squares);
    const double excess = difference.squared - difference.noise;
    constexpr double surely = 6;  // standard errors; squares of differences have long tails
    agrees = excess < surely * std::sqrt(2 * difference.noise2) ||
             excess < n * std::pow(1e-5, 2);  // or it is rounding
    if (!agrees) error.floor += excess / n;
    return error;
}

CostReference finished(const StudyGround& ground, std::span<const Source> sources)
{
    CostReference reference;
    reference.means = pooled_means(sources, ground.points.figure_lit);
    reference.scale = scale_of(ground, reference.means);
    reference.error = error_of(ground, sources, reference.scale.squares, reference.report.agrees);
    reference.report.error = std::sqrt(reference.error.floor);
    for (const Source& source : sources) {
        reference.report.sources.push_back(name_of(source.run.strategy()));
    }
    if (!sources[0].run.results().empty())
        reference.report.samples = sources[0].run.results()[0].luminance.count;
    return reference;
}

}  // namespace

double draws_of(const Strategy& strategy, std::size_t lights)
{
    if (!strategy.chooses_light()) return 1;
    const double of_light = draws_every_light(strategy.policy) ? static_cast<double>(lights) : 1;
    return strategy.counts[0] * of_light + strategy.counts[1];
}

std::optional<CostReference> exact_reference(const StudyGround& ground)
{
    const Scene& scene = ground.scene.scene();
    if (scene.camera || scene.lights.size() > most_lights_for_quadrature) return std::nullopt;
    const std::vector<std::size_t> probes = probes_of_points(ground.points);
    const std::vector<Strategy> any{parse_strategy("uniform/light")};
    CostReference reference;
    reference.means.resize(probes.size());
    std::vector<double> errors(probes.size());
    std::vector<char> is_answered(probes.size());
    stoppable(ground.executor, ground.stop).for_each(probes.size(), [&](std::size_t p) {
        try {
            const Predicted found =
                predict(scene, scene.probes[probes[p]], any, {}, {.stop = ground.stop}).front();
            reference.means[p] = found.mean;
            errors[p] = found.mean_error;
            is_answered[p] = found.mean_error <= 1e-4 * found.mean;
        } catch (const PredictError&) {  // then there are samples
        }
    });
    if (std::find(is_answered.begin(), is_answered.end(), 0) != is_answered.end())
        return std::nullopt;
    reference.scale = scale_of(ground, reference.means);
    for (std::size_t p = 0; p < errors.size(); ++p)
        reference.error.floor +=
            relative(errors[p] * errors[p], reference.scale.squares[p]) / points_of(ground);
    reference.report.exact = true;
    reference.report.error = std::sqrt(reference.error.floor);
    return reference;
}

CostReference pooled_reference(const StudyGround& ground, const ReferenceLimit& limit)
{
    const Clock::time_point start = Clock::now();
    std::vector<Source> sources;
    std::uint64_t seed = ground.seed ^ 0x7265666572656e63;  // "referenc"
    for (const Strategy& strategy : sources_for(ground))
        sources.push_back(
            {StrategyRun(ground.scene, ground.points, strategy, seed++, ground.stop)});
    std::uint64_t taken = 0;
    for (int count = 16; ground.points.figure_lit > 0; count = std::min(2 * count, 4096)) {
        if (limit.samples > 0 && limit.samples - taken < static_cast<std::uint64_t>(count))
            count = static_cast<int>(limit.samples - taken);
        const Clock::time_point round = Clock::now();
        for (std::size_t s = 0; s < sources.size(); ++s) {
            const int own = s == 0 || taken == 0 ? count : std::max(1, count / check_share);
            const std::size_t lights = ground.scene.scene().lights.size();
            if (!sources[s].run.sample_apart({samples_of(sources[s].run.strategy(), lights, own)},
                                             ground.workspaces, ground.executor, ground.stop))
                throw Stopped();
        }
        weigh(ground, sources);
        if (taken == 0) put_best_first(sources, ground.scene.scene().lights.size());
        taken += static_cast<std::uint64_t>(count);
        if (taken == limit.samples) break;
        if (limit.samples > 0) continue;
        const double next = seconds_since(round) * std::min(2 * count, 4096) / count;
        if (seconds_since(start) + next > limit.seconds) break;
        double precision = 0;
        for (const Source& source : sources) precision += 1 / (source.relative_variance + 1e-30);
        if (precision * limit.error * limit.error > 1) break;
    }
    if (ground.points.figure_lit == 0) weigh(ground, sources);
    return finished(ground, sources);
}

}  // namespace mis
