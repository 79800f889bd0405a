// SPDX-License-Identifier: MIT
// The workbench in a real window: what keys and the mouse do, by the pictures and the files that
// the program saves.

#include "program.h"
#include "renderer/image/image_io.h"
#include "tests/support/source_dir.h"
#include "window_session.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// The columns of a CSV file, by name; no cell of ours has a comma in it.
std::vector<std::map<std::string, std::string>> rowsOf(const std::filesystem::path& file) {
    std::istringstream text(bytesOf(file));
    std::string line, cell;
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(text, line)) {
        if (line.starts_with('#')) // what the curves belong to
            continue;
        if (line.ends_with('\r'))
            line.pop_back();
        std::vector<std::string> cells;
        std::istringstream parts(line);
        while (std::getline(parts, cell, ','))
            cells.push_back(cell);
        if (names.empty()) {
            names = cells;
            continue;
        }
        cells.resize(names.size());
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i)
            row[names[i]] = cells[i];
    }
    return rows;
}

Picture columns(const Picture& picture, int from, int to) {
    return crop(picture, {from, 0}, {to - from, picture.size().y});
}

/// In most of its pixels.
bool differs(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        count += a.pixels()[i] != b.pixels()[i];
    return count > a.pixels().size() / 2;
}

/// In a window of 240 x 160 without curves and timeline the picture has 240 x 160 pixels.
std::vector<std::string> tinyScene(std::initializer_list<std::string> more = {}) {
    std::vector<std::string> words{"tiny", "--still", "--set", "signal=shadows"};
    words.insert(words.end(), more);
    return words;
}

} // namespace

TEST_CASE("the light goes out: the A-SVGF pane follows within a frame and the SVGF pane does not") {
    WindowSession session(tinyScene());
    session.keys({"p", "F8", "t"}); // paused, no timeline, wipe
    session.afterSteps(1);
    session.drag({4, 4}, {236, 156});
    session.keys({"F4"}); // where there is room for curves they would make the picture smaller
    session.afterSteps(18);
    const Picture before = session.picture();
    session.keys({"1"});
    const Picture after = session.afterSteps(2);
    // The halves of the wipe, clear of the divider.
    const int middle = before.size().x / 2, width = before.size().x;
    const double left =
        meanOf(columns(after, 8, middle - 8)) / meanOf(columns(before, 8, middle - 8));
    const double right = meanOf(columns(after, middle + 8, width - 8)) /
                         meanOf(columns(before, middle + 8, width - 8));
    CAPTURE(left);
    CAPTURE(right);
    CHECK(left < 0.5 * right);

    session.afterSteps(30);
    session.keys({"ctrl+e"});
    const auto rows = rowsOf(session.waitForFile("afterglow-curves-0001.csv"));
    int event = -1;
    std::map<std::string, double> start, next;
    for (const auto& row : rows) {
        const int frame = std::stoi(row.at("frame"));
        if (row.at("event").find("off") != std::string::npos)
            event = frame;
        if (row.at("response").empty())
            continue;
        if (frame == event + 1)
            next[row.at("pane")] = std::stod(row.at("response"));
    }
    REQUIRE(event > 10);
    REQUIRE(next.size() == 2);
    CAPTURE(next["A"]);
    CAPTURE(next["B"]);
    CHECK(next["A"] > 0.9);
    CHECK(next["B"] < 0.6);
    CHECK(session.quit() == 0);
    CHECK(session.log().find("GL_") == std::string::npos);
}

TEST_CASE("the divider of a wipe follows the mouse and the arrow keys") {
    WindowSession session(tinyScene());
    // Left A-SVGF, right the raw signal: noise tells where the divider is.
    session.keys({"p", "F8", "t", "g", "shift+f", "shift+f"});
    Picture picture = session.afterSteps(8);
    const int width = picture.size().x;
    const auto noise = [&](int fromPercent, int toPercent) {
        return roughnessOf(columns(picture, width * fromPercent / 100, width * toPercent / 100));
    };
    CHECK(noise(52, 70) > 3.0 * noise(30, 48));
    const double smooth = noise(30, 48), rough = noise(52, 70);
    session.drag({120, 80}, {180, 90});
    picture = session.picture();
    CHECK(noise(52, 70) < 0.5 * rough);
    session.drag({180, 80}, {60, 80});
    picture = session.picture();
    CHECK(noise(30, 48) > 2.0 * smooth);
    // From a quarter to beyond the half again.
    session.keys(std::vector<std::string>(15, "Right"));
    picture = session.picture();
    CHECK(noise(30, 48) < 1.5 * smooth);
    session.keys({"x"}); // the noisy one is left now
    picture = session.picture();
    CHECK(noise(30, 48) > 2.0 * smooth);
    CHECK(session.quit() == 0);
}

