// Drives the real window on a virtual display, with its own keys and mouse, and looks at the
// pictures that it saves.

#include "program.h"
#include "renderer/image/image_io.h"
#include "virtual_display.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

namespace {

using Picture = Image<glm::u8vec4>;

std::string programPath() {
    const char* const program = std::getenv("AFTERGLOW_BIN");
    if (!program)
        throw std::runtime_error("AFTERGLOW_BIN is not set: which program is to be tested?");
    return program;
}

double meanOf(const Picture& picture) {
    double sum = 0.0;
    for (const glm::u8vec4& p : picture.pixels())
        sum += (p.r + p.g + p.b) / 3.0;
    return sum / double(picture.pixels().size());
}

// Mean difference between neighbors in a row: noise, where the picture is otherwise the same.
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

/// The program in a window of 240 x 160, too narrow for the panel, so that all of it is picture.
class Session {
public:
    explicit Session(const std::vector<std::string>& words)
        : display_(900, 700, folder_.path()),
          program_(withProgram(words), folder_.path(), display_.name(), "afterglow.log") {
        try {
            window_ = display_.windowTitled("Afterglow", program_, 30.0);
            display_.act({"mousemove", "--sync", "--window", window_, "60", "60"});
            display_.act({"windowfocus", window_});
        } catch (const std::exception& error) {
            throw std::runtime_error(error.what() + ("; the program said: " + log()));
        }
    }

    void keys(std::vector<std::string> names) {
        names.insert(names.begin(), "key");
        display_.act(names);
    }
    void act(std::initializer_list<std::string> words) { display_.act(words); }

