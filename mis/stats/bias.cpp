#include "mis/stats/bias.h"

#include "mis/stats/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {
namespace {

/// One mean (of the image or of a region), by one strategy.
struct Series {
    std::vector<double> values;   ///< one per replicate
    double spread2 = 0;           ///< variance over the replicates
    double largest_skewness = 0;  ///< of the mean of all replicates
    bool usable = false;
};

struct Test {
    double p = 1, t = 0, difference = 0, reference = 0;
    int region = -1;  ///< −1: the whole image

    /// Where both p are too small to be told from 0, t decides.
    bool is_worse_than(const Test& other) const
    {
        return p < other.p || (p == other.p && t > other.t);
    }
};

Series series_of(const StrategyMeasurements& s, int region, std::size_t replicates)
{
    Series series;
    for (std::size_t r = 0; r < replicates; ++r)
        series.values.push_back(region < 0 ? s.replicates[r].mean : s.region_means[r][region]);
    const Participation& carried =
        region < 0 ? s.pooled.participation : s.region_participation[region];
    const bool exact = s.all_samples_equal_reference;
    series.spread2 = Moments::of(std::span<const double>(series.values)).variance();
    series.largest_skewness = exact ? 0 : 1 / std::sqrt(std::max(carried.number(), 1.0));
    series.usable = exact || carried.number() >= (region < 0 ? 1 : least_region_participation);
    return series;
}

/// [level][strategy]; level 0 is the image, level k the region k − 1.
std::vector<std::vector<Series>> all_series(std::span<const StrategyMeasurements* const> strategies,
                                            std::size_t replicates)
{
    std::size_t regions = std::numeric_limits<std::size_t>::max();
    for (const StrategyMeasurements* s : strategies)
        regions = std::min(
            regions, s->region_means.size() < replicates ? 0 : s->region_participation.size());
    std::vector<std::vector<Series>> levels(1 + regions);
    for (std::size_t level = 0; level < levels.size(); ++level)
        for (const StrategyMeasurements* s : strategies)
            levels[level].push_back(series_of(*s, static_cast<int>(level) - 1, replicates));
    return levels;
}

/// Hall's (1992) transformation of a t statistic to one of a normal mean, at the skewness (of the
/// mean, either sign) that brings it closest to 0. It never falls as t grows.
double unskewed(double t, double skewness)
{
    if (skewness <= 0) return t;
    return std::max(0.0, (1 - std::pow(1 - skewness * t / 3, 3)) / skewness - skewness / 6);
}

class BiasSearch {
public:
    BiasSearch(std::span<const StrategyMeasurements* const> strategies, std::size_t replicates)
        : strategies_(strategies), replicates_(replicates),
          levels_(all_series(strategies, replicates)), trusted_(strategies.size(), true)
    {
    }

    /// The strategy's levels against the trusted others, corrected for the number of tests.
    std::vector<Test> tests_of(std::size_t s) const
    {
        std::vector<Test> tests;
        const double count = static_cast<double>(levels_.size() * strategies_.size());
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            tests.push_back(tested(s, level));
            tests.back().p = std::min(1.0, tests.back().p * count);
        }
        return tests;
    }

    bool trusts(std::size_t s) const { return trusted_[s]; }
    void distrust(std::size_t s) { trusted_[s] = false; }
    std::size_t trusted_count() const
    {
        return static_cast<std::size_t>(std::count(trusted_.begin(), trusted_.end(), true));
    }

private:
    std::vector<std::size_t> reference_members(std::size_t s, std::size_t level) const
    {
        std::vector<std::size_t> members;
        for (std::size_t k = 0; k < strategies_.size(); ++k)
            if (k != s && trusted_[k] && levels_[level][k].usable) members.push_back(k);
        return members;
    }

    /// In proportion to 1/(u + the second least u), u the variance of the mean: near the optimum,
    /// but no strategy alone outvotes the rest however small it claims its variance to be.
    std::vector<double> weights(const std::vector<std::size_t>& members) const
    {
        std::vector<double> u;
        for (const std::size_t k : members) {
            const PooledFigures& pooled = strategies_[k]->pooled;
            u.push_back(strategies_[k]->all_samples_equal_reference
                            ? 0
                            : pooled.variance /
                                  static_cast<double>(std::max<std::uint64_t>(pooled.samples, 1)));
        }
        std::vector<double> sorted = u;
        std::sort(sorted.begin(), sorted.end());
        const double second = sorted.size() > 1 ? sorted[1] : sorted[0];
        double sum = 0;
        for (double& w : u) sum += w = second > 0 ? second / (w + second) : w == 0 ? 1 : 0;
        for (double& w : u) w /= sum;
        return u;
    }

