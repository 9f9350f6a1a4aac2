#include "mis/io/text_layout.h"

#include "mis/words/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace mis {
namespace {

TEST(ShortNumbers, TakeSixPlaces)
{
    EXPECT_EQ(short_number(0.01234), "0.0123");
    EXPECT_EQ(short_number(1.23e-5), "1.2e-5");
    EXPECT_EQ(short_number(123456), "123456");
    EXPECT_EQ(short_number(9999.6), "10000");
    EXPECT_EQ(short_number(1.26e9), "1.3e9");
    EXPECT_EQ(short_number(9.99e9), "1.0e10");
    EXPECT_EQ(short_number(0), "0");
    EXPECT_EQ(short_number(std::nan("")), "");
    EXPECT_EQ(short_interval({2, 1.9, 2.11}), "2.0±0.2");
    EXPECT_EQ(short_interval({0, 0, 0}), "0");
    EXPECT_EQ(short_interval({3544, 688, 253061}), "3500(690–250000)");
    EXPECT_EQ(short_duration(0.5), "0.5s");
    EXPECT_EQ(short_duration(1e-5), "10µs");
    EXPECT_EQ(short_duration(7200), "2h");
    EXPECT_EQ(short_duration(Interval{0.83, 0.81, 0.85}), "830±20ms");
    EXPECT_EQ(short_duration(Interval{5e-3, 3e-3, 9e-3}), "5(3–9)ms");
    EXPECT_EQ(short_duration(Interval{7200, 7200, 7200}), "2h");
}

TEST(Printable, LeavesNoControlCharacter)
{
    EXPECT_EQ(printable("a\tb\x1b[31m\x7f"), "a\\u0009b\\u001b[31m\\u007f");
    EXPECT_EQ(printable("\u009b31m \u00a0é☃\xc2"), "\\u009b31m \u00a0é☃\xc2");
    EXPECT_EQ(printable("a\u202etxt\u2066\u2028é"), "a\\u202etxt\\u2066\u2028é");
}

TEST(Wrapped, BreaksBetweenWordsAndIndents)
{
    EXPECT_EQ(wrapped("one two three", 2, 8), "one two\n  three\n");
    EXPECT_EQ(wrapped("within 2 % or 3 ± 1", 0, 8), "within\n2 % or\n3 ± 1\n");
    EXPECT_EQ(wrapped("after 11 (9.2 to 13) µs, or so", 0, 9),
              "after\n11 (9.2 to 13) µs,\nor so\n");
    EXPECT_EQ(wrapped("in 1.7 s on 2 threads", 0, 6), "in\n1.7 s\non 2\nthreads\n");
    EXPECT_EQ(wrapped("a (2 more) b", 0, 4), "a\n(2 more)\nb\n");
    EXPECT_EQ(wrapped("unbreakable", 2, 4), "unbreakable\n");
    EXPECT_EQ(wrapped("é é é é", 0, 7), "é é é é\n");
    EXPECT_EQ(wrapped("red \x1b[31mlamp", 0, 80), "red \\u001b[31mlamp\n");
}

TEST(ShortNumbers, HaveIntervalsInTheFormThatSentencesHave)
{
    for (const Interval& x : {Interval{2, 1.9, 2.11},
                              {3544, 688, 253061},
                              {1.234e-5, 1.2e-5, 1.3e-5},
                              {-0.5, -0.51, -0.49},
                              {0.99, 0.97, 1.01}}) {
        std::string compact = with_error(x);
        for (const auto& [wide, narrow] :
             {std::pair<std::string, std::string>{" ± ", "±"}, {" (", "("}, {" to ", "–"}})
            if (const std::size_t at = compact.find(wide); at != compact.npos)
                compact.replace(at, wide.size(), narrow);
        EXPECT_EQ(short_interval(x), compact);
    }
    EXPECT_EQ(short_interval({1.234e-5, 1.2e-5, 1.3e-5}), "1.23e-5±7e-7");
}

TEST(Fitted, BreaksLinesBetweenWordsBelowTheirText)
{
    EXPECT_EQ(fitted("short\n", 10), "short\n");
    EXPECT_EQ(fitted("one two three\nfour", 8), "one two\n  three\nfour");
    EXPECT_EQ(fitted("  a  one two three\n", 12), "  a  one two\n     three\n");
    EXPECT_EQ(fitted("    mis replay a b c d\n", 10), "    mis replay a b c d\n");
    EXPECT_EQ(fitted("unbreakable\n\nx", 4), "unbreakable\n\nx");
}

TEST(Styled, MarksEveryLineAndOnlyWhereThereIsAStyle)
{
    EXPECT_EQ(styled("a\nb\n", Style::bold, {}), "a\nb\n");
    EXPECT_EQ(styled("a\nb\n", Style::bold, {.has_style = true}),
              "\x1b[1ma\x1b[0m\n\x1b[1mb\x1b[0m\n");
    EXPECT_EQ(styled("a\n", Style::plain, {.has_style = true}), "a\n");
}

TEST(Legend, NamesTheMarksThatAreUsed)
{
    Legend legend;
    EXPECT_EQ(legend.text({}), "");
    legend.add(true, "~ open");
    legend.add(false, "= tied");
    legend.add(true, "* new");
    EXPECT_EQ(legend.text({}), "~ open; * new\n");
}

TEST(TextTable, LeavesColumnsOutWhereThereIsNoRoomAndSaysSo)
{
    TextTable table({{"rank", "name", "first", "second", "third"}}, {3, 2});
    table.add({"1", "power", "12345678", "12345678", "12345678"});
    EXPECT_EQ(table.text({.columns = 40}),
              "rank name     first   second    third\n   1 power 12345678 12345678 12345678\n");
    EXPECT_EQ(table.text({.columns = 36}),
              "rank name     first    third\n   1 power 12345678 12345678\nno room for: second\n");
    EXPECT_EQ(table.text({.columns = 24}),
              "rank name     third\n   1 power 12345678\nno room for: first,\n  second\n");
}

TEST(TextTable, PutsLongNamesOnALineOfTheirOwn)
{
    TextTable table({{"rank", "name", "a", "b"}});
    table.add({"1", std::string(75, 'x'), "12.5", "3"});
    table.add_remark("-", "short", "a remark");
    const std::string text = table.text();
    EXPECT_NE(text.find(std::string(75, 'x') + "\n"), std::string::npos);
    std::size_t start = 0;
    for (std::size_t end; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
        EXPECT_LE(end - start, 80u);
    EXPECT_NE(text.find("a remark"), std::string::npos);
}

}  // namespace
}  // namespace mis
