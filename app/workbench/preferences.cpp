// SPDX-License-Identifier: MIT
#include "app/workbench/preferences.h"

#include "app/base/json_reader.h"
#include "app/base/output.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxBytes = 1 << 20;

// What is read replaces a default; each function throws InputError for what it cannot read.

void readUiScale(Preferences& p, const JsonReader& json) {
    const double scale = json.number(0.0, 4.0);
    if (scale > 0.0 && scale < 0.5)
        json.fail("0, or a number from 0.5 to 4");
    p.uiScale = float(scale);
}

void readRecentFiles(Preferences& p, const JsonReader& json) {
    std::vector<fs::path> files;
    for (const JsonReader& item : json.list("a list of at most 10 files", 0, kRecentFiles)) {
        const fs::path file = item.text();
        if (!file.is_absolute())
            item.fail("an absolute path");
        if (std::ranges::count(files, file) > 0)
            item.refuse("is there twice");
        files.push_back(file);
    }
    p.recentFiles = std::move(files);
}

CameraBookmark readBookmark(const JsonReader& json) {
    json.expectKeys({"name", "position", "orientation", "verticalFov"});
    const JsonReader orientation = json.at("orientation");
    const auto q =
        orientation.vector<glm::vec4>("a rotation of 4 numbers: w, x, y, z", -1.001, 1.001);
    if (std::abs(glm::dot(q, q) - 1.0f) > 1e-3f)
        orientation.fail("a rotation: w, x, y, z of length 1");
    return {.name = json.at("name").text(),
            .position =
                json.at("position").vector<glm::vec3>("a position of 3 numbers", -1e30, 1e30),
            .orientation = glm::quat(q[0], q[1], q[2], q[3]),
            .verticalFov = float(json.at("verticalFov").number(0.01, 3.14))};
}

void readBookmarks(Preferences& p, const JsonReader& json) {
    std::map<std::string, std::vector<CameraBookmark>> bookmarks;
    for (const auto& [scene, list] : json.members())
        for (const JsonReader& item : list.list("a list of at most 9 places", 1, kBookmarks))
            bookmarks[scene].push_back(readBookmark(item));
    p.bookmarks = std::move(bookmarks);
}

Json toJson(const CameraBookmark& bookmark) {
    const glm::vec3& p = bookmark.position;
    const glm::quat& q = bookmark.orientation;
    return {{"name", bookmark.name},
            {"position", {shortest(p.x), shortest(p.y), shortest(p.z)}},
            {"orientation", {shortest(q.w), shortest(q.x), shortest(q.y), shortest(q.z)}},
            {"verticalFov", shortest(bookmark.verticalFov)}};
}

/// A member of the file, read and written.
struct Member {
    std::string_view key;
    void (*read)(Preferences&, const JsonReader&);
    Json (*write)(const Preferences&);
};

/// A truth value or a text.
template <auto member>
constexpr Member plain(std::string_view key) {
    return {key,
            [](Preferences& p, const JsonReader& json) {
                if constexpr (std::is_same_v<decltype(p.*member), bool&>)
                    p.*member = json.boolean();
                else
                    p.*member = json.text();
            },
            [](const Preferences& p) { return Json(p.*member); }};
}

constexpr Member kMembers[] = {
    {"windowSize",
     [](Preferences& p, const JsonReader& json) {
         p.windowSize = json.vector<glm::ivec2>("a width and a height", kLeastWindow, kMostWindow);
     },
     [](const Preferences& p) {
         return Json{p.windowSize.x, p.windowSize.y};
     }},
    plain<&Preferences::showPanel>("showPanel"),
    {"uiScale", readUiScale, [](const Preferences& p) { return Json(shortest(p.uiScale)); }},
    plain<&Preferences::vsync>("vsync"),
    plain<&Preferences::smoothScaling>("smoothScaling"),
    plain<&Preferences::lastScene>("lastScene"),
    {"recentFiles", readRecentFiles,
     [](const Preferences& p) {
         Json files = Json::array();
         for (const fs::path& file : p.recentFiles)
             files.push_back(file.string());
         return files;
     }},
    {"bookmarks", readBookmarks,
     [](const Preferences& p) {
         Json bookmarks = Json::object();
         for (const auto& [scene, places] : p.bookmarks)
             for (const CameraBookmark& place : places)
                 bookmarks[scene].push_back(toJson(place));
         return bookmarks;
     }},
    plain<&Preferences::tourDone>("tourDone"),
};

