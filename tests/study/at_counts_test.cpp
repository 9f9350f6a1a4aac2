#include "mis/study/at_counts.h"

#include "mis/run/serial.h"
#include "mis/run/tbb.h"
#include "mis/trace/analytic.h"
#include "mis/words/reasons.h"

#include "tests/study/small_picture.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string>
#include <vector>

namespace mis {
namespace {

Study study_at(const Scene& scene, const std::vector<Strategy>& strategies,
               const StudyOptions& options, const std::vector<double>& further,
               const AnyExecutor& executor = any_executor(SerialExecutor{}))
{
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    return run_study_at(lit, strategies, options, further, executor);
}

TEST(AtCountsOfAStudy, AreTheVarianceOfIndependentSamplesAtAnyCount)
{
    const Study study =
        study_at(small_picture(), strategies_named({"solid-angle/power", "product/power"}),
                 {.own_samples = true, .spp = 256}, {1, 1024});
    for (const StrategyReport& s : study.report.strategies) {
        ASSERT_EQ(s.status, Status::ranked) << reason_words(s.reason);
        ASSERT_EQ(s.at_counts.size(), 3U);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(s.at_counts[k].n, (std::array{16.0, 1.0, 1024.0}[k]));
            EXPECT_EQ(s.at_counts[k].variance.value, s.variance.value);
        }
        EXPECT_EQ(s.at_counts[0].efficiency.value, s.efficiency.value);
        EXPECT_GT(s.at_counts[1].seconds_per_sample.value, s.at_counts[2].seconds_per_sample.value);
    }
}

/// The figure at a further count is that of a study at this count alone, bit for bit, for any
/// number of threads.
TEST(AtCountsOfAStudy, AreThoseOfAStudyOfSequencesOfThatLength)
{
    const Scene scene = small_picture();
    const auto strategies = strategies_named({"uniform/power", "solid-angle/balance"});
    const auto options = [](std::uint64_t n) {
        return StudyOptions{.samples_per_scrambling = n, .at = static_cast<double>(n), .spp = 1024};
    };
    const Study several = study_at(scene, strategies, options(4), {64, 16}),
                threads =
                    study_at(scene, strategies, options(4), {64, 16}, any_executor(TbbExecutor(3))),
                alone = study_at(scene, strategies, options(64), {});
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        const StrategyReport &a = several.report.strategies[s], &b = alone.report.strategies[s];
        ASSERT_EQ(a.at_counts.size(), 3U);
        EXPECT_EQ(a.at_counts[1].n, 64);
        EXPECT_EQ(a.at_counts[1].variance.value, b.variance.value);
        EXPECT_EQ(a.at_counts[1].relative_variance.low, b.relative_variance.low);
        EXPECT_LT(1.5 * a.at_counts[1].variance.value, a.variance.value);  // so sequences do
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(a.at_counts[k].variance.value,
                      threads.report.strategies[s].at_counts[k].variance.value);
    }
}

/// Stopped after the ranking: every count that has not run says so.
TEST(AtCountsOfAStudy, SayWhatWasNotRun)
{
    std::atomic<bool> stop{false};
    StudyOptions options{.samples_per_scrambling = 4, .at = 4, .spp = 1024};
    options.stop = &stop;
    options.progress = [&](double done, const SceneReport&) { stop = stop || done > 0.48; };
    const Study study = study_at(
        small_picture(), strategies_named({"uniform/power", "solid-angle/balance"}), options, {64});
    EXPECT_TRUE(study.report.partial);
    int ranked = 0;
    for (const StrategyReport& s : study.report.strategies) {
        if (s.status != Status::ranked) continue;
        ++ranked;
        ASSERT_EQ(s.at_counts.size(), 2U);
        EXPECT_NE(s.at_counts[1].status, Status::ranked);
        EXPECT_NE(reason_words(s.at_counts[1].reason), "");
    }
    EXPECT_EQ(ranked, 2);
}

/// Of independent samples only strata's variance depends on the count: it is run again with as many
/// draws as a point gets, and says so where it cannot be.
TEST(AtCountsOfAStudy, RunStrataWithAsManyDraws)
{
    const StudyOptions options{.own_samples = true, .at = 16, .spp = 1024};
    const std::vector<Strategy> strategies{strata(16), parse_strategy("solid-angle/power")};
    const Study study = study_at(small_picture(), strategies, options, {64, 48}),
                alone = study_at(small_picture(), {strata(64)}, options, {});
    const StrategyReport &s = study.report.strategies[0], &other = study.report.strategies[1];
    ASSERT_EQ(s.at_counts.size(), 3U) << reason_words(s.reason);
    EXPECT_EQ(s.at_counts[0].variance.value, s.variance.value);
    EXPECT_NE(s.at_counts[1].variance.value, s.variance.value);
    EXPECT_EQ(s.at_counts[1].variance.value, alone.report.strategies[0].variance.value);
    EXPECT_EQ(s.at_counts[2].status, Status::not_run);  // 1024 is no multiple of 48
    EXPECT_NE(reason_words(s.at_counts[2].reason).find("come together"), std::string::npos);
    EXPECT_EQ(other.at_counts[2].variance.value, other.variance.value);
}

}  // namespace
}  // namespace mis
