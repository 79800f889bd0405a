// SPDX-License-Identifier: MIT
#include "tests/support/gl_fixture.h"

#include "renderer/base/error.h"

#include <cstdlib>
#include <optional>

#include <doctest/doctest.h>

namespace afterglow {

namespace {

struct Fixture {
    std::unique_ptr<GlContext> context;
    std::optional<ShaderLibrary> shaders; // after the context: it goes first
};

Fixture& fixture() {
    static Fixture instance;
    return instance;
}

int expectedMessages = 0;

} // namespace

Backend testBackend() {
    const char* name = std::getenv("AFTERGLOW_CONTEXT");
    const std::string_view wanted = name ? name : "osmesa";
    if (wanted == "osmesa")
        return Backend::OsMesa;
    if (wanted == "egl")
        return Backend::Egl;
    if (wanted == "auto")
        return Backend::Auto;
    throw UsageError("AFTERGLOW_CONTEXT is " + std::string(wanted) +
                     "; it may be osmesa, egl or auto");
}

GlContext& testContext() {
    if (!fixture().context) {
        fixture().context = createHeadlessContext(testBackend(), {.debug = true});
        setStrictBindings(true);
    }
    return *fixture().context;
}

ShaderLibrary& testShaders() {
    if (!fixture().shaders)
        fixture().shaders.emplace(makeShaderLibrary(glInfo(testContext())));
    return *fixture().shaders;
}

void releaseTestContext() {
    fixture().shaders.reset();
    fixture().context.reset();
}

int unexpectedGlMessages() {
    return glMessageCount() - expectedMessages;
}

GlCheck::GlCheck() : before_(unexpectedGlMessages()) {}

GlCheck::~GlCheck() {
    CHECK_MESSAGE(unexpectedGlMessages() == before_, "OpenGL complained; see the messages above");
}

ExpectGlMessages::ExpectGlMessages() : before_(glMessageCount()) {}

ExpectGlMessages::~ExpectGlMessages() {
    expectedMessages += count();
}

int ExpectGlMessages::count() const {
    return glMessageCount() - before_;
}

} // namespace afterglow
