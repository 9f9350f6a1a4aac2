#pragma once

#include "mis/engine/stopwatch.h"
#include "mis/math/stop_token.h"
#include "mis/study/stopping.h"

#include <atomic>
#include <chrono>

namespace mis {

/// The time of a study, which begins when this is made, and when what it does must end.
class StudyTime {
public:
    StudyTime(const StudyGoal& goal, const std::atomic<bool>* stop) : goal_(goal), stop_(stop) {}

    const StudyGoal& goal() const { return goal_; }
    const StopToken& stop() const { return stop_; }
    bool is_stopped() const { return stop_.is_up(); }

    double elapsed() const { return seconds_since(start_); }
    double left() const { return goal_.budget() - elapsed(); }
    /// CPU seconds that so many threads have in all; without end where samples are counted.
    double cpu_budget(int threads) const { return goal_.spp ? 1e300 : goal_.budget() * threads; }

    /// Up when the study is stopped, and once that share of its time is over.
    StopToken until(double share) const
    {
        if (goal_.spp) return stop_;
        return stop_.until(start_ + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(share * goal_.budget())));
    }

private:
    StudyGoal goal_;
    StopToken stop_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace mis
