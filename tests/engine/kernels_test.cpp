// Every instruction set and number type: the same samples, but for rounding.
#include "mis/engine/kernels.h"

#include "mis/bsdf/any_bsdf.h"
#include "mis/engine/light_columns.h"
#include "mis/policy/product.h"
#include "mis/sampling/random.h"

#include "tests/engine/bench.h"
#include "tests/policy/prepared.h"
#include "tests/support/irradiance.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

TEST(InstructionSets, HoldScalarAndOnlyWhatIsNamed)
{
    const auto sets = instruction_sets();
    ASSERT_FALSE(sets.empty());
    EXPECT_EQ(sets.back(), "scalar");
    for (const std::string_view set : sets) {
        EXPECT_EQ(kernels_of<float>(set).instruction_set, set);
        EXPECT_EQ(kernels_of<double>(set).instruction_set, set);
        EXPECT_EQ(kernels_of<float>(set).lanes == 1, set == "scalar");
    }
    EXPECT_EQ(&kernels_of<float>(""), &kernels_of<float>(sets.front()));
    EXPECT_THROW(kernels_of<float>("mmx"), std::runtime_error);
}

TEST(InstructionSets, EachHasEveryRegisteredChoice)
{
    for (const std::string_view set : instruction_sets()) {
        const Kernels<float>& kernels = kernels_of<float>(set);
        EXPECT_EQ(kernels.policies.size(), policy_names().size());
        EXPECT_EQ(kernels.heuristics.size(), heuristic_names().size());
        EXPECT_EQ(kernels.bsdfs.size(), 4U);
        std::size_t light_techniques = 0;
        for (const Choosable& technique : technique_names())
            light_techniques +=
                std::any_of(kernels.light_techniques.begin(), kernels.light_techniques.end(),
                            [&](const auto& k) { return k.name == technique.name; });
        EXPECT_EQ(kernels.light_techniques.size(), light_techniques);
        EXPECT_EQ(kernels.directions.size(),
                  (technique_names().size() - light_techniques) * kernels.bsdfs.size());
    }
}

/// One draw in 1e5 may fall on the other side of a border between two lights, two lobes, or a light
/// and none.
template <class T> void expect_agreement(std::string_view type, double tolerance)
{
    const Material material{.type = std::string(type),
                            .diffuse = {0.2, 0.1, 0.1},
                            .specular = {0.3, 0.5, 0.2},
                            .exponent = 40,
                            .alpha = 0.3};
    const TestScene test(probe_under(eclipse(), material));
    constexpr int samples = 2'003;  // no multiple of anything
    for (const Strategy& s : every_strategy()) {
        const Outcome usual =
            run_probe<double>(test, s, kernels_of<double>("scalar"), scaled(samples));
        for (const std::string_view set : instruction_sets()) {
            const Outcome found = run_probe<T>(test, s, kernels_of<T>(set), scaled(samples));
            EXPECT_NEAR(found.result.luminance.mean / usual.result.luminance.mean, 1, tolerance)
                << set << " " << name_of(s);
            EXPECT_NEAR(found.result.luminance.m2 / usual.result.luminance.m2, 1, 10 * tolerance)
                << set << " " << name_of(s);
            EXPECT_EQ(found.totals.invalid, 0U) << set << " " << name_of(s);
        }
    }
}

TEST(InstructionSets, AgreeInDouble)
{
    for (const char* type : {"lambert", "lecture", "blinn", "ggx"})
        expect_agreement<double>(type, 1e-12);
}

TEST(InstructionSets, AgreeWithDoubleInFloat)
{
    for (const char* type : {"lambert", "lecture", "blinn", "ggx"})
        expect_agreement<float>(type, 2e-4);
}

/// A light of each of some sizes and heights over the horizon, at distance 2 from
/// point_facing_up(): of such radiance that Y(L)·E is E/sin²θ_max.
struct LowLights {
    Lights lights;
    std::vector<double> weight, tolerance;

    /// smallest: below 1e-4 a float cannot tell how high a light is over the horizon.
    explicit LowLights(double smallest)
    {
        for (const double s : {smallest, 1e-4, 0.01, 0.1, 0.5, 0.7, 0.9, 0.99})
            for (const double height : {2.0, 0.9, 0.4, 0.0, -0.3, -0.7, -0.95}) {
                const double c = height * s;
                if (c >= 1) continue;
                lights.push_back(make_light({2 * std::sqrt(1 - c * c), 2 * c, 0}, 2 * s,
                                            Vec3<double>(1 / (s * s))));
                const double brightness = luminance_radius(lights.back());  // a float
                weight.push_back(brightness * s / 2 * exact_irradiance_over_sin2(s, c));
                // Near tangency more than 1e-5: places are floats.
                tolerance.push_back(2.5 * 4 / ((1 + height) * std::sqrt(1 - s * s)));
            }
    }
};

