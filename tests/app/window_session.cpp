// SPDX-License-Identifier: MIT
#include "window_session.h"

#include "drop_source.h"
#include "program.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

namespace afterglow::test {
namespace {

using Clock = std::chrono::steady_clock;

// Between two movements of a hand, so that the program sees more than the last.
constexpr const char* kMoment = "0.03";

} // namespace

double roughnessOf(const Picture& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.size().y; ++y)
        for (int x = 1; x < picture.size().x; ++x)
            sum += std::abs(int(picture({x, y}).g) - int(picture({x - 1, y}).g));
    return sum / double(picture.pixels().size());
}

bool same(const Picture& a, const Picture& b) {
    return a.size() == b.size() && std::ranges::equal(a.pixels(), b.pixels());
}

Picture crop(const Picture& picture, glm::ivec2 min, glm::ivec2 size) {
    Picture part(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            part({x, y}) = picture(min + glm::ivec2(x, y));
    return part;
}

WindowSession::WindowSession(const std::vector<std::string>& words, const WindowSetup& setup)
    : run_(folder_ / "run"),
      config_(setup.configHome.empty() ? folder_ / "config" : setup.configHome),
      display_(setup.screen.x, setup.screen.y, folder_.path(), setup.manager) {
    std::filesystem::create_directory(run_);
    std::vector<std::string> all{programPath(), "view"};
    all.insert(all.end(), words.begin(), words.end());
    if (setup.size != glm::ivec2(0))
        all.insert(all.end(),
                   {"--size", std::to_string(setup.size.x) + "x" + std::to_string(setup.size.y)});
    program_.emplace(all, run_, display_.name(), "../afterglow.log", -1,
                     std::map<std::string, std::string>{{"XDG_CONFIG_HOME", config_.string()}});
    try {
        // The title tells the time of a frame once there is one: before, keys may have no effect.
        window_ = display_.windowTitled("Afterglow.* ms", 30.0, &*program_);
        moveTo({60, 60});
        act({"windowfocus", window_});
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

void WindowSession::fail(const std::string& what) {
    throw std::runtime_error(what + (program_->isRunning() ? "" : "; the program ended") +
                             "; the program said: " + log());
}

void WindowSession::keys(std::vector<std::string> names) {
    names.insert(names.begin(), "key");
    act(names);
}

std::vector<std::string> WindowSession::at(glm::ivec2 place) const {
    return {"mousemove", "--window", window_, std::to_string(place.x), std::to_string(place.y),
            "sleep",     kMoment};
}

void WindowSession::moveTo(glm::ivec2 place) {
    act(at(place));
}

void WindowSession::drag(glm::ivec2 from, glm::ivec2 to) {
    constexpr int kSteps = 4;
    std::vector<std::string> words = at(from);
    words.insert(words.end(), {"mousedown", "1", "sleep", kMoment});
    for (int i = 1; i <= kSteps; ++i) {
        const std::vector<std::string> step = at(from + (to - from) * i / kSteps);
        words.insert(words.end(), step.begin(), step.end());
    }
    words.insert(words.end(), {"mouseup", "1", "sleep", kMoment});
    act(words);
}

void WindowSession::look(glm::ivec2 moved) {
    act({"mousedown", "3"});
    act({"mousemove_relative", "--", std::to_string(moved.x), std::to_string(moved.y)});
    act({"mouseup", "3"});
}

void WindowSession::drop(const std::vector<std::filesystem::path>& files, glm::ivec2 place) {
    moveTo(place);
    try {
        dropFiles(display_.name(), window_, files, place);
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

void WindowSession::resize(glm::ivec2 size) {
    act({"windowsize", window_, std::to_string(size.x), std::to_string(size.y)});
}

void WindowSession::minimize() {
    act({"windowminimize", "--sync", window_});
}

void WindowSession::restore() {
    act({"windowmap", "--sync", window_});
    act({"windowfocus", window_});
}

glm::ivec2 WindowSession::size() const {
    std::istringstream said(display_.ask({"getwindowgeometry", "--shell", window_}));
    glm::ivec2 size{0};
    for (std::string line; std::getline(said, line);) {
        if (line.starts_with("WIDTH="))
            size.x = std::stoi(line.substr(6));
        if (line.starts_with("HEIGHT="))
            size.y = std::stoi(line.substr(7));
    }
    return size;
}

std::string WindowSession::title() const {
    const std::string said = display_.ask({"getwindowname", window_});
    return said.substr(0, said.find('\n'));
}

Picture WindowSession::picture(const std::string& key) {
    keys({key});
    char name[32];
    std::snprintf(name, sizeof name, "afterglow-%04d.png", ++pictures_);
    return readPng(waitForFile(name, 30.0)); // written whole or not at all
}

Picture WindowSession::afterStep() {
    keys({"n"});
    return picture();
}

Picture WindowSession::afterSteps(int count) {
    keys(std::vector<std::string>(std::size_t(count), "n"));
    Picture before = picture();
    for (;;) {
        Picture now = picture();
        if (same(now, before))
            return now;
        before = std::move(now);
    }
}

Picture WindowSession::pictureWhere(const std::function<bool(const Picture&)>& holds,
                                    std::string_view what, double seconds, const std::string& key) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
        Picture now = picture(key);
        if (holds(now))
            return now;
        if (Clock::now() >= end) {
            std::ostringstream said;
            said << "no picture " << what << " in " << seconds << " s; the last is " << now.size().x
                 << " x " << now.size().y << " with mean " << meanOf(now) << " and roughness "
                 << roughnessOf(now);
            fail(said.str());
        }
    }
}

void WindowSession::waitUntil(const std::function<bool()>& holds, std::string_view what,
                              double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!holds()) {
        if (Clock::now() >= end || !program_->isRunning()) {
            if (holds()) // meanwhile, before it ended
                return;
            fail("it does not come about that " + std::string(what));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

std::filesystem::path WindowSession::waitForFile(const std::string& name, double seconds) {
    const std::filesystem::path file = run_ / name;
    waitUntil([&] { return std::filesystem::exists(file); }, "there is " + name, seconds);
    return file;
}

std::string WindowSession::log() const {
    return bytesOf(folder_ / "afterglow.log");
}

std::optional<int> WindowSession::quit() {
    keys({"ctrl+q"});
    return exitCode();
}

} // namespace afterglow::test
