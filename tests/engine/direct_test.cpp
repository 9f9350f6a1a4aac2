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
#include "tests/support/ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

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

/// A BSDF at a point, whatever its type.
struct AnyHostBsdf {
    std::function<Vec3<double>(const Vec3<double>&)> evaluate;
    std::function<double(const Vec3<double>&)> pdf;
    std::function<Vec3<double>(double, const Vec2<double>&)> sample;
};

template <class B> AnyHostBsdf any_host_bsdf(const FramedBsdf<B, double>& b)
{
    return {[b](const auto& wi) { return b.evaluate(wi); },
            [b](const auto& wi) { return b.pdf(wi); },
            [b](double lobe, const auto& u) { return b.sample(lobe, u); }};
}

template <class Heuristic, class Technique, class Point>
void expect_the_pipelines_samples(const Point& point, std::string_view policy, const auto& bsdf,
                                  const Host& host)
{
    const std::string name = std::string(policy) + '/' + std::string(Heuristic::name) +
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
        if constexpr (!requires { requires Point::draws_every_light(); }) {
            if (point.draws_every_light()) continue;
            const double technique =
                unit_number<double>(random_words(seed, {0, k, 0}, Block::bsdf)[0]);
            expect_same(
                sample_direct_once<Heuristic, Technique>(point, bsdf, host, technique, numbers(0))
                    .radiance,
                by_pipeline(host, name + "/one-sample", k), name + "/one-sample", k);
        }
    }
}

/// Every heuristic × light technique, compiled for all policies and BSDFs.
void expect_the_pipelines_samples_of_all(const AnyDirectPoint<double>& point,
                                         std::string_view policy, const AnyHostBsdf& bsdf,
                                         const Host& host)
{
    for_each_type(Heuristics{}, [&]<class Heuristic>() {
        for_each_type(Techniques{}, [&]<class Technique>() {
            if constexpr (Technique::chooses_light)
                expect_the_pipelines_samples<Heuristic, Technique>(point, policy, bsdf, host);
        });
    });
}

/// Every policy × heuristic × light technique on one BSDF; and every policy compiled into the
/// draws.
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
        expect_the_pipelines_samples_of_all(AnyDirectPoint<double>(point), Policy::name,
                                            any_host_bsdf(bsdf), host);
        expect_the_pipelines_samples<BalanceHeuristic, UnionTechnique>(point, Policy::name, bsdf,
                                                                       host);
    });
}

/// A host's draw towards a lamp half in the floor, at the ends of its numbers.
template <class Heuristic, class T>
void expect_no_draw_lost(const Vec3<double>& up, const DirectCounts<T>& counts, bool is_constant)
{
    const Frame<double> around = frame_around(up);
    const Vec3<double> center = around.x * 2.0 + up * 0.2;
    const DirectLights<PowerPolicy, T> lights({make_light(center, 0.5, Vec3<double>(7))});
    DirectPoint<PowerPolicy, T> point(lights);
    const auto n = vec_cast<T>(up);
    point.move_to(Vec3<double>(0), n);
    const Lambert white(grey_floor());
    const FramedBsdf<Lambert, T> bsdf(white, n, n);
    const auto nothing = [](const Vec3<T>&, T) { return false; };
    const Cap<T> cap = point.cap(0);
    const double answer = 0.5 / pi<double> * 7 * 0.5 / static_cast<double>(cap.distance) *
                          static_cast<double>(cap.sin_max) *
                          static_cast<double>(irradiance_over_sin2(tilted(cap, n)));
    for (const Vec2<T>& u : ends_of_square<T>(32, 2)) {
        const DirectDraw<T> draw = draw_towards<Heuristic, ProjectedTechnique>(
            point, bsdf, nothing, Choice{0, 1}, u, counts);
        const auto found = static_cast<double>(draw.radiance.x) / answer;
        ASSERT_GT(dot(n, draw.wi), 0) << u.x << ", " << u.y;
        ASSERT_TRUE(found > 0 && found < 1.001) << u.x << ", " << u.y << ": " << found;
        if (!is_constant) continue;
        ASSERT_NEAR(found, 1, 16 * static_cast<double>(std::numeric_limits<T>::epsilon()))
            << u.x << ", " << u.y;
    }
}

