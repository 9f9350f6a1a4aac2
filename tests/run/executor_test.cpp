#include "mis/run/executor.h"
#include "mis/run/made_once.h"
#include "mis/run/serial.h"
#include "mis/run/tbb.h"
#include "mis/run/watched.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mis {
namespace {

TEST(Stoppable, BeginsNoOtherBodyOnceItsTokenIsUp)
{
    constexpr std::size_t count = 100000;
    for (const AnyExecutor& executor :
         {any_executor(SerialExecutor{}), any_executor(TbbExecutor(3))}) {
        std::atomic<bool> stop{false};
        std::atomic<std::size_t> begun{0};
        const AnyExecutor stopped = stoppable(executor, StopToken(&stop));
        EXPECT_EQ(stopped.threads, executor.threads);
        EXPECT_THROW(stopped.for_each(count,
                                      [&](std::size_t) {
                                          if (++begun == 10) stop = true;
                                      }),
                     Stopped);
        EXPECT_LT(begun, 10U + static_cast<std::size_t>(executor.threads));
        stop = false, begun = 0;
        stopped.for_each(5, [&](std::size_t) { ++begun; });
        EXPECT_EQ(begun, 5U);
    }
}

TEST(MadeOnce, MakesAValueOnceAndKeepsNoneThatThrew)
{
    MadeOnce<int> values;
    int made = 0;
    const auto make = [&] { return ++made; };
    EXPECT_THROW(values.get("a", []() -> int { throw Stopped(); }), Stopped);
    EXPECT_EQ(values.get("a", make), 1);
    EXPECT_EQ(values.get("a", make), 1);
    EXPECT_EQ(values.get("b", make), 2);
}

TEST(Watched, SetsItsFlagWhereLookingThrowsAndThrowsThatOnceTheWorkHasEnded)
{
    std::atomic<bool> stop{false}, is_ended{false};
    const auto work = [&] {
        while (!stop) std::this_thread::yield();
        is_ended = true;
        throw Stopped();
    };
    EXPECT_THROW(watched(
                     work, [] { throw std::runtime_error("interrupted"); }, stop),
                 std::runtime_error);
    EXPECT_TRUE(is_ended);
}

TEST(Watched, PassesOnWhatTheWorkThrows)
{
    std::atomic<bool> stop{false};
    EXPECT_THROW(watched([] { throw Stopped(); }, [] {}, stop), Stopped);
    bool is_done = false;
    watched([&] { is_done = true; }, [] {}, stop);
    EXPECT_TRUE(is_done);
    EXPECT_FALSE(stop);
}

}  // namespace
}  // namespace mis
