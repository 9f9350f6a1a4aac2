// The scalar call against the pipeline, with the same random numbers, sample by sample.
#include "mis/engine/direct.h"

#include "mis/bsdf/framed.h"
#include "mis/bsdf/registry.h"
#include "mis/engine/replay.h"
#include "mis/heuristic/registry.h"
#include "mis/policy/registry.h"
#include "mis/sampling/random.h"
#include "mis/technique/registry.h"
#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <limits>

namespace mis {
namespace {

constexpr std::uint64_t seed = 1;

/// Lights of all sizes, some before others, and a ball before some of them.
Scene crowded_scene(const Material& material)
{
    Lights lights = thirty_lights_one_dark();
    for (const Light& light : eclipse()) lights.push_back(light);
    Scene scene = probe_under(lights, material);
    scene.surfaces.push_back({SphereSurface{{0.3, 1, 0.2}, 0.25}, 0});
    return scene;
}

/// The pipeline's numbers of a sample's draw.
DirectNumbers<double> numbers_of(std::uint64_t sample, int draw)
{
    const Counter counter{0, sample, static_cast<std::uint32_t>(draw)};
    const Words light = random_words(seed, counter, Block::light),
                bsdf = random_words(seed, counter, Block::bsdf);
    const auto u = [](std::uint32_t word) { return unit_number<double>(word); };
    return {choice_bits(light), {u(light[2]), u(light[3])}, u(bsdf[1]), {u(bsdf[2]), u(bsdf[3])}};
}

/// The host's side of a scene's first probe.
struct Host {
    const TestScene& test;
    const ShadingPoint& point = test.probes.points.at(0);

