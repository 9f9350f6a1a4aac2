#include "mis/words/verdict.h"

#include "mis/stats/rank.h"
#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

SceneReport scene_of(std::vector<StrategyMeasurements> strategies)
{
    Ranking ranking = rank({.points = 64, .strategies = std::move(strategies)}, {});
    SceneReport scene;
    scene.strategies = std::move(ranking.strategies);
    scene.pairs = std::move(ranking.pairs);
    scene.settled = ranking.settled;
    scene.replicates = ranking.replicates;
    return scene;
}

std::string all_of(const SceneReport& scene)
{
    std::string text;
    for (const std::string& sentence : sentences_of(scene, 2, 0.02)) text += sentence + "\n";
    return text;
}

/// `said`, up to the first number that a clock decided.
void expect_said(const std::string& text, const std::string& said)
{
    EXPECT_NE(text.find(said), std::string::npos) << text;
}

TEST(Sentences, BeginWithWhatToUseAndWhatItSaves)
{
    const SceneReport scene = scene_of({simulate("uniform", uniform_samples(0.3)),
                                        simulate("solid-angle", uniform_samples(0.02)),
                                        simulate("other", uniform_samples(0.2))});
    const auto sentences = sentences_of(scene, 2, 0.02);
    EXPECT_EQ(sentences[0].find("Use solid-angle/power: it reaches 1 % error 9."), 0u)
        << sentences[0];
    EXPECT_NE(sentences[0].find("times sooner than uniform/power"), std::string::npos);
    EXPECT_NE(sentences[0].find("on 2 threads)."), std::string::npos);
    expect_said(all_of(scene), "It is sure to lead in time to 1 % error");
}

TEST(Sentences, ClaimNoMoreThanWasLookedAt)
{
    SceneReport scene = scene_of(
        {simulate("uniform", uniform_samples(0.3)), simulate("other", uniform_samples(0.02))});
    EXPECT_EQ(all_of(scene).find("Intervals are rough"), std::string::npos);
    EXPECT_EQ(all_of(scene).find("audited"), std::string::npos);
    scene.replicates = 8;
    expect_said(all_of(scene), "Intervals are rough: there was room for 8 replicates, not 16");
    scene.partial = true;
    EXPECT_EQ(all_of(scene).find("Intervals are rough"), std::string::npos);
    scene.lacks_audit = true;
    expect_said(all_of(scene), "By these samples it leads in time to 1 % error");
    expect_said(all_of(scene), "Sequences are not audited");
}

TEST(Sentences, NameNothingAsPerhapsBetterThatTheAuditFoundWorse)
{
    SceneReport scene = scene_of(
        {simulate("uniform", uniform_samples(0.3)), simulate("other", uniform_samples(0.02))});
    StrategyReport& other = scene.strategies[1];
    other.status = Status::not_resolved, other.reason = reason::AsWritten{"of something"};
    scene.pairs.clear();
    expect_said(all_of(scene), "Not yet sure: other/power is not resolved, and ahead of it");
    other.least_growth = {.variance = 1e6, .relative_variance = 1e6};
    EXPECT_EQ(all_of(scene).find("ahead of it"), std::string::npos);
}

TEST(Sentences, CallABlackSceneBlack)
{
    SceneReport scene = scene_of(
        {simulate("uniform", uniform_samples(0.3)), simulate("other", uniform_samples(0.02))});
    for (StrategyReport& s : scene.strategies) s.exact = true, s.mean = 0;
    expect_said(all_of(scene), "No light reaches any point that was measured");
    EXPECT_EQ(all_of(scene).find("Use "), std::string::npos);
}

TEST(Sentences, CompareWithTheNextBestAndWithWhatIsUsual)
{
    const std::string text = sentences_of(
        scene_of({simulate("a", uniform_samples(0.1)), simulate("b", uniform_samples(0.3)),
                  simulate("c", uniform_samples(0.6)), simulate("uniform", uniform_samples(0.9))}),
        2, 0.02)[0];
    expect_said(text, "times sooner than b/power and ");
    expect_said(text, "times sooner than uniform/power (in ");
    EXPECT_EQ(text.find("c/power"), std::string::npos);
}

TEST(Sentences, SayWhereEfficiencyAndTimeToOnePercentDisagree)
{
    // a is noisy where it is bright, b where it is dark.
    StrategyMeasurements a = simulate("a", uniform_samples(0.4)),
                         b = simulate("b", uniform_samples(0.1));
    for (ReplicateValues& r : b.replicates) r.relative_variance *= 20;
    b.pooled.relative_variance *= 20;
    const std::string text = all_of(scene_of({a, b}));
    expect_said(text, "Use a/power: it reaches 1 % error 5");
    expect_said(text, "Where only bright places matter, use b/power: by plain variance it is 3.9");
}

TEST(Sentences, NameTiesAndTheUndecided)
{
    StrategyMeasurements a = simulate("a", uniform_samples(0.1)), twin = a;
    twin.strategy = named("twin");
    const std::string text = all_of(scene_of(
        {a, twin, simulate("b", uniform_samples(0.101)), simulate("c", uniform_samples(0.9))}));
    expect_said(text, "a/power and twin/power are tied in variance within 2 %");
    expect_said(text, "times as many samples) would decide.");
}

