// SPDX-License-Identifier: MIT
#include "app/workbench/preferences.h"

#include "app/base/json_reader.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <system_error>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxBytes = 1 << 20;

/// As few digits as make the same float again.
Json shortest(float value) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return Json::parse(digits.data(), end);
}

// What is read replaces a default; each function throws InputError for what it cannot read.

void readWindowSize(Preferences& p, const JsonReader& json) {
    const auto size = json.list("a width and a height", 2, 2);
    const auto length = [](const JsonReader& value) {
        return int(value.wholeNumber(kLeastWindow, kMostWindow));
    };
    p.windowSize = {length(size[0]), length(size[1])};
}

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

glm::quat readOrientation(const JsonReader& json) {
    const auto q = json.list("a rotation of 4 numbers: w, x, y, z", 4, 4);
    const auto part = [&](int i) { return float(q[std::size_t(i)].number(-1.001, 1.001)); };
    const glm::quat orientation(part(0), part(1), part(2), part(3));
    if (std::abs(glm::dot(orientation, orientation) - 1.0f) > 1e-3f)
        json.fail("a rotation: w, x, y, z of length 1");
    return orientation;
}

CameraBookmark readBookmark(const JsonReader& json) {
    json.expectKeys({"name", "position", "orientation", "verticalFov"});
    CameraBookmark bookmark;
    bookmark.name = json.at("name").text();
    const auto position = json.at("position").list("a position of 3 numbers", 3, 3);
    for (int i = 0; i < 3; ++i)
        bookmark.position[i] = float(position[std::size_t(i)].number(-1e30, 1e30));
    bookmark.orientation = readOrientation(json.at("orientation"));
    bookmark.verticalFov = float(json.at("verticalFov").number(0.01, 3.14));
    return bookmark;
}

void readBookmarks(Preferences& p, const JsonReader& json) {
    std::map<std::string, std::vector<CameraBookmark>> bookmarks;
    for (const auto& [scene, list] : json.members())
        for (const JsonReader& item : list.list("a list of at most 9 places", 1, kBookmarks))
            bookmarks[scene].push_back(readBookmark(item));
    p.bookmarks = std::move(bookmarks);
}

struct Member {
    std::string_view key;
    void (*read)(Preferences&, const JsonReader&);
};

constexpr Member kMembers[] = {
    {"windowSize", readWindowSize},
    {"showPanel", [](Preferences& p, const JsonReader& json) { p.showPanel = json.boolean(); }},
    {"uiScale", readUiScale},
    {"vsync", [](Preferences& p, const JsonReader& json) { p.vsync = json.boolean(); }},
    {"smoothScaling",
     [](Preferences& p, const JsonReader& json) { p.smoothScaling = json.boolean(); }},
    {"lastScene", [](Preferences& p, const JsonReader& json) { p.lastScene = json.text(); }},
    {"recentFiles", readRecentFiles},
    {"bookmarks", readBookmarks},
    {"tourDone", [](Preferences& p, const JsonReader& json) { p.tourDone = json.boolean(); }},
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

Json toJson(const CameraBookmark& bookmark) {
    Json json;
    json["name"] = bookmark.name;
    for (int i = 0; i < 3; ++i)
        json["position"].push_back(shortest(bookmark.position[i]));
    const glm::quat& q = bookmark.orientation;
    for (const float part : {q.w, q.x, q.y, q.z})
        json["orientation"].push_back(shortest(part));
    json["verticalFov"] = shortest(bookmark.verticalFov);
    return json;
}

Json toJson(const Preferences& p) {
    Json json;
    json["windowSize"] = {p.windowSize.x, p.windowSize.y};
    json["showPanel"] = p.showPanel;
    json["uiScale"] = shortest(p.uiScale);
    json["vsync"] = p.vsync;
    json["smoothScaling"] = p.smoothScaling;
    json["lastScene"] = p.lastScene;
    json["recentFiles"] = Json::array();
    for (const fs::path& file : p.recentFiles)
        json["recentFiles"].push_back(file.string());
    json["bookmarks"] = Json::object();
    for (const auto& [scene, places] : p.bookmarks)
        for (const CameraBookmark& place : places)
            json["bookmarks"][scene].push_back(toJson(place));
    json["tourDone"] = p.tourDone;
    return json;
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
    std::error_code error;
    if (path.has_parent_path())
        fs::create_directories(path.parent_path(), error);
    if (error)
        throw Error(path.parent_path().string() + ": cannot be created: " + error.message());
    if (!loadPreferences(path).warning.empty())
        keepBroken(path);
    writeFileAtomically(
        path, toJson(preferences).dump(4, ' ', false, Json::error_handler_t::replace) + "\n");
}

void resetPreferences(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        throw Error(path.string() + ": cannot be removed: " + error.message());
}

} // namespace afterglow