template <class T>
std::vector<T> probabilities_of(std::string_view policy, const TestScene& test,
                                const Kernels<T>& kernels)
{
    const Strategy strategy = parse_strategy(std::string(policy) + "/light");
    const ReadyStrategy<T> ready(test.lit, strategy, kernels, 1);
    TileJob<T> job = ready.job(test.probes.tiles.at(0), test.probes.points);
    LargeVector<T> storage;
    job.columns = fill_light_columns(test.scene.lights, job.origin, storage);
    const auto stages = *std::find_if(kernels.policies.begin(), kernels.policies.end(),
                                      [&](const auto& p) { return p.name == policy; });
    const std::size_t count = test.scene.lights.size();
    Scratch scratch(stages.table_bytes(count) + 64);
    const auto batch = std::make_unique<Batch<T>>();
    batch->points = 1, batch->tile_point = {0}, batch->rows = static_cast<int>(count);
    for (std::size_t i = 0; i < count; ++i)
        batch->point[i] = 0, batch->light[i] = static_cast<LightIndex>(i);
    stages.prepare(job, *batch, 0, scratch);
    stages.probability(job, *batch);
    return std::vector<T>(batch->probability.begin(),
                          batch->probability.begin() + static_cast<std::ptrdiff_t>(count));
}

/// Probabilities of the first lights at some points, whose tables are made `together` at a time.
template <class T>
std::vector<T> probabilities_at(std::span<const ShadingPoint> points, std::size_t together,
                                std::string_view policy, const TestScene& test,
                                const Kernels<T>& kernels)
{
    const ReadyStrategy<T> ready(test.lit, parse_strategy(std::string(policy) + "/light"), kernels,
                                 1);
    TileJob<T> job = ready.job(test.probes.tiles.at(0), points);
    LargeVector<T> storage;
    job.columns = fill_light_columns(test.scene.lights, job.origin, storage);
    const auto stages = *std::find_if(kernels.policies.begin(), kernels.policies.end(),
                                      [&](const auto& p) { return p.name == policy; });
    Scratch scratch(points.size() * stages.table_bytes(test.scene.lights.size()) + 64);
    const auto batch = std::make_unique<Batch<T>>();
    for (std::size_t p = 0; p < points.size(); ++p)
        batch->tile_point[p] = static_cast<std::uint32_t>(p);
    for (std::size_t first = 0; first < points.size(); first += together) {
        batch->points = std::min(first + together, points.size());
        stages.prepare(job, *batch, first, scratch);
    }
    std::vector<T> found;
    batch->rows = batch_capacity;
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (std::size_t i = 0; i < batch_capacity; ++i)
            batch->point[i] = static_cast<std::int32_t>(p),
            batch->light[i] = static_cast<LightIndex>(i);
        stages.probability(job, *batch);
        found.insert(found.end(), batch->probability.begin(),
                     batch->probability.begin() + batch_capacity);
    }
    return found;
}

