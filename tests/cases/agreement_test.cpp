// Every strategy on every case, through the engine's own pipeline, in every number type and on
// every instruction set, against quadrature; and planted errors that the same test sees.
#include "mis/predict/predict.h"

#include "tests/cases/cases.h"
#include "tests/cases/judge.h"
#include "tests/cases/measure.h"
#include "tests/predict/predict_cases.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

/// The chance that any test of the whole suite fails where all is right: Bonferroni over all means
/// and all variances, tested or not. The seed is fixed, so that a red run stays red.
constexpr double false_alarm = 1e-6;
constexpr std::uint64_t seed = 20;

/// The policies of a library change with time, so the number of tests is counted.
double false_alarm_of_one()
{
    static const std::size_t tests =
        2 * all_cases().size() * every_plain_strategy().size() * 2 * instruction_sets().size();
    return false_alarm / static_cast<double>(tests);
}

/// As many samples as this strategy's tests ask for, within what there is time for, and a few at
/// least. A sample of `all` costs a draw per light.
int samples_for(const Strategy& s, const Predicted& p, std::size_t lights, int draws_at_most)
{
    const double per_sample = draws_every_light(s.policy) ? static_cast<double>(lights) : 1;
    const double most = draws_at_most / per_sample;
    const double kurtosis = p.variance > 0 ? p.fourth / square(p.variance) : 0;
    const double wanted = std::clamp(1001 * kurtosis, std::min(4000.0, most), most);
    return std::max(4, scaled(static_cast<int>(wanted)));
}

std::vector<Strategy> plain_strategies(bool cosine_ties)
{
    std::vector<Strategy> all = every_plain_strategy();
    if (cosine_ties)
        std::erase_if(all, [](const Strategy& s) {
            return s.heuristic == "maximum" && s.technique == "projected";
        });
    return all;
}

/// A case with its predictions.
struct Suite {
    ReadyCase ready;
    std::vector<Strategy> strategies;
    std::vector<Predicted> predicted;

    explicit Suite(const Scene& scene, bool cosine_ties = false)
        : ready(scene), strategies(plain_strategies(cosine_ties)),
          predicted(predict(scene, scene.probes[0], strategies, {.smooth = 1e-4, .jumps = 1e-3}))
    {
    }
};

/// Which strategies' figures cannot be, and how many were tested.
struct Verdict {
    std::vector<std::string> wrong;  ///< names
    std::string what;                ///< all that is wrong
    std::uint64_t invalid = 0;
    int normal_means = 0, variances = 0;
};

template <class T>
Verdict verdict_on(const Suite& suite, const Kernels<T>& kernels, int draws_at_most,
                   std::uint64_t seed_of_set, const PipelineChange<T>& change = {})
{
    const Scene& scene = suite.ready.test.scene;
    const Strictness strictness{false_alarm_of_one(), rounding_of(scene)};
    Verdict verdict;
    for (std::size_t i = 0; i < suite.strategies.size(); ++i) {
        const Strategy& s = suite.strategies[i];
        const int n = samples_for(s, suite.predicted[i], scene.lights.size(), draws_at_most);
        const Outcome outcome = run_case<T>(suite.ready, s, kernels, n, seed_of_set, change);
        const Predicted& p = suite.predicted[i];
        verdict.invalid += outcome.totals.invalid;
        verdict.normal_means += n * square(p.variance) >= mean_needs * p.fourth;
        verdict.variances += n * square(p.variance) >= variance_needs * p.fourth;
        const std::string what = disagreement(outcome.result.luminance, p, strictness);
        if (what.empty()) continue;
        verdict.wrong.push_back(name_of(s));
        verdict.what += name_of(s) + ": " + what + "\n";
    }
    return verdict;
}

/// The first instruction set in float, which most runs use, gets the most samples.
constexpr int most_draws = 40'000, fewer_draws = 4'000;

int draws_of(std::size_t set, bool is_float)
{
    return is_float && set == 0 ? most_draws : fewer_draws;
}

template <class T> void expect_agreement(const Suite& suite, std::uint64_t type)
{
    const std::vector<std::string_view> sets = instruction_sets();
    for (std::size_t k = 0; k < sets.size(); ++k) {
        const bool is_float = std::is_same_v<T, float>;
        const Verdict verdict = verdict_on<T>(suite, kernels_of<T>(sets[k]), draws_of(k, is_float),
                                              seed + 2 * k + type);
        EXPECT_TRUE(verdict.wrong.empty())
            << sets[k] << (is_float ? " in float\n" : " in double\n") << verdict.what;
        EXPECT_EQ(verdict.invalid, 0U) << sets[k];
        if (k > 0 || !is_float) continue;
        const int strategies = static_cast<int>(suite.strategies.size());
        EXPECT_TRUE(sample_share < 1 || 3 * verdict.normal_means >= strategies);
        EXPECT_TRUE(sample_share < 1 || 6 * verdict.variances >= strategies) << verdict.variances;
        testing::Test::RecordProperty("strategies", strategies);
        testing::Test::RecordProperty("normal_means", verdict.normal_means);
        testing::Test::RecordProperty("variances", verdict.variances);
    }
}

