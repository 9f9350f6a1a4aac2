#include "mis/words/cost_remarks.h"

#include "mis/stats/resolved.h"
#include "mis/words/kinds.h"
#include "mis/words/numbers.h"
#include "mis/words/reasons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace mis {
namespace {

const TimeToError* to_one_percent(const CostCurveReport& curve)
{
    for (const TimeToError& time : curve.times)
        if (time.error == 0.01 && time.reach != Reach::unknown) return &time;
    return nullptr;
}

bool is_exact(const CostCurveReport& curve)
{
    return !curve.points.empty() &&
           std::ranges::all_of(curve.points, [](const CostPoint& p) { return p.error.high == 0; });
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
    return name_of(curve) + " is the first to reach 1 % error, after " + duration(time.seconds) +
           (time.reach == Reach::extrapolated ? ", extrapolated" : "");
}

/// The first to reach 1 %; nullptr where none is known to.
const CostCurveReport* first_of(const CostSceneReport& scene)
{
    const CostCurveReport* first = nullptr;
    for (const CostCurveReport& curve : scene.curves)
        if (const TimeToError* time = to_one_percent(curve))
            if (first == nullptr || surely_by(*time) < surely_by(*to_one_percent(*first)))
                first = &curve;
    return first;
}

void add_first(std::vector<std::string>& sentences, const CostSceneReport& scene,
               const CostCurveReport* first)
{
    if (first == nullptr) {
        sentences.emplace_back("It is not known when any strategy reaches 1 % error.");
        return;
    }
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

enum class Steepness { unknown, as_theory, steeper, flatter };

/// How the error falls in time, beside −½.
Steepness steepness(const CostCurveReport& curve)
{
    const Interval& slope = curve.slope_in_time;
    if (!std::isfinite(slope.value) || !std::isfinite(slope.low) || !std::isfinite(slope.high))
        return Steepness::unknown;
    if (slope.high < -0.5) return Steepness::steeper;
    return slope.low > -0.5 ? Steepness::flatter : Steepness::as_theory;
}

std::string slope_of_first(const CostCurveReport& first)
{
    const std::string measured =
        "In time the error of " + name_of(first) + " falls with slope " +
        (std::isfinite(first.slope_in_time.value) ? with_error(first.slope_in_time) : "");
    switch (steepness(first)) {
        case Steepness::as_theory: return measured + ", beside -1/2 in theory: they agree.";
        case Steepness::steeper:
            return measured + ", steeper than -1/2: what is prepared is paid once.";
        case Steepness::flatter: return measured + ", flatter than the -1/2 of theory.";
        case Steepness::unknown: break;
    }
    return "How the error of " + name_of(first) +
           " falls in time was not measured well enough to set beside -1/2.";
}

/// "a at -0.53 ± 0.01 and b at -0.61 ± 0.02": the first three, and how many more.
std::string with_slopes(const std::vector<const CostCurveReport*>& curves)
{
    constexpr std::size_t most = 3;
    std::vector<std::string> names;
    for (const CostCurveReport* curve : curves)
        if (names.size() < most)
            names.push_back(name_of(*curve) + (steepness(*curve) == Steepness::unknown
                                                   ? std::string()
                                                   : " at " + with_error(curve->slope_in_time)));
    if (curves.size() > most) names.push_back(std::to_string(curves.size() - most) + " more");
    return listed(names);
}

/// "Slopes in time of the 5 others: as -1/2: a at -0.51 ± 0.02; steeper: b at -0.61 ± 0.02".
void add_other_slopes(std::vector<std::string>& sentences, const CostSceneReport& scene,
                      const CostCurveReport* first)
{
    std::array<std::vector<const CostCurveReport*>, 4> of;
    std::size_t others = 0;
    for (const CostCurveReport& curve : scene.curves) {
        if (&curve == first || is_exact(curve)) continue;
        of[static_cast<std::size_t>(steepness(curve))].push_back(&curve);
        ++others;
    }
    if (others == 0) return;
    std::vector<std::string> parts;
    for (const auto& [kind, what] :
         {std::pair{Steepness::as_theory, "as -1/2: "}, std::pair{Steepness::steeper, "steeper: "},
          std::pair{Steepness::flatter, "flatter: "},
          std::pair{Steepness::unknown, "not measured: "}})
        if (const auto& curves = of[static_cast<std::size_t>(kind)]; !curves.empty())
            parts.push_back(what + with_slopes(curves));
    std::string text = "Slopes in time of the " +
                       (others == 1 ? std::string("other") : std::to_string(others) + " others") +
                       ": ";
    for (std::size_t i = 0; i < parts.size(); ++i) text += (i > 0 ? "; " : "") + parts[i];
    sentences.push_back(text + ".");
}

void add_crossings(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    for (const CrossingReport& c : scene.crossings)
        sentences.push_back(name_of(scene.curves[static_cast<std::size_t>(c.before)]) + " beats " +
                            name_of(scene.curves[static_cast<std::size_t>(c.after)]) + " below " +
                            duration(c.seconds) + ", where both err by " + percent(c.error.value) +
                            (c.is_extrapolated ? " (extrapolated)" : "") +
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

std::size_t points_of(const CostCurveReport& curve, Trust trust)
{
    return static_cast<std::size_t>(std::ranges::count(curve.points, trust, &CostPoint::trust));
}

void add_doubts(std::vector<std::string>& sentences, const CostCurveReport& curve, bool is_sobol)
{
    const std::string name = name_of(curve);
    if (!is_none(curve.reason)) {
        sentences.push_back(name + " has no curve: " + reason_words(curve.reason) + ".");
        return;
    }
    if (is_exact(curve)) {
        sentences.push_back(name + " has no error at all.");
        return;
    }
    if (!curve.fits && !falls_faster(curve, is_sobol))
        sentences.push_back(name + " does not fall like the root of its samples (p = " +
                            number(curve.slope_p_value, 2) +
                            " for a slope of -1/2), so nothing of it is extrapolated.");
    const std::string of_points = " of " + many(curve.points.size(), "point");
    if (const std::size_t rare = points_of(curve, Trust::rare_samples); rare > 0)
        sentences.push_back(name + ": at " + std::to_string(rare) + of_points +
                            " few rare samples carry the error (~)" +
                            (curve.fits && std::isnan(curve.relative_variance.value)
                                 ? "; and over all of them, so nothing is fitted."
                                 : "."));
    if (const std::size_t below = points_of(curve, Trust::below_reference); below > 0)
        sentences.push_back(name + ": " + std::to_string(below) + of_points +
                            (below == 1 ? " lies" : " lie") +
                            " below what the reference can tell.");
    if (curve.invalid_samples > 0)
        sentences.push_back(name + ": " + many(curve.invalid_samples, "sample") +
                            (curve.invalid_samples == 1 ? " was" : " were") +
                            " NaN or infinite, and counted as 0.");
}

/// Of a small picture no error is trusted, however long it is sampled.
void add_smallness(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    const double errors = static_cast<double>(scene.shading_points * scene.copies) *
                          static_cast<double>(scene.replicates);
    if (errors < 2 * least_participation)
        sentences.push_back("Each error is the mean of " + counted(errors, "square") +
                            ", too few to trust it: take a larger --resolution.");
}

/// On the scene as a whole.
void add_remarks(std::vector<std::string>& sentences, const CostSceneReport& scene)
{
    add_sequences(sentences, scene);
    add_smallness(sentences, scene);
    if (!scene.reference.agrees)
        sentences.push_back("The strategies that the reference is pooled from, " +
                            listed(scene.reference.sources) +
                            ", differ by more than their noise; their difference counts as the "
                            "reference's error.");
}

}  // namespace

std::string name_of(const CostCurveReport& curve)
{
    return name_of(curve.strategy) + (curve.precision == Precision::in_double ? " in double" : "");
}

CostWords words_of(const CostSceneReport& scene)
{
    CostWords words;
    if (scene.is_black) {
        for (const CostCurveReport& curve : scene.curves)
            if (!is_none(curve.reason)) add_doubts(words.details, curve, scene.is_sobol);
        words.answer.emplace_back(
            "No sample met any light: as far as it was seen the scene is black, and there is "
            "nothing to tell strategies apart by.");
        return words;
    }
    const CostCurveReport* const first = first_of(scene);
    if (!scene.curves.empty()) add_first(words.answer, scene, first);
    if (first != nullptr && !is_exact(*first)) words.answer.push_back(slope_of_first(*first));
    add_other_slopes(words.answer, scene, first);
    add_crossings(words.details, scene);
    for (const CostCurveReport& curve : scene.curves)
        add_doubts(words.details, curve, scene.is_sobol);
    add_remarks(words.details, scene);
    return words;
}

std::vector<std::string> sentences_of(const CostSceneReport& scene)
{
    CostWords words = words_of(scene);
    words.answer.insert(words.answer.end(), words.details.begin(), words.details.end());
    return words.answer;
}

std::vector<std::string> kinds_of_doubt(const CostSceneReport& scene)
{
    constexpr std::size_t most_crossings = 3;
    std::vector<std::string> sentences;
    const auto add_kind = [&](const auto& is_of_it, const KindWords& words) {
        std::vector<std::string> names;
        for (const CostCurveReport& curve : scene.curves)
            if (is_of_it(curve)) names.push_back(name_of(curve));
        if (!names.empty()) sentences.push_back(kind_of_trouble(names, "curve", words) + ".");
    };
    constexpr const char* why = " (--verbose says why)";
    constexpr const char* more = " (--verbose says more)";
    if (!scene.is_black) {
        add_crossings(sentences, scene);
        if (sentences.size() > most_crossings) {
            const std::size_t others = sentences.size() - most_crossings;
            sentences.resize(most_crossings);
            sentences.push_back(many(others, "more crossing") + " (--verbose).");
        }
    }
    add_kind([](const auto& c) { return !is_none(c.reason); },
             {"was not run", "were not run", why});
    if (scene.is_black) return sentences;
    add_kind(is_exact, {"has no error at all", "have no error at all"});
    add_kind(
        [&](const auto& c) {
            return !c.points.empty() && !c.fits && !falls_faster(c, scene.is_sobol);
        },
        {"does not fall like the root of its samples (!)",
         "do not fall like the root of their samples (!)", more});
    add_kind([](const auto& c) { return points_of(c, Trust::rare_samples) > 0; },
             {"has points that few rare samples carry (~)",
              "have points that few rare samples carry (~)", more});
    add_kind([](const auto& c) { return points_of(c, Trust::below_reference) > 0 && !is_exact(c); },
             {"has points below what the reference can tell (<)",
              "have points below what the reference can tell (<)", more});
    add_kind([](const auto& c) { return c.invalid_samples > 0; },
             {"gave NaN or infinite samples", "gave NaN or infinite samples", more});
    add_remarks(sentences, scene);
    return sentences;
}

}  // namespace mis
