#include "mis/io/changes_text.h"

#include "mis/io/text_layout.h"
#include "tests/io/sample_report.h"
#include "tests/support/changes.h"

#include <gtest/gtest.h>

#include <sstream>

namespace mis {
namespace {

/// The sample's first scene, with something else in every strategy.
Report changed_report()
{
    Report report = sample_report();
    report.seed = 2;
    std::vector<StrategyReport>& s = report.scenes[0].strategies;
    for (double* part : {&s[0].variance.value, &s[0].variance.low, &s[0].variance.high})
        *part *= 1.5;
    s[1].status = Status::biased;
    s[2].exact = false;
    s[2].variance = {0.1, 0.09, 0.11};
    s[4].status = Status::not_run;
    s.pop_back();
    return report;
}

std::string text(const ChangesOptions& options = {})
{
    return changes_text(remarked_changes(sample_report(), changed_report(), options));
}

void expect_line(const std::string& start, const std::string& rest)
{
    std::istringstream lines(text({.worse_by = 0.05}));
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(start, 0) == 0 && line.find(rest) != std::string::npos) return;
    ADD_FAILURE() << start << " … " << rest << "\n" << text({.worse_by = 0.05});
}

TEST(ChangesText, HasAMarkAndARatioForEachStrategy)
{
    expect_line("! solid-angle/power", "1.50±");
    expect_line("! radiant-solid-angle/balance", "was ranked, is biased");
    expect_line("! uniform/light", "was exact");
    expect_line("~ power/power/one-sample", "biased in both");
    expect_line("* brdf", "was not resolved, is not run");
    expect_line("* uniform/power", "gone; was ranked");
    expect_line("~ all/balance@4+1", "not run in both");
    expect_line("~ solid-angle/power", "~<");  // of the other scene
    expect_line("! worse; * changed; ~ no change is seen; ~<9% it is below 9 %", "");
}

TEST(ChangesText, SaysInWordsWhatChanged)
{
    const std::string words = text();
    EXPECT_NE(words.find("The runs differ: seed 1, then 2."), std::string::npos) << words;
    EXPECT_NE(words.find("solid-angle/power: variance 1.50 ± "), std::string::npos) << words;
    EXPECT_NE(words.find("uniform/light: variance no longer exact"), std::string::npos) << words;
    EXPECT_EQ(words.find("egression"), std::string::npos) << words;  // not asked for
}

TEST(ChangesText, ListsRegressionsWhereTheyWereAskedFor)
{
    expect_line("Regressions (worse by more than 5 %", "");
    expect_line("plates: solid-angle/power: variance 1.50 ± ", "times what it was.");
    expect_line("plates: radiant-solid-angle/balance: now biased.", "");
    const std::string none =
        changes_text(remarked_changes(sample_report(), sample_report(), {.worse_by = 0.05}));
    EXPECT_NE(none.find("No regression: nothing is surely worse by more than 5 %."),
              std::string::npos)
        << none;
    EXPECT_NE(none.find(" 0 changed"), std::string::npos) << none;
}

TEST(ChangesText, FitsATerminal)
{
    std::istringstream lines(text({.worse_by = 0.05}));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(width_of(line), 80u) << line;
}

}  // namespace
}  // namespace mis