    /// Presses F12 and waits for what it saves.
    Picture picture(const std::string& key = "F12") {
        keys({key});
        char name[32];
        std::snprintf(name, sizeof name, "afterglow-%04d.png", ++pictures_);
        const auto file = folder_.path() / name; // written whole or not at all
        for (int tries = 0; tries < 3000 && !std::filesystem::exists(file); ++tries) {
            if (!program_.isRunning())
                throw std::runtime_error("the program ended: " + log());
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return readPng(file);
    }
    Picture afterStep() {
        keys({"n"});
        return picture();
    }

    Picture afterSteps(int count) {
        keys(std::vector<std::string>(std::size_t(count), "n"));
        Picture before = picture();
        for (;;) { // steps take their time
            Picture now = picture();
            if (same(now, before))
                return now;
            before = std::move(now);
        }
    }

    std::optional<int> exitCode() { return program_.wait(20.0); }
    std::string log() const { return bytesOf(folder_.path() / "afterglow.log"); }
    const std::string& window() const { return window_; }
    const TemporaryFolder& folder() const { return folder_; }

private:
    static std::vector<std::string> withProgram(const std::vector<std::string>& words) {
        std::vector<std::string> all{programPath(), "view"};
        all.insert(all.end(), words.begin(), words.end());
        return all;
    }

    TemporaryFolder folder_;
    VirtualDisplay display_;
    Process program_;
    std::string window_;
    int pictures_ = 0;
};

} // namespace

TEST_CASE("keys, mouse and resizing do in the window what they promise") {
    Session session({"cornell", "--size", "240x160", "--filter", "none", "--debug"});

    // Pausing stops, a step renders one frame more.
    session.keys({"p"});
    const Picture paused = session.picture();
    CHECK(paused.size() == glm::ivec2(240, 160));
    CHECK(same(session.picture(), paused));
    const Picture noisy = session.afterStep();
    CHECK_FALSE(same(noisy, paused)); // another frame has other noise

    // Lights.
    session.keys({"1"});
    const Picture without = session.afterStep();
    CHECK(meanOf(without) < 0.9 * meanOf(noisy));
    session.keys({"l"});
    CHECK(meanOf(session.afterStep()) == doctest::Approx(meanOf(noisy)).epsilon(0.05));

    // Filters: none, fixed, svgf, asvgf and around. Another filter goes on with the history, H does
    // not.
    session.keys({"f"});
    const double noise = roughnessOf(noisy);
    CHECK(roughnessOf(session.afterSteps(15)) < 0.6 * noise);
    session.keys({"f"});
    CHECK(roughnessOf(session.afterStep()) < 0.6 * noise);
    session.keys({"shift+f"});
    CHECK(roughnessOf(session.afterStep()) < 0.7 * noise);
    session.keys({"h"});
    CHECK(roughnessOf(session.afterStep()) > 0.85 * noise);
    session.keys({"shift+f"});

    // The fourth image behind the picture is albedo, in which there is no noise: only the camera
    // counts.
    session.keys({"v", "v", "v", "v"});
    const Picture albedo = session.afterStep();
    CHECK(same(session.afterStep(), albedo));
    session.act({"mousedown", "3"});
    session.act({"mousemove_relative", "70", "12"});
    session.act({"mouseup", "3"});
    const Picture turned = session.afterStep();
    CHECK_FALSE(same(turned, albedo));
    session.keys({"r"});
    CHECK(same(session.afterStep(), albedo));
    session.keys({"b"});
    CHECK_FALSE(same(session.picture("ctrl+s"), albedo));

    // Sizes, with the program running.
    session.keys({"p"});
    for (const auto& [width, height] :
         {std::pair(251, 173), {1, 1}, {3, 200}, {540, 7}, {240, 160}}) {
        CAPTURE(width);
        session.act(
            {"windowsize", session.window(), std::to_string(width), std::to_string(height)});
        // The pointer may be outside of the small ones: keys go to the window that has the focus.
        glm::ivec2 saved{0};
        for (int tries = 0; tries < 40 && saved != glm::ivec2(width, height); ++tries)
            saved = session.picture().size();
        CHECK(saved == glm::ivec2(width, height));
    }

    // Hidden and shown again.
    session.act({"windowunmap", session.window()});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    session.act({"windowmap", session.window()});
    session.act({"windowminimize", session.window()});
    session.act({"windowmap", session.window()});
    session.act({"windowfocus", session.window()});
    CHECK(session.picture().size() == glm::ivec2(240, 160));

    session.keys({"ctrl+q"});
    CHECK(session.exitCode() == 0);
    CAPTURE(session.log());
    CHECK(session.log().find("GL_") == std::string::npos);
    CHECK(session.log().find("rror") == std::string::npos);
}

TEST_CASE("a window closes by itself after its frames and leaves the picture of all of it") {
    const TemporaryFolder folder;
    const VirtualDisplay display(900, 700, folder.path());
    Process program({programPath(), "view", "tiny", "--size", "720x300", "--frames", "3",
                     "--screenshot", "window.png"},
                    folder.path(), display.name(), "afterglow.log");
    CHECK(program.wait(60.0) == 0);
    CAPTURE(bytesOf(folder.path() / "afterglow.log"));
    const Picture window = readPng(folder.path() / "window.png");
    REQUIRE(window.size() == glm::ivec2(720, 300));
    // The panel on the left is darker than the lit scene beside it, and has letters on it.
    Picture panel({372, 300}), view({348, 270});
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 720; ++x)
            if (x < 372)
                panel({x, y}) = window({x, y});
            else if (y < 270) // above the line of facts
                view({x - 372, y}) = window({x, y});
    CHECK(meanOf(panel) < 60.0);
    CHECK(roughnessOf(panel) > 2.0);
    CHECK(meanOf(view) > 80.0);
}

TEST_CASE("without a display the window says so in one line") {
    const TemporaryFolder folder;
    for (const char* nowhere : {"", ":4242"}) {
        CAPTURE(nowhere);
        Process program({programPath(), "view", "tiny"}, folder.path(), nowhere, "afterglow.log");
        CHECK(program.wait(20.0) == 4);
        const std::string said = bytesOf(folder.path() / "afterglow.log");
        CAPTURE(said);
        CHECK(isOneErrorLine(said));
        CHECK(said.find("no display") != std::string::npos);
    }
}

TEST_CASE("a hidden window serves as a context for work without one") {
    const TemporaryFolder folder;
    const VirtualDisplay display(300, 200, folder.path());
    Process program({programPath(), "render", "tiny", "--context", "glfw", "--size", "31x17",
                     "--frames", "1", "--out", "out"},
                    folder.path(), display.name(), "afterglow.log");
    CHECK(program.wait(60.0) == 0);
    CAPTURE(bytesOf(folder.path() / "afterglow.log"));
    CHECK(readPng(folder.path() / "out" / "color_0000.png").size() == glm::ivec2(31, 17));
}
