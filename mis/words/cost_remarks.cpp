#include "mis/words/cost_remarks.h"

#include "mis/stats/resolved.h"
#include "mis/words/numbers.h"
#include "mis/words/reasons.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {
namespace {

const TimeToError* to_one_percent(const CostCurveReport& curve)
{
    for (const TimeToError& time : curve.times)
        if (time.error == 0.01 && time.reach != Reach::unknown) return &time;
    return nullptr;
}

/// "0.8 s (0.7 s to 0.9 s)".
std::string with_bounds(const Interval& seconds)
{
    const std::string value = duration(seconds.value), low = duration(seconds.low),
                      high = duration(seconds.high);
    if (!std::isfinite(seconds.low) || !std::isfinite(seconds.high) ||
        (low == value && high == value))
        return value;
    return value + " (" + low + " to " + high + ")";
}

/// A curve's error after so many seconds, by its own points: between two in logarithms, beyond the
/// last as the root. Infinite before the first.
double error_after(const CostCurveReport& curve, double seconds)
{
    double error = std::numeric_limits<double>::infinity();
    const CostPoint* before = nullptr;
    for (const CostPoint& point : curve.points) {
        if (point.seconds.value > seconds) {
            if (before == nullptr) return error;
            const double part = std::log(seconds / before->seconds.value) /
                                std::log(point.seconds.value / before->seconds.value);
            return before->error.value * std::pow(point.error.value / before->error.value, part);
        }
        before = &point;
    }
    if (before != nullptr) error = before->error.value * std::sqrt(before->seconds.value / seconds);
    return error;
}

/// Is it not known when this curve reaches 1 %, but perhaps for a bound, though at its last point
/// it surely was ahead?
bool may_be_sooner(const CostCurveReport& curve, const CostCurveReport& first)
{
    const TimeToError* time = to_one_percent(curve);
    if (&curve == &first || (time != nullptr && time->reach != Reach::at_most)) return false;
    for (std::size_t k = curve.points.size(); k-- > 0;) {
        const CostPoint& last = curve.points[k];
        if (last.trust != Trust::rare_samples)
            return last.error.high < error_after(first, last.seconds.value);
    }
    return false;
}

/// Of a bound, the bound.
double surely_by(const TimeToError& time)
{
    return time.reach == Reach::at_most ? time.seconds.high : time.seconds.value;
}

std::string reaches_one_percent(const CostCurveReport& curve, const TimeToError& time)
{
    if (time.reach == Reach::at_most)
        return name_of(curve) + " is the first that surely reaches 1 % error, after at most " +
               duration(time.seconds.high);
    return name_of(curve) + " is the first to reach 1 % error, after " + with_bounds(time.seconds) +
           (time.reach == Reach::extrapolated ? ", extrapolated" : "");
}

void add_first(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    const CostCurveReport* first = nullptr;
    for (const CostCurveReport& curve : scene.curves)
        if (const TimeToError* time = to_one_percent(curve))
            if (first == nullptr || surely_by(*time) < surely_by(*to_one_percent(*first)))
                first = &curve;
    if (first == nullptr) return;
    const TimeToError& time = *to_one_percent(*first);
    std::vector<std::string> close, ahead;
    for (const CostCurveReport& curve : scene.curves) {
        const TimeToError* other = to_one_percent(curve);
        if (other != nullptr && &curve != first && other->reach != Reach::at_most &&
            !(other->seconds.low > time.seconds.high))
            close.push_back(name_of(curve));
        if (may_be_sooner(curve, *first)) ahead.push_back(name_of(curve));
    }
    std::string text = reaches_one_percent(*first, time);
    if (!ahead.empty() && time.reach != Reach::at_most)
        text = "Of those whose time is known, " + text;
    if (!close.empty()) text += "; intervals overlap with " + listed(close);
    sentences.push_back(text + ".");
    if (!ahead.empty())
        sentences.push_back(
            "As far as it was measured, the error is smaller after the same time by " +
            listed(ahead) + "; when that is 1 % is not known, or but for a bound.");
}

void add_crossings(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    for (const CrossingReport& c : scene.crossings)
        sentences.push_back(name_of(scene.curves[static_cast<std::size_t>(c.before)]) + " beats " +
                            name_of(scene.curves[static_cast<std::size_t>(c.after)]) + " below " +
                            with_bounds(c.seconds) + ", where both err by " +
                            percent(c.error.value) + (c.is_extrapolated ? " (extrapolated)" : "") +
                            "; beyond, it is the other way round.");
}

/// Than the root of its samples, as sequences may.
bool falls_faster(const CostCurveReport& curve, bool is_sobol)
{
    return !curve.fits && is_sobol && curve.slope.high < -0.5;
}

void add_sequences(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    std::vector<std::string> faster;
    for (const CostCurveReport& curve : scene.curves)
        if (falls_faster(curve, scene.is_sobol)) faster.push_back(name_of(curve));
    if (!faster.empty())
        sentences.push_back(
            "Faster than by the root of its samples, as that of scrambled sequences may, falls the "
            "error of " +
            listed(faster) + ".");
    if (scene.is_sobol)
        sentences.push_back(
            "Times beyond the last point are bounds (<): the error of a sequence falls "
            "at least by the root of its samples.");
}

void add_doubts(std::vector<std::string>& sentences, const CostCurveReport& curve, bool is_sobol)
{
    const std::string name = name_of(curve);
    if (!is_none(curve.reason)) {
        sentences.push_back(name + " has no curve: " + reason_words(curve.reason) + ".");
        return;
    }
    if (std::all_of(curve.points.begin(), curve.points.end(),
                    [](const CostPoint& point) { return point.error.high == 0; })) {
        sentences.push_back(name + " has no error at all.");
        return;
    }
    if (!curve.fits && !falls_faster(curve, is_sobol))
        sentences.push_back(name + " does not fall like the root of its samples (p = " +
                            number(curve.slope_p_value, 2) +
                            " for a slope of -1/2), so nothing of it is extrapolated.");
    std::size_t trusted = 0, rare = 0;
    for (const CostPoint& point : curve.points) {
        trusted += point.trust == Trust::trusted ? 1 : 0;
        rare += point.trust == Trust::rare_samples ? 1 : 0;
    }
    if (rare > 0)
        sentences.push_back(name + ": at " + count(double(rare)) + " of " +
                            count(double(curve.points.size())) +
                            " points few rare samples carry the error (~)" +
                            (curve.fits && std::isnan(curve.relative_variance.value)
                                 ? "; and over all of them, so nothing is fitted."
                                 : "."));
    if (trusted < curve.points.size() - rare)
        sentences.push_back(name + ": " + count(double(curve.points.size() - rare - trusted)) +
                            " of " + count(double(curve.points.size())) +
                            " points lie below what the reference can tell.");
    if (curve.invalid_samples > 0)
        sentences.push_back(name + ": " + count(double(curve.invalid_samples)) +
                            " samples were no number and count as 0.");
}

/// Of a small picture no error is trusted, however long it is sampled.
void add_smallness(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    const double errors = static_cast<double>(scene.shading_points * scene.copies) *
                          static_cast<double>(scene.replicates);
    if (errors < 2 * least_participation)
        sentences.push_back("Each error is the mean of " + count(errors) +
                            " squares, too few to trust it: take a larger --resolution.");
}

}  // namespace

std::string name_of(const CostCurveReport& curve)
{
    return name_of(curve.strategy) + (curve.precision == Precision::in_double ? " in double" : "");
}

std::vector<std::string> sentences_of(const CostSceneReport& scene)
{
    std::vector<std::string> sentences;
    if (scene.is_black) {
        for (const CostCurveReport& curve : scene.curves)
            if (!is_none(curve.reason)) add_doubts(sentences, curve, scene.is_sobol);
        sentences.emplace_back(
            "No sample met any light: as far as it was seen the scene is black, and there is "
            "nothing to tell strategies apart by.");
        return sentences;
    }
    add_first(sentences, scene);
    add_crossings(sentences, scene);
    for (const CostCurveReport& curve : scene.curves) add_doubts(sentences, curve, scene.is_sobol);
    add_sequences(sentences, scene);
    add_smallness(sentences, scene);
    if (!scene.reference.agrees)
        sentences.push_back("The strategies that the reference is pooled from, " +
                            listed(scene.reference.sources) +
                            ", differ by more than their noise; their difference counts as the "
                            "reference's error.");
    return sentences;
}

}  // namespace mis
