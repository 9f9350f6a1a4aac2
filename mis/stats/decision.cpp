#include "mis/stats/decision.h"

#include "mis/math/limits.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

/// log(figure of one member / figure of another), with its one-sided bound: the truth is at most
/// value + room. Infinite room where no error is known.
struct Gap {
    double value = 0, room = 0;
    double at_most() const { return value + room; }
    bool is_surely_above_0() const { return value > room; }
};

/// All gaps of a family, each seen from either side.
class Gaps {
public:
    explicit Gaps(const Contenders& among)
        : strategies_(among.strategies), gaps_(strategies_ * strategies_, Gap{0, infinity})
    {
        const double others = static_cast<double>(std::max<std::size_t>(among.members.size(), 2));
        const double tail = among.error / (others - 1);
        for (const Comparison& pair : among.pairs) {
            const double room = room_of(pair.log_ratio, tail);
            const double value = std::isnan(pair.log_ratio.value) ? 0 : pair.log_ratio.value;
            of(pair.a, pair.b) = {value, room};
            of(pair.b, pair.a) = {-value, room};
        }
    }

    const Gap& operator()(int i, int j) const { return gaps_[index(i, j)]; }

private:
    static double room_of(const LogEstimate& ratio, double tail)
    {
        if (std::isnan(ratio.value) || std::isnan(ratio.se)) return infinity;
        return ratio.se > 0 ? t_quantile(tail, ratio.dof) * ratio.se : 0;
    }
    std::size_t index(int i, int j) const
    {
        return static_cast<std::size_t>(i) * strategies_ + static_cast<std::size_t>(j);
    }
    Gap& of(int i, int j) { return gaps_[index(i, j)]; }

    std::size_t strategies_;
    std::vector<Gap> gaps_;
};

/// Those of which no other is surely ahead.
std::vector<int> candidates(const Contenders& among, const Gaps& gap)
{
    std::vector<int> found;
    for (const int i : among.members)
        if (std::ranges::none_of(among.members,
                                 [&](int j) { return j != i && gap(i, j).is_surely_above_0(); }))
            found.push_back(i);
    return found;
}

/// Those that could be best at earlier looks, too.
std::vector<int> that_were(const std::vector<int>& now, std::span<const Standing> earlier)
{
    std::vector<int> both;
    for (const int i : now)
        if (earlier[static_cast<std::size_t>(i)].may_be_best) both.push_back(i);
    return both;
}

/// log of how far i may be behind the best, which is one of `best`.
double behind(int i, const std::vector<int>& best, const Gaps& gap)
{
    double most = 0;
    for (const int b : best)
        if (b != i) most = std::max(most, gap(i, b).at_most());
    return most;
}

int leader_of(const std::vector<int>& best, const Contenders& among, const Gaps& gap)
{
    int first = best.front();
    for (const int i : best)
        if (gap(i, first).value < 0) first = i;
    for (const int i : best)  // in the order they were asked for
        if (i == first ||
            (among.are_alike(i, first) && gap(i, first).value <= std::log1p(most_behind)))
            return i;
    return first;
}

/// Errors fall with the root of the number of samples; what they must fall to is known.
double factor_to_decide(int leader, const std::vector<int>& best, const Gaps& gap)
{
    double factor = 1;
    for (const int b : best) {
        if (b == leader) continue;
        const Gap& to = gap(leader, b);
        factor = std::max(factor, std::pow(to.room / (std::log1p(most_behind) - to.value), 2));
    }
    return std::isfinite(factor) ? factor - 1 : nan;
}

}  // namespace

Decision decide_best(const Contenders& among)
{
    Decision decision;
    decision.of.resize(among.strategies);
    if (among.members.empty()) return decision;
    const Gaps gap(among);
    std::vector<int> best = candidates(among, gap);
    const auto both = among.earlier.empty() ? std::vector<int>() : that_were(best, among.earlier);
    if (!both.empty()) best = both;  // else one of the looks was wrong, and this one saw more
    for (const int i : among.members) {
        Standing& standing = decision.of[static_cast<std::size_t>(i)];
        standing.behind_at_most = std::expm1(behind(i, best, gap));
        if (!both.empty())
            standing.behind_at_most = std::min(
                standing.behind_at_most, among.earlier[static_cast<std::size_t>(i)].behind_at_most);
    }
    for (const int i : best) decision.of[static_cast<std::size_t>(i)].may_be_best = true;
    decision.leader = leader_of(best, among, gap);
    decision.is_decided =
        decision.of[static_cast<std::size_t>(decision.leader)].behind_at_most <= most_behind;
    decision.more = decision.is_decided ? 0 : factor_to_decide(decision.leader, best, gap);
    return decision;
}

bool have_same_samples(const StrategyReport& a, const StrategyReport& b)
{
    return a.samples == b.samples && a.mean == b.mean && a.variance.value > 0 &&
           a.variance.value == b.variance.value &&
           a.relative_variance.value == b.relative_variance.value;
}

bool is_known_to(double error, const Interval& figure)
{
    return !(figure.value > 0) || figure.high - figure.low <= 2 * error * figure.value;
}

}  // namespace mis
