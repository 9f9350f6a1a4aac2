// What is true of every heuristic of the registry, and what each one says.
#include "mis/heuristic/heuristic.h"

#include "mis/heuristic/registry.h"

#include "tests/support/lanes.h"
#include "tests/support/typed.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <limits>

namespace mis {
namespace {

template <class H, class T, std::size_t N> std::array<T, N> weights(const std::array<T, N>& density)
{
    std::array<T, N> w{};
    for (std::size_t i = 0; i < N; ++i) w[i] = H::weight(density, i);
    return w;
}

template <class T> constexpr T infinity = std::numeric_limits<T>::infinity();

template <class H> class EveryHeuristic : public testing::Test {
protected:
    /// The weights of N densities lie in [0, 1] and sum to 1 within 4 ulp.
    template <class T, std::size_t N> static void expect_shares(const std::array<T, N>& density)
    {
        T sum(0);
        for (const T& w : weights<H>(density)) {
            ASSERT_GE(w, 0);
            ASSERT_LE(w, 1);
            sum += w;
        }
        ASSERT_NEAR(static_cast<double>(sum), 1, 4 * ulp_of<T>)
            << static_cast<double>(density[0]) << " " << static_cast<double>(density[1]);
    }
};
TYPED_TEST_SUITE(EveryHeuristic, TestedTypes<Heuristics>, RegisteredName);

TYPED_TEST(EveryHeuristic, WeightsSumTo1ForDensitiesFrom1e38To1e38)
{
    Uniforms uniforms(1);
    for (int i = 0; i < 100'000; ++i) {
        const double a = uniforms.log_between(1e-38, 1e38);
        const double b =
            i % 2 == 0 ? uniforms.log_between(1e-38, 1e38) : a * uniforms.between(0.05, 2);
        const double c = uniforms.log_between(1e-38, 1e38);
        this->expect_shares(std::array{a, b});
        this->expect_shares(std::array{a, b, c});
        this->expect_shares(
            std::array{static_cast<float>(a), static_cast<float>(std::min(b, 1e38))});
        this->expect_shares(std::array{static_cast<float>(a), static_cast<float>(std::min(b, 1e38)),
                                       static_cast<float>(c)});
    }
}

TYPED_TEST(EveryHeuristic, ATechniqueOfDensity0HasWeight0)
{
    for (const double p : {1e-38, 1.0, 1e38, infinity<double>}) {
        const auto only_light = weights<TypeParam>(std::array{p, 0.0});
        EXPECT_EQ(only_light[0], 1) << p;
        EXPECT_EQ(only_light[1], 0) << p;
        EXPECT_EQ(weights<TypeParam>(std::array{0.0, p})[0], 0) << p;
    }
    EXPECT_EQ(weights<TypeParam>(std::array{0.0, 0.0}), (std::array{0.0, 0.0}));
}

TYPED_TEST(EveryHeuristic, ATechniqueOfInfiniteDensityHasWeight1SharedWhereBothAre)
{
    for (const float p : {0.F, 1e-38F, 1.F, 1e38F})
        EXPECT_EQ(weights<TypeParam>(std::array{infinity<float>, p}), (std::array{1.F, 0.F})) << p;
    this->expect_shares(std::array{infinity<float>, infinity<float>});
}

/// Only the ratio of densities matters.
TYPED_TEST(EveryHeuristic, DoesNotDependOnTheUnitOfTheDensities)
{
    Uniforms uniforms(2);
    for (int i = 0; i < 1000; ++i) {
        const double a = uniforms.log_between(1e-3, 1e3), b = uniforms.log_between(1e-3, 1e3);
        const auto one = weights<TypeParam>(std::array{a, b}),
                   scaled = weights<TypeParam>(std::array{a * 0x1p90, b * 0x1p90});
        EXPECT_EQ(one, scaled);
    }
}

TYPED_TEST(EveryHeuristic, LanesAgreeWithOneAtATime)
{
    using V = TestLanes<float>;
    Uniforms uniforms(3);
    const std::array special{0.F, infinity<float>, 1e-38F, 1e38F, 1.F};
    for (int round = 0; round < 1000; ++round) {
        std::array<std::array<float, 2>, lane_count<V>> d{};
        for (auto& pair : d)
            for (float& p : pair)
                p = uniforms() < 0.5 ? static_cast<float>(uniforms.log_between(1e-38, 1e38))
                                     : special[static_cast<std::size_t>(uniforms.below(5))];
        const std::array<V, 2> density{lanes_from<V>([&](std::size_t i) { return d[i][0]; }),
                                       lanes_from<V>([&](std::size_t i) { return d[i][1]; })};
        for (std::size_t k = 0; k < 2; ++k) {
            const V found = TypeParam::weight(density, k);
            for (std::size_t i = 0; i < d.size(); ++i)
                EXPECT_EQ(lane(found, i), TypeParam::weight(d[i], k));
        }
    }
}

using Pair = std::array<double, 2>;

TEST(Heuristics, SayWhatVeachWrote)
{
    EXPECT_EQ(weights<BalanceHeuristic>(Pair{3, 1}), (Pair{0.75, 0.25}));
    EXPECT_DOUBLE_EQ(weights<PowerHeuristic>(Pair{3, 1})[0], 0.9);
    EXPECT_DOUBLE_EQ(weights<PowerHeuristic>(Pair{3, 1})[1], 0.1);
    EXPECT_EQ(weights<CutoffHeuristic>(Pair{3, 1}), (Pair{0.75, 0.25}));
    EXPECT_EQ(weights<CutoffHeuristic>(Pair{100, 9}), (Pair{1, 0}));
    EXPECT_NEAR(weights<CutoffHeuristic>(Pair{100, 11})[1], 11.0 / 111, 1e-15);
    EXPECT_EQ(weights<MaximumHeuristic>(Pair{3, 2.9}), (Pair{1, 0}));
    EXPECT_EQ(weights<MaximumHeuristic>(Pair{2.9, 3}), (Pair{0, 1}));
    EXPECT_EQ(weights<MaximumHeuristic>(Pair{3, 3}), (Pair{1, 0}));  // a tie goes to the light
    EXPECT_EQ(weights<SingleHeuristic>(Pair{1, 100}), (Pair{1, 0}));
}

/// Veach's theorem 9.2 for two techniques that draw once each, on ten points of equal measure: no
/// weights have a variance below the balance heuristic's by more than (1 − ½) μ².
TEST(Heuristics, NoneBeatsBalanceByMoreThanVeachsBound)
{
    constexpr std::size_t n = 10;
    Uniforms uniforms(4);
    for (int round = 0; round < 2000; ++round) {
        std::array<double, n> f{};
        std::array<std::array<double, n>, 2> p{};
        double mean = 0;
        for (double& v : f) v = uniforms.log_between(0.01, 10), mean += v;
        for (auto& density : p) {
            double sum = 0;
            for (double& v : density) v = uniforms.log_between(1e-3, 1), sum += v;
            for (double& v : density) v /= sum;
        }
        // Σ over techniques of ∫ w²f²/p − (∫ w f)².
        const auto variance = [&](const auto& weight) {
            double total = 0;
            for (std::size_t i = 0; i < 2; ++i) {
                double second = 0, first = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    const double wf = weight(std::array{p[0][k], p[1][k]}, i, k) * f[k];
                    second += wf * wf / p[i][k], first += wf;
                }
                total += second - first * first;
            }
            return total;
        };
        std::array<double, n> any{};
        for (double& v : any) v = uniforms();
        const double bound = 0.5 * mean * mean;
        const auto balance = [](const Pair& d, std::size_t i, std::size_t) {
            return BalanceHeuristic::weight(d, i);
        };
        const auto power = [](const Pair& d, std::size_t i, std::size_t) {
            return PowerHeuristic::weight(d, i);
        };
        const auto maximum = [](const Pair& d, std::size_t i, std::size_t) {
            return MaximumHeuristic::weight(d, i);
        };
        const auto random = [&](const Pair&, std::size_t i, std::size_t k) {
            return i == 0 ? any[k] : 1 - any[k];
        };
        const double least = std::min({variance(power), variance(maximum), variance(random)});
        EXPECT_LE(variance(balance), least + bound);
    }
}

}  // namespace
}  // namespace mis
