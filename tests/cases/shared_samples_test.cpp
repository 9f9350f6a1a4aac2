// Variances from shared directions against quadrature, on every case and for every strategy; and
// planted errors that the same test sees.
#include "mis/study/shared_samples.h"
#include "mis/predict/predict.h"

#include "tests/cases/cases.h"
#include "tests/cases/measure.h"
#include "tests/predict/predict_cases.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>

namespace mis {
namespace {

/// The chance that any test of the suite fails where all is right: Bonferroni over all variances
/// and all means. The seed is fixed, so that a red run stays red.
constexpr double shared_false_alarm = 1e-6;
constexpr int shared_rounds = 400;

std::vector<Strategy> strategies_for(const Case& of)
{
    std::vector<Strategy> all = every_plain_strategy();
    for (const char* more : {"uniform/balance@3+2", "all/power@2+1", "all/balance/union@2+1"})
        all.push_back(parse_strategy(more));
    if (of.cosine_ties)
        std::erase_if(all, [](const Strategy& s) {
            return s.heuristic == "maximum" && s.technique == "projected";
        });
    return all;
}

/// What is not exceeded by Student's t of so many rounds, but once in a million of all tests.
double shared_bound(int rounds)
{
    static const double tests =
        2.0 * double(all_cases().size()) * double(every_plain_strategy().size() + 3);
    return boost::math::quantile(boost::math::complement(
        boost::math::students_t_distribution<double>(rounds - 1), shared_false_alarm / tests / 2));
}

struct SharedSuite {
    ReadyCase ready;
    std::vector<Strategy> strategies;
    std::vector<Predicted> predicted;

    explicit SharedSuite(const Case& of) : SharedSuite(of, strategies_for(of)) {}
    SharedSuite(const Case& of, const std::vector<Strategy>& some)
        : ready(of.scene), strategies(some),
          predicted(
              predict(of.scene, of.scene.probes[0], strategies, {.smooth = 1e-4, .jumps = 1e-3}))
    {
    }
};

/// Of how many standard errors the variances and the mean are off; 0 where that is rounding.
struct SharedScores {
    std::vector<double> variance;  ///< [strategy]
    double mean = 0;
};

SharedScores scores(const SharedSuite& suite, int counted, double planted = 1)
{
    const TestScene& test = suite.ready.test;
    SharedSamples shared(test.lit, {{test.probes.points.at(0), 0}}, suite.strategies, {.seed = 20});
    shared.take(counted + 1, any_executor(SerialExecutor{}));
    SharedScores found;
    const double rounding = rounding_of(test.scene);
    const auto score = [](double off, double se, double allowed) {
        const double beyond = std::max(std::abs(off) - allowed, 0.0);
        return beyond > 0 ? std::copysign(beyond / se, off) : 0;
    };
    for (std::size_t s = 0; s < suite.strategies.size(); ++s) {
        const Predicted& p = suite.predicted[s];
        const ValueAndError v = shared.at(s, 0);
        found.variance.push_back(
            score(v.value - planted * p.variance, v.se,
                  p.variance_error + rounding * p.variance + square(rounding * p.mean)));
        EXPECT_EQ(shared.missed(s), 0) << name_of(suite.strategies[s]);
    }
    const ValueAndError mean = shared.luminance(0);
    found.mean = score(mean.value - suite.predicted[0].mean, mean.se,
                       suite.predicted[0].mean_error + rounding * suite.predicted[0].mean);
    return found;
}

class SharedAgreement : public testing::TestWithParam<Case> {};

TEST_P(SharedAgreement, OfEveryVarianceWithItsPrediction)
{
    const SharedSuite suite(GetParam());
    if (suite.ready.has_no_tile()) return;
    const int rounds = scaled(shared_rounds);
    const SharedScores found = scores(suite, rounds);
    const double bound = shared_bound(rounds);
    EXPECT_LT(std::abs(found.mean), bound);
    for (std::size_t s = 0; s < suite.strategies.size(); ++s) {
        EXPECT_LT(std::abs(found.variance[s]), bound)
            << name_of(suite.strategies[s]) << " " << suite.predicted[s].variance;
    }
}

std::string shared_test_name(const testing::TestParamInfo<Case>& info)
{
    std::string name = info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Cases, SharedAgreement, testing::ValuesIn(all_cases()), shared_test_name);

/// The twin: variances that are 1 % off are seen, by the same bound, of each strategy that is
/// asked; and those that are right pass with as many rounds.
TEST(SharedAgreementTwin, Sees1PercentOnFiveCases)
{
    const std::vector<Strategy> some = strategies_of({"power/light", "power/balance"});
    const std::vector<Case> cases = all_cases();
    for (const std::string_view name :
         {"three_lamps", "eclipse", "random_4", "cut_by_the_horizon", "big_behind_small"}) {
        const auto found =
            std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.name == name; });
        ASSERT_NE(found, cases.end()) << name;
        const SharedSuite suite(*found, some);
        const int counted = 24'000;
        const double bound = shared_bound(counted);
        for (const double z : scores(suite, counted).variance)
            EXPECT_LT(std::abs(z), bound) << name;
        for (const double z : scores(suite, counted, 1.01).variance) EXPECT_LT(z, -bound) << name;
    }
}

}  // namespace
}  // namespace mis
