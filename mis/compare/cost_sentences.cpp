#include "mis/compare/cost_report.h"

#include "mis/compare/words.h"

#include <algorithm>
#include <cmath>

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
    if (!std::isfinite(seconds.low) || !std::isfinite(seconds.high)) return duration(seconds.value);
    return duration(seconds.value) + " (" + duration(seconds.low) + " to " +
           duration(seconds.high) + ")";
}

void add_first(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    const CostCurveReport* first = nullptr;
    for (const CostCurveReport& curve : scene.curves)
        if (const TimeToError* time = to_one_percent(curve))
            if (first == nullptr || time->seconds.value < to_one_percent(*first)->seconds.value)
                first = &curve;
    if (first == nullptr) return;
    const TimeToError& time = *to_one_percent(*first);
    std::string text =
        name_of(*first) + " is the first to reach 1 % error, after " + with_bounds(time.seconds);
    if (time.reach == Reach::extrapolated) text += ", extrapolated";
    std::vector<std::string> close;
    for (const CostCurveReport& curve : scene.curves)
        if (const TimeToError* other = to_one_percent(curve);
            other != nullptr && &curve != first && !(other->seconds.low > time.seconds.high))
            close.push_back(name_of(curve));
    if (!close.empty()) text += "; intervals overlap with " + listed(close);
    sentences.push_back(text + ".");
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

void add_doubts(std::vector<std::string>& sentences, const CostCurveReport& curve, bool is_sobol)
{
    const std::string name = name_of(curve);
    if (!curve.reason.empty()) {
        sentences.push_back(name + " has no curve: " + curve.reason + ".");
        return;
    }
    if (std::all_of(curve.points.begin(), curve.points.end(),
                    [](const CostPoint& point) { return point.error.high == 0; })) {
        sentences.push_back(name + " has no error at all.");
        return;
    }
    if (!curve.fits && is_sobol && curve.slope.high < -0.5)
        sentences.push_back(name +
                            " falls faster than the root of its samples, as scrambled "
                            "sequences may, so nothing of it is extrapolated.");
    else if (!curve.fits)
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
                            (std::isnan(curve.relative_variance.value)
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

}  // namespace

std::string name_of(const CostCurveReport& curve)
{
    return name_of(curve.strategy) + (curve.precision == Precision::in_double ? " in double" : "");
}

std::vector<std::string> sentences_of(const CostSceneReport& scene)
{
    std::vector<std::string> sentences;
    add_first(sentences, scene);
    add_crossings(sentences, scene);
    for (const CostCurveReport& curve : scene.curves) add_doubts(sentences, curve, scene.is_sobol);
    if (!scene.reference.agrees)
        sentences.push_back("The strategies that the reference is pooled from, " +
                            listed(scene.reference.sources) +
                            ", differ by more than their noise; their difference counts as the "
                            "reference's error.");
    return sentences;
}

}  // namespace mis
