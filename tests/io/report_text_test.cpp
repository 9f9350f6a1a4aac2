#include "mis/io/report_text.h"

#include "mis/io/report_json.h"
#include "mis/io/report_read.h"
#include "mis/io/text_layout.h"
#include "mis/stats/at_counts.h"
#include "tests/io/sample_report.h"

#include <gtest/gtest.h>

#include <sstream>

namespace mis {
namespace {

std::vector<std::string> lines_of(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string line_with(const std::string& text, const std::string& part)
{
    for (const std::string& line : lines_of(text))
        if (line.find(part) != std::string::npos) return line;
    return "";
}

TEST(ReportText, FitsEightyColumns)
{
    for (const std::string& line : lines_of(report_text(sample_report())))
        EXPECT_LE(width_of(line), 80u) << line;
}

TEST(ReportText, FitsEightyColumnsWithTheLongestNamesAndFigures)
{
    Report report = sample_report();
    for (StrategyReport& s : report.scenes[0].strategies) {
        s.strategy.policy = "radiant-solid-angle";
        s.strategy.technique = "projected";
        s.strategy.heuristic = "balance";
        s.variance = {1.234e-12, 1e-12, 1.5e-12};
        s.seconds_per_sample.value = 12345e-9;
        s.efficiency.value = 1.2e12;
        s.seconds_to_1_percent.value = 123456;
    }
    for (const std::string& line : lines_of(report_text(report)))
        EXPECT_LE(width_of(line), 80u) << line;
}

TEST(ReportText, ShowsTheTableByRankWithTiesMarked)
{
    const std::string text = scene_text(sample_report().scenes[0], sample_report());
    EXPECT_NE(line_with(text, "rank  strategy").find("variance"), std::string::npos);
    EXPECT_EQ(line_with(text, " uniform/light").find("   1  uniform/light"), 0u) << text;
    EXPECT_NE(line_with(text, "=solid-angle/power").find(" 2-3 ="), std::string::npos) << text;
    EXPECT_LT(text.find("uniform/light"), text.find("=solid-angle/power"));
    EXPECT_NE(line_with(text, "- power/power/one-sample").size() +
                  line_with(text, "-  power/power").size(),
              0u);
    EXPECT_NE(text.find("not resolved"), std::string::npos);
    EXPECT_NE(text.find("not run"), std::string::npos);
    EXPECT_NE(text.find("±"), std::string::npos);
}

/// Words are broken between lines alone: what any two lines hold is in the text as it was.
TEST(ReportText, FitsTheWidthThatATerminalHas)
{
    for (const std::size_t columns : {40U, 60U, 80U, 100U, 132U})
        for (const bool is_verbose : {false, true})
            for (const std::string& line : lines_of(
                     report_text(sample_report(), {.columns = columns, .is_verbose = is_verbose})))
                EXPECT_LE(width_of(line), columns) << line;
    const std::string wide = scene_text(sample_scene("plates"), sample_report(), {.columns = 132});
    EXPECT_NE(line_with(wide, "rank  strategy").find("efficiency"), std::string::npos) << wide;
    EXPECT_NE(line_with(scene_text(sample_scene("plates"), {}), "effic.").find("effic."),
              std::string::npos);
}

TEST(ReportText, EndsWithTheAnswerAndHasTroublesBeforeIt)
{
    const SceneReport scene = sample_scene("plates");
    const std::string text = scene_text(scene, sample_report());
    const std::size_t answer = text.find("\nUse ");
    ASSERT_NE(answer, std::string::npos) << text;
    for (const char* before : {"rank  strategy", "= tied with another", "not resolved", "not run"})
        EXPECT_LT(text.rfind(before), answer) << before << "\n" << text;
    EXPECT_LE(lines_of(text.substr(answer)).size(), 24U) << text;
}

TEST(ReportText, HasOneSentenceForEachKindOfTroubleAndItsReasonsOnRequest)
{
    SceneReport scene = sample_scene("plates");
    scene.strategies.push_back(scene.strategies[4]);
    scene.strategies.back().strategy = parse_strategy("hemisphere");
    const std::string brief = scene_text(scene, sample_report()),
                      verbose = scene_text(scene, sample_report(), {.is_verbose = true});
    EXPECT_NE(
        brief.find("2 strategies are not resolved: brdf and hemisphere (--verbose says why)."),
        std::string::npos)
        << brief;
    EXPECT_NE(brief.find("power/power/one-sample is biased (--verbose says why)."),
              std::string::npos)
        << brief;
    EXPECT_EQ(brief.find("said \"enough\""), std::string::npos) << brief;
    EXPECT_NE(verbose.find("all/balance@4+1 was not run: its budget is past, said \"enough\""),
              std::string::npos)
        << verbose;
    EXPECT_EQ(verbose.find("--verbose"), std::string::npos) << verbose;
}

TEST(ReportText, HasBoldAndColourWhereTheyAreWanted)
{
    const Report report = sample_report();
    const std::string plain = report_text(report),
                      styled = report_text(report, {.has_style = true});
    EXPECT_EQ(plain.find('\x1b'), std::string::npos);
    EXPECT_NE(styled.find("\x1b[1;32mUse "), std::string::npos) << styled;
    std::string bare;
    for (std::size_t i = 0; i < styled.size(); ++i) {
        if (styled[i] == '\x1b') i = styled.find('m', i);
        else bare += styled[i];
    }
    EXPECT_EQ(bare, plain) << "style takes no room";
}

TEST(ReportText, HasTheRankingByItself)
{
    const SceneReport scene = sample_scene("plates");
    const std::string ranking = ranking_text(scene), all = scene_text(scene, sample_report());
    EXPECT_EQ(ranking.rfind("rank", 0), 0U) << ranking;
    EXPECT_NE(all.find(ranking), std::string::npos) << all;
}

TEST(ReportText, BeginsWithTheSceneAndItsEffects)
{
    const auto lines = lines_of(report_text(sample_report()));
    EXPECT_EQ(
        lines[0].find("plates (scenes/plates.json): 8x8, 64 shading points, 5 lights, 7 surfaces"),
        0u)
        << lines[0];
    EXPECT_NE(report_text(sample_report())
                  .find("effects: shadows (80 % of tiles); not called for: horizon\n"),
              std::string::npos);
}

TEST(ReportText, HoldsNoNumberThatIsNone)
{
    const std::string text = report_text(sample_report());
    for (const char* none : {"nan", "inf"}) EXPECT_EQ(text.find(none), std::string::npos) << text;
}

TEST(ReportText, ShowsProbesApartAndAllScenesTogether)
{
    const std::string text = report_text(sample_report());
    EXPECT_NE(text.find("probe 1"), std::string::npos);
    EXPECT_NE(text.find("All 2 scenes"), std::string::npos);
    EXPECT_EQ(overall_text({}), "");
}

TEST(ReportText, OfNothingIsASentence)
{
    EXPECT_NE(scene_text({}, {}).find("No strategy could be ranked"), std::string::npos);
}

/// The variance per draw at every count, each as it came out, in 80 columns.
TEST(ReportText, HasATableOfSeveralCounts)
{
    Report report = sample_report();
    const auto text = [&] { return scene_text(report.scenes[0], report, TextLook{}); };
    EXPECT_EQ(text().find("draw at n ="), std::string::npos);
    for (StrategyReport& s : report.scenes[0].strategies)
        if (s.status == Status::ranked)
            for (const double n : {16, 64, 256}) s.at_counts.push_back(at_count(s, 16, n));
    EXPECT_EQ(text().find("draw at n ="), std::string::npos);  // all the same
    EXPECT_NE(text().find("Of independent samples the variance per draw is the same"),
              std::string::npos);
    StrategyReport& s = report.scenes[0].strategies[0];
    s.at_counts[1].variance.value = 0.5;
    s.at_counts[1].relative_variance = {0.25, 0.24, 0.26};
    s.at_counts[2].status = Status::not_resolved;
    const std::string table = text().substr(text().find("rel. variance per"));
    EXPECT_NE(table.find(" 256\n"), std::string::npos) << table;
    EXPECT_NE(table.find("0.25±0.01"), std::string::npos) << table;
    EXPECT_NE(table.find("not resolved"), std::string::npos) << table;
    EXPECT_NE(table.find("exact"), std::string::npos) << table;
    for (const std::string& line : lines_of(text())) EXPECT_LE(width_of(line), 80U) << line;
}

/// What stands in files comes back.
TEST(ReportText, OfCountsIsTheSameOnceRead)
{
    Report report = sample_report();
    StrategyReport& s = report.scenes[0].strategies[0];
    s.at_counts = {at_count(s, 16, 16), at_count(s, 16, 64)};
    s.at_counts[1].status = Status::not_run;
    s.at_counts[1].reason = reason::NotReady{};
    const std::string json = report_json(report);
    const Report read = parse_report(json, "x");
    ASSERT_EQ(read.scenes[0].strategies[0].at_counts.size(), 2U);
    EXPECT_EQ(read.scenes[0].strategies[0].at_counts[1].n, 64);
    EXPECT_EQ(report_json(read), json);
}

}  // namespace
}  // namespace mis
