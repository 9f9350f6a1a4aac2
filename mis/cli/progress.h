#pragma once

#include <chrono>
#include <string>

namespace mis::cli {

/// A line on standard error that shows how far a run is: redrawn in place where standard error is a
/// terminal, nothing otherwise, and nothing where it is not wanted.
class Progress {
public:
    explicit Progress(bool is_wanted);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// done: in [0, 1]. Draws at most ten times a second.
    void show(const std::string& what, double done);
    void clear();

private:
    bool is_shown_;
    bool is_drawn_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace mis::cli