TEST(Sentences, NameManyThatAreTiedOnce)
{
    StrategyMeasurements a = simulate("a", uniform_samples(0.1)), b = a, c = a;
    b.strategy = named("b");
    c.strategy = named("c");
    const std::string text = all_of(scene_of({a, b, c, simulate("other", uniform_samples(0.9))}));
    expect_said(text, "a/power, b/power and c/power are tied in variance, each with each, within");
    EXPECT_EQ(text.find("(ratio 1"), std::string::npos) << text;
}

TEST(Sentences, QuoteNoGainOverWhatMayBeAsGood)
{
    const std::string text = all_of(
        scene_of({simulate("a", uniform_samples(0.1)), simulate("uniform", uniform_samples(0.101)),
                  simulate("power", uniform_samples(0.9))}));
    expect_said(text, "times sooner than power/power");
    EXPECT_EQ(text.find("sooner than uniform"), std::string::npos) << text;
    EXPECT_EQ(text.find("sooner than a/"), std::string::npos) << text;  // whichever leads
}

TEST(Sentences, DoNotCallSureWhatAnUnresolvedStrategyMayBeat)
{
    // Some 3 samples of 16384 carry the variance of `lucky`, which is far below that of `a`.
    const SampleOf lucky = [](Random& bits) {
        return uniform_samples(1e-3)(bits) + (std::bernoulli_distribution(2e-4)(bits) ? 16 : 0);
    };
    const std::string text =
        all_of(scene_of({simulate("a", uniform_samples(0.3)), simulate("b", uniform_samples(0.9)),
                         simulate("lucky", lucky)}));
    expect_said(text, "Use a/power");
    expect_said(text, "Not yet sure: lucky/power is not resolved, and ahead of it by the samples");
    expect_said(text, "Of those that are resolved it is sure to lead in time to 1 % error");
    EXPECT_EQ(text.find("It is sure to lead"), std::string::npos) << text;

    const std::string behind =
        all_of(scene_of({simulate("a", uniform_samples(0.3)), simulate("b", uniform_samples(0.9)),
                         simulate("late", rare_samples(1e-4))}));
    expect_said(behind, "late/power is not resolved");
    expect_said(behind, "It is sure to lead in time to 1 % error");
    EXPECT_EQ(behind.find("ahead of it"), std::string::npos) << behind;
}

TEST(Sentences, GiveTheReasonOfWhatIsExcluded)
{
    StrategyMeasurements dear;
    dear.strategy = named("dear");
    dear.was_run = false;
    dear.not_run_reason = reason::AsWritten{"one sample takes 10000 draws"};
    dear.estimated_seconds = 600;
    StrategyMeasurements broken = simulate("broken", uniform_samples(0.3));
    broken.invalid_samples = 3;
    const std::string text = all_of(scene_of(
        {simulate("a", uniform_samples(0.1)), simulate("b", uniform_samples(0.2)),
         simulate("c", rare_samples(1e-4)), broken,
         simulate("d", [](Random& bits) { return 1.2 * uniform_samples(0.1)(bits); }), dear}));
    expect_said(text, "c/power is not resolved: its variance is carried by about");
    expect_said(text, "d/power is biased: its mean is 20 % above");
    expect_said(text,
                "dear/power was not run: one sample takes 10000 draws (it would take about 10 min "
                "of CPU time).");
    expect_said(text, "broken/power gave 3 samples that are NaN or infinite");
}

TEST(Sentences, SayWhatIsExact)
{
    const std::string text =
        all_of(scene_of({simulate_exact("x"), simulate("a", uniform_samples(0.1))}));
    expect_said(text, "Use x/power");
    expect_said(text, "x/power is exact here, without variance: every sample is the answer");
}

/// The clock's noise makes now the one, now the other seem the faster; twice as slow is no noise.
TEST(Sentences, NameTheSameOfExactOnesThatAreAsFastWhateverTheClockSays)
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Simulation sim{.seed = seed}, slow{.seed = seed, .seconds_per_sample = 2e-8};
        const auto verdict = [](const StrategyMeasurements& first) {
            return all_of(scene_of(
                {first, simulate_exact("y", {.seed = 99}), simulate("a", uniform_samples(0.1))}));
        };
        expect_said(verdict(simulate_exact("x", sim)), "Use x/power");
        expect_said(verdict(simulate_exact("x", slow)), "Use y/power");
    }
}

TEST(Sentences, SayThatTheLeastVarianceCostsMore)
{
    const std::string text =
        all_of(scene_of({simulate("a", uniform_samples(0.1), {.seconds_per_sample = 1e-7}),
                         simulate("b", uniform_samples(0.3))}));
    expect_said(text, "Use b/power");
    expect_said(text, "Per sample a/power has the least variance, 3");
    expect_said(text, "times as much");
}

TEST(Sentences, SayThatNothingCouldBeRanked)
{
    const SceneReport scene = scene_of({simulate("c", rare_samples(1e-4))});
    EXPECT_EQ(sentences_of(scene, 2, 0.02)[0],
              "No strategy could be ranked on this scene: about 99 times the samples (--spp, "
              "--time) may tell.");
    EXPECT_EQ(sentences_of({}, 1, 0.02).size(), 1u);
}

TEST(Sentences, HoldNoNumberThatIsNone)
{
    StrategyMeasurements untimed = simulate("a", uniform_samples(0.1));
    untimed.times.clear();
    for (const SceneReport& scene :
         {scene_of({simulate_exact("x"), simulate_exact("y"), untimed}), scene_of({untimed})}) {
        const std::string text = all_of(scene);
        for (const char* none : {"nan", "inf", "?"})
            EXPECT_EQ(text.find(none), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace mis
