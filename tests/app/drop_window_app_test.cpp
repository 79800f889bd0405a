// SPDX-License-Identifier: MIT
// Files dropped on a window, from the X server's side. The receiver here is a bare one of GLFW:
// what it hears is what the program can hear.

#include "drop_source.h"
#include "renderer/base/error.h"
#include "tests/support/temporary_folder.h"
#include "virtual_display.h"

#include <future>

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// A window of 200 x 100 with nothing in it, which keeps the names of what is dropped on it.
class Receiver {
public:
    explicit Receiver(const std::string& display) {
        setenv("DISPLAY", display.c_str(), 1);
        if (!glfwInit())
            throw std::runtime_error("GLFW does not start");
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window_ = glfwCreateWindow(200, 100, "Receiver", nullptr, nullptr);
        if (!window_)
            throw std::runtime_error("no window");
        glfwSetWindowUserPointer(window_, this);
        glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
            auto& self = *static_cast<Receiver*>(glfwGetWindowUserPointer(window));
            ++self.drops;
            self.files.assign(paths, paths + count);
        });
        glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
            static_cast<Receiver*>(glfwGetWindowUserPointer(window))->at = {x, y};
        });
    }
    ~Receiver() { glfwTerminate(); }
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    /// Events are looked at until the source is done.
    void serve(std::future<void>& source) {
        while (source.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            glfwWaitEventsTimeout(0.01);
        glfwPollEvents();
    }

    int drops = 0;
    std::vector<std::filesystem::path> files;
    glm::dvec2 at{-1.0}; ///< where the files were dragged last

private:
    GLFWwindow* window_ = nullptr;
};

} // namespace

TEST_CASE("files dropped on a window arrive with their names and the place, together and again") {
    const TemporaryFolder folder;
    const VirtualDisplay display(400, 300, folder.path());
    Receiver receiver(display.name());
    const std::string window = display.windowTitled("Receiver");
    using Files = std::vector<std::filesystem::path>;
    int drops = 0;
    for (const Files& files : {Files{folder / "scene.gltf"},
                               Files{folder / "two words.json", folder / "100% Gr\xc3\xbc\xc3\x9f"
                                                                         "e#?&+.json"},
                               Files(60, folder / "many.json")}) {
        const glm::ivec2 at{10 + 50 * drops, 30};
        auto source =
            std::async(std::launch::async, [&] { dropFiles(display.name(), window, files, at); });
        receiver.serve(source);
        source.get();
        CHECK(receiver.drops == ++drops);
        CHECK(receiver.files == files);
        CHECK(receiver.at.x == at.x);
        CHECK(receiver.at.y == at.y);
    }
}

TEST_CASE("dropping on a window that takes no files, is silent or is gone ends with the reason") {
    const TemporaryFolder folder;
    const VirtualDisplay display(400, 300, folder.path());
    std::string window;
    {
        const Receiver receiver(display.name());
        window = display.windowTitled("Receiver");
        const auto faultOf = [&](const std::string& target) {
            return messageOf<std::runtime_error>([&] {
                dropFiles(display.name(), target, {folder / "a.json"}, {5, 5}, 0.2);
            });
        };
        CHECK(faultOf(window) == "in vain was waited for XdndStatus");
        CHECK(faultOf(display.root()).find("takes no files") != std::string::npos);
    }
    CHECK(messageOf<std::runtime_error>([&] {
              dropFiles(display.name(), window, {folder / "a.json"}, {5, 5}, 0.2);
          }) == "there is no window to drop on");
}
