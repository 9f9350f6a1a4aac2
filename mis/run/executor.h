#pragma once

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

}  // namespace mis
