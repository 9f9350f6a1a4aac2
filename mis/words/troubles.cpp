#include "mis/words/troubles.h"

#include "mis/stats/measurements.h"
#include "mis/words/kinds.h"
#include "mis/words/numbers.h"
#include "mis/words/reasons.h"
#include "mis/words/same.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

void say_troubles_of(Sentences& sentences, const SceneView& view, int i)
{
    const StrategyReport& s = view.of(i);
    if (s.status == Status::not_resolved)
        sentences.say(view.name(i) + " is not resolved: " + reason_words(s.reason));
    if (s.status == Status::biased)
        sentences.say(view.name(i) + " is biased: " + reason_words(s.reason));
    if (s.status == Status::not_run)
        sentences.say(view.name(i) + " was not run: " + reason_words(s.reason) +
                      (s.estimated_seconds > 0 ? " (it would take about " +
                                                     duration(s.estimated_seconds) + " of CPU time)"
                                               : ""));
    if (s.invalid_samples > 0)
        sentences.say(view.name(i) + " gave " + many(s.invalid_samples, "sample") +
                      (s.invalid_samples == 1 ? " that is NaN or infinite and was left out"
                                              : " that are NaN or infinite and were left out") +
                      ": do not trust its figures" +
                      (s.first_invalid
                           ? "; '" + replay_words(view.scene().file, s.strategy, *s.first_invalid) +
                                 "' with this run's --seed and --resolution shows the first"
                           : ""));
}

bool has_intervals(const SceneReport& scene)
{
    return std::ranges::any_of(scene.strategies, [](const StrategyReport& s) {
        return s.status == Status::ranked && !s.exact;
    });
}

void say_extent(Sentences& sentences, const SceneReport& scene)
{
    if (scene.partial) sentences.say("Stopped early: these are the results so far");
    // Turns of shared directions are compared region by region, so that a few tell enough.
    else if (scene.directions == 0 && scene.replicates > 1 && scene.replicates < most_replicates &&
             has_intervals(scene))
        sentences.say("Intervals are rough: there was room for " +
                      std::to_string(scene.replicates) + " replicates, not " +
                      std::to_string(most_replicates) + " (--spp)");
}

/// In how many ranked strategies a bias of this share would not have been missed.
void say_least_bias(Sentences& sentences, const SceneReport& scene)
{
    constexpr double share = 0.05;
    std::size_t ranked = 0, sure = 0;
    for (const StrategyReport& s : scene.strategies) {
        if (s.status != Status::ranked || std::isnan(s.least_detectable_bias)) continue;
        ++ranked;
        sure += s.least_detectable_bias <= share ? 1 : 0;
    }
    if (ranked > 0)
        sentences.say("A bias of " + percent(share) +
                      " of the image's mean would have been found in " + std::to_string(sure) +
                      " of " + std::to_string(ranked) + " ranked strategies");
}

void say_kind(Sentences& sentences, const SceneView& view, const auto& is_of_it,
              const KindWords& words)
{
    std::vector<std::string> names;
    for (int i = 0; i < view.count(); ++i)
        if (is_of_it(view.of(i))) names.push_back(view.name(i));
    if (!names.empty()) sentences.say(kind_of_trouble(names, "strategy", words));
}

/// "2 pairs are tied in variance within 2 %".
void say_pairs(Sentences& sentences, const SceneView& view, const SameStrategies& same)
{
    std::size_t tied = 0, undecided = 0;
    for (const PairReport& p : view.scene().pairs) {
        if (!same.is_first(p.a) || !same.is_first(p.b)) continue;
        tied += p.verdict == Verdict::tied && !view.of(p.a).exact ? 1 : 0;
        undecided += p.verdict == Verdict::undecided ? 1 : 0;
    }
    const auto are = [](std::size_t count, const char* what) {
        return many(count, "pair") + (count == 1 ? " is " : " are ") + what;
    };
    std::string text = tied > 0 ? are(tied, "tied") : "";
    if (undecided > 0) text += (text.empty() ? "" : " and ") + are(undecided, "undecided");
    if (!text.empty()) sentences.say(text + " in variance (--verbose lists them)");
}

}  // namespace

void say_troubles(Sentences& sentences, const SceneView& view)
{
    for (int i = 0; i < view.count(); ++i) say_troubles_of(sentences, view, i);
    say_least_bias(sentences, view.scene());
    say_extent(sentences, view.scene());
}

std::vector<std::string> kinds_of_trouble(const SceneReport& scene)
{
    const SceneView view(scene);
    Sentences sentences;
    const auto in = [](Status status) {
        return [status](const StrategyReport& s) { return s.status == status; };
    };
    constexpr const char* why = " (--verbose says why)";
    const SameStrategies same(view);
    say_the_same(sentences, view, same);
    say_pairs(sentences, view, same);
    say_kind(sentences, view, in(Status::not_resolved),
             {"is not resolved", "are not resolved", why});
    say_kind(sentences, view, in(Status::biased), {"is biased", "are biased", why});
    say_kind(sentences, view, in(Status::not_run), {"was not run", "were not run", why});
    say_kind(sentences, view, [](const StrategyReport& s) { return s.invalid_samples > 0; },
             {"gave NaN or infinite samples", "gave NaN or infinite samples",
              ": do not trust such figures (--verbose says how to see the samples)"});
    say_extent(sentences, scene);
    return std::move(sentences).all();
}

}  // namespace mis
