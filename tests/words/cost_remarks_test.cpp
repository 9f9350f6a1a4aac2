#include "mis/words/cost_remarks.h"

#include <gmock/gmock.h>

#include <limits>

namespace mis {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A curve of one point that reaches 1 % after so many seconds.
CostCurveReport curve(const std::string& name, double seconds, const Interval& slope_in_time)
{
    CostCurveReport curve;
    curve.strategy = parse_strategy(name);
    curve.points = {{.samples = 1, .error = {0.1, 0.09, 0.11}, .seconds = {1, 1, 1}}};
    curve.slope = {-0.5, -0.51, -0.49};
    curve.slope_in_time = slope_in_time;
    curve.times = {{.error = 0.01,
                    .samples = 100,
                    .seconds = {seconds, 0.99 * seconds, 1.01 * seconds},
                    .reach = Reach::measured}};
    return curve;
}

CostSceneReport cost_scene(std::vector<CostCurveReport> curves)
{
    CostSceneReport scene;
    scene.shading_points = 1000, scene.replicates = 8;
    scene.curves = std::move(curves);
    return scene;
}

TEST(CostSentences, SetTheSlopeInTimeBesideMinusOneHalf)
{
    const auto said_of = [](const Interval& slope) {
        return words_of(cost_scene({curve("brdf", 2, slope)})).answer[1];
    };
    EXPECT_EQ(
        said_of({-0.5, -0.51, -0.49}),
        "In time the error of brdf falls with slope -0.50 ± 0.01, beside -1/2 in theory: they "
        "agree.");
    EXPECT_EQ(said_of({-0.66, -0.69, -0.63}),
              "In time the error of brdf falls with slope -0.66 ± 0.03, steeper than -1/2: what is "
              "prepared is paid once.");
    EXPECT_EQ(said_of({-0.4, -0.42, -0.38}),
              "In time the error of brdf falls with slope -0.40 ± 0.02, flatter than the -1/2 of "
              "theory.");
    EXPECT_EQ(said_of({-0.5, not_known, not_known}),
              "How the error of brdf falls in time was not measured well enough to set beside "
              "-1/2.");
}

TEST(CostSentences, SortTheOtherSlopesByKind)
{
    EXPECT_EQ(
        words_of(cost_scene({curve("brdf", 1, {-0.5, -0.52, -0.48}),
                             curve("power/power", 2, {-0.51, -0.53, -0.49}),
                             curve("uniform/power", 3, {-0.6, -0.61, -0.59}),
                             curve("uniform/light", 4, {-0.4, -0.42, -0.38}),
                             curve("power/light", 5, {not_known, not_known, not_known})}))
            .answer.back(),
        "Slopes in time of the 4 others: as -1/2: power/power at -0.51 ± 0.02; steeper: "
        "uniform/power at -0.60 ± 0.01; flatter: uniform/light at -0.40 ± 0.02; not measured: "
        "power/light.");
}

TEST(CostSentences, SayWhereNothingReachesOnePercent)
{
    CostCurveReport lost = curve("brdf", 1, {not_known, not_known, not_known});
    lost.times.clear();
    EXPECT_THAT(words_of(cost_scene({lost})).answer,
                ElementsAre("It is not known when any strategy reaches 1 % error.",
                            "Slopes in time of the other: not measured: brdf."));
}

TEST(CostSentences, HaveOneForEachKindOfDoubt)
{
    std::vector<CostCurveReport> curves;
    for (const char* name :
         {"brdf", "power/power", "power/light", "uniform/light", "uniform/power"}) {
        curves.push_back(curve(name, 1, {-0.5, -0.52, -0.48}));
        curves.back().invalid_samples = 1;
    }
    curves[0].reason = reason::NoTimeLeft{};
    curves[0].points.clear();
    const CostSceneReport scene = cost_scene(curves);
    EXPECT_THAT(kinds_of_doubt(scene),
                ElementsAre("brdf was not run (--verbose says why).",
                            "5 curves gave NaN or infinite samples: brdf, power/power, power/light "
                            "and 2 more (--verbose says more)."));
    EXPECT_THAT(
        words_of(scene).details,
        Contains(HasSubstr("power/power: 1 sample was NaN or infinite, and counted as 0.")));
}

}  // namespace
}  // namespace mis
