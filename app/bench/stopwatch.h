// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include <glad/gl.h>

namespace afterglow {

/// Returns the milliseconds that run() takes on this thread.
template <class Run>
double millisecondsOf(const Run& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

/// Returns the milliseconds from an idle device until it has done what run() asks of it.
template <class Run>
double millisecondsOnDevice(const Run& run) {
    glFinish();
    return millisecondsOf([&] {
        run();
        glFinish();
    });
}

} // namespace afterglow
