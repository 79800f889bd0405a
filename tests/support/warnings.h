// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/base/log.h"

#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// Collects the warnings of the log while it lives; nothing is written to standard error.
struct Warnings {
    Warnings() {
        before = setLogSink([this](LogLevel level, std::string_view text) {
            if (level == LogLevel::Warning)
                texts.emplace_back(text);
        });
    }
    Warnings(const Warnings&) = delete;
    Warnings& operator=(const Warnings&) = delete;
    ~Warnings() { setLogSink(before); }

    std::vector<std::string> texts;
    LogSink before;
};

} // namespace afterglow
