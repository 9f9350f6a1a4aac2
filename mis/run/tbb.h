#pragma once

#include "mis/run/executor.h"

#include <memory>

namespace mis {

/// On a oneTBB arena of `threads` threads, the caller's among them; 0 takes as many as the machine
/// has.
class TbbExecutor {
public:
    /// Makes the arena.
    explicit TbbExecutor(int threads = 0);
    /// How many run.
    int threads() const;
    /// Executor::for_each.
    void for_each(std::size_t n, const std::function<void(std::size_t)>& body) const;

private:
    struct Arena;
    std::shared_ptr<Arena> arena_;
};
static_assert(Executor<TbbExecutor>);

}  // namespace mis
