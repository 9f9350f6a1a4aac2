#pragma once

#include "mis/math/raise.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace mis {

/// Thrown by work that was told to stop before it was done; what it was making is lost.
struct Stopped : std::runtime_error {
    Stopped() : Stopped("stopped before it was done") {}
    /// what: as what() says it.
    explicit Stopped(const std::string& what) : std::runtime_error(what) {}
};

/// Is work to stop before it is done? All that may take more than some tenths of a second asks one,
/// every few milliseconds, on whatever thread it runs. Copies ask the same.
class StopToken {
public:
    /// What deadlines go by.
    using Clock = std::chrono::steady_clock;

    /// Never.
    StopToken() = default;
    /// Once the flag is set, by another thread or a signal. Kept by reference; null: never.
    explicit StopToken(const std::atomic<bool>* flag) : flag_(flag) {}
    /// Once `asked` says so, on any thread. Kept by reference.
    explicit StopToken(const std::function<bool()>* asked) : asked_(asked) {}

    /// This one, and from that time on in any case.
    StopToken until(Clock::time_point time) const
    {
        StopToken earlier = *this;
        if (!time_ || time < *time_) earlier.time_ = time;
        return earlier;
    }

    /// Is it time to stop?
    bool is_up() const
    {
        return (flag_ != nullptr && flag_->load(std::memory_order_relaxed)) ||
               (asked_ != nullptr && (*asked_)()) || (time_ && Clock::now() >= *time_);
    }
    /// Throws Stopped where it is.
    void check() const
    {
        if (is_up()) raise<Stopped>("stopped before it was done");
    }

private:
    const std::atomic<bool>* flag_ = nullptr;
    const std::function<bool()>* asked_ = nullptr;
    std::optional<Clock::time_point> time_;
};

/// Asks a token once in so many calls, for loops whose turns are short.
class StopEvery {
public:
    /// stop: kept by reference.
    StopEvery(const StopToken& stop, unsigned calls) : stop_(&stop), calls_(calls) {}
    /// Throws Stopped.
    void operator()()
    {
        if (--left_ > 0) return;
        left_ = calls_;
        stop_->check();
    }

private:
    const StopToken* stop_;
    unsigned calls_, left_ = 1;
};

}  // namespace mis
