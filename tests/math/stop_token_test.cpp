#include "mis/math/stop_token.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

TEST(StopToken, IsNeverUpUnlessSomethingSaysSo)
{
    const std::atomic<bool>* const none = nullptr;
    EXPECT_FALSE(StopToken().is_up());
    EXPECT_FALSE(StopToken(none).is_up());
    EXPECT_NO_THROW(StopToken().check());
}

TEST(StopToken, IsUpOnceItsFlagItsQuestionOrItsTimeSaysSo)
{
    std::atomic<bool> flag{false};
    bool answer = false;
    const std::function<bool()> asked = [&] { return answer; };
    const StopToken by_flag(&flag), by_question(&asked);
    EXPECT_FALSE(by_flag.is_up());
    EXPECT_FALSE(by_question.is_up());
    flag = answer = true;
    EXPECT_TRUE(by_flag.is_up());
    EXPECT_TRUE(by_question.is_up());
    EXPECT_THROW(by_flag.check(), Stopped);
    const auto now = StopToken::Clock::now();
    EXPECT_TRUE(StopToken().until(now).is_up());
    EXPECT_FALSE(StopToken().until(now + std::chrono::hours(1)).is_up());
    EXPECT_TRUE(by_flag.until(now + std::chrono::hours(1)).is_up());
}

TEST(StopToken, KeepsTheEarlierOfTwoTimes)
{
    const auto now = StopToken::Clock::now(), later = now + std::chrono::hours(1);
    EXPECT_TRUE(StopToken().until(now).until(later).is_up());
    EXPECT_TRUE(StopToken().until(later).until(now).is_up());
}

TEST(StopEvery, AsksAtOnceAndThenOnceInSoManyCalls)
{
    int asks = 0;
    const std::function<bool()> asked = [&] { return ++asks > 2; };
    const StopToken stop(&asked);
    StopEvery check(stop, 10);
    int calls = 0;
    EXPECT_THROW(
        for (;;) {
            ++calls;
            check();
        },
        Stopped);
    EXPECT_EQ(calls, 21);
}

}  // namespace
}  // namespace mis
