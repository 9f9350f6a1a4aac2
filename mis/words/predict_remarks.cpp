#include "mis/words/predict_remarks.h"

#include "mis/math/limits.h"
#include "mis/words/numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {
namespace {

using AtProbe = PredictedVariances::AtProbe;

/// No more than this share of the squared mean: what bounds of error leave of 0.
constexpr double nothing = 1e-6;

bool is_exact_at(const AtProbe& probe, std::size_t i)
{
    return probe.variances[i].high <= nothing * probe.means[i] * probe.means[i];
}

bool is_exact(const PredictedVariances& found, std::size_t i)
{
    return std::ranges::all_of(found.probes,
                               [i](const AtProbe& probe) { return is_exact_at(probe, i); });
}

/// The mean over the probes, with the mean of the bounds.
Interval mean_variance(const PredictedVariances& found, std::size_t i)
{
    Interval mean{0, 0, 0};
    for (const AtProbe& probe : found.probes) {
        mean.value += probe.variances[i].value;
        mean.low += probe.variances[i].low;
        mean.high += probe.variances[i].high;
    }
    const auto n = static_cast<double>(found.probes.size());
    return {mean.value / n, mean.low / n, mean.high / n};
}

bool may_be_equal(const Interval& a, const Interval& b)
{
    return a.low <= b.high && b.low <= a.high;
}

/// "0.3 % more", "3.21 times as much"; with an error where that is seen in three digits.
std::string how_much_more(const Interval& more, const Interval& less)
{
    const Interval ratio{more.value / less.value, more.low / less.high, more.high / less.low};
    const bool is_sharp = ratio.high - ratio.low < 1e-3 * (ratio.value - 1);
    if (ratio.value < 1.1 && is_sharp) return percent(ratio.value - 1) + " more";
    return (is_sharp || !(ratio.low > 0) ? number(ratio.value) : with_error(ratio)) +
           " times as much";
}

std::string where(const PredictedVariances& found)
{
    if (found.probes.size() == 1) return "At probe " + std::to_string(found.probes[0].number);
    const bool are_some = found.probes.size() < found.all_probes;
    return "Over " + std::to_string(found.probes.size()) +
           (are_some ? " of " + std::to_string(found.all_probes) : "") + " probes";
}

std::vector<std::string> names_of(const PredictedVariances& found,
                                  const std::vector<std::size_t>& of)
{
    std::vector<std::string> names;
    for (const std::size_t i : of) names.push_back(found.strategies[i]);
    return names;
}

/// Those that are not exact, from the least mean variance on.
std::vector<std::size_t> in_order(const std::vector<Interval>& variances,
                                  const PredictedVariances& found)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < variances.size(); ++i)
        if (!is_exact(found, i)) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return variances[i].value; });
    return order;
}

/// "; next is b, with 1.3 times as much".
std::string next_words(const PredictedVariances& found, const std::vector<Interval>& variances,
                       const std::vector<std::size_t>& order, std::size_t next)
{
    if (next == order.size()) return "";
    const Interval& other = variances[order[next]];
    if (!std::isfinite(other.value)) return "; that of the others is infinite";
    return "; next is " + found.strategies[order[next]] + ", with " +
           how_much_more(other, variances[order[0]]);
}

std::string least_words(const PredictedVariances& found, const std::vector<Interval>& variances,
                        const std::vector<std::size_t>& order, bool are_others)
{
    const Interval& least = variances[order[0]];
    if (!std::isfinite(least.value))
        return where(found) + ", the variance of " +
               (are_others ? "the others" : "every strategy") + " is infinite, or beyond a double.";
    std::vector<std::size_t> tied;
    std::size_t next = 0;
    while (next < order.size() && may_be_equal(variances[order[next]], least))
        tied.push_back(order[next++]);
    const std::string of = are_others ? " of the others" : "";
    const std::string what =
        std::string(found.probes.size() == 1 ? " the least variance" : " the least mean variance") +
        of + ", " + number(least.value);
    return where(found) + " " + listed(names_of(found, tied)) +
           (tied.size() == 1 ? " has" + what
                             : " have" + what + ", equal within the bounds of error") +
           next_words(found, variances, order, next) + ".";
}

/// At single probes another may surely have less than the one that is least over all.
std::string elsewhere(const PredictedVariances& found, std::size_t least)
{
    constexpr std::size_t most = 3;
    std::vector<std::string> places;
    std::size_t count = 0;
    for (const AtProbe& probe : found.probes) {
        const Interval& own = probe.variances[least];
        std::size_t best = least;
        for (std::size_t i = 0; i < probe.variances.size(); ++i)
            if (!is_exact(found, i) && probe.variances[i].value < probe.variances[best].value)
                best = i;
        if (best == least || may_be_equal(probe.variances[best], own)) continue;
        if (++count <= most)
            places.push_back(found.strategies[best] + " at probe " + std::to_string(probe.number));
    }
    if (count == 0) return "";
    if (count > most) places.push_back(std::to_string(count - most) + " more");
    const std::string at = count == found.probes.size() ? "each" : std::to_string(count);
    return "At " + at + " of them another has less: " + listed(places) + ".";
}

}  // namespace

std::vector<std::string> sentences_of(const PredictedVariances& found)
{
    std::vector<std::string> sentences;
    if (found.probes.empty()) return sentences;
    std::vector<std::size_t> exact;
    std::vector<Interval> variances;
    for (std::size_t i = 0; i < found.strategies.size(); ++i) {
        variances.push_back(mean_variance(found, i));
        if (is_exact(found, i)) exact.push_back(i);
    }
    const bool is_black = std::ranges::all_of(found.probes, [](const AtProbe& probe) {
        return std::ranges::all_of(probe.means, [](double mean) { return mean == 0; });
    });
    if (is_black) return {where(found) + " no light arrives: every strategy says 0."};
    if (!exact.empty())
        sentences.push_back(where(found) + " " + listed(names_of(found, exact)) +
                            (exact.size() == 1 ? " is" : " are") +
                            " exact: without variance, to within the bounds of error.");
    const std::vector<std::size_t> order = in_order(variances, found);
    if (order.empty()) return sentences;
    sentences.push_back(least_words(found, variances, order, !exact.empty()));
    if (const std::string others = elsewhere(found, order[0]); !others.empty())
        sentences.push_back(others);
    return sentences;
}

}  // namespace mis