TEST(Direct, LosesNoProjectedDrawAtTheHorizon)
{
    const Vec3<double> tilt = normalized(Vec3<double>{0.3, -0.5, 0.8});
    for (const Vec3<double>& up : {Vec3<double>{0, 0, 1}, tilt}) {
        expect_no_draw_lost<SingleHeuristic, float>(up, {1, 0}, true);
        expect_no_draw_lost<SingleHeuristic, double>(up, {1, 0}, true);
        expect_no_draw_lost<BalanceHeuristic, float>(up, {1, 1}, false);
        expect_no_draw_lost<PowerHeuristic, double>(up, {1, 1}, false);
    }
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

using CapTechniques = TypeList<ConeTechnique, UnionTechnique, ProjectedTechnique>;

/// Each way in which a host may lie, under every policy and technique: some light or none, never a
/// number that is none, and what makes no sense is counted. (Debug builds assert what is a lie
/// beyond doubt.)
TEST(Direct, ALyingHostIsCountedAndNeverBelieved)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const float bad = std::numeric_limits<float>::quiet_NaN();
    const Faulty no_direction{.wi = {bad, bad, bad}}, no_density{.density = nan};
    EXPECT_EQ(sample_of(overhead, no_direction).invalid, 1);
    EXPECT_GT(sample_of(overhead, no_direction).radiance.y, 0);  // of the light draw
    EXPECT_EQ(sample_of(overhead, no_density).invalid, 2);
    EXPECT_EQ(sample_of(overhead, {}, {nan, 0, 0}).invalid, 1);
    for_each_type(Policies{}, [&]<class Policy>() {
        for_each_type(CapTechniques{}, [&]<class Technique>() {
            for (const Lights& lights : {Lights(), overhead, thirty_lights_one_dark()}) {
                const DirectLights<Policy> ready(lights);
                DirectPoint<Policy> point(ready);
                point.move_to(Vec3<double>(0, -0.01, 0), {0, 1, 0});
                const auto numbers = [&](int k) {
                    return DirectNumbers<float>{
                        k % 2 == 0 ? ~0ULL : 0, {bad, bad}, bad, {bad, bad}};
                };
                int calls = 0;
                const auto changes_its_mind = [&](const Vec3<float>&, float) {
                    return ++calls % 2 == 0;
                };
                for (const Faulty& faulty :
                     {no_direction, no_density, Faulty{.f = nan}, Faulty{}}) {
                    const auto sample = sample_direct<BalanceHeuristic, Technique>(
                        point, faulty, changes_its_mind, numbers, 2, 2);
                    EXPECT_TRUE(std::isfinite(sample.radiance.y)) << Policy::name;
                    if (!lights.empty()) EXPECT_GT(sample.invalid, 0) << Policy::name;
                    else EXPECT_EQ(sample.invalid, faulty.wi.x == faulty.wi.x ? 0 : 2);
                }
            }
        });
    });
}

