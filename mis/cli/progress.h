#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace mis::cli {

/// A line on standard error that shows how far a run is, perhaps under a table of what is known so
/// far: redrawn in place where standard error is a terminal, nothing otherwise, and nothing where
/// it is not wanted.
class Progress {
public:
    explicit Progress(bool is_wanted);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Would show() draw? At most ten times a second.
    bool is_due() const;
    /// done: in [0, 1]. table: lines that fit into the terminal; those that it has no room
    /// for are left out.
    void show(const std::string& what, double done, const std::string& table = "");
    void clear();

private:
    void go_back() const;

    bool is_shown_;
    bool is_drawn_ = false;
    std::size_t lines_above_ = 0;  ///< of the table, as drawn last
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace mis::cli
