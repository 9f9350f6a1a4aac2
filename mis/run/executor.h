#pragma once

#include "mis/math/stop_token.h"

#include <concepts>
#include <cstddef>
#include <functional>

namespace mis {

/// Runs body(0) … body(n − 1), each once, on any thread and in any order; returns when all are
/// done. What a body throws is thrown again by the call. Bodies write to places of their own, so
/// results do not depend on the threads.
// clang-format off
template <class E>
concept Executor = requires(const E& executor, std::size_t n,
                            const std::function<void(std::size_t)>& body) {
    { executor.for_each(n, body) } -> std::same_as<void>;
    { executor.threads() } -> std::convertible_to<int>;
};
// clang-format on

/// Any executor, as a value that compiled code takes.
struct AnyExecutor {
    int threads = 1;  ///< how many run
    /// Executor::for_each.
    std::function<void(std::size_t n, const std::function<void(std::size_t)>& body)> for_each;
};

/// An executor as such a value.
template <Executor E> AnyExecutor any_executor(E executor)
{
    return {executor.threads(),
            [executor](std::size_t n, const auto& body) { executor.for_each(n, body); }};
}

/// The same executor, but once the token is up it begins no other body, and the call throws
/// Stopped: what the bodies were to write is then not all there.
inline AnyExecutor stoppable(const AnyExecutor& executor, const StopToken& stop)
{
    return {executor.threads, [executor, stop](std::size_t n, const auto& body) {
                executor.for_each(n, [&](std::size_t i) {
                    stop.check();
                    body(i);
                });
            }};
}

}  // namespace mis
