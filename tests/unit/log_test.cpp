// SPDX-License-Identifier: MIT
#include "renderer/base/log.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("messages go to the sink that is set, with their level, and to no other") {
    std::vector<std::string> first, second;
    const LogSink original = setLogSink([&](LogLevel level, std::string_view message) {
        first.push_back(std::to_string(int(level)) + std::string(message));
    });
    log(LogLevel::Error, "a");
    const LogSink before =
        setLogSink([&](LogLevel, std::string_view message) { second.emplace_back(message); });
    log(LogLevel::Info, "b");
    setLogSink(before);
    log(LogLevel::Debug, "c");
    setLogSink({});
    log(LogLevel::Error, "dropped");
    setLogSink(original);
    CHECK(first == std::vector<std::string>{"3a", "0c"});
    CHECK(second == std::vector<std::string>{"b"});
}

TEST_CASE("a sink may log and may replace itself") {
    std::vector<std::string> seen;
    const LogSink original = setLogSink([&](LogLevel, std::string_view message) {
        seen.emplace_back(message);
        setLogSink([&](LogLevel, std::string_view later) { seen.emplace_back(later); });
        log(LogLevel::Info, "from the sink");
    });
    log(LogLevel::Info, "from outside");
    setLogSink(original);
    CHECK(seen == std::vector<std::string>{"from outside", "from the sink"});
}
