// SPDX-License-Identifier: MIT
#include "app/window/window.h"

#include "renderer/base/error.h"

#include <utility>

#include <GLFW/glfw3.h>

namespace afterglow {
namespace {

constexpr std::pair<Key, int> kNamedKeys[] = {
    {Key::Escape, GLFW_KEY_ESCAPE},
    {Key::Tab, GLFW_KEY_TAB},
    {Key::Backspace, GLFW_KEY_BACKSPACE},
    {Key::Home, GLFW_KEY_HOME},
    {Key::PageUp, GLFW_KEY_PAGE_UP},
    {Key::PageDown, GLFW_KEY_PAGE_DOWN},
    {Key::Left, GLFW_KEY_LEFT},
    {Key::Right, GLFW_KEY_RIGHT},
    {Key::Up, GLFW_KEY_UP},
    {Key::Down, GLFW_KEY_DOWN},
    {Key::Shift, GLFW_KEY_LEFT_SHIFT},
    {Key::Shift, GLFW_KEY_RIGHT_SHIFT},
    {Key::Control, GLFW_KEY_LEFT_CONTROL},
    {Key::Control, GLFW_KEY_RIGHT_CONTROL},
};

Key keyOfGlfw(int code) {
    for (const auto& [key, known] : kNamedKeys)
        if (known == code)
            return key;
    if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12)
        return Key(int(Key::F1) + code - GLFW_KEY_F1);
    return code >= GLFW_KEY_SPACE && code < GLFW_KEY_ESCAPE ? Key(code) : Key::Unknown; // ASCII
}

std::string lastError() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

Window& windowOf(GLFWwindow* handle) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

} // namespace

Window::Library::Library() {
    if (!glfwInit())
        throw ContextError("GLFW: a window cannot be opened, there is no display (" + lastError() +
                           ")");
}

Window::Library::~Library() {
    glfwTerminate();
}

void Window::Destroy::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
}

Window::Window(const Options& options) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debugContext ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE); // options.size is in units, not in pixels
    window_.reset(
        glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr));
    if (!window_)
        throw ContextError("GLFW: no window with OpenGL 4.5 can be opened (" + lastError() + ")");

    glfwMakeContextCurrent(window_.get());
    initializeGl(glfwGetProcAddress, backend());
    glfwSwapInterval(1);

    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_.get(), &x, &y);
    cursor_ = {float(x), float(y)};
    seenAt_ = cursor_;
    glfwSetWindowUserPointer(window_.get(), this);
    // Dear ImGui's back end comes later and hands on what it hears.
    glfwSetKeyCallback(window_.get(), [](GLFWwindow* w, int code, int, int action, int modifiers) {
        if (action == GLFW_PRESS)
            windowOf(w).input_.strokes.push_back({.key = keyOfGlfw(code),
                                                  .control = (modifiers & GLFW_MOD_CONTROL) != 0,
                                                  .shift = (modifiers & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* w, int button, int action, int) {
        if (button == GLFW_MOUSE_BUTTON_RIGHT)
            (action == GLFW_PRESS ? windowOf(w).input_.rightPressed
                                  : windowOf(w).input_.rightReleased) = true;
        Window& window = windowOf(w);
        if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) {
            window.input_.leftPressed = true;
            window.input_.leftPressedAt = window.inPixels(window.seenAt_);
        } else if (button == GLFW_MOUSE_BUTTON_LEFT) {
            window.input_.leftReleased = true;
            window.input_.leftReleasedAt = window.inPixels(window.seenAt_);
        }
    });
    glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* w, double cursorX, double cursorY) {
        windowOf(w).seenAt_ = {float(cursorX), float(cursorY)};
    });
    glfwSetDropCallback(window_.get(), [](GLFWwindow* w, int count, const char** paths) {
        windowOf(w).input_.dropped.insert(windowOf(w).input_.dropped.end(), paths, paths + count);
    });
    glfwSetScrollCallback(window_.get(), [](GLFWwindow* w, double, double notches) {
        windowOf(w).input_.wheel += float(notches);
    });
}

Window::~Window() = default;

WindowInput Window::takeInput() {
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_.get(), &x, &y);
    const glm::vec2 cursor{float(x), float(y)};
    input_.cursorMoved = cursor - std::exchange(cursor_, cursor);
    return std::exchange(input_, {});
}

WindowInput Window::poll() {
    glfwPollEvents();
    return takeInput();
}

WindowInput Window::wait(double seconds) {
    glfwWaitEventsTimeout(seconds);
    return takeInput();
}

void Window::swap() {
    glfwSwapBuffers(window_.get());
}

bool Window::isDown(Key key) const {
    for (const auto& [known, code] : kNamedKeys)
        if (known == key && glfwGetKey(window_.get(), code) == GLFW_PRESS)
            return true;
    return int(key) >= GLFW_KEY_SPACE && int(key) < GLFW_KEY_ESCAPE &&
           glfwGetKey(window_.get(), int(key)) == GLFW_PRESS;
}

bool Window::closeWanted() const {
    return glfwWindowShouldClose(window_.get());
}

bool Window::isMinimized() const {
    return glfwGetWindowAttrib(window_.get(), GLFW_ICONIFIED);
}

glm::ivec2 Window::framebufferSize() const {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(window_.get(), &size.x, &size.y);
    return size;
}

float Window::contentScale() const {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_.get(), &x, &y);
    return x > 0.0f ? x : 1.0f;
}

glm::ivec2 Window::size() const {
    glm::ivec2 size{0};
    glfwGetWindowSize(window_.get(), &size.x, &size.y);
    return size;
}

glm::ivec2 Window::sizeInUnits() const {
    return glm::ivec2(glm::round(glm::vec2(framebufferSize()) / contentScale()));
}

glm::vec2 Window::inPixels(glm::vec2 screen) const {
    return screen * glm::vec2(framebufferSize()) / glm::vec2(glm::max(size(), glm::ivec2(1)));
}

glm::vec2 Window::cursor() const {
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_.get(), &x, &y);
    return inPixels({float(x), float(y)});
}

void Window::waitForScreen(bool waits) {
    glfwSwapInterval(waits ? 1 : 0);
}

std::string Window::clipboard() const {
    const char* const text = glfwGetClipboardString(window_.get());
    return text ? text : "";
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(window_.get(), text.c_str());
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_.get(), title.c_str());
}

void Window::captureCursor(bool captured) {
    glfwSetInputMode(window_.get(), GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_.get(), &x, &y);
    cursor_ = {float(x), float(y)}; // the jump is no movement
}

std::unique_ptr<GlContext> createHiddenWindowContext() {
    return std::make_unique<Window>(Window::Options{.size = {16, 16}, .visible = false});
}

} // namespace afterglow
