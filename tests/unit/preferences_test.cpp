// SPDX-License-Identifier: MIT
#include "app/workbench/preferences.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace afterglow;
namespace fs = std::filesystem;

namespace {

CameraBookmark place(std::string name) {
    return {.name = std::move(name),
            .position = {0.1f, -2.0f / 3.0f, 1e-7f},
            .orientation = glm::normalize(glm::quat(0.3f, 0.1f, -0.7f, 0.2f)),
            .verticalFov = 0.8f};
}

Preferences changed() {
    Preferences p;
    p.windowSize = {1001, 777};
    p.showPanel = false;
    p.uiScale = 1.5f;
    p.vsync = false;
    p.smoothScaling = false;
    p.lastScene = "hall";
    rememberFile(p, "/scenes/a \"quoted\" name.gltf");
    rememberFile(p, "/scenes/b.glb");
    rememberPlace(p, "hall", place("door"));
    rememberPlace(p, "hall", place("window"));
    rememberPlace(p, "/scenes/b.glb", place("door"));
    p.tourDone = true;
    return p;
}

} // namespace

TEST_CASE("preferences that are saved are loaded again, to the last bit") {
    const TemporaryFolder folder;
    const fs::path file = folder / "config/afterglow/preferences.json";
    for (const Preferences& p : {changed(), Preferences{}}) {
        savePreferences(file, p);
        const LoadedPreferences loaded = loadPreferences(file);
        CHECK(loaded.warning == "");
        CHECK(loaded.preferences == p);
    }
    CHECK_FALSE(changed() == Preferences{});
    // Nothing but the file itself.
    CHECK(std::distance(fs::directory_iterator(file.parent_path()), {}) == 1);
}

TEST_CASE("preferences that are not there are the defaults, and no fault") {
    const TemporaryFolder folder;
    const LoadedPreferences loaded = loadPreferences(folder / "none/preferences.json");
    CHECK(loaded.warning == "");
    CHECK(loaded.preferences == Preferences{});
}

TEST_CASE("a broken preference is at its default, the others are read, and one line names it") {
    const TemporaryFolder folder;
    const auto warningOf = [&](const std::string& text) {
        const LoadedPreferences loaded = loadPreferences(folder.write("preferences.json", text));
        // What is whole is read; what is broken is at its default.
        CHECK(loaded.preferences.vsync == (text.find(R"("vsync": false)") == std::string::npos));
        Preferences rest = loaded.preferences;
        rest.vsync = true;
        CHECK(rest == Preferences{});
        const std::string at = (folder / "preferences.json").string();
        REQUIRE(loaded.warning.starts_with(at));
        return loaded.warning.substr(at.size());
    };
    CHECK(warningOf("{\n\"vsync\": fals") == ":2: this is not JSON");
    CHECK(warningOf("") == ":1: this is not JSON");
    CHECK(warningOf("[]") == ": expected an object, found a list of 0");
    CHECK(warningOf(R"({"vsync": false, "color": 1})") == ": color: there is no such preference");
    CHECK(warningOf(R"({"windowSize": [1, 2], "vsync": false})") ==
          ": windowSize[0]: expected a whole number from 64 to 16384, found 1");
    CHECK(warningOf(R"({"uiScale": 0.1, "vsync": false})") ==
          ": uiScale: expected 0, or a number from 0.5 to 4, found 0.1");
    CHECK(warningOf(R"({"recentFiles": ["relative"], "vsync": false})") ==
          ": recentFiles[0]: expected an absolute path, found \"relative\"");
    CHECK(warningOf(R"({"recentFiles": ["/a", "/a"], "vsync": false})") ==
          ": recentFiles[1]: is there twice");
    CHECK(warningOf(R"({"showPanel": 1, "tourDone": "yes", "vsync": false})") ==
          ": showPanel: expected true or false, found 1 (and 1 more)");
    CHECK(warningOf(R"({"bookmarks": {"hall": [{"name": "a", "position": [0, 0, 0],
                        "orientation": [1, 1, 0, 0], "verticalFov": 1}]}, "vsync": false})") ==
          ": bookmarks.hall[0].orientation: expected a rotation: w, x, y, z of length 1, "
          "found a list of 4");
    CHECK(warningOf(R"({"bookmarks": {"hall": [{"name": "a", "position": [0, 0, 0],
                        "orientation": [1, 0, 0, 0], "verticalFov": 0}]}, "vsync": false})") ==
          ": bookmarks.hall[0].verticalFov: expected a number from 0.01 to 3.14, found 0");
}