class Agreement : public testing::TestWithParam<Case> {};

TEST_P(Agreement, OfEveryStrategyWithItsPrediction)
{
    const Suite suite(GetParam().scene, GetParam().cosine_ties);
    if (GetParam().is_dark) {
        for (const Predicted& p : suite.predicted) EXPECT_EQ(p.mean, 0);
        for (const Predicted& p : suite.predicted) EXPECT_EQ(p.variance, 0);
    } else ASSERT_FALSE(suite.ready.has_no_tile());
    if (suite.ready.has_no_tile()) return;
    expect_agreement<float>(suite, 0);
    expect_agreement<double>(suite, 1);
}

std::string test_name(const testing::TestParamInfo<Case>& info)
{
    std::string name = info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Cases, Agreement, testing::ValuesIn(all_cases()), test_name);

/// A pdf that is 1 % too large, wherever it is used: in the estimate and in the weights.
enum class Planted { light_pdf, bsdf_pdf };

template <class T> void too_large_light_draw(const TileJob<T>&, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        batch.light_pdf[static_cast<std::size_t>(row)] *= T(1.01);
        batch.radiance.put(row, batch.radiance.at(row) / T(1.01));  // it is over the pdf here
    }
}
template <class T> void too_large_light_pdf(const TileJob<T>&, Batch<T>& batch)
{
    for (T& pdf : batch.light_pdf) pdf *= T(1.01);
}
template <class T> void too_large_bsdf_pdf(const TileJob<T>&, Batch<T>& batch)
{
    for (T& pdf : batch.bsdf_pdf) pdf *= T(1.01);
}

/// Puts a stage behind the last one of its kind.
template <class T> void put_in(std::vector<NamedStage<T>>& stages, const NamedStage<T>& stage)
{
    const auto last = std::find_if(stages.rbegin(), stages.rend(),
                                   [&](const auto& s) { return s.kind == stage.kind; });
    if (last != stages.rend()) stages.insert(last.base(), stage);
}

template <class T> PipelineChange<T> plant(Planted planted)
{
    return [planted](Pipeline<T>& p) {
        if (planted == Planted::light_pdf) {
            put_in<T>(p.light, {StageKind::draw, too_large_light_draw<T>});
            put_in<T>(p.bsdf, {StageKind::draw, too_large_light_pdf<T>});
            return;
        }
        put_in<T>(p.light, {StageKind::bsdf, too_large_bsdf_pdf<T>});
        put_in<T>(p.bsdf, {StageKind::bsdf, too_large_bsdf_pdf<T>});
    };
}

bool uses(const std::string& strategy, Planted planted)
{
    const Strategy s = parse_strategy(strategy);
    return planted == Planted::light_pdf ? s.chooses_light()
                                         : s.technique != "hemisphere" && s.heuristic != "light";
}

/// The suite must fail, and those strategies alone that use the wrong pdf.
template <class T> void expect_failure(const Suite& suite, Planted planted)
{
    const std::vector<std::string_view> sets = instruction_sets();
    for (std::size_t k = 0; k < sets.size(); ++k) {
        const Verdict verdict =
            verdict_on<T>(suite, kernels_of<T>(sets[k]), draws_of(k, std::is_same_v<T, float>),
                          seed + 2 * k, plant<T>(planted));
        EXPECT_FALSE(verdict.wrong.empty()) << sets[k];
        for (const std::string& strategy : verdict.wrong)
            EXPECT_TRUE(uses(strategy, planted)) << sets[k] << " " << strategy << "\n"
                                                 << verdict.what;
    }
}

const Case& case_named(const std::vector<Case>& cases, std::string_view name)
{
    return *std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.name == name; });
}

TEST(PlantedError, Of1PercentInTheLightsPdfIsSeen)
{
    Scene scene = case_named(all_cases(), "cap_1e-2").scene;
    scene.lights.resize(1);  // without another, its variance is next to nothing: few samples do
    const Suite suite(scene);
    expect_failure<float>(suite, Planted::light_pdf);
    expect_failure<double>(suite, Planted::light_pdf);
}

TEST(PlantedError, Of1PercentInTheBsdfsPdfIsSeen)
{
    const Suite suite(case_named(all_cases(), "sky_of_one_light").scene);
    expect_failure<float>(suite, Planted::bsdf_pdf);
    expect_failure<double>(suite, Planted::bsdf_pdf);
}

}  // namespace
}  // namespace mis