    Test tested(std::size_t s, std::size_t level) const
    {
        const Series& own = levels_[level][s];
        const std::vector<std::size_t> members = reference_members(s, level);
        if (!own.usable || members.empty() || replicates_ < 2) return {};
        const std::vector<double> weight = weights(members);
        std::vector<double> difference = own.values;
        double reference = 0, spread2 = own.spread2,
               third = std::pow(own.spread2, 1.5) * own.largest_skewness;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const Series& other = levels_[level][members[i]];
            for (std::size_t r = 0; r < replicates_; ++r) {
                difference[r] -= weight[i] * other.values[r];
                reference += weight[i] * other.values[r] / static_cast<double>(replicates_);
            }
            const double scaled = weight[i] * weight[i] * other.spread2;
            spread2 += scaled;
            third += std::pow(scaled, 1.5) * other.largest_skewness;
        }
        const MeanAndError d = mean_and_error(difference);
        const double se = std::hypot(d.se, rounding_of_means * std::fabs(reference));
        const double skewness = spread2 > 0 ? third / std::pow(spread2, 1.5) : 0;
        const double t = d.mean == 0 ? 0 : unskewed(std::fabs(d.mean) / se, skewness);
        const double p = std::min(1.0, 2 * upper_tail(t, static_cast<double>(replicates_ - 1)));
        return {p, t, d.mean, reference, static_cast<int>(level) - 1};
    }

    std::span<const StrategyMeasurements* const> strategies_;
    std::size_t replicates_;
    std::vector<std::vector<Series>> levels_;
    std::vector<char> trusted_;
};

const Test& worst_of(const std::vector<Test>& tests)
{
    return *std::min_element(tests.begin(), tests.end(),
                             [](const Test& a, const Test& b) { return a.is_worse_than(b); });
}

BiasFinding finding_of(const std::vector<Test>& tests, double error)
{
    const Test& worst = worst_of(tests);
    BiasFinding finding{true,
                        true,
                        true,
                        worst.p,
                        {.region = worst.region,
                         .regions = tests.size() - 1,
                         .difference = worst.difference,
                         .reference = worst.reference,
                         .p_value = worst.p}};
    for (const Test& test : tests) {
        if (test.p >= error) continue;
        if (test.difference > 0) finding.too_low = false;
        finding.relative_excess =
            std::max(finding.relative_excess, test.difference / std::fabs(test.reference));
        if (test.region < 0) finding.only_in_regions = false;
    }
    return finding;
}

}  // namespace

bool may_lack_rare_samples(const BiasFinding& finding, const StrategyMeasurements& strategy)
{
    if (!finding.biased || strategy.all_samples_equal_reference) return false;
    if (!finding.too_low)
        return !finding.only_in_regions &&
               finding.relative_excess <=
                   most_never_drawn / static_cast<double>(strategy.pooled.samples);
    const double carried_by = strategy.pooled.participation.number();
    return finding.only_in_regions ||
           (!strategy.audit.available && carried_by < least_participation_without_audit);
}

std::vector<BiasFinding> find_bias(std::span<const StrategyMeasurements* const> strategies,
                                   double error)
{
    std::vector<BiasFinding> findings(strategies.size());
    if (strategies.size() < 2) return findings;
    std::size_t replicates = strategies[0]->replicates.size();
    for (const StrategyMeasurements* s : strategies)
        replicates = std::min(replicates, s->replicates.size());
    BiasSearch search(strategies, replicates);
    while (search.trusted_count() > 1) {
        std::vector<std::size_t> trusted;
        std::vector<std::vector<Test>> tests(strategies.size());
        for (std::size_t s = 0; s < strategies.size(); ++s) {
            if (!search.trusts(s)) continue;
            trusted.push_back(s);
            tests[s] = search.tests_of(s);
            findings[s].p_value = worst_of(tests[s]).p;
        }
        const std::size_t worst =
            *std::min_element(trusted.begin(), trusted.end(), [&](std::size_t a, std::size_t b) {
                return worst_of(tests[a]).is_worse_than(worst_of(tests[b]));
            });
        if (findings[worst].p_value >= error) break;
        const bool last_two = trusted.size() == 2;
        const auto lacks = [&](std::size_t s) {
            return may_lack_rare_samples(finding_of(tests[s], error), *strategies[s]);
        };
        for (const std::size_t s : trusted) {
            if (s != worst && !last_two) continue;
            const std::size_t other = s == trusted.front() ? trusted.back() : trusted.front();
            if (last_two && lacks(other) && !lacks(s)) {
                search.distrust(s);
                continue;
            }
            findings[s] = finding_of(tests[s], error);
            findings[s].why.are_only_two = last_two;
            search.distrust(s);
        }
    }
    return findings;
}

}  // namespace mis