    bool operator()(const Vec3<double>& wi, double distance) const
    {
        const ShadowRay ray{point.ray_origin, vec_cast<float>(wi), static_cast<float>(distance)};
        std::uint8_t hidden = 0;
        test.lit.surfaces()->occluded({&ray, 1}, {&hidden, 1});
        return hidden != 0;
    }
};

Vec3<double> by_pipeline(const Host& host, const std::string& name, std::uint64_t sample)
{
    const ReadyStrategy<double> ready(host.test.lit, parse_strategy(name),
                                      kernels_of<double>("scalar"), seed);
    return replay(host.test.lit, ready, host.test.probes.tiles.at(0), host.point, sample).value;
}

void expect_same(const Vec3<double>& direct, const Vec3<double>& pipeline, const std::string& name,
                 std::uint64_t sample)
{
    EXPECT_LE(length(direct - pipeline), 1e-9 * length(pipeline))
        << name << ", sample " << sample << ": " << direct.x << " and " << pipeline.x;
}

constexpr std::uint64_t samples = 24;

template <class Policy, class Heuristic, class Technique>
void expect_the_pipelines_samples(const DirectPoint<Policy, double>& point, const auto& bsdf,
                                  const Host& host)
{
    const std::string name = std::string(Policy::name) + '/' + std::string(Heuristic::name) +
                             (Technique::name == "cone" ? "" : '/' + std::string(Technique::name));
    const bool is_alone = Heuristic::name == "light";
    for (std::uint64_t k = 0; k < samples; ++k) {
        const auto numbers = [&](int draw) { return numbers_of(k, draw); };
        expect_same(
            sample_direct<Heuristic, Technique>(point, bsdf, host, numbers, 1, !is_alone).radiance,
            by_pipeline(host, name, k), name, k);
        if (is_alone) continue;
        expect_same(sample_direct<Heuristic, Technique>(point, bsdf, host, numbers, 3, 2).radiance,
                    by_pipeline(host, name + "@3+2", k), name + "@3+2", k);
        if constexpr (!Policy::draws_every_light) {
            const double technique =
                unit_number<double>(random_words(seed, {0, k, 0}, Block::bsdf)[0]);
            expect_same(
                sample_direct_once<Heuristic, Technique>(point, bsdf, host, technique, numbers(0))
                    .radiance,
                by_pipeline(host, name + "/one-sample", k), name + "/one-sample", k);
        }
    }
}

/// Every policy × heuristic × light technique on one BSDF.
template <class B> void expect_the_pipelines_samples_of(const Material& material)
{
    Scene scene = crowded_scene(material);
    const AnalyticTracer tracer(scene);
    const TestScene test(scene, &tracer);
    const Host host{test};
    const B own(material);
    const auto n = vec_cast<double>(host.point.n), wo = vec_cast<double>(host.point.wo);
    const FramedBsdf<B, double> bsdf(own, n, wo);
    for_each_type(Policies{}, [&]<class Policy>() {
        const DirectLights<Policy, double> lights(scene.lights);
        DirectPoint<Policy, double> point(lights);
        point.move_to(host.point.x, n, wo, any_bsdf(own));
        ASSERT_TRUE(point.is_lit());
        for_each_type(Heuristics{}, [&]<class Heuristic>() {
            for_each_type(Techniques{}, [&]<class Technique>() {
                if constexpr (Technique::chooses_light)
                    expect_the_pipelines_samples<Policy, Heuristic, Technique>(point, bsdf, host);
            });
        });
    });
}

TEST(Direct, GivesThePipelinesSamplesOnLambert)
{
    expect_the_pipelines_samples_of<Lambert>(grey_floor());
}

TEST(Direct, GivesThePipelinesSamplesOnAGlossyLobe)
{
    Material material;
    material.type = "blinn", material.diffuse = Vec3<double>(0.2);
    material.specular = {0.5, 0.4, 0.3}, material.exponent = 30;
    expect_the_pipelines_samples_of<Blinn>(material);
}

/// A host's BSDF with a choice of faults.
struct Faulty {
    double f = 0.3, density = 0.2;
    Vec3<float> wi{0, 1, 0};
    Vec3<float> evaluate(const Vec3<float>&) const { return Vec3<float>(static_cast<float>(f)); }
    float pdf(const Vec3<float>&) const { return static_cast<float>(density); }
    Vec3<float> sample(float, const Vec2<float>&) const { return wi; }
};

DirectSample<float> sample_of(const Lights& lights, const Faulty& bsdf,
                              const Vec3<double>& x = Vec3<double>(0))
{
    const DirectLights<PowerPolicy> ready(lights);
    DirectPoint<PowerPolicy> point(ready);
    point.move_to(x, {0, 1, 0});
    const auto never = [](const Vec3<float>&, float) { return false; };
    const auto middle = [](int) {
        return DirectNumbers<float>{1ULL << 63, {0.5F, 0.5F}, 0.5F, {0.5F, 0.5F}};
    };
    return sample_direct<BalanceHeuristic, ConeTechnique>(point, bsdf, never, middle);
}

const Lights overhead{make_light({0, 2, 0}, 0.5, Vec3<double>(3))};

TEST(Direct, CountsWhatIsNotFiniteAndLeavesItOut)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(sample_of(overhead, {}).invalid, 0);
    EXPECT_GT(sample_of(overhead, {}).radiance.y, 0);
    const DirectSample<float> of_nan = sample_of(overhead, {.f = nan});
    EXPECT_EQ(of_nan.invalid, 2);
    EXPECT_EQ(of_nan.radiance, Vec3<float>(0));
    EXPECT_EQ(sample_of(overhead, {.f = infinity}).invalid, 2);
}

TEST(Direct, ADensityOf0OrInfinityLeavesOneTechnique)
{
    // Both draws go straight up the middle, so each technique alone gives f · L/pdf.
    const float by_light =
        0.3F * 3 *
        static_cast<float>(cap_of_sphere<double>({0, 2, 0}, 0.5, Vec3<double>(0)).solid_angle());
    EXPECT_NEAR(sample_of(overhead, {.density = 0}).radiance.y / by_light, 1, 0.02);
    const DirectSample<float> infinite =
        sample_of(overhead, {.density = std::numeric_limits<double>::infinity()});
    EXPECT_EQ(infinite.invalid, 0);
    EXPECT_EQ(infinite.radiance.y, 0);
}

TEST(Direct, LightsNothingWhereNothingCanBeLit)
{
    EXPECT_EQ(sample_of({}, {}).radiance, Vec3<float>(0));
    EXPECT_EQ(sample_of(overhead, {}, {0, 2, 0.1}).radiance, Vec3<float>(0));  // inside the light
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(sample_of(overhead, {}, {nan, 0, 0}).radiance, Vec3<float>(0));
    EXPECT_EQ(sample_of(overhead, {.wi = {0, -1, 0}}).invalid, 0);  // a lost draw
}

TEST(Direct, OtherLightsAreAsThoughNewlyMade)
{
    for_each_type(Policies{}, [&]<class Policy>() {
        Lights lights = thirty_lights_one_dark();
        DirectLights<Policy> changed(overhead), recolored(lights);
        DirectPoint<Policy> a(changed);  // made for one light
        changed.assign(lights);
        lights[1] = make_light(lights[1].center, lights[1].radius, {9, 1, 2});
        recolored.recolor(1, {9, 1, 2});
        changed.recolor(1, {9, 1, 2});
        const DirectLights<Policy> fresh(lights);
        DirectPoint<Policy> b(recolored), c(fresh);
        for (auto* point : {&a, &b, &c}) point->move_to(Vec3<double>(0), {0, 1, 0});
        for (LightIndex j = 0; j < 30; ++j) {
            EXPECT_EQ(a.probability(j), c.probability(j)) << Policy::name;
            EXPECT_EQ(b.probability(j), c.probability(j)) << Policy::name;
        }
    });
}

}  // namespace
}  // namespace mis
