#include "mis/io/report_read.h"

#include "mis/io/report_csv.h"
#include "mis/io/report_json.h"
#include "mis/io/report_peek.h"
#include "mis/io/report_text.h"
#include "mis/io/scene_error.h"
#include "mis/run/serial.h"
#include "mis/study/study.h"
#include "mis/trace/analytic.h"
#include "mis/words/verdict.h"
#include "tests/io/sample_report.h"
#include "tests/io/temporary_folder.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mis {
namespace {

using Json = nlohmann::json;

Json sample() { return Json::parse(report_json(sample_report())); }

/// The message about a report that was changed at one place; "" if it is read.
std::string message_about(const char* pointer, const Json& value)
{
    Json json = sample();
    json[Json::json_pointer(pointer)] = value;
    try {
        parse_report(json.dump(), "old.json");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

/// A report in which no field is as it is by default.
Report full_report()
{
    Report report = sample_report();
    report.is_sobol = report.partial = true;
    report.seed = std::numeric_limits<std::uint64_t>::max();
    report.margin = 0.1, report.at = 64;
    SceneReport& scene = report.scenes[0];
    scene.file = "été's.json";
    scene.lacks_audit = scene.partial = true;
    scene.decided = false, scene.seconds_to_decide = 12.5;
    scene.strategies[1].may_be_best = true, scene.strategies[0].behind_at_most = 0.25;
    scene.triangles = 12, scene.background_pixels = 3;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    scene.effects.clear();
    for (const char* name : effect_names)
        scene.effects.push_back({name, name[0] != 'c', 0.25, "because", unknown, -1e-9});
    scene.strategies[0].invalid_samples = 3;
    scene.strategies[0].first_invalid = SampleName{7, 12345678901};
    scene.strategies[4].resolving_factor = 12.5;
    scene.strategies[4].least_growth = {1e30, 1e29};  // that it seems to lead means nothing
    scene.strategies[4].variance = scene.strategies[4].seconds_to_1_percent = {1e-9, 1e-9, 1e-9};
    scene.strategies[3].resolving_factor = std::numeric_limits<double>::infinity();
    return report;
}

/// Strategies in many states, of a scene with a blocker, three lights and perhaps samples that are
/// no numbers.
Report studied_report(const StudyOptions& options, bool has_bad_samples = false)
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    scene.camera = Camera{.position = {0, 2, 6}, .target = {0, 0, 0}, .resolution = {20, 12}};
    scene.surfaces.push_back({Quad{{-5, 0, -5}, {Vec3<double>{0, 0, 10}, {10, 0, 0}}}, 0});
    scene.surfaces.push_back({SphereSurface{{0.5, 0.6, 0.5}, 0.3}, 0});
    if (has_bad_samples)
        scene.lights.front().radiance_radius = Vec3<float>(std::numeric_limits<float>::quiet_NaN());
    std::vector<Strategy> strategies;
    for (const char* name : {"uniform/power", "solid-angle/balance@2+1", "all/light", "brdf",
                             "power/light/union", "power/power/one-sample"})
        strategies.push_back(parse_strategy(name));
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    Study study = run_study(lit, strategies, options, any_executor(SerialExecutor{}));
    study.report.file = "a.json";
    study.report.effects = explained(scene, all_effects(scene), {});
    Report report;
    report.is_sobol = options.samples_per_scrambling > 0;
    report.scenes = {study.report, study.report};
    report.overall = rank_overall(report.scenes);
    return report;
}

const std::vector<Report>& many_reports()
{
    static const std::vector<Report> reports = [] {
        Report bare, nothing_ranked = sample_report(), not_utf8 = full_report();
        not_utf8.scenes[0].file = "caf\xe9's.json";
        bare.scenes.resize(2);
        for (SceneReport& scene : nothing_ranked.scenes) {
            scene.pairs.clear();
            std::erase_if(scene.strategies,
                          [](const StrategyReport& s) { return s.status == Status::ranked; });
            scene.strategies[0].resolving_factor = 3;
        }
        return std::vector<Report>{{},
                                   bare,
                                   sample_report(),
                                   full_report(),
                                   not_utf8,
                                   nothing_ranked,
                                   studied_report({.spp = 32}),
                                   studied_report({.samples_per_scrambling = 8, .spp = 64}),
                                   studied_report({.spp = 8}, true)};
    }();
    return reports;
}

TEST(ReportRead, IsTheSameFileOnceItIsWrittenAgain)
{
    for (const Report& report : many_reports()) {
        const std::string text = report_json(report);
        EXPECT_EQ(report_json(parse_report(text, "x")), text);
    }
}

/// A file's name that is not UTF-8 stands in JSON with replacement characters.
bool is_utf8(const Report& report)
{
    return report.scenes.empty() || !report.scenes[0].file.starts_with("caf");
}

TEST(ReportRead, SaysTheSame)
{
    for (const Report& report : many_reports()) {
        if (!is_utf8(report)) continue;
        const Report again = parse_report(report_json(report), "x");
        ASSERT_EQ(again.scenes.size(), report.scenes.size());
        for (std::size_t i = 0; i < report.scenes.size(); ++i)
            EXPECT_EQ(sentences_of(again.scenes[i], again.threads, again.margin),
                      sentences_of(report.scenes[i], report.threads, report.margin));
        EXPECT_EQ(overall_sentences_of(again), overall_sentences_of(report));
        EXPECT_EQ(report_text(again), report_text(report));
        EXPECT_EQ(report_csv(again), report_csv(report));
    }
}

TEST(ReportRead, HoldsWhatSentencesAloneSay)
{
    const Report report = parse_report(report_json(full_report()), "x");
    const SceneReport& scene = report.scenes[0];
    EXPECT_TRUE(scene.lacks_audit);
    EXPECT_FALSE(report.scenes[1].lacks_audit);
    ASSERT_TRUE(scene.strategies[0].first_invalid);
    EXPECT_EQ(scene.strategies[0].first_invalid->point, 7u);
    EXPECT_EQ(scene.strategies[0].first_invalid->sample, 12345678901u);
    EXPECT_FALSE(scene.strategies[1].first_invalid);
    EXPECT_EQ(scene.strategies[4].resolving_factor, 12.5);
    EXPECT_EQ(scene.strategies[4].least_growth.variance, 1e30);
    EXPECT_EQ(scene.strategies[4].least_growth.relative_variance, 1e29);
    EXPECT_EQ(scene.strategies[0].timed_rounds, 16);
    for (std::size_t i = 0; i < effect_names.size(); ++i)
        EXPECT_EQ(scene.effects.at(i).name, effect_names[i]);
}

/// One that this program wrote before reports said all that sentences need.
TEST(ReportRead, TakesOlderReportsAndClaimsNothingForThem)
{
    const Report old = read_report(source_dir() / "tests/fuzz/report.json");
    EXPECT_TRUE(std::isnan(old.scenes[0].strategies[0].resolving_factor));
    EXPECT_FALSE(old.scenes[0].lacks_audit);
    const std::string text = report_json(old);
    EXPECT_EQ(report_json(parse_report(text, "x")), text);

    Json json = Json::parse(report_json(full_report()));
    for (Json& scene : json["scenes"]) {
        for (const char* key : {"lacks_audit", "decided", "leader", "decided_of_one_light",
                                "leader_of_one_light", "seconds_to_decide"})
            scene.erase(key);
        for (Json& s : scene["strategies"])
            for (const char* key : {"resolving_factor", "least_growth", "first_invalid",
                                    "timed_rounds", "may_be_best", "behind_at_most", "at_counts"})
                s.erase(key);
    }
    const Report read = parse_report(json.dump(), "x");
    EXPECT_TRUE(read.scenes[1].lacks_audit);  // sequences are not audited
    EXPECT_FALSE(read.scenes[0].strategies[0].first_invalid);
    EXPECT_EQ(read.scenes[0].strategies[4].least_growth.variance, 1);
    EXPECT_EQ(read.scenes[0].strategies[1].timed_rounds, 0);
    EXPECT_FALSE(read.scenes[1].decided);
    const std::string said = report_text(read, {.columns = 1000, .is_verbose = true});
    EXPECT_NE(said.find("Use uniform/light: "), said.npos);  // the first that it ranks
    EXPECT_EQ(said.find("Not decided: "), said.npos);
    EXPECT_EQ(said.find("decide.\n"), said.npos);
    EXPECT_NE(said.find("gave 3 samples that are NaN or infinite"), said.npos);
    EXPECT_EQ(said.find("mis replay"), said.npos);
}

TEST(ReportRead, TakesNullForNotKnown)
{
    Json json = sample();
    json["scenes"][0]["strategies"][0]["variance"] = {
        {"value", nullptr}, {"low", nullptr}, {"high", nullptr}};
    const Report report = parse_report(json.dump(), "x");
    EXPECT_TRUE(std::isnan(report.scenes[0].strategies[0].variance.high));
    EXPECT_EQ(report.scenes[0].strategies[5].rank, 0);
}

TEST(ReportRead, PassesOverWhatLaterVersionsMayAdd)
{
    Json json = sample();
    json["new"] = {1, 2};
    json["scenes"][0]["strategies"][0]["variance"]["new"] = "x";
    json["scenes"][0]["strategies"][0]["policy"] = "later";
    json["scenes"][0]["strategies"][0]["name"] = "later/power";
    for (Json& p : json["scenes"][0]["pairs"])
        for (const char* key : {"a", "b"})
            if (p[key] == "solid-angle/power") p[key] = "later/power";
    json["scenes"][0]["strategies"][1].erase("timed_rounds");  // and what earlier ones lacked
    const Report report = parse_report(json.dump(), "x");
    EXPECT_EQ(name_of(report.scenes[0].strategies[0].strategy), "later/power");
    EXPECT_EQ(report.scenes[0].strategies[1].timed_rounds, 0);
}

TEST(ReportRead, SaysWhereWhatIsWrong)
{
    struct Wrong {
        const char* pointer;
        Json value;
        const char* message;
    };
    const std::string strategy = "/scenes/0/strategies/0/";
    for (const Wrong& wrong : std::initializer_list<Wrong>{
             {"/format", "mis-report/2", "found \"mis-report/2\"; this version reads"},
             {"/seed", -1, "found -1; a whole number between 0 and"},
             {"/seed", 1e300, "a whole number between"},
             {"/threads", 0, "a whole number between 1 and"},
             {"/threads", 1e10, "a whole number between 1 and"},
             {"/partial", 1, "true or false belongs here"},
             {"/scenes", 3, "an array, [ ... ], belongs here"},
             {"/scenes/0", {1}, "/scenes/0: found [1]; an object"},
             {"/scenes/0/resolution", {1}, "two whole numbers"},
             {"/scenes/0/replicates", 0.5, "a whole number"},
             {"/scenes/0/strategies/1/name", "a/b", "describe is \"radiant-solid-angle/balance\""},
             {"/scenes/0/strategies/1", sample()["scenes"][0]["strategies"][0],
              "stands in a scene once"},
             {"/scenes/0/strategies/0/status", "good",
              "known are not_run, not_resolved, biased, ranked"},
             {"/scenes/0/strategies/0/counts", {1, 1e9}, "counts/1: found 1000000000"},
             {"/scenes/0/strategies/0/mean", "x", "found \"x\"; a number, or null, belongs here"},
             {"/scenes/0/strategies/0/variance/low", -1, "found -1; a number that is at least 0"},
             {"/scenes/0/strategies/0/variance/low", 1e9, "low is at most high"},
             {"/scenes/0/strategies/0/rank", 0, "a whole number between 1"},
             {"/scenes/0/pairs/0/a", "brdf/x", "the name of a strategy of this scene"},
             {"/scenes/0/effects/shadows/on", "yes", "/scenes/0/effects/shadows/on: found"},
             {"/scenes/0/strategies/0/seconds_to_1_percent", 1,
              "it is the value of \"seconds_to_1_percent_interval\""},
             {"/scenes/0/strategies/0/seconds_to_1_percent", nullptr, "it is the value of"},
             {"/scenes/0/strategies/0/first_invalid",
              {{"point", -1}, {"sample", 0}},
              "first_invalid/point: found -1; a whole number"},
             {"/scenes/0/strategies/0/least_growth", 2, "an object"},
             {"/scenes/0/strategies/0/resolving_factor", -2, "at least 0"},
             {"/scenes/0/lacks_audit", 0, "true or false"},
             {"/sampler", "halton", "known are independent, sobol"},
             {"/margin", nullptr, "found null; a number that is at least 0 belongs here"},
             {"/overall/0/beaten_by_exact", 1e18, "a whole number"},
         }) {
        const std::string message = message_about(wrong.pointer, wrong.value);
        EXPECT_NE(message.find(wrong.message), std::string::npos)
            << wrong.pointer << ": " << message;
        EXPECT_EQ(message.find("old.json: " + std::string(wrong.pointer).substr(0, 8)), 0u)
            << message;
    }
}

TEST(ReportRead, NeedsEveryKey)
{
    Json json = sample();
    json["scenes"][0]["strategies"][0].erase("variance");
    try {
        parse_report(json.dump(), "old.json");
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_STREQ(error.what(),
                     "old.json: /scenes/0/strategies/0/variance: found nothing; \"variance\" is "
                     "required here\n    See docs/report-format.md.");
    }
}

TEST(ReportRead, RefusesWhatIsTooDeepOrTooLarge)
{
    const auto refused = [](const std::string& text) {
        EXPECT_THROW(parse_report(text, "x"), SceneError) << text.substr(0, 40);
    };
    refused("{\"format\": " + std::string(100'000, '['));
    refused("{\"format\": \"mis-report/1\", \"seed\": 1e999}");
    refused("");
    refused("[]");
    refused("[[1]]");
    refused("{\"\": [1]}");
    refused("{\"format\": \"mis-report/1\"");
}

TEST(ReportFile, IsKnownByItsFormat)
{
    const TemporaryFolder folder;
    const auto is_report = [&](const std::string& text) {
        return is_report_file(folder.write("x.json", text));
    };
    EXPECT_TRUE(is_report(report_json(sample_report())));
    EXPECT_TRUE(is_report("{\"at\":16,\"format\" :\n\"mis-report/2\""));
    EXPECT_FALSE(is_report("{\"format\": \"mis-scene/1\", \"name\": \"mis-report/1\"}"));
    EXPECT_FALSE(is_report("{\"name\": \"format\"}"));
    EXPECT_FALSE(is_report("{\"format\""));
    EXPECT_FALSE(is_report(""));
    EXPECT_FALSE(is_report_file(folder / "none.json"));
    EXPECT_FALSE(is_report_file(folder / "."));
    EXPECT_FALSE(is_report(std::string(1 << 17, ' ') + report_json({})));  // not near the start
}

}  // namespace
}  // namespace mis
