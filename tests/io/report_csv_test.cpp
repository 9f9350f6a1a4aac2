#include "mis/io/report_csv.h"

#include "tests/io/sample_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace mis {
namespace {

/// RFC 4180, as any reader of tables takes it.
std::vector<std::vector<std::string>> parsed_csv(const std::string& text)
{
    std::vector<std::vector<std::string>> rows(1, {""});
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            rows.back().back() += text[++i];
        else if (c == '"') quoted = !quoted;
        else if (!quoted && c == ',') rows.back().emplace_back();
        else if (!quoted && c == '\r') rows.emplace_back(1, ""), ++i;
        else rows.back().back() += c;
    }
    rows.pop_back();  // what follows the last line's end
    return rows;
}

std::size_t column(const std::vector<std::string>& header, const std::string& name)
{
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
}

TEST(ReportCsv, HasOneRowForEachSceneAndStrategy)
{
    const Report report = sample_report();
    const auto rows = parsed_csv(report_csv(report));
    ASSERT_EQ(rows.size(), 1u + 2 * 7);
    for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
    EXPECT_EQ(rows[1][column(rows[0], "strategy")], "solid-angle/power");
    EXPECT_EQ(rows[8][column(rows[0], "scene")], "a, \"quoted\" name");
    EXPECT_EQ(rows[6][column(rows[0], "reason")], "its budget is past, said \"enough\"");
}

TEST(ReportCsv, HoldsTheFiguresWithAllTheirDigits)
{
    const Report report = sample_report();
    const auto rows = parsed_csv(report_csv(report));
    const Interval variance = report.scenes[0].strategies[0].variance;
    EXPECT_EQ(std::strtod(rows[1][column(rows[0], "variance")].c_str(), nullptr), variance.value);
    EXPECT_EQ(std::strtod(rows[1][column(rows[0], "variance_high")].c_str(), nullptr),
              variance.high);
}

TEST(ReportCsv, LeavesEmptyWhatIsNotKnown)
{
    const auto rows = parsed_csv(report_csv(sample_report()));
    EXPECT_EQ(rows[6][column(rows[0], "variance")], "");
    EXPECT_EQ(rows[6][column(rows[0], "rank")], "");
    EXPECT_EQ(rows[5][column(rows[0], "light_draws")], "0");
    EXPECT_EQ(rows[3][column(rows[0], "bsdf_draws")], "0");
    EXPECT_EQ(report_csv(sample_report()).find("nan"), std::string::npos);
}

TEST(ReportCsv, OfNothingIsAHeader) { EXPECT_EQ(parsed_csv(report_csv({})).size(), 1u); }

}  // namespace
}  // namespace mis
