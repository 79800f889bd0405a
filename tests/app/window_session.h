// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"
#include "tests/support/compare.h"
#include "tests/support/temporary_folder.h"
#include "virtual_display.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow::test {

using Picture = Image<glm::u8vec4>;

/// Mean difference between neighbors in a row: noise, where the picture is otherwise the same.
double roughnessOf(const Picture& picture);
bool same(const Picture& a, const Picture& b);
Picture crop(const Picture& picture, glm::ivec2 min, glm::ivec2 size);

struct WindowSetup {
    glm::ivec2 size{240, 160}; ///< of the window, for --size; 0: the program's own idea
    glm::ivec2 screen{900, 700};
    WindowManager manager = WindowManager::None;
    /// XDG_CONFIG_HOME. Empty: a new one for this session alone; else sessions may share it.
    std::filesystem::path configHome = {};
};

/// `afterglow view` with these words in a window on a display of its own, with hands on its keys
/// and mouse. The window has the focus, and at first the pointer at (60, 60). Places are in the
/// window's pixels, with y down.
///
/// 240 x 160 is too narrow for the panel; 240 x 140 is also too low for the strip, so that all of
/// the window is picture. Everything throws std::runtime_error with what the program said when it
/// ends or does not do what is waited for.
class WindowSession {
public:
    explicit WindowSession(const std::vector<std::string>& words, const WindowSetup& setup = {});

    // The keyboard; keys as xdotool names them: "p", "shift+F12", "ctrl+s", "Escape".
    void keys(std::vector<std::string> names);

    // The mouse.
    void moveTo(glm::ivec2 at);
    void drag(glm::ivec2 from, glm::ivec2 to); ///< with the left button
    /// From where the pointer is, with the right button: the program may hide and hold the pointer.
    void look(glm::ivec2 moved);
    void drop(const std::vector<std::filesystem::path>& files, glm::ivec2 at = {60, 60});

    // The window.
    void resize(glm::ivec2 size);
    void minimize(); ///< needs a window manager
    void restore();  ///< from minimized or hidden, with the focus
    glm::ivec2 size() const;
    std::string title() const;
    /// xdotool with these words, for what has no name here.
    void act(const std::vector<std::string>& words) const { display_.act(words); }
    const std::string& window() const { return window_; } ///< its X id

    // What is seen.
    /// Presses the key and reads the picture that it saves: F12 the picture, shift+F12 the window.
    Picture picture(const std::string& key = "F12");
    Picture windowPicture() { return picture("shift+F12"); }
    Picture afterStep();
    /// Steps take their time: looks until nothing changes any more.
    Picture afterSteps(int count);
    /// The first picture of which this holds. `what` completes "no picture ...".
    Picture pictureWhere(const std::function<bool(const Picture&)>& holds, std::string_view what,
                         double seconds = 20.0, const std::string& key = "F12");
    /// `what` completes "it does not come about that ...".
    void waitUntil(const std::function<bool()>& holds, std::string_view what,
                   double seconds = 20.0);
    /// Waits for a file of the run folder and gives its path.
    std::filesystem::path waitForFile(const std::string& name, double seconds = 20.0);

    // What it leaves.
    const std::filesystem::path& runFolder() const { return run_; } ///< it works and saves there
    std::string log() const;                                        ///< stdout and stderr so far
    std::optional<int> exitCode(double seconds = 20.0) { return program_->wait(seconds); }
    /// ctrl+q, and the exit code.
    std::optional<int> quit();
    Process& program() { return *program_; }

private:
    [[noreturn]] void fail(const std::string& what);
    std::vector<std::string> at(glm::ivec2 place) const;

    TemporaryFolder folder_;
    std::filesystem::path run_, config_;
    VirtualDisplay display_;
    std::optional<Process> program_;
    std::string window_;
    int pictures_ = 0;
};

} // namespace afterglow::test
