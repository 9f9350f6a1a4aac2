#include "mis/engine/replay.h"

#include "mis/engine/stages_trace.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace mis {
namespace {

/// Every sample that a run takes can be had again by its number, to the last bit.
TEST(Replay, GivesTheSampleThatTheRunHad)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    const Tile& tile = test.probes.tiles.at(0);
    for (const char* name : {"uniform/power", "radiant-solid-angle/balance/union", "all/light",
                             "power/power/one-sample", "brdf"}) {
        const Strategy strategy = parse_strategy(name);
        const ReadyStrategy<float> ready(test.lit, strategy, kernels<float>(), 1);
        Vec3<double> sum{0};
        for (std::uint64_t k = 0; k < 100; ++k) {
            const Replay again = replay(test.lit, ready, tile, test.probes.points[0], k);
            EXPECT_FALSE(again.steps.empty());
            sum += again.value;
        }
        const Outcome run = run_probe<float>(test, strategy, kernels<float>(), 100);
        EXPECT_EQ(sum, run.result.radiance_sum) << name;
        EXPECT_GT(sum.y, 0) << name;
    }
}

TEST(Replay, EndsOnceItIsToldTo)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    const ReadyStrategy<float> ready(test.lit, parse_strategy("all/light"), kernels<float>(), 1);
    int asks = 0;
    const std::function<bool()> asked = [&] { return ++asks > 2; };  // of three draws
    EXPECT_THROW(replay(test.lit, ready, test.probes.tiles.at(0), test.probes.points[0], 7,
                        StopToken(&asked)),
                 Stopped);
}

TEST(Replay, StepsSayWhatEachStageDid)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    const ReadyStrategy<double> ready(test.lit, parse_strategy("uniform/light"), kernels<double>(),
                                      1);
    const Replay again = replay(test.lit, ready, test.probes.tiles.at(0), test.probes.points[0], 7);
    EXPECT_EQ(again.steps.front().stage, StageKind::rows);
    EXPECT_EQ(again.steps.back().stage, StageKind::add);
    EXPECT_EQ(again.steps.back().contribution, again.value);
    EXPECT_DOUBLE_EQ(again.steps.back().probability, 1.0 / 3);
}

/// What is no number is counted, left out, and the first one named.
TEST(InvalidSamples, AreNamed)
{
    std::array<ShadingPoint, 2> points{};
    points[0].id = 40, points[1].id = 47;
    const TileJob<float> job{.points = points};
    const auto batch = std::make_unique<Batch<float>>();
    batch->rows = batch->samples = 3;
    batch->tile_point = {0, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        batch->slot[i] = static_cast<std::int32_t>(i);
        batch->point[i] = i == 0 ? 0 : 1;
        batch->sample_number[i] = 500 + i;
        batch->contribution.put(static_cast<int>(i), Vec3<float>(1.0F));
    }
    batch->contribution.put(1, Vec3<float>(std::numeric_limits<float>::quiet_NaN()));
    batch->contribution.put(2, Vec3<float>(std::numeric_limits<float>::infinity()));
    kernels<float>().sums[1].add(job, *batch);
    EXPECT_EQ(batch->invalid, 2U);
    EXPECT_EQ(batch->first_invalid.point, 47U);
    EXPECT_EQ(batch->first_invalid.sample, 501U);
    EXPECT_EQ(batch->value.at(0), Vec3<double>(1));
    EXPECT_EQ(batch->value.at(1), Vec3<double>(0));
}

}  // namespace
}  // namespace mis
