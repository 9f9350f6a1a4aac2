#include "mis/stats/winners.h"

#include "mis/report/maps.h"
#include "mis/stats/estimate.h"
#include "mis/stats/pool.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

namespace mis {
namespace {

/// log(variance · cost) at a place, and how many samples carry it (0: it is not known).
struct LogCost {
    double value = 0, carried_by = 0, mean = 0, mean_se2 = 0;
};

/// Of strategies that are far behind so much is known from a few large samples.
constexpr double fewest_of_others = 4;

/// Means of the same quantity that are further apart, in standard errors, are not both right.
constexpr double most_apart = 4;

/// A variance below the rounding of single precision says no more than that.
LogCost log_cost(const PlaceSamples& place, double cost)
{
    const double rounding = double(std::numeric_limits<float>::epsilon()) / 2,
                 least = rounding * rounding * place.squared_means;
    if (!std::isfinite(place.variance) || place.variance + least <= 0) return {};
    if (place.variance <= least)
        return {std::log(least * cost), static_cast<double>(place.samples), place.mean, least};
    return {std::log(place.variance * cost), place.participation.number(), place.mean,
            place.mean_se2};
}

bool agree(const LogCost& a, const LogCost& b)
{
    return std::abs(a.mean - b.mean) <= most_apart * std::sqrt(a.mean_se2 + b.mean_se2);
}

/// The largest p-value that stands for a find (Benjamini and Hochberg 1995); below 0 where none
/// does.
double largest_found(std::span<const Candidate> candidates)
{
    std::vector<double> sorted;
    for (const Candidate& c : candidates)
        if (c.p < 1) sorted.push_back(c.p);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = sorted.size(); k > 0; --k)
        if (sorted[k - 1] <=
            false_winners * static_cast<double>(k) / static_cast<double>(candidates.size()))
            return sorted[k - 1];
    return -1;
}

}  // namespace

void PlaceSamples::add(const Moments& point)
{
    samples += point.count;
    mean += point.mean;
    squared_means += point.mean * point.mean;
    if (point.count < 2) return;
    const Participation own = participation_of(std::span(&point, 1));
    variance += own.sum_d2;
    mean_se2 += own.sum_d2 / static_cast<double>(point.count);
    participation.sum_d2 += own.sum_d2;
    participation.sum_d4 += own.sum_d4;
}

void PlaceSamples::add(const Moments& point, const ValueAndError& known)
{
    samples += point.count;
    mean += point.mean;
    squared_means += point.mean * point.mean;
    variance += known.value;
    mean_se2 +=
        std::max(known.value, 0.0) / static_cast<double>(std::max<std::uint64_t>(point.count, 1));
    // So many samples carry it as would leave it the same relative error.
    participation.sum_d2 = variance;
    participation.sum_d4 += known.se * known.se;
}

bool Contest::is_contest() const
{
    return !costs.empty() &&
           std::adjacent_find(groups.begin(), groups.end(), std::not_equal_to<>()) != groups.end();
}

Candidate candidate(std::span<const PlaceSamples> samples, const Contest& contest)
{
    if (!contest.is_contest()) return {};
    std::vector<LogCost> logs;
    std::size_t best = 0;
    for (std::size_t s = 0; s < samples.size(); ++s) {
        logs.push_back(log_cost(samples[s], contest.costs[s]));
        if (logs[s].carried_by < fewest_of_others) return {};
        if (logs[s].value < logs[best].value) best = s;
    }
    if (logs[best].carried_by < few_samples) return {};
    double p = 0;
    for (std::size_t s = 0; s < logs.size(); ++s) {
        if (!agree(logs[best], logs[s])) return {};
        if (contest.groups[s] == contest.groups[best]) continue;
        const double t = (logs[s].value - logs[best].value) /
                         std::sqrt(1 / logs[s].carried_by + 1 / logs[best].carried_by);
        p = std::max(p, upper_tail(t, std::min(logs[s].carried_by, logs[best].carried_by) - 1));
    }
    return {static_cast<int>(best), std::min(1.0, static_cast<double>(logs.size()) * p)};
}

std::vector<int> winners_of(std::span<const Candidate> places)
{
    const double found = largest_found(places);
    std::vector<int> winners;
    for (const Candidate& place : places) winners.push_back(place.p <= found ? place.strategy : -1);
    return winners;
}

int winner_square(double samples_per_pixel)
{
    int side = 1;
    while (side < 16 && side * side * samples_per_pixel < 2000) side *= 2;
    return side;
}

}  // namespace mis
