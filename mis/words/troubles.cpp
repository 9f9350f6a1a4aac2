#include "mis/words/troubles.h"

#include "mis/stats/measurements.h"
#include "mis/words/numbers.h"
#include "mis/words/reasons.h"

#include <algorithm>

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
        sentences.say(view.name(i) + " gave " + std::to_string(s.invalid_samples) +
                      " samples that are no numbers and were left out: do not trust its figures" +
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

}  // namespace

void say_troubles(Sentences& sentences, const SceneView& view)
{
    const SceneReport& scene = view.scene();
    for (int i = 0; i < view.count(); ++i) say_troubles_of(sentences, view, i);
    if (scene.partial) sentences.say("Stopped early: these are the results so far");
    else if (scene.replicates > 1 && scene.replicates < most_replicates && has_intervals(scene))
        sentences.say("Intervals are rough: there was room for " +
                      std::to_string(scene.replicates) + " replicates, not " +
                      std::to_string(most_replicates) + " (--spp)");
}

}  // namespace mis
