// Variances from shared directions against each strategy's own samples, on every scene that is
// shipped, where those are resolved.
#include "mis/study/shared_samples.h"
#include "mis/io/scene_json.h"
#include "mis/run/tbb.h"
#include "mis/study/study.h"
#include "mis/trace/embree.h"

#include "tests/support/places.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <variant>

namespace mis {
namespace {

constexpr double false_alarm = 1e-6;  // over all scenes and strategies
constexpr int most_scenes = 40;

std::vector<Strategy> strategies_of_scenes()
{
    std::vector<Strategy> all;
    for (const char* name :
         {"uniform/balance", "power/light", "solid-angle/power", "product/light",
          "product/balance@3+2", "irradiance/power", "tree/balance/one-sample", "all/light",
          "all/power", "power/balance/union", "product/light/projected", "brdf"})
        all.push_back(parse_strategy(name));
    return all;
}

std::vector<std::string> shipped_scenes()
{
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(source_dir() / "scenes"))
        if (file.path().extension() == ".json") names.push_back(file.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

class SharedOnScenes : public testing::TestWithParam<std::string> {};

TEST_P(SharedOnScenes, AgreeWithOwnSamples)
{
    Scene scene = read_scene((source_dir() / "scenes" / (GetParam() + ".json")).string());
    if (scene.camera) scene.camera->resolution = {16, 12};
    const EmbreeTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    const AnyExecutor executor = any_executor(TbbExecutor(2));
    const std::vector<Strategy> strategies = strategies_of_scenes();
    const bool has_many = scene.lights.size() > 50;  // which `all` draws for each sample
    const auto spp = static_cast<std::uint64_t>(scaled(has_many ? 128 : 1024));
    const Study own = run_study(lit, strategies, {.own_samples = true, .spp = spp}, executor);
    const StudyPoints& ground = *own.points;
    std::vector<SharedPoint> points;
    for (std::size_t p = 0; p < ground.figure_lit; ++p)
        points.push_back({ground.shading.points[p], ground.material_of(p)});
    ASSERT_FALSE(points.empty());
    SharedSamples shared(lit, points, strategies, {.seed = 3});
    shared.take(scaled(2000) / static_cast<int>(points.size()) + scaled(24), executor);
    const double bound =
        1.3 * z_bound(false_alarm, most_scenes * static_cast<int>(strategies.size()));
    int resolved = 0;
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        double variance = 0, squares = 0;
        Participation carrying;
        for (std::size_t p = 0; p < points.size(); ++p) {
            const Moments& moments = own.runs[s]->results()[p].luminance;
            variance += moments.variance(), squares += std::pow(moments.variance_se(), 2);
            carrying.sum_d2 += moments.m2, carrying.sum_d4 += moments.m4;
        }
        if (carrying.number() < 1000) continue;  // not resolved by its own
        if (std::holds_alternative<reason::AuditFails>(own.report.strategies[s].reason))
            continue;  // nor by them: they never met what matters
        const double n = static_cast<double>(points.size());
        if (variance / n < 1e-9 * std::pow(own.report.strategies[s].mean, 2)) continue;  // rounding
        const ValueAndError found = shared.mean(s);
        const double se = std::hypot(std::sqrt(squares) / n, found.se);
        EXPECT_NEAR(found.value, variance / n, bound * se) << name_of(strategies[s]);
        resolved += se < 0.1 * variance / n;
    }
    EXPECT_TRUE(resolved > 0 || sample_share < 1);  // so that the test can fail
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedOnScenes, testing::ValuesIn(shipped_scenes()),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace mis
