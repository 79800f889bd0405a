// SPDX-License-Identifier: MIT
#include "app/bench/startup.h"

#include "app/bench/text_table.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace afterglow {

namespace {

using Clock = std::chrono::steady_clock;

/// Environment variables for drivers' shader caches: Mesa, the user's cache, NVIDIA.
constexpr std::array kCacheVariables{"MESA_SHADER_CACHE_DIR", "XDG_CACHE_HOME",
                                     "__GL_SHADER_DISK_CACHE_PATH"};
/// Set in the processes that are started here, which must not start any.
constexpr const char* kInside = "AFTERGLOW_STARTUP";
constexpr std::string_view kLineBegins = "startup: ";

/// A folder that is gone at the end of the scope.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "afterglow-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw Error(name + ": cannot be created: " + std::strerror(errno));
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::vector<std::string> environmentWith(const std::filesystem::path& cache) {
    std::vector<std::string> all;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view text(*entry);
        const std::string_view name = text.substr(0, text.find('='));
        if (std::ranges::find(kCacheVariables, name) == kCacheVariables.end())
            all.emplace_back(text);
    }
    for (const char* name : kCacheVariables)
        all.push_back(std::string(name) + "=" + cache.string());
    all.push_back(std::string(kInside) + "=1");
    return all;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Runs this program and waits for it; returns what it has written on standard output.
std::string outputOf(std::vector<std::string> words, const ScratchFolder& scratch,
                     const std::filesystem::path& cache) {
    words.insert(words.begin(), "afterglow");
    std::vector<std::string> environment = environmentWith(cache);
    const std::string output = (scratch.path() / "output").string();
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t process = 0;
    const int code = posix_spawn(&process, "/proc/self/exe", &files, nullptr,
                                 pointersTo(words).data(), pointersTo(environment).data());
    posix_spawn_file_actions_destroy(&files);
    if (code != 0)
        throw Error(std::string("the program cannot be started again: ") + std::strerror(code));
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error("the program that was started to measure its start has failed");
    return readFile(output);
}

/// The phases of one start, milliseconds.
std::vector<std::pair<std::string, double>> phasesOf(Clock::time_point start,
                                                     const StartupTimes& t) {
    const auto between = [](Clock::time_point from, Clock::time_point to) {
        return std::chrono::duration<double, std::milli>(to - from).count();
    };
    return {{"process", between(start, t.command)},
            {"scene", between(t.command, t.scene)},
            {"context", between(t.scene, t.context)},
            {"shaders", between(t.context, t.programs)},
            {"bvh", t.bvhMilliseconds},
            {"upload", between(t.programs, t.upload) - t.bvhMilliseconds},
            {"first frame", between(t.upload, t.first)},
            {"total", between(start, t.first)},
            {"second frame", between(t.first, t.second)}};
}

} // namespace

std::string lineOf(const StartupTimes& times) {
    nlohmann::ordered_json line{{"bvh_ms", times.bvhMilliseconds}};
    const auto add = [&](const char* name, Clock::time_point point) {
        line[name] = std::chrono::nanoseconds(point.time_since_epoch()).count();
    };
    add("command", times.command);
    add("scene", times.scene);
    add("context", times.context);
    add("programs", times.programs);
    add("upload", times.upload);
    add("first", times.first);
    add("second", times.second);
    return std::string(kLineBegins) + jsonText(line);
}

StartupTimes startupTimesIn(std::string_view output) {
    const std::size_t begin = output.rfind(kLineBegins);
    if (begin == output.npos)
        throw Error("the program that was started to measure its start has told no times");
    const std::string_view rest = output.substr(begin + kLineBegins.size());
    nlohmann::json line;
    try {
        line = parseSortedJson(rest.substr(0, rest.find('\n')));
    } catch (const nlohmann::json::exception&) { // as if it told nothing
    }
    const auto point = [&](const char* name) {
        if (!line.is_object() || !line.contains(name) || !line[name].is_number_integer())
            throw Error(std::string("the times of a start lack ") + name);
        return Clock::time_point(std::chrono::nanoseconds(line[name].get<std::int64_t>()));
    };
    return {.command = point("command"),
            .scene = point("scene"),
            .context = point("context"),
            .programs = point("programs"),
            .upload = point("upload"),
            .first = point("first"),
            .second = point("second"),
            .bvhMilliseconds = line.value("bvh_ms", 0.0)};
}

StartupFigures measureStartup(const std::vector<std::string>& words, int repeats) {
    if (std::getenv(kInside))
        throw Error("a process that was started to measure its start starts no others");
    std::vector<std::string> names;
    std::vector<std::array<std::vector<double>, 2>> samples; // by phase; cold, warm
    const ScratchFolder scratch;
    for (int i = 0; i < repeats; ++i) {
        const std::filesystem::path cache = scratch.path() / std::to_string(i);
        std::filesystem::create_directory(cache);
        for (const bool warm : {false, true}) {
            const auto start = Clock::now();
            const auto phases = phasesOf(start, startupTimesIn(outputOf(words, scratch, cache)));
            samples.resize(phases.size());
            names.clear();
            for (std::size_t p = 0; p < phases.size(); ++p) {
                names.push_back(phases[p].first);
                samples[p][warm ? 1 : 0].push_back(phases[p].second);
            }
        }
    }
    StartupFigures figures;
    for (std::size_t p = 0; p < names.size(); ++p)
        figures.phases.push_back(
            {.name = names[p], .cold = spreadOf(samples[p][0]), .warm = spreadOf(samples[p][1])});
    return figures;
}

void addTo(Figures& figures, const std::string& subject, const StartupFigures& startup) {
    for (const StartupFigures::Phase& phase : startup.phases) {
        figures.add(subject, "startup.cold." + phase.name + ".ms", "ms", Better::Less, phase.cold);
        figures.add(subject, "startup.warm." + phase.name + ".ms", "ms", Better::Less, phase.warm);
    }
}

std::string tableOf(const StartupFigures& startup) {
    TextTable table({"start, ms", "shader cache cold", "quartiles", "warm", "quartiles"});
    const auto range = [](const Spread& spread) {
        return digits(spread.lower) + " - " + digits(spread.upper);
    };
    for (const StartupFigures::Phase& phase : startup.phases)
        table.add({phase.name, digits(phase.cold.median), range(phase.cold),
                   digits(phase.warm.median), range(phase.warm)});
    return table.text() + "\n";
}

} // namespace afterglow
