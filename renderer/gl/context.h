// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glad/gl.h>

namespace afterglow {

/// An OpenGL 4.5 core context, current on this thread from construction to destruction.
/// One at a time: a second one takes the thread from the first and does not give it back.
class GlContext {
public:
    virtual ~GlContext() = default;
    virtual std::string_view backend() const = 0; ///< "OSMesa", "EGL" or "GLFW"
};

enum class Backend {
    Auto,   ///< EGL; if that fails, OSMesa
    OsMesa, ///< Mesa's software renderer, without a display or a driver
    Egl,    ///< a GPU's own driver where there is one, else Mesa without a surface
};

struct ContextOptions {
    /// Lets the driver check more, and report each message before the call returns that it is
    /// about. Always so in builds that take shaders from the source folder.
    bool debug = false;
    /// Only this one of eglDevices(); not for OSMesa, which then is no way out either.
    std::optional<int> device = {};
};

/// Returns the names by which EGL's devices describe themselves without a context, in the order in
/// which EGL has them; nothing where there is no EGL, or one that has none to choose from.
std::vector<std::string> eglDevices();

/// Makes a context without a window. It has no default framebuffer that could be drawn into. Throws
/// ContextError, one line that names the library or version that is missing.
std::unique_ptr<GlContext> createHeadlessContext(Backend backend = Backend::Auto,
                                                 ContextOptions options = {});

/// Sets up a context that is current, for every back end alike: loads the functions, checks for
/// 4.5, sends the driver's messages to the log, puts row 0 at the top (glClipControl) with depth in
/// [0, 1], and packs pixels without padding. Throws ContextError. Messages are logged as they
/// happen if the context is one for debugging, or if it is to be taken for one: elsewhere that
/// would cost drivers with threads their speed.
void initializeGl(GLADloadfunc load, std::string_view backend, bool debug = false);

/// Returns the number of messages so far, over all contexts of the process, that mean this program
/// uses OpenGL wrongly or badly: errors, undefined or deprecated behavior, performance.
int glMessageCount();

/// Returns whether the CPU draws, going by the name of a renderer (GL_RENDERER).
bool isSoftwareRenderer(std::string_view renderer);

struct GlInfo {
    std::string vendor, renderer, version, backend;
    bool softwareRasterizer; ///< the CPU draws: timer queries are useless, image loads are fast
    int computeImageUnits;   ///< images one compute shader may use
};
GlInfo glInfo(const GlContext& context);

} // namespace afterglow
