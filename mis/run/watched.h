#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace mis {

/// Runs work() on a thread of its own while this one calls look() 20 times a
/// second, for callers who may be interrupted on their own thread alone. What
/// look() throws sets `stop`, and is thrown again once work() has ended, which
/// is to heed it. Else what work() throws is.
inline void watched(const std::function<void()>& work, const std::function<void()>& look,
                    std::atomic<bool>& stop)
{
    std::mutex mutex;
    std::condition_variable ended;
    bool is_done = false;
    std::exception_ptr of_work, of_look;
    std::thread worker([&] {
        try {
            work();
        } catch (...) {
            of_work = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        is_done = true;
        ended.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return is_done; })) {
        if (of_look) continue;
        lock.unlock();
        try {
            look();
        } catch (...) {
            of_look = std::current_exception();
            stop = true;
        }
        lock.lock();
    }
    lock.unlock();
    worker.join();
    if (of_look) std::rethrow_exception(of_look);
    if (of_work) std::rethrow_exception(of_work);
}

}  // namespace mis
