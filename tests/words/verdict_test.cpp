#include "mis/words/verdict.h"

#include "mis/stats/rank.h"
#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

namespace mis {
namespace {

SceneReport scene_of(std::vector<StrategyMeasurements> strategies)
{
    Ranking ranking = rank({.points = 64, .strategies = std::move(strategies)}, {});
    SceneReport scene;
    put_ranking(std::move(ranking), 2, scene);
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
    EXPECT_EQ(sentences[0].find("Use solid-angle/power: it reaches 1 % error in "), 0u)
        << sentences[0];
    EXPECT_NE(sentences[0].find("on 2 threads."), std::string::npos);
    EXPECT_EQ(sentences[1],
              "It is sure to be no slower than any other (95 %, all strategies together).");
    EXPECT_EQ(sentences[2].find("It reaches 1 % error 9."), 0u) << sentences[2];
    EXPECT_NE(sentences[2].find("times sooner than uniform/power"), std::string::npos);
}

TEST(Sentences, ClaimNoMoreThanWasLookedAt)
{
    SceneReport scene = scene_of(
        {simulate("uniform", uniform_samples(0.3)), simulate("other", uniform_samples(0.02))});
    EXPECT_EQ(all_of(scene).find("Intervals are rough"), std::string::npos);
    EXPECT_EQ(all_of(scene).find("audited"), std::string::npos);
    scene.replicates = 8;
    expect_said(all_of(scene), "Intervals are rough: there was room for 8 replicates, not 16");
    scene.directions = 160;
    EXPECT_EQ(all_of(scene).find("Intervals are rough"), std::string::npos);
    scene.directions = 0;
    scene.strategies[0].least_detectable_bias = 0.04;
    scene.strategies[1].least_detectable_bias = 0.06;
    expect_said(all_of(scene), "A bias of 5 % of the image's mean would have been found in 1 of 2");
    scene.partial = true;
    EXPECT_EQ(all_of(scene).find("Intervals are rough"), std::string::npos);
    scene.lacks_audit = true;
    expect_said(all_of(scene), "By these samples it is sure to be no slower than any other");
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
        2, 0.02)[2];
    expect_said(text, "times sooner than b/power and ");
    expect_said(text, "times sooner than uniform/power.");
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
    expect_said(text, "Use a/power: it reaches 1 % error in");
    expect_said(text, "Where only bright places matter, use b/power: by plain variance it is 3.9");
}

/// The same, but for a variance that is some ‰ higher.
StrategyMeasurements like(StrategyMeasurements s, const std::string& policy, double factor = 1.002)
{
    s.strategy = named(policy);
    s.pooled.variance *= factor;
    for (ReplicateValues& r : s.replicates) r.variance *= factor;
    for (std::vector<double>& regions : s.region_variances)
        for (double& v : regions) v *= factor;
    return s;
}

TEST(Sentences, NameTiesAndTheUndecided)
{
    const StrategyMeasurements a = simulate("a", uniform_samples(0.1)), twin = like(a, "twin");
    const std::string text = all_of(scene_of(
        {a, twin, simulate("b", uniform_samples(0.101)), simulate("c", uniform_samples(0.9))}));
    expect_said(text, "a/power and twin/power are tied in variance within 2 %");
    expect_said(text, "times as many samples) would decide.");
}

TEST(Sentences, NameManyThatAreTiedOnce)
{
    const StrategyMeasurements a = simulate("a", uniform_samples(0.1)), b = like(a, "b"),
                               c = like(b, "c");
    const std::string text = all_of(scene_of({a, b, c, simulate("other", uniform_samples(0.9))}));
    expect_said(text, "a/power, b/power and c/power are tied in variance, each with each, within");
    EXPECT_EQ(text.find("(ratio 1"), std::string::npos) << text;
}

TEST(Sentences, SayOfWhatIsDecidedHowMuchIsSure)
{
    const auto sentences = sentences_of(
        scene_of({simulate("a", uniform_samples(0.1)), simulate("b", uniform_samples(0.1)),
                  simulate("c", uniform_samples(0.9))}),
        2, 0.02);
    EXPECT_EQ(
        sentences[1],
        "It is sure to be at most 5 % slower than any other (95 %, all strategies together).");
}

/// Of five, of which the first three may be best by their intervals.
SceneReport undecided_scene()
{
    const Simulation few{.samples = 2};
    SceneReport scene = scene_of({simulate("a", uniform_samples(0.1), few),
                                  simulate("b", uniform_samples(0.11), few),
                                  simulate("c", uniform_samples(0.105), few),
                                  simulate("d", uniform_samples(0.9), few), simulate_exact("e")});
    scene.strategies[4].status = Status::biased;
    return scene;
}

TEST(Sentences, SayWhatIsMissingInNumbers)
{
    SceneReport scene = undecided_scene();
    scene.decided = false;
    scene.leader = "a/power";
    scene.seconds_to_decide = 5.3;
    for (int i = 0; i < 4; ++i) scene.strategies[i].may_be_best = i < 3;
    scene.strategies[0].behind_at_most = 0.25;  // 1 − 1/1.25: as much may another be sooner
    scene.strategies[0].seconds_to_1_percent.value = 1;
    scene.strategies[1].seconds_to_1_percent.value = 1.1;
    scene.strategies[2].seconds_to_1_percent.value = 1.2;
    const auto second = [&] { return sentences_of(scene, 2, 0.02)[1]; };
    EXPECT_EQ(second(),
              "Not decided: b/power and c/power may be up to 20 % sooner; about 6 more "
              "seconds would decide.");
    scene.seconds_to_decide = 250;
    expect_said(second(), "about 5 more minutes would decide");
    scene.seconds_to_decide = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(second(), "Not decided: b/power and c/power may be up to 20 % sooner.");
    scene.strategies[0].behind_at_most = std::numeric_limits<double>::infinity();
    EXPECT_EQ(second(), "Not decided: b/power and c/power may be sooner.");
}

TEST(Sentences, NameNothingAsPerhapsBestThatNoIntervalLetsWin)
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const Simulation few{.samples = 2, .seed = seed};
        std::vector<StrategyMeasurements> all;
        for (const auto& [policy, variance] :
             {std::pair{"a", 0.1}, {"b", 0.105}, {"c", 0.12}, {"d", 0.15}, {"e", 0.3}})
            all.push_back(simulate(policy, uniform_samples(variance), few));
        const SceneReport scene = scene_of(all);
        const std::string second = sentences_of(scene, 2, 0.02)[1];
        for (const StrategyReport& s : scene.strategies) {
            if (s.may_be_best) continue;
            EXPECT_EQ(second.find(name_of(s.strategy)), std::string::npos) << second;
        }
    }
}

