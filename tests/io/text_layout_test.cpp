#include "mis/io/text_layout.h"

#include <gtest/gtest.h>

#include <cmath>

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
    EXPECT_EQ(short_interval({2, 1.9, 2.11}), "2±6%");
    EXPECT_EQ(short_interval({0, 0, 0}), "0");
    EXPECT_EQ(short_interval({3544, 688, 253061}), "690-250000");
    EXPECT_EQ(short_duration(0.5), "0.5s");
    EXPECT_EQ(short_duration(1e-5), "10µs");
    EXPECT_EQ(short_duration(7200), "2h");
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
    EXPECT_EQ(wrapped("unbreakable", 2, 4), "unbreakable\n");
    EXPECT_EQ(wrapped("é é é é", 0, 7), "é é é é\n");
    EXPECT_EQ(wrapped("red \x1b[31mlamp", 0, 80), "red \\u001b[31mlamp\n");
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
