#include "mis/stats/pairs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace mis {
namespace {

/// p-value of "the ratio is outside 1 ± margin": the larger of the two one-sided tests'.
double p_of_not_tied(const LogEstimate& ratio, double margin)
{
    const double room = std::log1p(margin) - std::fabs(ratio.value);  // symmetric in the logarithm
    if (std::isnan(room) || std::isnan(ratio.se)) return 1;
    if (ratio.se == 0) return room >= 0 ? 0 : 1;
    return upper_tail(room / ratio.se, ratio.dof);
}

std::vector<double> p_values(std::span<const Comparison> family,
                             const std::function<double(const LogEstimate&)>& p)
{
    std::vector<double> values;
    for (const Comparison& comparison : family) values.push_back(p(comparison.log_ratio));
    return values;
}

/// The fewest replicates of which `gap`, in standard errors of one, is past the quantile of `tail`;
/// each but the first brings `dof` degrees of freedom.
double replicates_for(double gap, double tail, double dof)
{
    const auto enough = [&](double n) {
        return gap * std::sqrt(n) >= t_quantile(tail, dof * (n - 1));
    };
    double high = 2;
    while (!enough(high) && high < 1e15) high *= 2;
    double low = high / 2;
    while (high - low > 1 && high > 2) {
        const double middle = std::floor(0.5 * (low + high));
        (enough(middle) ? high : low) = middle;
    }
    return high;
}

}  // namespace

std::vector<bool> holm(std::span<const double> p, double error)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return p[i] < p[j]; });
    std::vector<bool> rejected(p.size(), false);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (p[order[k]] * static_cast<double>(order.size() - k) > error) break;
        rejected[order[k]] = true;
    }
    return rejected;
}

void decide(std::span<Comparison> family, double margin, double error)
{
    const auto apart =
        holm(p_values(family, [](const LogEstimate& r) { return two_sided_p(r); }), error);
    const auto tied = holm(
        p_values(family, [&](const LogEstimate& r) { return p_of_not_tied(r, margin); }), error);
    for (std::size_t i = 0; i < family.size(); ++i)
        family[i].verdict = tied[i]    ? Verdict::tied
                            : apart[i] ? Verdict::apart
                                       : Verdict::undecided;
}

double replicates_to_decide(const Comparison& comparison, std::size_t pairs, double replicates,
                            double margin, double error)
{
    const LogEstimate& ratio = comparison.log_ratio;
    if (comparison.verdict != Verdict::undecided) return 0;
    if (!(ratio.se > 0) || !std::isfinite(ratio.value))
        return std::numeric_limits<double>::quiet_NaN();
    const double tail = error / static_cast<double>(std::max<std::size_t>(pairs, 1));
    const double distance = std::fabs(ratio.value), room = std::log1p(margin) - distance;
    const double one_se = ratio.se * std::sqrt(replicates);  // of one replicate
    const double dof = ratio.dof / std::max(1.0, replicates - 1);
    double n = std::numeric_limits<double>::infinity();
    if (distance > 0) n = replicates_for(distance / one_se, tail / 2, dof);
    if (room > 0) n = std::min(n, replicates_for(room / one_se, tail, dof));
    return std::max(1.0, std::ceil(n - replicates));
}

std::vector<RankInterval> rank_intervals(std::span<const Comparison> family,
                                         std::span<const int> members, std::size_t strategies)
{
    std::vector<RankInterval> ranks(strategies, {0, 0});
    for (const int member : members) ranks[member] = {1, static_cast<int>(members.size())};
    for (const Comparison& pair : family) {
        if (pair.verdict != Verdict::apart) continue;
        const int less = pair.log_ratio.value < 0 ? pair.a : pair.b,
                  more = less == pair.a ? pair.b : pair.a;
        ++ranks[more].low;
        --ranks[less].high;
    }
    return ranks;
}

}  // namespace mis
