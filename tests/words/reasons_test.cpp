#include "mis/words/reasons.h"

#include <gtest/gtest.h>

#include <limits>

namespace mis {
namespace {

TEST(Reasons, AreSaidInWords)
{
    const reason::Observations samples{4096, false}, scramblings{256, true};
    EXPECT_EQ(reason_words(Reason()), "");
    EXPECT_EQ(reason_words(Reason(reason::AsWritten{"so it stood"})), "so it stood");
    EXPECT_EQ(reason_words(Reason(reason::PastBudget{64, 0.6})),
              "past the budget: the first 64 samples of it and of those that cost less would take "
              "more than 60 % of the time given");
    EXPECT_EQ(reason_words(Reason(reason::AuditFails{true, 33.2, 5})),
              "the other strategies' samples find a relative variance of at least 33 where its own "
              "saw 5: it has not drawn the rare samples that matter");
    EXPECT_EQ(reason_words(Reason(reason::NeverVaries{scramblings})),
              "all of its 256 scramblings say the same, which proves nothing: rare samples may not "
              "have been drawn yet");
    EXPECT_EQ(reason_words(Reason(reason::CarriedByFew{false, 50, 200, samples})),
              "its variance is carried by about 50 of 4096 samples; 200 are needed, about 4 times "
              "as many samples as now");
    EXPECT_EQ(reason_words(
                  Reason(reason::ReplicatesDiffer{std::numeric_limits<double>::quiet_NaN(), 0.25})),
              "its variance differs too much from replicate to replicate (its standard error is "
              "unknown; at most 25 % is trusted)");
}

TEST(Reasons, SayByHowMuchAMeanDiffersAndWhere)
{
    reason::MeanDiffers why{.difference = -0.096, .reference = 1, .p_value = 1e-9};
    EXPECT_EQ(reason_words(Reason(why)),
              "its mean is 9.6 % below what the others agree on (p = 1e-9, corrected)");
    why.region = 3, why.regions = 64, why.are_only_two = true;
    EXPECT_EQ(reason_words(Reason(why)),
              "its mean in region 3 of 64 is 9.6 % below what the others agree on (p = 1e-9, "
              "corrected); only two are left, and nothing says which of them is right");
}

TEST(Reasons, OfCurvesAreSaidToo)
{
    EXPECT_EQ(reason_words(CostReason()), "");
    EXPECT_EQ(reason_words(CostReason(reason::SampleTooDear{90, 8})),
              "past the budget: one sample per point takes 90 s, 8 times");
    EXPECT_EQ(reason_words(CostReason(reason::DoublingsTooDear{600})),
              "past the budget: about 10 min of CPU time for the first three doublings");
}

}  // namespace
}  // namespace mis
