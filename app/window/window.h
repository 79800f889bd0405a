// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/keymap.h"
#include "renderer/gl/context.h"

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

struct GLFWwindow;

namespace afterglow {

/// What happened since the last look at the window.
struct WindowInput {
    std::vector<KeyStroke> strokes; ///< keys that went down, with repeats left out
    glm::vec2 cursorMoved{0.0f};    ///< screen coordinates, y down
    float wheel = 0.0f;             ///< notches, away from the hand is positive
    bool rightPressed = false, rightReleased = false;
    bool leftPressed = false, leftReleased = false;
    // Where that was, in framebuffer pixels: by now the cursor may be elsewhere.
    glm::vec2 leftPressedAt{0.0f}, leftReleasedAt{0.0f};
    std::vector<std::string> dropped; ///< paths of files that were let fall on the window
};

/// An OpenGL context that can be seen. One at a time, on the main thread.
class Window final : public GlContext {
public:
    struct Options {
        std::string title = "Afterglow";
        glm::ivec2 size{1600, 900}; ///< screen coordinates
        bool visible = true;
        bool debugContext = false;
    };
    /// Throws ContextError "GLFW: ..." without a display or without OpenGL 4.5.
    explicit Window(const Options& options);
    ~Window() override;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    std::string_view backend() const override { return "GLFW"; }

    WindowInput poll();               ///< returns at once
    WindowInput wait(double seconds); ///< returns when something happens, or after that time
    void swap();                      ///< shows what was drawn

    bool isDown(Key key) const; ///< of keys that are held: all but the function keys
    bool closeWanted() const;
    bool isMinimized() const;
    glm::ivec2 framebufferSize() const; ///< pixels; 0 while minimized on some systems
    float contentScale() const;         ///< of the monitor: 2 where letters need twice the pixels
    glm::ivec2 sizeInUnits() const; ///< pixels of a monitor of scale 1: what Options::size asks for
    glm::ivec2 size() const;        ///< screen coordinates
    glm::vec2 cursor() const;       ///< framebuffer pixels
    void setTitle(const std::string& title);
    void waitForScreen(bool waits); ///< whether swap() waits until the screen has shown a frame
    std::string clipboard() const;  ///< empty if there is no text in it
    void setClipboard(const std::string& text);
    /// Hides the cursor and lets it move without end.
    void captureCursor(bool captured);

    GLFWwindow* handle() const { return window_.get(); } ///< for Dear ImGui's back end

private:
    struct Library { // glfwInit() and glfwTerminate()
        Library();
        ~Library();
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };
    struct Destroy {
        void operator()(GLFWwindow* window) const;
    };

    WindowInput takeInput();
    glm::vec2 inPixels(glm::vec2 screen) const;

    Library library_;
    std::unique_ptr<GLFWwindow, Destroy> window_;
    WindowInput input_;
    glm::vec2 cursor_{0.0f};
    glm::vec2 seenAt_{0.0f}; ///< the cursor, by the last event that told of it
};

/// A window that is never shown, as a context for work without one.
std::unique_ptr<GlContext> createHiddenWindowContext();

} // namespace afterglow
