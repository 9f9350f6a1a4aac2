#include "mis/words/predict_remarks.h"

#include <gmock/gmock.h>

#include <limits>

namespace mis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double infinite = std::numeric_limits<double>::infinity();

Interval within(double value, double error) { return {value, value - error, value + error}; }

PredictedVariances::AtProbe at(std::size_t number, const std::vector<Interval>& variances)
{
    return {number, std::vector<double>(variances.size(), 1.0), variances};
}

TEST(PredictSentences, SayWhichHasTheLeastVarianceAndByHowMuch)
{
    EXPECT_THAT(sentences_of(PredictedVariances{
                    {"a", "b", "c"}, {at(0, {within(3, 1e-9), within(1, 1e-9), within(2, 1e-9)})}}),
                ElementsAre("At probe 0 b has the least variance, 1; next is c, with 2 times as "
                            "much."));
    EXPECT_THAT(sentences_of(PredictedVariances{{"a", "b"},
                                                {at(3, {within(1.002, 1e-9), within(1, 1e-9)})}}),
                ElementsAre("At probe 3 b has the least variance, 1; next is a, with 0.2 % more."));
    EXPECT_THAT(
        sentences_of(PredictedVariances{{"a", "b"}, {at(0, {within(2, 0.1), within(1, 0.01)})}}),
        ElementsAre("At probe 0 b has the least variance, 1; next is a, with 2.0 ± 0.2 "
                    "times as much."));
    EXPECT_THAT(sentences_of(PredictedVariances{{"a"}, {at(0, {within(2, 0.1)})}}),
                ElementsAre("At probe 0 a has the least variance, 2."));
}

TEST(PredictSentences, TakeTheMeanOverProbesAndNameThoseWhereAnotherIsBetter)
{
    EXPECT_THAT(sentences_of(PredictedVariances{{"a", "b"},
                                                {at(0, {within(1, 1e-9), within(2, 1e-9)}),
                                                 at(2, {within(8, 1e-9), within(4, 1e-9)})}}),
                ElementsAre("Over 2 probes b has the least mean variance, 3; next is a, with 1.5 "
                            "times as much.",
                            "At 1 of them another has less: a at probe 0."));
    EXPECT_THAT(
        sentences_of(PredictedVariances{{"a"}, {at(0, {within(1, 0)}), at(2, {within(2, 0)})}, 4}),
        ElementsAre("Over 2 of 4 probes a has the least mean variance, 1.5."));
}

TEST(PredictSentences, CallNothingLeastThatTheBoundsDoNotTellApart)
{
    EXPECT_THAT(
        sentences_of(PredictedVariances{
            {"a", "b", "c"}, {at(0, {within(1, 0.1), within(1.05, 0.1), within(3, 1e-9)})}}),
        ElementsAre("At probe 0 a and b have the least variance, 1, equal within the "
                    "bounds of error; next is c, with 3.0 ± 0.4 times as much."));
}

TEST(PredictSentences, NameTheExactOnesApart)
{
    EXPECT_THAT(
        sentences_of(PredictedVariances{
            {"a", "b", "c"}, {at(0, {within(1e-12, 1e-11), within(2, 1e-9), within(3, 1e-9)})}}),
        ElementsAre("At probe 0 a is exact: without variance, to within the bounds of "
                    "error.",
                    "At probe 0 b has the least variance of the others, 2; next is c, with "
                    "1.5 times as much."));
    EXPECT_THAT(sentences_of(PredictedVariances{{"a"}, {at(0, {within(0, 0)})}}),
                ElementsAre("At probe 0 a is exact: without variance, to within the bounds of "
                            "error."));
}

TEST(PredictSentences, AreHonestOfBlackInfiniteAndNoProbes)
{
    EXPECT_THAT(sentences_of(PredictedVariances{{"a"}, {}}), IsEmpty());
    EXPECT_THAT(
        sentences_of(PredictedVariances{{"a", "b"}, {{0, {0, 0}, {within(0, 0), within(0, 0)}}}}),
        ElementsAre("At probe 0 no light arrives: every strategy says 0."));
    const Interval beyond{infinite, infinite, infinite};
    EXPECT_THAT(sentences_of(PredictedVariances{{"a", "b"}, {at(0, {beyond, within(2, 1e-9)})}}),
                ElementsAre("At probe 0 b has the least variance, 2; that of the others is "
                            "infinite."));
    EXPECT_THAT(sentences_of(PredictedVariances{{"a", "b"}, {at(0, {beyond, beyond})}}),
                ElementsAre("At probe 0, the variance of every strategy is infinite, or beyond a "
                            "double."));
}

}  // namespace
}  // namespace mis
