// SPDX-License-Identifier: MIT
#include "app/base/machine.h"

#include "app/base/build_commit.h"
#include "renderer/base/file.h"
#include "renderer/base/hash.h"

#include <fstream>
#include <thread>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

/// What follows `key` and a separator in the first line of a text file that begins with it.
std::string valueIn(const char* file, std::string_view key, char separator) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(key))
            continue;
        const std::size_t start = line.find_first_not_of(" \t\"", line.find(separator) + 1);
        if (start == line.npos)
            continue;
        return line.substr(start, line.find_last_not_of(" \t\"") + 1 - start);
    }
    return "unknown";
}

} // namespace

std::string_view commit() {
    return AFTERGLOW_COMMIT;
}

std::string programFingerprint() {
    static const std::string fingerprint = [] {
        Hash hash;
        hash.add(readFile("/proc/self/exe"));
        return hash.hex();
    }();
    return fingerprint;
}

nlohmann::ordered_json describeMachine() {
    return {{"cpu", valueIn("/proc/cpuinfo", "model name", ':')},
            {"threads", std::thread::hardware_concurrency()},
            {"os", valueIn("/etc/os-release", "PRETTY_NAME", '=')}};
}

} // namespace afterglow
