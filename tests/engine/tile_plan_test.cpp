// What a tile's plan leaves out changes no bit of a result; a plan whose proofs are 1 % too small
// is found out.
#include "mis/trace/embree.h"

#include "tests/engine/bench.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <cstring>

namespace mis {
namespace {

struct Ball {
    Vec3<double> center;
    double radius;
};

Vec3<double> beside(const Vec3<double>& direction, Uniforms& uniforms)
{
    return normalized(cross(direction, uniforms.direction()));
}

/// A ball that reaches into the way from `from` to the rim of a light, or stays off it, by some
/// thousandths of its radius: the hardest there is for a test of all ways between.
Ball grazing_ball(const Vec3<double>& from, const Light& light, Uniforms& uniforms)
{
    const Vec3<double> to_center = light.center - from;
    const Vec3<double> rim = beside(to_center, uniforms) * light.radius;
    const double share = uniforms.between(0.3, 0.9);
    const Vec3<double> way = (to_center + rim) * share;
    const double radius = light.radius * uniforms.log_between(0.1, 3);
    const Vec3<double> out = normalized(rim - way * (dot(rim, way) / length2(way)));
    const double reach = share * light.radius * uniforms.between(-0.001, 0.009);
    return {from + way + out * (radius - reach), radius};
}

/// Of each kind that leaves something out, and of each that does not: with and without a lobe, a
/// black one, and colours.
Material random_material(Uniforms& uniforms)
{
    const auto rgb = [&] {
        const double grey = uniforms.between(0.1, 0.9);
        return uniforms() < 0.5 ? Vec3<double>(grey) : Vec3<double>(grey, 0.5, 0.3);
    };
    Material material = grey_floor();
    material.diffuse = rgb();
    const double kind = uniforms();
    if (kind < 0.5) return material;
    material.type = "blinn", material.exponent = 20;
    if (kind < 0.75) material.specular = rgb();
    return material;
}

/// A small piece of floor or ball, seen from near by, under a few lights, among surfaces that
/// touch, graze, hold or hide them.
Scene random_scene(Uniforms& uniforms)
{
    Scene scene;
    const double size = uniforms.log_between(0.003, 1);
    scene.camera = Camera{.position = {0, 3, 1},
                          .target = {0, 0, 0},
                          .vertical_fov_degrees = 10 * size,
                          .resolution = {8, 8}};
    scene.materials = {random_material(uniforms)};
    const bool is_coloured = uniforms() < 0.3;
    if (uniforms() < 0.8)
        scene.surfaces.push_back(
            {Quad{{-9, 0, -9}, {Vec3<double>{0, 0, 18}, Vec3<double>{18, 0, 0}}}, 0});
    else scene.surfaces.push_back({SphereSurface{{0, -1, 0}, 1}, 0});
    const int lights = 1 + uniforms.below(5);
    for (int j = 0; j < lights; ++j) {
        const double radius = uniforms.log_between(0.03, 1);
        Vec3<double> center = uniforms.in_box(3);
        if (uniforms() < 0.7) center.y = std::abs(center.y) + radius;
        if (uniforms() < 0.2) center.y = radius * std::array{-1.0, 1.0, 1.001}[uniforms.below(3)];
        if (length(center) < radius + 0.2) center += Vec3<double>(0, radius + 0.2, 0);
        Light light = make_light(center, radius, Vec3<double>(1));
        if (j > 0 && uniforms() < 0.5) {  // it grazes the way to the one before
            const Ball ball = grazing_ball({0, 0, 0}, scene.lights.back(), uniforms);
            light = make_light(ball.center, ball.radius, Vec3<double>(1));
        }
        if (is_coloured) light.radiance_radius.y *= 0.5F;
        scene.lights.push_back(light);
    }
    for (int k = uniforms.below(4); k > 0; --k) {
        const Light& light = scene.lights[static_cast<std::size_t>(uniforms.below(lights))];
        if (uniforms() < 0.6) {
            const Ball ball = grazing_ball({0, 0, 0}, light, uniforms);
            scene.surfaces.push_back({SphereSurface{ball.center, ball.radius}, 0});
        } else {
            const Vec3<double> corner = light.center * uniforms.between(0.3, 1.5);
            const Vec3<double> edge = uniforms.direction() * uniforms.log_between(0.1, 4);
            scene.surfaces.push_back({Quad{corner, {edge, beside(edge, uniforms) * 1.5}}, 0});
        }
    }
    return scene;
}

/// The results of a tile's points by one strategy, as the tile's plan says.
std::vector<PointResult> results_of(const LitScene& lit, const GBuffer& shading, const Tile& tile,
                                    const char* strategy, int samples)
{
    const ReadyStrategy<float> ready(lit, parse_strategy(strategy), kernels<float>(), 7);
    std::vector<PointResult> results(tile.count);
    Workspace<float> workspace;
    workspace.run(ready.job(tile, std::span(shading.points).subspan(tile.first, tile.count)),
                  ready.pipeline(tile), {.chunk = samples, .chunks = 1}, results, {}, {});
    return results;
}

bool same_bits(const std::vector<PointResult>& a, const std::vector<PointResult>& b)
{
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(PointResult)) == 0;
}

/// With lights 1 % smaller: all that lies between, but thinner.
TilePlan plan_of_a_shaft_too_small(const LitScene& lit, const Vec3<double>& frame,
                                   std::span<const ShadingPoint> points)
{
    Scene smaller = lit.scene();
    for (Light& light : smaller.lights) light.radius *= 0.99;
    const LightHierarchy hierarchy(smaller.lights);
    TilePlan plan = TilePlanner(smaller, hierarchy, lit.effects(), frame).plan(points);
    plan.blockers = nullptr;  // they would ask lights that are gone
    return plan;
}

struct Tally {
    int tiles = 0, differ = 0, leaner = 0;
    int proved_shadows = 0, proved_lights = 0, below_all = 0;
    EffectShares called_for;  ///< sums over scenes
};

constexpr std::array strategies{"uniform/power",
                                "solid-angle/light",
                                "all/balance",
                                "radiant-solid-angle/maximum/union",
                                "uniform/balance/one-sample",
                                "brdf"};

/// Every tile of random scenes, with everything and with its plan, until `most` of them differ;
/// plan(lit, frame, points).
template <class Plan> Tally compare_plans(int scenes, int most, const Plan& plan)
{
    const AnyExecutor serial = any_executor(SerialExecutor{});
    Tally tally;
    Uniforms uniforms(61);
    for (int k = 0; k < scenes && tally.differ < most; ++k) {
        const Scene scene = random_scene(uniforms);
        const EmbreeTracer tracer(scene);
        const LitScene everything(scene, &tracer, all_effects(scene)),
            planned(scene, &tracer, called_for(scene));
        const GBuffer shading = find_shading_points(scene, planned.lights(), &tracer, 0, 8, serial);
        GBuffer with_plans = shading;
        planned.plan(with_plans, serial);
        tally.called_for.add(planned.tiles_that_call(with_plans).of(with_plans.tiles.size()));
        for (Tile tile : shading.tiles) {
            const auto points = std::span(shading.points).subspan(tile.first, tile.count);
            const char* strategy = strategies[static_cast<std::size_t>(k) % strategies.size()];
            const auto expected = results_of(everything, shading, tile, strategy, 64);
            tile.plan = plan(planned, tracer.origin(), points);
            const auto found = results_of(planned, shading, tile, strategy, 64);
            ++tally.tiles;
            tally.differ += same_bits(expected, found) ? 0 : 1;
            const EffectSet simulated = tile.plan.effects;
            tally.leaner +=
                simulated.has(Effect::shadows) && simulated.has(Effect::light_occlusion) ? 0 : 1;
            for (const std::uint8_t proofs : tile.plan.lights) {
                tally.below_all += (proofs & below) != 0 ? 1 : 0;
                if ((proofs & below) != 0) continue;
                tally.proved_shadows += (proofs & unshadowed) != 0 ? 1 : 0;
                tally.proved_lights += (proofs & unhidden) != 0 ? 1 : 0;
            }
        }
    }
    return tally;
}

TEST(TilePlans, ChangeNoBitOnRandomScenes)
{
    const Tally tally = compare_plans(
        scaled(1000), 1,
        [](const LitScene& lit, const auto& frame, std::span<const ShadingPoint> points) {
            return TilePlanner(lit.scene(), lit.lights(), lit.effects(), frame).plan(points);
        });
    EXPECT_EQ(tally.differ, 0);
    EXPECT_GT(tally.tiles, scaled(800));
    EXPECT_GT(tally.leaner, scaled(200));
    EXPECT_GT(tally.proved_shadows, scaled(500));
    EXPECT_GT(tally.proved_lights, scaled(500));
    EXPECT_GT(tally.below_all, scaled(50));
    for (const Effect effect : EffectSet::all()) {
        const double share = tally.called_for[effect];
        EXPECT_GT(share, scaled(100)) << name_of(effect);  // left out of many, and not of many
        EXPECT_LT(share, scaled(950)) << name_of(effect);
    }
}

TEST(TilePlans, OfAShaftTooSmallByAPercentAreFoundOut)
{
    EXPECT_GT(compare_plans(3000, 1, plan_of_a_shaft_too_small).differ, 0);
}

TEST(EffectShares, OfAllTilesAreExactly1)
{
    for (std::size_t tiles = 1; tiles < 300; ++tiles) {
        EffectShares counts;
        for (std::size_t t = 0; t < tiles; ++t) counts.add(EffectSet::all());
        for (const Effect effect : EffectSet::all())
            EXPECT_EQ(counts.of(tiles)[effect], 1) << tiles;
    }
}

TEST(TilePlans, ThatLeaveOutAHorizonInTheWayAreFoundOut)
{
    const auto without_horizon = [](const LitScene& lit, const auto& frame,
                                    std::span<const ShadingPoint> points) {
        TilePlan plan = TilePlanner(lit.scene(), lit.lights(), lit.effects(), frame).plan(points);
        plan.effects.set(Effect::horizon, false);
        return plan;
    };
    EXPECT_GT(compare_plans(300, 1, without_horizon).differ, 0);
}

TEST(TilePlans, OfFloorUnderLightsTraceNothing)
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    scene.surfaces = {{Quad{{-9, 0, -9}, {Vec3<double>{0, 0, 18}, Vec3<double>{18, 0, 0}}}, 0}};
    const EmbreeTracer tracer(scene);
    const TestScene test(scene, &tracer);
    GBuffer probes = test.probes;
    test.lit.plan(probes, any_executor(SerialExecutor{}));
    EXPECT_FALSE(probes.tiles.at(0).plan.effects.has(Effect::shadows));
    EXPECT_FALSE(probes.tiles.at(0).plan.effects.has(Effect::light_occlusion));
    const ReadyStrategy<float> ready(test.lit, parse_strategy("uniform/power"), kernels<float>(),
                                     1);
    for (const NamedStage<float>& stage : ready.pipeline(probes.tiles[0]).light)
        EXPECT_NE(stage.kind, StageKind::rays);
    for (const NamedStage<float>& stage : ready.pipeline(probes.tiles[0]).light)
        EXPECT_NE(stage.kind, StageKind::light_occlusion);
}

/// What is drawn below the floor is worth nothing, so the floor hides nothing of a light that it
/// cuts; but of a light that a tilted point sees beyond the floor's far end it may.
TEST(TilePlans, OfAFloorThatCutsALightTraceNothingUnlessThePointIsTilted)
{
    Scene scene = probe_under({make_light({3, 0.2, 0}, 0.5, Vec3<double>(1))}, grey_floor());
    scene.surfaces = {{Quad{{-9, 0, -9}, {Vec3<double>{0, 0, 18}, Vec3<double>{18, 0, 0}}}, 0}};
    for (const double tilt : {0.0, 1e-3}) {
        scene.probes[0].normal = normalized(Vec3<double>{tilt, 1, 0});
        const EmbreeTracer tracer(scene);
        const TestScene test(scene, &tracer);
        GBuffer probes = test.probes;
        test.lit.plan(probes, any_executor(SerialExecutor{}));
        EXPECT_EQ(probes.tiles.at(0).plan.effects.has(Effect::shadows), tilt > 0) << tilt;
    }
}

}  // namespace
}  // namespace mis
