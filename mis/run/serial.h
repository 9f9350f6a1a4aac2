#pragma once

#include "mis/run/executor.h"

namespace mis {

/// One after the other, on the calling thread.
struct SerialExecutor {
    /// One.
    int threads() const { return 1; }
    /// Executor::for_each.
    void for_each(std::size_t n, const std::function<void(std::size_t)>& body) const
    {
        for (std::size_t i = 0; i < n; ++i) body(i);
    }
};
static_assert(Executor<SerialExecutor>);

}  // namespace mis
