// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"
#include "renderer/pipeline/renderer.h"

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace afterglow {

/// Where a command that needs no window gets its OpenGL from.
enum class ContextChoice { Auto, OsMesa, Egl, Glfw };

struct ContextInfo {
    ContextChoice choice;
    std::string_view name;
    std::string_view meaning;
};
std::span<const ContextInfo> contexts();

std::string_view nameOf(ContextChoice choice);
ContextChoice contextFromName(std::string_view name); ///< UsageError names the nearest known

struct ContextWish {
    ContextChoice choice = ContextChoice::Auto;
    std::optional<int> device = {}; ///< one of eglDevices(), for Auto and Egl
};

/// Makes the context of a window that is not shown.
using HiddenContextFactory = std::unique_ptr<GlContext> (*)();

/// A renderer with all it stands on, in the order in which it must live and die.
struct Headless {
    Headless(ContextWish wish, HiddenContextFactory hiddenContext);

    /// Sees to it that no error of OpenGL goes with the context unseen; see requireNoGlErrors().
    ~Headless();
    Headless(const Headless&) = delete;
    Headless& operator=(const Headless&) = delete;

    /// Resizes; UsageError if this driver's textures cannot be that large.
    void resize(glm::ivec2 size);

    std::unique_ptr<GlContext> context;
    GlInfo gl;
    std::chrono::steady_clock::time_point contextMade = std::chrono::steady_clock::now();
    ShaderLibrary shaders;
    Renderer renderer;
};

/// Prints a line about what drew, if that was the CPU.
void noteSoftwareRenderer(const GlInfo& gl);

} // namespace afterglow
