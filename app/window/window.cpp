#include "app/window/window.h"

#include "renderer/base/error.h"

#include <utility>

#include <GLFW/glfw3.h>

namespace afterglow {
namespace {

constexpr std::pair<Key, int> kNamedKeys[] = {
    {Key::Escape, GLFW_KEY_ESCAPE},
    {Key::Tab, GLFW_KEY_TAB},
    {Key::Home, GLFW_KEY_HOME},
    {Key::Shift, GLFW_KEY_LEFT_SHIFT},
    {Key::Shift, GLFW_KEY_RIGHT_SHIFT},
    {Key::Control, GLFW_KEY_LEFT_CONTROL},
    {Key::Control, GLFW_KEY_RIGHT_CONTROL},
    {Key::F1, GLFW_KEY_F1},
    {Key::F12, GLFW_KEY_F12},
};

Key keyOfGlfw(int code) {
    for (const auto& [key, known] : kNamedKeys)
        if (known == code)
            return key;
    return code >= GLFW_KEY_SPACE && code < GLFW_KEY_ESCAPE ? Key(code) : Key::Unknown; // ASCII
}

std::string lastError() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

WindowInput& inputOf(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
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
    glfwSetWindowUserPointer(window_.get(), &input_);
    // Dear ImGui's back end comes later and hands on what it hears.
    glfwSetKeyCallback(window_.get(), [](GLFWwindow* w, int code, int, int action, int modifiers) {
        if (action == GLFW_PRESS)
            inputOf(w).strokes.push_back({.key = keyOfGlfw(code),
                                          .control = (modifiers & GLFW_MOD_CONTROL) != 0,
                                          .shift = (modifiers & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* w, int button, int action, int) {
        if (button == GLFW_MOUSE_BUTTON_RIGHT)
            (action == GLFW_PRESS ? inputOf(w).rightPressed : inputOf(w).rightReleased) = true;
    });
    glfwSetScrollCallback(window_.get(), [](GLFWwindow* w, double, double notches) {
        inputOf(w).wheel += float(notches);
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
