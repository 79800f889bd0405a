// SPDX-License-Identifier: MIT
#include "renderer/base/log.h"

#include <cstdio>
#include <mutex>
#include <string>
#include <utility>

namespace afterglow {

namespace {

void writeToStandardError(LogLevel level, std::string_view message) {
    if (level == LogLevel::Debug)
        return;
    const char* prefix = level == LogLevel::Error     ? "error: "
                         : level == LogLevel::Warning ? "warning: "
                                                      : "";
    std::fprintf(stderr, "%s%.*s\n", prefix, int(message.size()), message.data());
}

// A driver may report from a thread of its own, so the sink has a lock.
struct SharedSink {
    std::mutex mutex;
    LogSink sink = writeToStandardError;
};

SharedSink& sharedSink() {
    static SharedSink shared;
    return shared;
}

} // namespace

void log(LogLevel level, std::string_view message) {
    LogSink sink;
    {
        const std::lock_guard lock(sharedSink().mutex);
        sink = sharedSink().sink;
    }
    if (sink)
        sink(level, message);
}

LogSink setLogSink(LogSink sink) {
    const std::lock_guard lock(sharedSink().mutex);
    return std::exchange(sharedSink().sink, std::move(sink));
}

} // namespace afterglow