TEST_CASE("a step is a frame, a pass of a frame, or a loop that comes back to the same bits") {
    WindowSession session({"moving"});
    session.keys({"p", "F8"});
    const Picture first = session.afterSteps(3);
    CHECK_FALSE(same(session.afterStep(), first));
    // From pass to pass; the last image of a frame is its picture.
    session.keys({"period"});
    const Picture ids =
        session.pictureWhere([&](const Picture& p) { return differs(p, first); }, "of ids");
    session.keys(std::vector<std::string>(6, "period"));
    session.pictureWhere([&](const Picture& p) { return differs(p, ids); }, "of another pass");
    session.keys({"comma", "b"});
    const Picture in = session.afterSteps(1);

    session.keys({"i"});
    std::vector<Picture> round;
    for (int i = 0; i < 3; ++i)
        round.push_back(session.afterStep());
    session.keys({"o"});
    for (int i = 0; i < 6; ++i) {
        CAPTURE(i);
        CHECK(same(session.afterStep(), round[std::size_t(i % 3)]));
    }
    session.keys({"BackSpace"});
    CHECK_FALSE(same(session.afterStep(), round[0]));
    CHECK_FALSE(same(in, round[0]));
    CHECK(session.quit() == 0);
}

TEST_CASE(
    "a broken shader is told with file and line, the last good one stays, a mended one counts") {
    const TemporaryFolder folder;
    const auto shaders = folder.path() / "shaders";
    std::filesystem::copy(sourceDir() / "shaders", shaders,
                          std::filesystem::copy_options::recursive);
    const auto file = shaders / "post" / "tonemap.comp";
    const std::string good = bytesOf(file);
    const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
    WindowSession session(tinyScene({"--shaders", shaders.string()}), {.size = {720, 300}});
    session.keys({"p", "F8"});
    const Picture before = session.afterSteps(4);
    const Picture window = session.windowPicture();

    const std::size_t store = good.find("imageStore(display");
    REQUIRE(store != std::string::npos);
    std::string bad = good;
    bad.insert(store, "dott(1);\n    ");
    write(bad);
    session.keys({"F5"});
    // The message stands over the picture and not in it.
    session.pictureWhere([&](const Picture& p) { return !same(p, window); }, "with a message", 20.0,
                         "shift+F12");
    CHECK(same(session.picture(), before));

    std::string inverted = good;
    const std::size_t end = good.find(';', store);
    inverted.insert(end + 1, "\n    imageStore(display, p, vec4(0.0, 1.0, 0.0, 1.0));");
    write(inverted);
    session.keys({"F5", "p"}); // it shows with the next frames
    const Picture green = session.pictureWhere(
        [&](const Picture& p) {
            return p({100, 50}) == glm::u8vec4(0, 255, 0, 255);
        },
        "in green", 20.0, "F12");
    write(good);
    session.keys({"F5"});
    session.pictureWhere([&](const Picture& p) { return differs(p, green); }, "as it was", 20.0);
    CHECK(session.quit() == 0);
}

