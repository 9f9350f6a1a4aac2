#include "mis/study/shared_turns.h"

#include "mis/engine/stopwatch.h"
#include "mis/math/stable.h"
#include "mis/stats/pool.h"
#include "mis/stats/relative_sum.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {

namespace {

/// So many turns are kept apart at most; an even number.
constexpr std::size_t most_turns = 128;

/// Points that a first look at the costs takes.
constexpr std::size_t points_of_look = 32;

SharedPoint shared_point(const StudyPoints& points, std::size_t p)
{
    return {points.shading.points[p], points.material_of(p)};
}

std::vector<SharedPoint> figure_points(const StudyPoints& points)
{
    std::vector<SharedPoint> all;
    for (std::size_t t = 0; t < points.figure_tiles; ++t) {
        const Tile& tile = points.shading.tiles[t];
        for (std::size_t p = 0; p < tile.count; ++p)
            all.push_back({points.shading.points[tile.first + p], tile.material});
    }
    return all;
}

/// Those that no figure is over.
std::vector<SharedPoint> other_points(const StudyPoints& points)
{
    std::vector<SharedPoint> all;
    for (std::size_t p = points.figure_lit; p < points.shading.points.size(); ++p)
        all.push_back(shared_point(points, p));
    return all;
}

std::vector<double> mean_of(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> mean(a.size());
    std::transform(a.begin(), a.end(), b.begin(), mean.begin(),
                   [](double x, double y) { return 0.5 * (x + y); });
    return mean;
}

}  // namespace

SharedTurns::SharedTurns(const StudyGround& ground, std::span<const double> weights,
                         std::span<const Strategy> strategies, const SharedCounts& counts,
                         int rounds_of_turn)
    : points_(&ground.points), weights_(weights.begin(), weights.end()),
      strategies_(strategies.size()), counts_(counts), rounds_of_turn_(rounds_of_turn),
      of_figures_(ground.scene, figure_points(ground.points), strategies,
                  {ground.seed, counts, ground.stop}),
      of_probes_(ground.scene, other_points(ground.points), strategies,
                 {ground.seed, counts, ground.stop})
{
}

double SharedTurns::round_seconds(const StudyGround& ground, std::span<const Strategy> strategies,
                                  const SharedCounts& counts)
{
    std::vector<SharedPoint> some;
    for (const std::size_t p : spread_points(ground.points, points_of_look))
        some.push_back(shared_point(ground.points, p));
    const auto looked_at = static_cast<double>(some.size());
    SharedSamples look(ground.scene, std::move(some), strategies,
                       {ground.seed, counts, ground.stop});
    const AnyExecutor alone{1, [](std::size_t n, const auto& body) {
                                for (std::size_t i = 0; i < n; ++i) body(i);
                            }};
    look.take(1, alone);  // the first touch of tables and memory is no cost of a round
    ground.stop.check();
    const double before = thread_seconds();
    look.take(1, alone);
    ground.stop.check();
    return (thread_seconds() - before) * static_cast<double>(ground.points.figure_lit) / looked_at;
}

void SharedTurns::weigh_again()
{
    const double epsilon2 = std::pow(epsilon(), 2);
    for (std::size_t p = 0; p < points_->figure_lit; ++p) {
        const double mean = of_figures_.luminance(p).value;
        weights_[p] = inverse(mean * mean + epsilon2);
    }
    weighed_from_ = turns_.size();
}

bool SharedTurns::take(const StudyGround& ground)
{
    const Clock::time_point before = Clock::now();
    const int rounds = rounds_of_turn_ + (is_begun() ? 0 : 1);  // the first one only centres
    of_figures_.take(rounds, ground.executor);
    of_probes_.take(rounds, ground.executor);
    if (!of_figures_.is_even() || !of_probes_.is_even()) return false;
    turns_.push_back(last_turn());
    if (turns_.size() == most_turns) merge_pairs();
    last_seconds_ = seconds_since(before);
    return true;
}

SharedTurns::Turn SharedTurns::last_turn() const
{
    const std::vector<double> of_regions(points_->regions);
    const Table of_strategies(strategies_, of_regions);
    Turn turn{of_strategies, of_strategies, of_regions};
    const double share = 1 / (static_cast<double>(points_->figure_points) * rounds_of_turn_);
    for (std::size_t t = 0; t < points_->figure_tiles; ++t) {
        const Tile& tile = points_->shading.tiles[t];
        const std::size_t region = points_->region_of(t);
        for (std::size_t p = tile.first; p < tile.first + tile.count; ++p) {
            turn.luminance[region] += share * of_figures_.last_luminance(p);
            for (std::size_t s = 0; s < strategies_; ++s) {
                const double variance = share * of_figures_.last_variance(s, p);
                turn.variance[s][region] += variance;
                turn.relative[s][region] += variance * weights_[p];
            }
        }
    }
    return turn;
}

