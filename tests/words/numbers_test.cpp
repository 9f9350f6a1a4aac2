#include "mis/words/numbers.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace mis {
namespace {

TEST(Words, ShowNumbersShort)
{
    EXPECT_EQ(number(0.0123456), "0.0123");
    EXPECT_EQ(number(1.2e-5), "1.2e-5");
    EXPECT_EQ(number(12345), "12300");
    EXPECT_EQ(number(1.5e9), "1.5e9");
    EXPECT_EQ(number(0), "0");
    EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "?");
    EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "infinite");
    EXPECT_EQ(number(-2.5), "-2.5");
    EXPECT_EQ(count(1048576), "1048576");
    EXPECT_EQ(counted(1, "sample"), "1 sample");
    EXPECT_EQ(counted(256, "sample"), "256 samples");
    EXPECT_EQ(percent(0.02), "2 %");
    EXPECT_EQ(percent(0.123), "12 %");
}

TEST(Words, ShowErrorsWithOneDigit)
{
    EXPECT_EQ(with_error({3.42, 3.25, 3.6}), "3.4 ± 0.2");
    EXPECT_EQ(with_error({186, 180, 193}), "186 ± 7");
    EXPECT_EQ(with_error({1234, 1100, 1360}), "1200 ± 200");
    EXPECT_EQ(with_error({1.0003, 0.9991, 1.0014}), "1.000 ± 0.002");
    EXPECT_EQ(with_error({3.4, 2.9, 4.1}), "3.4 (2.9 to 4.1)");
    EXPECT_EQ(with_error({3.4, std::numeric_limits<double>::quiet_NaN(), 4}), "3.4");
    EXPECT_EQ(with_error({1, 1, 1}), "1");
    EXPECT_EQ(with_error({9.97, 9.02, 10.92}), "10 ± 1");
}

TEST(Words, ShowDurations)
{
    EXPECT_EQ(duration(0.83), "830 ms");
    EXPECT_EQ(duration(1.23), "1.2 s");
    EXPECT_EQ(duration(0), "0 s");
    EXPECT_EQ(duration(2e-5), "20 µs");
    EXPECT_EQ(duration(90), "90 s");
    EXPECT_EQ(duration(600), "10 min");
    EXPECT_EQ(duration(9000), "2.5 h");
    EXPECT_EQ(duration({0.125, 0.118, 0.132}), "125 ± 7 ms");
    EXPECT_EQ(duration({8, 5, 13}), "8 (5 to 13) s");
    EXPECT_EQ(duration({8, 8, 8}), "8 s");
    EXPECT_EQ(duration({8, std::numeric_limits<double>::quiet_NaN(), 9}), "8 s");
}

TEST(Words, ListNames)
{
    EXPECT_EQ(listed(std::vector<std::string>{}), "");
    EXPECT_EQ(listed(std::vector<std::string>{"a"}), "a");
    EXPECT_EQ(listed(std::vector<std::string>{"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace mis
