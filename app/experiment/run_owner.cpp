// SPDX-License-Identifier: MIT
#include "app/experiment/run_owner.h"

#include "app/experiment/run_files.h"
#include "renderer/base/error.h"
#include "renderer/base/json.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRunFile = "experiment.json";
constexpr const char* kUnfinished = "unfinished.json"; // while there is no experiment.json

constexpr std::size_t kLongestValue = 40; // characters, in a message

bool holdsRun(const fs::path& folder) {
    return fs::exists(folder / kRunFile) || fs::exists(folder / kUnfinished);
}

/// The run in a folder.
WantedRun runIn(const fs::path& folder) {
    const fs::path file = folder / (fs::exists(folder / kRunFile) ? kRunFile : kUnfinished);
    const Json json = readJson(file);
    WantedRun run;
    try {
        run.experiment = json.at("experiment");
        run.experiment.at("name").get_ref<const std::string&>();
        for (const Json& variant : run.experiment.at("variants"))
            variant.at("name").get_ref<const std::string&>();
        if (json.contains("part"))
            run.part = {json["part"].at(0), json["part"].at(1)};
    } catch (const Json::exception&) {
        throw InputError(file.string() + ": this does not describe a run");
    }
    return run;
}

std::vector<fs::path> runsBelow(const fs::path& folder) {
    std::vector<fs::path> runs;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (holdsRun(entry.path()))
            runs.push_back(entry.path());
    std::ranges::sort(runs);
    return runs;
}

Json namesOfVariants(const Json& experiment) {
    Json names = Json::array();
    for (const Json& variant : experiment.at("variants"))
        names.push_back(variant.at("name"));
    return names;
}

std::string nameOf(const WantedRun& run) {
    return run.experiment.at("name");
}

std::string textOf(Part part) {
    return part.isWhole() ? "the whole" : fmt::format("part {} of {}", part.index, part.count);
}

/// "size [96,54] and not [61,37]", for each thing in which two runs differ; empty if they are the
/// same.
std::string differences(const WantedRun& there, const WantedRun& wanted) {
    std::string text;
    const auto add = [&](const std::string& difference) {
        text += (text.empty() ? "" : ", ") + difference;
    };
    if (there.part.index != wanted.part.index || there.part.count != wanted.part.count)
        add(textOf(there.part) + " and not " + textOf(wanted.part));
    for (const auto& [key, value] : wanted.experiment.items()) {
        const Json before = there.experiment.value(key, Json());
        if (before == value || (key == "variants" && wanted.anyVariants))
            continue;
        const bool areVariants = key == "variants";
        const std::string old = jsonText(areVariants ? namesOfVariants(there.experiment) : before);
        const std::string now = jsonText(areVariants ? namesOfVariants(wanted.experiment) : value);
        const bool isTold =
            old != now && old.size() <= kLongestValue && now.size() <= kLongestValue;
        add(isTold ? fmt::format("{} {} and not {}", key, old, now) : "other " + key);
    }
    return text;
}

/// Returns what the user is told of another run in the folder, or of runs below it; empty if there
/// is neither.
std::string obstacleFor(const WantedRun& wanted, const fs::path& folder) {
    const std::string path = folder.string(), name = nameOf(wanted);
    if (holdsRun(folder)) {
        const WantedRun there = runIn(folder);
        if (nameOf(there) != name)
            return fmt::format("{}: holds a run of {}, and {} was asked for; --fresh replaces it",
                               path, nameOf(there), name);
        const std::string other = differences(there, wanted);
        return other.empty() ? ""
                             : fmt::format("{}: holds another run of {}: {}; --fresh replaces it",
                                           path, name, other);
    }
    const std::vector<fs::path> runs = runsBelow(folder);
    return runs.empty() ? ""
                        : fmt::format("{}: holds folders of runs ({}{}), and {} was asked for in "
                                      "the folder itself; --fresh replaces them",
                                      path, runs[0].filename().string(),
                                      runs.size() > 1 ? ", ..." : "", name);
}

