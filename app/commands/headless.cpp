// SPDX-License-Identifier: MIT
#include "app/commands/headless.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace afterglow {

namespace {

constexpr std::array kContexts{
    ContextInfo{ContextChoice::Auto, "auto", "EGL; where that cannot be had, OSMesa"},
    ContextInfo{ContextChoice::OsMesa, "osmesa",
                "Mesa's software renderer, without a display or a driver"},
    ContextInfo{ContextChoice::Egl, "egl",
                "the GPU's driver without a display, else Mesa without a surface"},
    ContextInfo{ContextChoice::Glfw, "glfw", "a window that is not shown; needs a display"},
};

std::unique_ptr<GlContext> makeContext(ContextWish wish, HiddenContextFactory hiddenContext) {
    const ContextOptions options{.device = wish.device};
    switch (wish.choice) {
    case ContextChoice::Auto: return createHeadlessContext(Backend::Auto, options);
    case ContextChoice::OsMesa: return createHeadlessContext(Backend::OsMesa, options);
    case ContextChoice::Egl: return createHeadlessContext(Backend::Egl, options);
    case ContextChoice::Glfw: break;
    }
    return hiddenContext();
}

} // namespace

std::span<const ContextInfo> contexts() {
    return kContexts;
}

std::string_view nameOf(ContextChoice choice) {
    return std::ranges::find(kContexts, choice, &ContextInfo::choice)->name;
}

ContextChoice contextFromName(std::string_view name) {
    std::vector<std::string_view> known;
    for (const ContextInfo& info : kContexts) {
        if (info.name == name)
            return info.choice;
        known.push_back(info.name);
    }
    throw UsageError(unknownName("context", name, known));
}

Headless::Headless(ContextWish wish, HiddenContextFactory hiddenContext)
    : context(makeContext(wish, hiddenContext)), gl(glInfo(*context)),
      shaders(makeShaderLibrary(gl)), renderer(shaders, gl) {}

Headless::~Headless() {
    sweepGlErrors();
}

void Headless::resize(glm::ivec2 size) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(size.x, size.y) > largest)
        throw UsageError(
            fmt::format("--size: the largest image of this driver is {} pixels along a side, found "
                        "'{}x{}'",
                        largest, size.x, size.y));
    renderer.resize(size);
}

void noteSoftwareRenderer(const GlInfo& gl) {
    if (gl.softwareRasterizer)
        fmt::print("{}, a software renderer: times are of the CPU\n", gl.renderer);
}

} // namespace afterglow