void SharedTurns::merge_pairs()
{
    std::vector<Turn> merged;
    for (std::size_t i = 0; i < turns_.size(); i += 2) {
        const Turn &a = turns_[i], &b = turns_[i + 1];
        Turn both{{}, {}, mean_of(a.luminance, b.luminance)};
        for (std::size_t s = 0; s < strategies_; ++s) {
            both.variance.push_back(mean_of(a.variance[s], b.variance[s]));
            both.relative.push_back(mean_of(a.relative[s], b.relative[s]));
        }
        merged.push_back(std::move(both));
    }
    turns_ = std::move(merged);
    rounds_of_turn_ *= 2;
    weighed_from_ = (weighed_from_ + 1) / 2;
}

std::uint64_t SharedTurns::directions() const
{
    return static_cast<std::uint64_t>(of_figures_.all_rounds()) * of_round();
}

std::uint64_t SharedTurns::directions_after_next() const
{
    return directions() +
           static_cast<std::uint64_t>(rounds_of_turn_ + (is_begun() ? 0 : 1)) * of_round();
}

RegionSums SharedTurns::relative_of(std::size_t strategy) const
{
    RegionSums values;
    for (std::size_t t = weighed_from_; t < turns_.size(); ++t)
        values.push_back(turns_[t].relative[strategy]);
    return values;
}

RegionSums SharedTurns::variances_of(std::size_t strategy) const
{
    RegionSums sums;
    for (const Turn& turn : turns_) sums.push_back(turn.variance[strategy]);
    return sums;
}

double SharedTurns::relative_error(std::size_t strategy, double times) const
{
    return log_contrast(variances_of(strategy), {}).se / std::sqrt(times);
}

double SharedTurns::epsilon() const
{
    if (!points_->has_camera || points_->figure_points == 0) return 0;
    double sum = 0;
    for (std::size_t p = 0; p < points_->figure_lit; ++p) sum += of_figures_.luminance(p).value;
    return share_of_epsilon * sum / static_cast<double>(points_->figure_points);
}

void SharedTurns::add_relative(SharedFigures& figures, std::size_t strategy) const
{
    RelativeSum sum(epsilon());
    for (std::size_t p = 0; p < points_->figure_lit; ++p)
        sum.add(at(strategy, p), of_figures_.luminance(p), of_figures_.covariance(strategy, p));
    const auto all = static_cast<double>(points_->figure_points);
    figures.relative_variance = sum.value() / all;
    figures.relative_variance_se = sum.se() / all;
    // What the second order moved is a measure of what the third leaves: seen at most 1.6 times as
    // much (`eclipse`, 160 directions).
    figures.relative_variance_doubt = 2 * sum.correction() / all;
}

SharedFigures SharedTurns::figures(std::size_t strategy) const
{
    SharedFigures figures;
    for (std::size_t p = 0; p < points_->figure_lit; ++p) figures.variance += at(strategy, p).value;
    const auto all = static_cast<double>(points_->figure_points);
    figures.variance /= all;
    add_relative(figures, strategy);
    figures.relative_region_variances = relative_of(strategy);
    figures.region_variances = variances_of(strategy);
    figures.missed = of_figures_.missed(strategy) * static_cast<double>(points_->figure_lit) / all;
    for (const std::int64_t p : points_->probe_point) {
        const auto place = static_cast<std::size_t>(p);
        figures.probes.push_back(p < 0 ? ValueAndError{}
                                 : place < points_->figure_lit
                                     ? at(strategy, place)
                                     : of_probes_.at(strategy, place - points_->figure_lit));
    }
    return figures;
}

std::vector<MeanCheck> SharedTurns::right_means() const
{
    std::vector<double> points_of(points_->regions);
    for (std::size_t t = 0; t < points_->figure_tiles; ++t)
        points_of[points_->region_of(t)] += points_->shading.tiles[t].count;
    const auto check_of = [&](const std::vector<double>& means) {
        const MeanAndError mean = mean_and_error(means);
        return MeanCheck{.shared = mean.mean,
                         .shared_se = mean.se,
                         .shared_dof = static_cast<double>(means.size()) - 1};
    };
    std::vector<double> image;
    for (const Turn& turn : turns_)
        image.push_back(std::accumulate(turn.luminance.begin(), turn.luminance.end(), 0.0));
    std::vector<MeanCheck> checks{check_of(image)};
    for (std::size_t region = 0; region < points_->regions; ++region) {
        std::vector<double> means;
        for (const Turn& turn : turns_)
            means.push_back(turn.luminance[region] * static_cast<double>(points_->figure_points) /
                            points_of[region]);
        checks.push_back(check_of(means));
    }
    return checks;
}

}  // namespace mis