/// Of so many lights that no weights are kept, points share a walk over the columns.
template <class T> void expect_the_same_tables_together_as_alone()
{
    Lights lights;
    for (int j = 0; j < 17'001; ++j)
        lights.push_back(make_light({(j % 131 - 65) * 0.1, 3 + j % 7, (j / 131 - 65) * 0.1}, 0.01,
                                    Vec3<double>(1 + j % 13)));
    const Material material{.type = "blinn", .exponent = 40};
    const TestScene test(probe_under(lights, material));
    std::vector<ShadingPoint> points(3, test.probes.points.at(0));
    points[1].x.x += 1.5, points[2].x.z -= 4;
    for (const std::string_view set : instruction_sets())
        for (const char* policy : {"solid-angle", "irradiance", "product"}) {
            const Kernels<T>& kernels = kernels_of<T>(set);
            const std::vector<T> alone = probabilities_at<T>(points, 1, policy, test, kernels);
            EXPECT_EQ(probabilities_at<T>(points, 3, policy, test, kernels), alone) << set;
            EXPECT_NE(
                std::vector<T>(alone.begin(), alone.begin() + batch_capacity),
                std::vector<T>(alone.begin() + batch_capacity, alone.begin() + 2 * batch_capacity));
            EXPECT_GT(*std::min_element(alone.begin(), alone.end()), 0);
        }
}
TEST(InstructionSets, PrepareSomePointsTogetherAsEachAlone)
{
    expect_the_same_tables_together_as_alone<float>();
    expect_the_same_tables_together_as_alone<double>();
}

template <class T> void expect_irradiances(const Kernels<T>& kernels)
{
    const LowLights low(std::is_same_v<T, float> ? 1e-3 : 1e-8);
    const TestScene test(probe_under(low.lights, grey_floor()));
    const std::vector<T> found = probabilities_of<T>("irradiance", test, kernels);
    double total = 0;
    for (const double w : low.weight) total += w;
    const double ulp = static_cast<double>(std::numeric_limits<T>::epsilon());
    for (std::size_t j = 0; j < found.size(); ++j)
        EXPECT_NEAR(static_cast<double>(found[j]) * total / low.weight[j], 1,
                    (std::is_same_v<T, float> ? 1e-5 : 1e-11) + ulp * low.tolerance[j])
            << j;
}

TEST(InstructionSets, WeighLightsCutByTheHorizonByTheirIrradiance)
{
    for (const std::string_view set : instruction_sets()) {
        SCOPED_TRACE(set);
        expect_irradiances(kernels_of<float>(set));
        expect_irradiances(kernels_of<double>(set));
    }
}

/// The view and the BSDF reach a policy that looks at them: a floor seen aslant, lobes of all
/// kinds.
template <class T> void expect_products(const Kernels<T>& kernels, const Material& material)
{
    Scene scene = probe_under(thirty_lights_one_dark(), material);
    scene.probes.at(0).outgoing =
        normalized(scene.probes.at(0).normal + Vec3<double>{0.9, 0.2, -0.4});
    const TestScene test(scene);
    const std::vector<T> found = probabilities_of<T>("product", test, kernels);
    const ShadingPoint& point = test.probes.points.at(0);
    const std::shared_ptr<const void> bsdf = make_bsdf(material);
    const Vec3<double> n = vec_cast<double>(point.n);
    const Prepared<ProductPolicy> known(test.scene.lights, point.x, n, point.x,
                                        vec_cast<double>(point.wo),
                                        {bsdf.get(), bsdf_number(material.type)});
    for (std::size_t j = 0; j < found.size(); ++j)
        EXPECT_NEAR(static_cast<double>(found[j]), known.probability(j),
                    (std::is_same_v<T, float> ? 1e-4 : 1e-6) * known.probability(j) + 1e-12)
            << material.type << " " << j;
}

TEST(InstructionSets, WeighLightsByWhatTheSurfaceReflectsOfThem)
{
    for (const char* type : {"lambert", "lecture", "blinn", "ggx"}) {
        const Material material{.type = type,
                                .diffuse = Vec3<double>(0.05),
                                .specular = Vec3<double>(0.5),
                                .exponent = 60,
                                .alpha = 0.2};
        for (const std::string_view set : instruction_sets()) {
            SCOPED_TRACE(set);
            expect_products(kernels_of<float>(set), material);
            expect_products(kernels_of<double>(set), material);
        }
    }
}

/// What `mis replay` and any other part of the work recompute: seed, point, sample, draw and block
/// say it all. 77 rows as after a compaction, runs of `run` of a point; from `start` on.
template <class T>
void expect_numbers_of_the_counter(const Kernels<T>& kernels, std::size_t run, std::uint64_t start)
{
    std::array<ShadingPoint, 3> points{};
    for (std::size_t p = 0; p < 3; ++p) points[p].id = static_cast<std::uint32_t>(40 + 7 * p);
    const TileJob<T> job{.points = points, .numbers = 0x1234'5678'9abc};
    const auto batch = std::make_unique<Batch<T>>();
    batch->rows = 77, batch->draw = 3;
    for (std::size_t i = 0; i < 77; ++i) {
        const std::size_t slot = 76 - i;
        batch->slot[i] = static_cast<std::int32_t>(slot);
        batch->point[i] = static_cast<std::int32_t>(i / run % 3);
        batch->sample_number[slot] = start + slot;
    }
    batch->tile_point = {2, 0, 1};
    const auto words = [&](std::size_t i, Block block) {
        const std::uint32_t id = points[batch->tile_point[i / run % 3]].id;
        return random_words(job.numbers.seed, {id, start + 76 - i, 3}, block);
    };
    kernels.light_numbers(job, *batch);
    for (std::size_t i = 0; i < 77; ++i) {
        const Words w = words(i, Block::light);
        ASSERT_EQ(batch->bits[i], choice_bits(w)) << i;
        ASSERT_EQ(batch->u[i], unit_number<T>(w[2])) << i;
        ASSERT_EQ(batch->v[i], unit_number<T>(w[3])) << i;
    }
    kernels.bsdf_numbers(job, *batch);
    for (std::size_t i = 0; i < 77; ++i) {
        const Words w = words(i, Block::bsdf);
        ASSERT_EQ(batch->lobe[i], unit_number<T>(w[1])) << i;
        ASSERT_EQ(batch->u[i], unit_number<T>(w[2])) << i;
        ASSERT_EQ(batch->v[i], unit_number<T>(w[3])) << i;
    }
}

TEST(InstructionSets, NumbersAreThoseOfTheCounter)
{
    constexpr std::uint64_t upper = std::uint64_t{5} << 32;
    for (const std::string_view set : instruction_sets())
        for (const std::size_t run : {1U, 6U, 16U})
            for (const std::uint64_t start : {std::uint64_t{0}, upper, upper - 40}) {
                SCOPED_TRACE(std::string(set) + ", runs of " + std::to_string(run) + " from " +
                             std::to_string(start));
                expect_numbers_of_the_counter(kernels_of<float>(set), run, start);
                expect_numbers_of_the_counter(kernels_of<double>(set), run, start);
            }
}

}  // namespace
}  // namespace mis