TEST(Sentences, GiveASecondAnswerWhereTheFirstDrawsEveryLight)
{
    SceneReport scene =
        scene_of({simulate("all", uniform_samples(0.02)), simulate("power", uniform_samples(0.1)),
                  simulate("uniform", uniform_samples(0.3))});
    scene.lights = 5;
    expect_said(all_of(scene), "Use all/power: it reaches");
    expect_said(all_of(scene),
                "Of those that draw one light per sample, use power/power: it reaches");
    scene.lights = 1;
    EXPECT_EQ(all_of(scene).find("Of those that draw one"), std::string::npos);
    // Where one that draws one light leads, there is one answer.
    scene =
        scene_of({simulate("all", uniform_samples(0.2)), simulate("power", uniform_samples(0.1))});
    scene.lights = 5;
    EXPECT_EQ(all_of(scene).find("Of those that draw one"), std::string::npos);
}

/// Those that choose one light of one, by policies of some heuristics; and brdf.
SceneReport one_light_scene()
{
    std::vector<StrategyMeasurements> all;
    for (const char* heuristic : {"power", "balance"})
        for (const char* policy : {"uniform", "power", "all"}) {
            const bool is_power = std::string_view(heuristic) == "power";
            all.push_back(simulate("u", uniform_samples(is_power ? 0.1 : 0.12)));
            all.back().strategy = named(policy);
            all.back().strategy.heuristic = heuristic;
        }
    all.push_back(simulate("brdf", uniform_samples(0.5)));
    all.back().strategy = {.policy = "", .heuristic = "", .technique = "brdf"};
    SceneReport scene = scene_of(all);
    scene.lights = 1;
    return scene;
}

TEST(Sentences, SayOnceThatPoliciesAreTheSame)
{
    SceneReport scene = one_light_scene();
    const std::string said = "the policies uniform, power and all are the same: they draw the same";
    const std::string text = all_of(scene);
    expect_said(text, "Use uniform/power");
    expect_said(text, "With one light, " + said);
    EXPECT_EQ(text.find("tied"), std::string::npos) << text;
    EXPECT_EQ(text.find("are the same", text.find(said) + said.size()), std::string::npos) << text;
    // Of one light by construction, though one had more samples than another.
    scene.strategies[1].samples *= 2, scene.strategies[1].variance.value *= 1.001;
    expect_said(all_of(scene), "With one light, " + said);
    scene.lights = 2;
    expect_said(all_of(scene), "On this scene, the policies uniform and all are the same");
    scene.strategies[2].mean *= 1.001, scene.strategies[5].mean *= 1.001;
    EXPECT_EQ(all_of(scene).find("the policies"), std::string::npos);
}

