// One sphere of fixed power over a floor: Φ·cosθ/(4π d²) · albedo/π whatever its radius, by
// Gauss–Legendre nodes put through the pipeline in place of random numbers.
#include "tests/engine/bench.h"
#include "tests/support/irradiance.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

constexpr int side = 16;  ///< nodes either way; 16 × 16 fill a batch
static_assert(side * side == batch_capacity);

const UnitNodes<side>& rule()
{
    static const UnitNodes<side> nodes;
    return nodes;
}

/// Sample s takes node (s mod 16, s div 16).
template <class T> void node_numbers(const TileJob<T>&, Batch<T>& batch)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        const std::uint64_t s = batch.sample_number[static_cast<std::size_t>(batch.slot[i])];
        batch.bits[i] = 0;
        batch.u[i] = static_cast<T>(rule().node[s % side]),
        batch.v[i] = static_cast<T>(rule().node[s / side]);
    }
}

/// The node's weight, times the number of nodes: a mean over samples is then the quadrature's sum.
template <class T> void node_weights(const TileJob<T>&, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const std::uint64_t s =
            batch
                .sample_number[static_cast<std::size_t>(batch.slot[static_cast<std::size_t>(row)])];
        const double weight = rule().weight[s % side] * rule().weight[s / side] * batch_capacity;
        batch.contribution.put(row, batch.contribution.at(row) * static_cast<T>(weight));
    }
}

/// The pipeline of "uniform/light" with nodes for numbers: a stage is put in like any other.
template <class T> Pipeline<T> with_nodes(Pipeline<T> pipeline)
{
    for (NamedStage<T>& stage : pipeline.light)
        if (stage.kind == StageKind::numbers) stage.run = node_numbers<T>;
    pipeline.light.insert(pipeline.light.end() - 1, {StageKind::weigh, node_weights<T>});
    return pipeline;
}

const Vec3<double> center{0.7, 2, -0.4};
constexpr double power = 7;

template <class T> double by_nodes(double radius, const Kernels<T>& kernels)
{
    const TestScene test(
        probe_under({make_light_of_power(center, radius, Vec3<double>(power))}, grey_floor()));
    const ReadyStrategy<T> ready(test.lit, parse_strategy("uniform/light"), kernels, 1);
    const Tile& tile = test.probes.tiles.at(0);
    Workspace<T> workspace;
    PointResult result;
    const TileTotals totals = workspace.run(
        ready.job(tile, test.probes.points), with_nodes(ready.pipeline(tile.material)),
        {.chunk = batch_capacity, .chunks = 1}, std::span(&result, 1), {}, {});
    EXPECT_EQ(totals.invalid, 0U);
    return result.luminance.mean;
}

/// Every kernel of this machine, for every radius while the sphere is above the horizon.
template <class T> void expect_closed_form(double tolerance)
{
    const double d = length(center), cos_theta = center.y / d;
    const double exact =
        power * cos_theta / (4 * std::numbers::pi * d * d) * 0.5 / std::numbers::pi;
    std::vector<double> radii{1e-20, 1e-12};
    for (double r = 1e-6; r < 1.0001; r *= std::sqrt(10.0)) radii.push_back(r);
    radii.push_back(1.9999);
    for (const std::string_view set : instruction_sets())
        for (const double radius : radii)
            EXPECT_NEAR(by_nodes(radius, kernels_of<T>(set)) / exact, 1, tolerance)
                << set << ", radius " << radius;
}

TEST(OneSphere, OfAnyRadiusGivesTheClosedFormInDouble) { expect_closed_form<double>(2e-7); }
TEST(OneSphere, OfAnyRadiusGivesTheClosedFormInFloat) { expect_closed_form<float>(1e-6); }

/// The least and the largest sample of the one light of power 7 at `at`, drawn in proportion to the
/// cosine, over what the closed form says.
template <class T>
void expect_every_sample_exact(const Vec3<double>& at, double radius, std::string_view strategy,
                               double tolerance)
{
    const double d = length(at), s = radius / d;
    const double exact = power * exact_irradiance_over_sin2(s, at.y / d) / std::numbers::pi /
                         (4 * std::numbers::pi * d * d) * 0.5 / std::numbers::pi;
    const TestScene test(
        probe_under({make_light_of_power(at, radius, Vec3<double>(power))}, grey_floor()));
    for (const std::string_view set : instruction_sets()) {
        const Outcome outcome =
            run_probe<T>(test, parse_strategy(strategy), kernels_of<T>(set), batch_capacity);
        EXPECT_EQ(outcome.totals.invalid, 0U);
        const Moments& found = outcome.result.luminance;
        EXPECT_NEAR(found.mean / exact, 1, tolerance) << set << ", radius " << radius;
        EXPECT_LT(std::sqrt(found.m2), tolerance * exact) << set << ", radius " << radius;
    }
}

template <class T> void expect_no_variance_under_one_sphere(double tolerance)
{
    for (const std::string_view strategy : {"uniform/light/projected", "all/light/projected"})
        for (const double radius : {1e-20, 1e-6, 1e-3, 0.1, 1.0, 1.9999}) {
            expect_every_sample_exact<T>(center, radius, strategy, tolerance);
            // The horizon cuts these: half, most, hardly any of it is above.
            if (radius < 1e-4) continue;
            for (const double height : {0.3, 0.0, -0.6})
                expect_every_sample_exact<T>({1, height * radius, 2}, radius, strategy, tolerance);
        }
}

TEST(OneSphere, DrawnInProportionToTheCosineGivesNoVarianceInDouble)
{
    expect_no_variance_under_one_sphere<double>(2e-6);
}
TEST(OneSphere, DrawnInProportionToTheCosineGivesNoVarianceInFloat)
{
    expect_no_variance_under_one_sphere<float>(1e-5);
}

}  // namespace
}  // namespace mis