TEST_CASE(
    "files dropped on the window are opened: a scene, an experiment, and one that is neither") {
    WindowSession session({"tiny"});
    session.keys({"F8"});
    const std::filesystem::path source = sourceDir();
    session.drop({source / "assets" / "scenes" / "spinner.glb"});
    session.waitUntil([&] { return session.title().find("spinner") != std::string::npos; },
                      "the title names the scene");
    const auto experiment = session.runFolder() / "little.json";
    std::ofstream(experiment) << R"({"name": "little", "scene": "cornell", "size": [96, 54],
        "frames": 12, "variants": ["asvgf"], "timeline": [{"frame": 6, "light": "key", "on": false}]})";
    session.drop({experiment});
    session.waitUntil([&] { return session.title().find("96 x 54") != std::string::npos; },
                      "the title has the size of the experiment");
    CHECK(session.title().find("cornell") != std::string::npos);
    // It begins again and again: both lights of the picture are seen.
    session.keys({"p"});
    const double first = meanOf(session.afterSteps(1));
    session.pictureWhere(
        [&](const Picture&) {
            const double now = meanOf(session.afterStep());
            return std::abs(now - first) > 10.0;
        },
        "with the other light");

    std::ofstream(session.runFolder() / "broken.glb") << "nothing";
    session.drop({session.runFolder() / "broken.glb"});
    session.waitUntil([&] { return session.log().find("broken.glb") != std::string::npos; },
                      "the file is named");
    CHECK(session.title().find("cornell") != std::string::npos);
    CHECK(session.quit() == 0);
}

TEST_CASE("places, files and the window are remembered, until that is reset") {
    const TemporaryFolder config;
    const WindowSetup setup{.size = {230, 150}, .configHome = config.path()};
    Picture place;
    {
        WindowSession session({"cornell", "--still", "--filter", "none"}, setup);
        session.keys({"p", "v", "v", "v", "v"}); // an image without noise
        session.keys({"shift+c"});
        const Picture home = session.afterSteps(1);
        session.afterSteps(30);
        session.keys({"shift+c", "ctrl+b"});
        place = session.afterSteps(1);
        CHECK_FALSE(same(place, home));
        CHECK(session.quit() == 0);
    }
    const auto file = config.path() / "afterglow" / "preferences.json";
    REQUIRE(std::filesystem::exists(file));
    {
        // Without a word: the scene and the size of before.
        WindowSession session({"--still", "--filter", "none"},
                              {.size = {0, 0}, .configHome = config.path()});
        CHECK(session.size() == glm::ivec2(230, 150));
        session.waitUntil([&] { return session.title().find("cornell") != std::string::npos; },
                          "the scene is the last one");
        session.keys({"p", "v", "v", "v", "v", "ctrl+shift+1"});
        CHECK(same(session.afterSteps(1), place));
        CHECK(session.quit() == 0);
    }
    {
        WindowSession session({"tiny", "--reset-settings"}, setup);
        CHECK(session.quit() == 0);
        CHECK(bytesOf(file).find("place 1") == std::string::npos);
    }
    std::ofstream(file) << "{ broken";
    {
        WindowSession session({"tiny"}, setup);
        CHECK(session.log().find("preferences.json") != std::string::npos);
        CHECK(session.quit() == 0);
        CHECK(bytesOf(file.string() + ".broken") == "{ broken");
    }
}

TEST_CASE("the tour sets the scene, the keyboard reaches the panel, frames are recorded") {
    WindowSession session({"tiny"}, {.size = {1180, 660}, .screen = {1280, 720}});
    session.keys({"F6"});
    session.waitUntil([&] { return session.title().find("cornell") != std::string::npos; },
                      "the tour has its scene");
    session.keys({"Page_Down", "Page_Down", "Escape"});
    session.keys({"k", "k", "k", "shift+k"}); // slower and faster are no harm
    session.keys({"F9"});
    session.waitForFile("afterglow-0001/frame_00002.png", 40.0);
    session.keys({"F9", "p"});
    session.waitUntil(
        [&] { return std::filesystem::exists(session.runFolder() / "afterglow-0001.mp4"); },
        "the frames are a film", 60.0);

    // By keyboard alone: the first widget of the panel that is pressed changes the window.
    session.afterSteps(1);
    const Picture before = session.windowPicture();
    for (const char* key : {"F10", "Down", "Down", "space", "F10"}) {
        session.keys({key});
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    session.pictureWhere([&](const Picture& p) { return !same(p, before); }, "with a change", 20.0,
                         "shift+F12");
    CHECK(session.quit() == 0);
}