TEST(Sentences, NameNoTwinAsARivalWhereThereIsAnother)
{
    SceneReport scene = one_light_scene();
    scene.decided = false;
    for (StrategyReport& s : scene.strategies)
        s.may_be_best = s.strategy.chooses_light(), s.behind_at_most = 0.25;
    EXPECT_EQ(sentences_of(scene, 2, 0.02)[1].find("Not decided: uniform/balance may be up to"), 0u)
        << sentences_of(scene, 2, 0.02)[1];
    for (StrategyReport& s : scene.strategies)
        if (s.strategy.heuristic == "balance") s.may_be_best = false;
    expect_said(sentences_of(scene, 2, 0.02)[1], "all/power");
    expect_said(sentences_of(scene, 2, 0.02)[1], "power/power");
}

TEST(Sentences, QuoteAGainOverThatWhichSpeaksForAll)
{
    SceneReport scene = one_light_scene();
    // power/balance is the first of its kind by the clock; uniform/balance was asked for first.
    scene.strategies[4].seconds_to_1_percent.value *= 0.9;
    for (PairReport& p : scene.pairs)
        if (p.a == 4 || p.b == 4) p.time_verdict = Verdict::apart;
    EXPECT_EQ(all_of(scene).find("sooner than power/balance"), std::string::npos) << all_of(scene);
}

TEST(Sentences, UseWhatTheReportSaysThoughAnotherIsFirstByTheClock)
{
    SceneReport scene = undecided_scene();
    scene.decided = false;
    scene.leader = "b/power";
    for (int i = 0; i < 4; ++i) scene.strategies[i].may_be_best = i < 2;
    scene.strategies[0].seconds_to_1_percent.value = 1e-9;
    scene.strategies[1].seconds_to_1_percent.value = 1.1e-9;
    expect_said(all_of(scene), "Use b/power");
    EXPECT_EQ(sentences_of(scene, 2, 0.02)[1].find("Not decided: a/power may be"), 0u);
}

TEST(Sentences, SayThatTwoTechniquesAreTheSame)
{
    StrategyMeasurements a = simulate("all", uniform_samples(0.1)), b = a;
    b.strategy.technique = "union";
    SceneReport scene = scene_of({a, b, simulate("c", uniform_samples(0.3))});
    scene.lights = 5;
    expect_said(all_of(scene), "all/power and all/power/union are the same here");
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
    expect_said(text, "Of those that are resolved it is sure to be no slower than any other");
    EXPECT_EQ(text.find("It is sure to be"), std::string::npos) << text;

    const std::string behind =
        all_of(scene_of({simulate("a", uniform_samples(0.3)), simulate("b", uniform_samples(0.9)),
                         simulate("late", rare_samples(1e-4))}));
    expect_said(behind, "late/power is not resolved");
    expect_said(behind, "It is sure to be no slower than any other");
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

/// Best of nothing: one strategy ran, and others may be better.
TEST(Sentences, DoNotCrownAStrategyThatRanAlone)
{
    StrategyMeasurements dear;
    dear.strategy = named("solid-angle");
    dear.was_run = false;
    dear.not_run_reason = reason::PastBudget{2048, 0.6};
    dear.estimated_seconds = 40;
    StrategyMeasurements other = dear;
    other.strategy = named("power");
    const std::string text =
        all_of(scene_of({simulate("uniform", uniform_samples(0.3)), dear, other}));
    EXPECT_EQ(text.find("Use "), text.npos) << text;
    EXPECT_EQ(text.find("sure to"), text.npos) << text;
    expect_said(text, "Not decided which to use: there was time to rank uniform/power alone; ");
    expect_said(text,
                "2 strategies were not run, and may be better; their first samples take about "
                "80 s of CPU time");
    expect_said(
        all_of(scene_of({simulate("uniform", uniform_samples(0.3)), dear})),
        "solid-angle/power was not run, and may be better; its first samples take about 40 s");
}

TEST(Sentences, NameAnotherThatIsBestAtAFurtherCount)
{
    SceneReport scene = scene_of({simulate("uniform", uniform_samples(0.3)),
                                  simulate("solid-angle", uniform_samples(0.02))});
    const Interval second{1, 0.99, 1.01};
    const auto counts = [&](double first, double later) {
        std::vector<CountFigures> figures;
        for (const auto& [n, v] : {std::pair(16.0, first), {256.0, later}})
            figures.push_back({.n = n,
                               .status = Status::ranked,
                               .relative_variance = {v, 0.95 * v, 1.05 * v},
                               .seconds_per_sample = second});
        return figures;
    };
    scene.strategies[0].at_counts = counts(0.3, 0.01);
    scene.strategies[1].at_counts = counts(0.02, 0.02);
    expect_said(all_of(scene), "At 256 samples uniform/power is best: it reaches the same error 2");
    scene.strategies[0].at_counts = counts(0.01, 0.019);
    EXPECT_EQ(all_of(scene).find("is best"), std::string::npos) << all_of(scene);
}

}  // namespace
}  // namespace mis