/// Removes the pictures and measures of a variant, or the pictures of the references.
void removeVariant(const fs::path& run, const std::string& name) {
    const fs::path folder = run / name;
    if (!isPlainName(name) || !fs::is_directory(folder))
        return;
    std::vector<fs::path> files{folder / "metrics.csv", folder / "timing.json",
                                folder / "import.json"};
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".png" &&
            entry.path().filename().string().starts_with("frame_"))
            files.push_back(entry.path());
    for (const auto& entry : fs::directory_iterator(folder / "maps", error))
        if (entry.path().extension() == ".png")
            files.push_back(entry.path());
    for (const fs::path& file : files)
        fs::remove(file);
    for (const fs::path& emptied : {folder / "maps", folder})
        fs::remove(emptied, error); // not if something else is in it
}

// The account says what else there is, so it goes last.
void removeRun(const fs::path& folder) {
    const WantedRun run = runIn(folder);
    removeVariant(folder, "reference");
    for (const Json& name : namesOfVariants(run.experiment))
        removeVariant(folder, name);
    for (const char* file : {"metrics.csv", "timing.json", "contact_sheet.png", "report.html",
                             "summary.json", kUnfinished, kRunFile})
        fs::remove(folder / file);
}

void removeRuns(const fs::path& folder) {
    if (holdsRun(folder))
        return removeRun(folder);
    std::error_code error;
    for (const fs::path& run : runsBelow(folder)) {
        removeRun(run);
        fs::remove(run, error); // not if something else is in it
    }
    fs::remove(folder / "report.html");
}

} // namespace

Json describe(const Experiment& experiment) {
    Json json = parseJson(toJson(experiment));
    // A file's path is relative to the file that names it, and that is another one now.
    if (fs::exists(experiment.scene))
        json["scene"] = fs::absolute(experiment.scene).lexically_normal().string();
    return json;
}

std::optional<Json> experimentIn(const fs::path& folder) {
    return holdsRun(folder) ? std::optional(runIn(folder).experiment) : std::nullopt;
}

void requireFolderFor(const WantedRun& wanted, const fs::path& folder) {
    const std::string obstacle = obstacleFor(wanted, folder);
    if (!obstacle.empty())
        throw UsageError(obstacle);
}

void requireFolderForRuns(const fs::path& folder) {
    if (holdsRun(folder))
        throw UsageError(fmt::format("{}: holds a run of {}, and folders of several runs were "
                                     "asked for; --fresh replaces it",
                                     folder.string(), nameOf(runIn(folder))));
}

void takeFolder(const WantedRun& wanted, const OutputFolder& folder, bool fresh) {
    const fs::path& path = folder.path();
    if (!fresh)
        requireFolderFor(wanted, path);
    else if (!obstacleFor(wanted, path).empty())
        removeRuns(path);
    const auto before = experimentIn(path);
    if (before == wanted.experiment)
        return;
    Json json{{"experiment", wanted.experiment}};
    if (!wanted.part.isWhole())
        json["part"] = {wanted.part.index, wanted.part.count};
    folder.writeJson(kUnfinished, json);
    if (!before)
        return;
    for (const char* file : {kRunFile, "summary.json"})
        fs::remove(path / file);
    const Json names = namesOfVariants(wanted.experiment);
    for (const Json& name : namesOfVariants(*before))
        if (std::ranges::find(names, name) == names.end())
            removeVariant(path, name);
}

void takeFolderForRuns(const OutputFolder& folder, bool fresh) {
    if (!fresh)
        requireFolderForRuns(folder.path());
    else if (holdsRun(folder.path()))
        removeRun(folder.path());
}

void writeAccount(const OutputFolder& folder, const Json& account) {
    folder.writeJson(kRunFile, account);
    fs::remove(folder.path() / kUnfinished);
}

} // namespace afterglow