TEST_CASE("a broken file of preferences is kept when the next one is saved, a whole one is not") {
    const TemporaryFolder folder;
    const fs::path file = folder.write("preferences.json", "{broken");
    const fs::path kept = folder / "preferences.json.broken";
    savePreferences(file, changed());
    CHECK(readFile(kept) == "{broken");
    CHECK(loadPreferences(file).preferences == changed());

    fs::remove(kept);
    savePreferences(file, Preferences{});
    CHECK_FALSE(fs::exists(kept));

    folder.write("preferences.json", R"({"color": 1})");
    savePreferences(file, Preferences{});
    CHECK(readFile(kept) == R"({"color": 1})");
}

TEST_CASE("preferences that cannot be written are one error that names the place") {
    const TemporaryFolder folder;
    const fs::path notFolder = folder.write("file", "");
    CHECK(messageOf<Error>([&] {
              savePreferences(notFolder / "preferences.json", {});
          }).starts_with(notFolder.string() + ": cannot be created: "));
    // A folder in the place of the file: it is read as broken, and cannot be kept or replaced.
    const fs::path inPlace = folder / "preferences.json";
    fs::create_directory(inPlace);
    CHECK(loadPreferences(inPlace).warning == inPlace.string() + ": is a folder, not a file");
    CHECK(messageOf<Error>([&] { savePreferences(inPlace, {}); }).starts_with(inPlace.string()));
    CHECK(fs::is_directory(inPlace));
}

TEST_CASE("resetting removes the preferences and nothing beside them") {
    const TemporaryFolder folder;
    const fs::path file = folder / "preferences.json";
    resetPreferences(file); // not there
    savePreferences(file, changed());
    const fs::path preset = folder.write("presets/mine.json", "{}");
    resetPreferences(file);
    CHECK_FALSE(fs::exists(file));
    CHECK(fs::exists(preset));
}

TEST_CASE("recent files are absolute, different and ten, the newest first") {
    Preferences p;
    for (int i = 0; i < 12; ++i)
        rememberFile(p, "/f" + std::to_string(i));
    REQUIRE(p.recentFiles.size() == kRecentFiles);
    CHECK(p.recentFiles.front() == "/f11");
    CHECK(p.recentFiles.back() == "/f2");
    rememberFile(p, "/x/../f5");
    CHECK(p.recentFiles.size() == kRecentFiles);
    CHECK(p.recentFiles[0] == "/f5");
    CHECK(p.recentFiles[1] == "/f11");
    CHECK(p.recentFiles.back() == "/f2");
    rememberFile(p, "here.gltf");
    CHECK(p.recentFiles[0] == fs::current_path() / "here.gltf");
}

TEST_CASE("a scene has nine places, and a name has one") {
    Preferences p;
    for (int i = 0; i < 9; ++i)
        rememberPlace(p, "hall", place(std::to_string(i)));
    CHECK_THROWS_AS(rememberPlace(p, "hall", place("ten")), UsageError);
    CameraBookmark moved = place("3");
    moved.position = glm::vec3(7.0f);
    rememberPlace(p, "hall", moved);
    REQUIRE(p.bookmarks["hall"].size() == 9);
    CHECK(p.bookmarks["hall"][3] == moved);
    rememberPlace(p, "cornell", place("ten"));
    CHECK(p.bookmarks["cornell"].size() == 1);
}

TEST_CASE("the folder of a user's files is where the XDG rules say") {
    CHECK(configFolder({.xdgConfigHome = "/x", .home = "/h"}) == "/x/afterglow");
    CHECK(configFolder({.xdgConfigHome = "", .home = "/h"}) == "/h/.config/afterglow");
    CHECK(configFolder({.xdgConfigHome = "relative", .home = "/h"}) == "/h/.config/afterglow");
    CHECK(configFolder({.xdgConfigHome = "/x", .home = ""}) == "/x/afterglow");
    CHECK_FALSE(configFolder({.xdgConfigHome = "", .home = ""}));
    CHECK_FALSE(configFolder({.xdgConfigHome = "../x", .home = "h"}));
}
