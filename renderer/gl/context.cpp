// SPDX-License-Identifier: MIT
#include "renderer/gl/context.h"

#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/gl/context_backends.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>

namespace afterglow {

namespace {

std::atomic<int> messageCount = 0;

// Notes that NVIDIA's driver files under performance, and which follow from reading results back or
// from moving a buffer once: nothing that could be done better.
constexpr std::array<GLuint, 3> kHarmlessPerformanceNotes{
    131154, // pixel transfer is synchronized with 3D rendering
    131186, // buffer object is being moved from video memory to host memory
    131218, // shader is being recompiled based on GL state
};

/// Returns how serious a driver's message is; Debug is not counted as misuse.
LogLevel levelOf(GLenum source, GLenum type, GLuint id) {
    // A shader that does not compile is reported by the program that was to be made of it.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER)
        return LogLevel::Debug;
    switch (type) {
    case GL_DEBUG_TYPE_ERROR:
    case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR: return LogLevel::Error;
    case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR: return LogLevel::Warning;
    case GL_DEBUG_TYPE_PERFORMANCE:
        return std::ranges::count(kHarmlessPerformanceNotes, id) ? LogLevel::Debug
                                                                 : LogLevel::Warning;
    default: return LogLevel::Debug;
    }
}

// Logs a message of the driver, which calls it, maybe from a thread of its own. Nothing may be
// thrown through it.
void GLAPIENTRY onMessage(GLenum source, GLenum type, GLuint id, GLenum, GLsizei length,
                          const GLchar* text, const void*) noexcept {
    const LogLevel level = levelOf(source, type, id);
    if (level != LogLevel::Debug)
        ++messageCount;
    std::string message(text, length >= 0 ? std::size_t(length) : std::string_view(text).size());
    while (message.ends_with('\n') || message.ends_with(' '))
        message.pop_back();
    if (level == LogLevel::Error && type == GL_DEBUG_TYPE_ERROR)
        noteReportedGlError(message);
    log(level, "OpenGL: " + message);
}

std::string text(GLenum name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return value ? value : "unknown";
}

/// Shortens "4.3 (Core Profile) Mesa 11.2" to "OpenGL 4.3 (Mesa 11.2)".
std::string shortVersion(std::string version) {
    const std::size_t space = version.find(' ');
    const std::string number = version.substr(0, space);
    std::string rest = space == std::string::npos ? "" : version.substr(space + 1);
    for (const std::string_view noise : {"(Core Profile) ", "(Compatibility Profile) "})
        if (rest.starts_with(noise))
            rest.erase(0, noise.size());
    return "OpenGL " + number + (rest.empty() ? "" : " (" + rest + ")");
}

} // namespace

std::unique_ptr<GlContext> createHeadlessContext(Backend backend, ContextOptions options) {
#ifdef AFTERGLOW_SHADER_DIR // a build for development
    options.debug = true;
#endif
    switch (backend) {
    case Backend::OsMesa: return createOsMesaContext(options);
    case Backend::Egl: return createEglContext(options);
    case Backend::Auto: break;
    }
    if (options.device)
        return createEglContext(options);
    std::string eglError;
    try {
        return createEglContext(options);
    } catch (const ContextError& error) {
        eglError = error.what();
    }
    try {
        return createOsMesaContext(options);
    } catch (const ContextError& error) {
        throw ContextError("no OpenGL 4.5 context without a window: " + eglError + "; " +
                           error.what());
    }
}

void initializeGl(GLADloadfunc load, std::string_view backend, bool debug) {
    const int version = gladLoadGL(load);
    if (version == 0)
        throw ContextError(std::string(backend) + " gives no OpenGL functions");
    if (version < GLAD_MAKE_VERSION(4, 5))
        throw ContextError("this driver offers " + shortVersion(text(GL_VERSION)) +
                           "; 4.5 is needed");

    beginGlErrors();
    glEnable(GL_DEBUG_OUTPUT);
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    if (debug || (flags & GL_CONTEXT_FLAG_DEBUG_BIT))
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    else
        glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, nullptr);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    // Where a buffer lies, which groups were pushed: so many that they cost time.
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr,
                          GL_FALSE);

    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    log(LogLevel::Debug, std::string(backend) + ": " + text(GL_RENDERER) + ", " + text(GL_VERSION));
}

int glMessageCount() {
    return messageCount;
}

bool isSoftwareRenderer(std::string_view renderer) {
    std::string name(renderer);
    std::ranges::transform(name, name.begin(),
                           [](unsigned char letter) { return char(std::tolower(letter)); });
    // Drivers on top of others (zink, ANGLE, D3D12, virgl) name those.
    for (const std::string_view known :
         {"llvmpipe", "lavapipe", "softpipe", "swiftshader", "microsoft basic render",
          "gdi generic", "software rasterizer", "apple software renderer"})
        if (name.find(known) != std::string::npos)
            return true;
    return name == "swr" || name.starts_with("swr "); // three letters could be part of a name
}

GlInfo glInfo(const GlContext& context) {
    GlInfo info;
    info.vendor = text(GL_VENDOR);
    info.renderer = text(GL_RENDERER);
    info.version = text(GL_VERSION);
    info.backend = context.backend();
    info.softwareRasterizer = isSoftwareRenderer(info.renderer);
    int units = 0, uniforms = 0;
    glGetIntegerv(GL_MAX_IMAGE_UNITS, &units);
    glGetIntegerv(GL_MAX_COMPUTE_IMAGE_UNIFORMS, &uniforms);
    info.computeImageUnits = std::min(units, uniforms);
    return info;
}

} // namespace afterglow