/// Throws for a file that cannot be read at all; what is wrong inside it is collected.
std::vector<std::string> read(Preferences& preferences, const fs::path& path) {
    const JsonDocument document(readFile(path, kMaxBytes), path.string());
    std::vector<std::string> faults;
    for (const auto& [key, value] : document.root().members()) {
        const auto member = std::ranges::find(kMembers, key, &Member::key);
        try {
            if (member == std::end(kMembers))
                value.refuse("there is no such preference");
            member->read(preferences, value);
        } catch (const InputError& error) {
            faults.push_back(error.what());
        }
    }
    return faults;
}

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::status(path, ignored).type() != fs::file_type::not_found;
}

void keepBroken(const fs::path& path) {
    fs::path kept = path;
    kept += ".broken";
    std::error_code error;
    fs::copy_file(path, kept, fs::copy_options::overwrite_existing, error);
    if (error)
        throw Error(path.string() + ": cannot be kept as " + kept.string() + ": " +
                    error.message());
}

std::string fromEnvironment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

} // namespace

void rememberFile(Preferences& preferences, const fs::path& file) {
    const fs::path absolute = fs::absolute(file).lexically_normal();
    std::vector<fs::path>& files = preferences.recentFiles;
    std::erase(files, absolute);
    files.insert(files.begin(), absolute);
    files.resize(std::min(files.size(), kRecentFiles));
}

void rememberPlace(Preferences& preferences, const std::string& scene, CameraBookmark bookmark) {
    std::vector<CameraBookmark>& places = preferences.bookmarks[scene];
    const auto same = std::ranges::find(places, bookmark.name, &CameraBookmark::name);
    if (same != places.end())
        *same = std::move(bookmark);
    else if (places.size() < kBookmarks)
        places.push_back(std::move(bookmark));
    else
        throw UsageError(std::to_string(kBookmarks) +
                         " places of a scene are remembered; forget one first");
}

ConfigEnvironment configEnvironment() {
    return {.xdgConfigHome = fromEnvironment("XDG_CONFIG_HOME"), .home = fromEnvironment("HOME")};
}

std::optional<fs::path> configFolder(const ConfigEnvironment& environment) {
    const fs::path config = environment.xdgConfigHome, home = environment.home;
    if (config.is_absolute())
        return config / "afterglow";
    if (home.is_absolute())
        return home / ".config" / "afterglow";
    return std::nullopt;
}

LoadedPreferences loadPreferences(const fs::path& path) {
    LoadedPreferences loaded;
    if (!isThere(path))
        return loaded;
    try {
        const std::vector<std::string> faults = read(loaded.preferences, path);
        if (!faults.empty())
            loaded.warning = faults[0];
        if (faults.size() > 1)
            loaded.warning += " (and " + std::to_string(faults.size() - 1) + " more)";
    } catch (const InputError& error) {
        loaded.warning = error.what();
    }
    return loaded;
}

void savePreferences(const fs::path& path, const Preferences& preferences) {
    if (path.has_parent_path())
        const OutputFolder made(path.parent_path());
    if (!loadPreferences(path).warning.empty())
        keepBroken(path);
    Json json;
    for (const Member& member : kMembers)
        json[std::string(member.key)] = member.write(preferences);
    writeFileAtomically(path, jsonText(json, 4) + "\n");
}

void resetPreferences(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        throw Error(path.string() + ": cannot be removed: " + error.message());
}

} // namespace afterglow
