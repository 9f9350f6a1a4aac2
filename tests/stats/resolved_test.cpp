#include "mis/stats/resolved.h"

#include "tests/support/simulated.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

bool is_resolved(const StrategyMeasurements& s) { return is_none(why_not_resolved(s)); }

/// Why it is not resolved, which must be of this kind.
template <class Kind> Kind why(const StrategyMeasurements& s)
{
    return std::get<Kind>(why_not_resolved(s));
}

TEST(Resolved, IsAnOrdinaryStrategy)
{
    EXPECT_TRUE(is_resolved(simulate("a", uniform_samples(0.1))));
}

TEST(Resolved, IsNotAStrategyThatSawNothing)
{
    // Hit probability 1e-7: 16384 samples see nothing 998 times of 1000 and look exact.
    const StrategyMeasurements s = simulate("a", rare_samples(1e-7));
    ASSERT_EQ(s.pooled.variance, 0);
    EXPECT_EQ(why<reason::NeverVaries>(s).of.count, 16384);
}

TEST(Resolved, IsAZeroVarianceThatWasProved) { EXPECT_TRUE(is_resolved(simulate_exact("a"))); }

TEST(Resolved, IsNotAVarianceThatSomeTensOfSamplesCarry)
{
    const StrategyMeasurements some = simulate("a", rare_samples(1e-3)),
                               many = simulate("b", rare_samples(1e-1));
    ASSERT_LT(some.pooled.participation.number(), 100);
    const reason::CarriedByFew few = why<reason::CarriedByFew>(some);
    EXPECT_FALSE(few.relative);
    EXPECT_EQ(few.carried_by, some.pooled.participation.number());
    EXPECT_TRUE(is_resolved(many));
}

TEST(Resolved, IsNotWhatOnlyTheRelativeVarianceSees)
{
    StrategyMeasurements s = simulate("a", uniform_samples(0.1));
    s.pooled.relative_participation = {10, 5};  // 20 samples, in a dark corner
    EXPECT_TRUE(why<reason::CarriedByFew>(s).relative);
}

TEST(Resolved, IsNotWithOneReplicateOrNone)
{
    StrategyMeasurements s = simulate("a", uniform_samples(0.1));
    s.replicates.resize(1);
    EXPECT_FALSE(is_resolved(s));
    s.replicates.clear();
    EXPECT_FALSE(is_resolved(s));
    s = simulate("a", uniform_samples(0.1), {.replicates = 2});
    EXPECT_TRUE(is_resolved(s));
}

TEST(Resolved, IsNotIfReplicatesDisagreeHoweverManySamplesThereAre)
{
    StrategyMeasurements s = simulate("a", uniform_samples(0.1));
    for (std::size_t r = 0; r < 8; ++r) s.replicates[r].variance *= 100;
    EXPECT_FALSE(is_resolved(s));
    for (ReplicateValues& replicate : s.replicates)
        replicate.variance = 0;  // against a pooled variance that is not
    EXPECT_FALSE(is_resolved(s));
}

TEST(Resolved, SurvivesReplicatesOfZero)
{
    StrategyMeasurements s = simulate("a", uniform_samples(0.1));
    s.replicates[3].variance = s.replicates[3].relative_variance = 0;
    EXPECT_TRUE(is_resolved(s));
}

/// Sees all but one sample in ten million, which would add 0.3 to its variance of 0.1.
StrategyMeasurements audited(double from_others, double se)
{
    StrategyMeasurements s = simulate("a", uniform_samples(0.1));
    s.audit = {.available = true,
               .variance_from_others = from_others,
               .variance_from_others_se = se,
               .own_variance = 0.1,
               .own_variance_se = 0.002};
    return s;
}

TEST(Resolved, IsNotWhatTheOthersSamplesSayIsMissingASignificantPart)
{
    EXPECT_FALSE(why<reason::AuditFails>(audited(0.4, 0.02)).relative);
    EXPECT_TRUE(is_resolved(audited(0.4, 0.15)));    // too unsure to accuse
    EXPECT_TRUE(is_resolved(audited(0.11, 0.001)));  // sure, but no significant part
    EXPECT_TRUE(is_resolved(audited(0.02, 0.001)));  // less than measured is no accusation
}

TEST(Resolved, IsNotWhatTheOthersSamplesFindInDarkPlaces)
{
    StrategyMeasurements s = audited(0.1, 0.001);
    s.audit.relative_available = true;
    s.audit.own_relative_variance = 5;
    s.audit.own_relative_variance_se = 0.5;
    s.audit.relative_variance_from_others = 6;
    s.audit.relative_variance_from_others_se = 1;
    EXPECT_TRUE(is_resolved(s));
    s.audit.relative_variance_from_others = 60;
    s.audit.relative_variance_from_others_se = 9;
    const auto found = why<reason::AuditFails>(s);
    EXPECT_TRUE(found.relative);
    EXPECT_DOUBLE_EQ(found.at_least, 33);
    EXPECT_EQ(found.own, 5);
}

TEST(Resolved, IsNotAnExactOneThatTheOthersSamplesRefute)
{
    StrategyMeasurements s = simulate_exact("a");
    s.audit = {.available = true, .variance_from_others = 0.3, .variance_from_others_se = 0.05};
    EXPECT_FALSE(is_resolved(s));
    s.audit.variance_from_others = 1e-13;  // rounding
    s.audit.variance_from_others_se = 1e-15;
    EXPECT_TRUE(is_resolved(s));
}

// Strategies of one seed in 200 whose variance is rare samples': each run that passes as resolved
// would be off by far.
TEST(Resolved, NeverTrustsAHundredThousandthHitProbability)
{
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
        EXPECT_FALSE(is_resolved(simulate("a", rare_samples(1e-5), {.seed = seed})));
}

}  // namespace
}  // namespace mis