TEST(DirectDeathTest, DebugBuildsNameTheArgumentThatIsALie)
{
    EXPECT_DEBUG_DEATH(sample_of(overhead, {.density = -1}), "bsdf.pdf: not negative");
    EXPECT_DEBUG_DEATH(sample_of(overhead, {.wi = {0, 2, 0}}), "bsdf.sample: a unit vector");
    const DirectLights<UniformPolicy> ready(overhead);
    DirectPoint<UniformPolicy> point(ready);
    EXPECT_DEBUG_DEATH(point.move_to(Vec3<double>(0), {0, 2, 0}), "n: a unit vector");
    point.move_to(Vec3<double>(0), {0, 1, 0});
    EXPECT_DEBUG_DEATH((draw_towards<BalanceHeuristic, ConeTechnique>(
                           point, Faulty{}, [](const Vec3<float>&, float) { return false; }, {0, 1},
                           {2, 0}, DirectCounts<float>{})),
                       "numbers.cap: in");
    DirectLights<UniformPolicy> changing(overhead);
#ifndef NDEBUG
    EXPECT_DEATH(changing.replace(1, overhead[0]), "j: an index of a light");
#else
    const float far = std::numeric_limits<float>::infinity();
    EXPECT_EQ(sample_of(overhead, {.density = -1}).invalid, 2);
    EXPECT_EQ(sample_of(overhead, {.wi = {far, far, far}}).invalid, 1);
#endif
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

/// A policy that counts how often its tables were made.
template <class Policy> struct Counted : Policy {
    static inline int made = 0;
    explicit Counted(const Lights& lights) : Policy(lights) { ++made; }
};

/// What a point has to say of thirty lights: their probabilities, and what it draws. Apart, since
/// GCC 12 sees the point's table as unset where it is inlined.
template <class Point> [[gnu::noinline]] std::vector<double> answers_of(const Point& point)
{
    std::vector<double> answers;
    for (LightIndex j = 0; j < 30; ++j) answers.push_back(point.probability(j));
    for (std::uint64_t i = 0; i < 100; ++i)
        answers.push_back(point.choose(i * 0x9e3779b97f4a7c15).light);
    return answers;
}

/// Each change of one light in turn, of lights whose medians, and so whose origin, stay.
TEST(Direct, AReplacedLightIsAsThoughAllWereNewlyMade)
{
    for_each_type(Policies{}, [&]<class Policy>() {
        Lights lights = thirty_lights_one_dark();
        DirectLights<Counted<Policy>, double> changed(lights);
        const auto far = static_cast<LightIndex>(  // beyond the median on each axis
            std::max_element(lights.begin(), lights.end(),
                             [](const Light& a, const Light& b) {
                                 return a.center.x + a.center.y < b.center.x + b.center.y;
                             }) -
            lights.begin());
        const Light old = lights[static_cast<std::size_t>(far)];
        const Vec3<double> moved = old.center + Vec3<double>(0.3, 0.2, 0), white(7);
        const std::string name(Policy::name);
        const bool of_power = name == "power" || name == "tree";
        struct Change {
            Light light;
            bool makes_tables;
        };
        for (const Change& change :
             {Change{make_light(moved, old.radius, radiance(old)), name == "tree"},
              Change{make_light(moved, old.radius, white), of_power},
              Change{make_light(moved, 2 * old.radius, white), of_power},
              Change{make_light(moved, 40, white), of_power},  // the largest
              Change{old, of_power}}) {
            lights[static_cast<std::size_t>(far)] = change.light;
            const int before = Counted<Policy>::made;
            changed.replace(far, change.light);
            EXPECT_EQ(Counted<Policy>::made - before, change.makes_tables ? 1 : 0) << name;
            const DirectLights<Policy, double> fresh(lights);
            ASSERT_EQ(changed.origin(), fresh.origin());
            DirectPoint<Counted<Policy>, double> a(changed);
            DirectPoint<Policy, double> b(fresh);
            const Vec3<double> x{-50, -1, 2};
            a.move_to(x, {0, 1, 0}), b.move_to(x, {0, 1, 0});
            ASSERT_TRUE(b.is_lit());
            EXPECT_EQ(answers_of(a), answers_of(b)) << name;
            for (const Light& light : lights) {
                const Vec3<double> wi = normalized(light.center - x);
                EXPECT_EQ(changed.hierarchy().nearest(x, wi).light,
                          fresh.hierarchy().nearest(x, wi).light);
            }
        }
    });
}

}  // namespace
}  // namespace mis
