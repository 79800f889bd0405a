// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace afterglow {

/// Returns the number of threads that the machine runs at once, at least one.
inline unsigned hardwareThreads() {
    return std::max(1u, std::thread::hardware_concurrency());
}

/// Calls work(i) once for each i in [0, count), on up to `threads` threads of which the caller's is
/// one. Which thread has which i is open. Returns when all are done; the first exception of any is
/// thrown then, and what has not begun by that time is left out.
template <class Work>
void parallelFor(std::size_t count, unsigned threads, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto run = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++)
                work(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(failing);
            if (!failure)
                failure = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min<std::size_t>(threads, count); ++i)
            others.emplace_back(run);
        run();
    }
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace afterglow
