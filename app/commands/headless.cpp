// SPDX-License-Identifier: MIT
#include "app/commands/headless.h"

#include "app/commands/arguments.h"
#include "renderer/base/error.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <array>
#include <cstdio>

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

constexpr int kMostDevices = 1000;

std::unique_ptr<GlContext> makeContext(ContextWish wish, HiddenContextFactory hiddenContext) {
    const ContextOptions options{.device = wish.device};
    switch (wish.choice) {
    case ContextChoice::Auto: return createHeadlessContext(Backend::Auto, options);
    case ContextChoice::OsMesa: return createHeadlessContext(Backend::OsMesa, options);
    case ContextChoice::Egl: return createHeadlessContext(Backend::Egl, options);
    case ContextChoice::Glfw: break;
    }
    if (!hiddenContext)
        throw ContextError("this build has no window, so no context of kind glfw");
    return hiddenContext();
}

} // namespace

std::span<const ContextInfo> contexts() {
    return kContexts;
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

ContextWish contextFrom(const std::optional<std::string>& name,
                        const std::optional<std::string>& device) {
    ContextWish wish;
    if (name)
        wish.choice = contextFromName(*name);
    if (!device)
        return wish;
    if (wish.choice != ContextChoice::Auto && wish.choice != ContextChoice::Egl)
        throw UsageError("--device " + *device + ": only EGL has devices to choose from, so " +
                         "--context " + *name + " excludes it");
    wish.device = int(parseWhole("--device", *device, 0, kMostDevices));
    const std::size_t count = eglDevices().size();
    if (std::size_t(*wish.device) >= count)
        throw UsageError("--device " + *device + ": EGL has " + std::to_string(count) +
                         (count == 1 ? " device" : " devices") +
                         ", counted from 0; see afterglow list contexts");
    return wish;
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
        throw UsageError("--size " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                         ": the largest image of this driver is " + std::to_string(largest) +
                         " pixels along a side");
    renderer.resize(size);
}

void tellSoftwareRenderer(const GlInfo& gl) {
    if (gl.softwareRasterizer)
        std::printf("%s, a software renderer: times are of the CPU\n", gl.renderer.c_str());
}

} // namespace afterglow
