// SPDX-License-Identifier: MIT
// Drives the real window on a virtual display, with its own keys and mouse, and looks at the
// pictures that it saves.

#include "program.h"
#include "renderer/image/image_io.h"
#include "window_session.h"

#include <chrono>
#include <thread>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

namespace {

double processorSecondsIn(Process& program, double seconds) {
    const double before = program.processorSeconds();
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    return program.processorSeconds() - before;
}

} // namespace

TEST_CASE("keys, mouse and resizing do in the window what they promise") {
    const glm::ivec2 wanted(240, 140); // all of it is picture
    WindowSession session({"cornell", "--filter", "none", "--debug"}, {.size = wanted});

    // Pausing stops, a step renders one frame more.
    session.keys({"p"});
    const Picture paused = session.picture();
    CHECK(paused.size() == wanted);
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
    session.look({70, 12});
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
        const glm::ivec2 size(width, height);
        session.resize(size);
        // The pointer may be outside of the small ones: keys go to the window that has the focus.
        session.pictureWhere([&](const Picture& now) { return now.size() == size; },
                             "of the size of the window", 20.0, "shift+F12");
    }

    // Hidden and shown again.
    session.act({"windowunmap", session.window()});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    session.restore();
    CHECK(session.windowPicture().size() == glm::ivec2(240, 160));

    CHECK(session.quit() == 0);
    CAPTURE(session.log());
    CHECK(session.log().find("GL_") == std::string::npos);
    CHECK(session.log().find("rror") == std::string::npos);
}

TEST_CASE("a minimized window rests, and goes on as large as before when it is restored") {
    const glm::ivec2 size(240, 140);
    WindowSession session({"cornell", "--filter", "none"},
                          {.size = size, .manager = WindowManager::Plain});
    CHECK(session.size() == size);
    CHECK(session.windowPicture().size() == size);
    const double working = processorSecondsIn(session.program(), 0.5);

    session.minimize();
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // the frame at hand
    const double resting = processorSecondsIn(session.program(), 0.5);
    CAPTURE(working);
    CHECK(resting < 0.25 * working);

    session.restore();
    CHECK(session.windowPicture().size() == size);
    const Picture after = session.picture();
    session.pictureWhere([&](const Picture& now) { return !same(now, after); },
                         "of another frame, which has other noise");
    CHECK(session.quit() == 0);
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
