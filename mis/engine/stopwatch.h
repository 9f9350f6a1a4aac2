#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace mis {

using Clock = std::chrono::steady_clock;

/// Seconds by the clock on the wall.
inline double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// CPU seconds of the calling thread.
inline double thread_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A cheap clock of arbitrary unit, for shares of a time that thread_seconds() measures.
inline std::uint64_t ticks()
{
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

}  // namespace mis
