// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/gl/context_backends.h"
#include "renderer/gl/errors.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/glsl_probe.h"

#include <thread>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// Collects what is logged while it lives.
class LogCapture {
public:
    LogCapture()
        : before_(setLogSink([this](LogLevel level, std::string_view message) {
              if (level >= LogLevel::Warning)
                  messages.emplace_back(message);
          })) {}
    LogCapture(const LogCapture&) = delete;
    LogCapture& operator=(const LogCapture&) = delete;
    ~LogCapture() { setLogSink(before_); }

    std::vector<std::string> messages;

private:
    LogSink before_;
};

/// A driver that is too old: as much of it as is asked before that is found out.
const GLubyte* GLAPIENTRY oldGetString(GLenum name) {
    return reinterpret_cast<const GLubyte*>(name == GL_VERSION ? "4.3 (Core Profile) Mesa 11.2"
                                                               : "old");
}
const GLubyte* GLAPIENTRY oldGetStringi(GLenum, GLuint) {
    return reinterpret_cast<const GLubyte*>("GL_ONE_extension");
}
void GLAPIENTRY oldGetIntegerv(GLenum, GLint* value) {
    *value = 1; // extension
}
GLADapiproc oldDriver(const char* name) {
    const std::string_view wanted = name;
    return wanted == "glGetString"     ? reinterpret_cast<GLADapiproc>(oldGetString)
           : wanted == "glGetStringi"  ? reinterpret_cast<GLADapiproc>(oldGetStringi)
           : wanted == "glGetIntegerv" ? reinterpret_cast<GLADapiproc>(oldGetIntegerv)
                                       : nullptr;
}

std::string contextErrorOf(auto make) {
    try {
        make();
    } catch (const ContextError& error) {
        return error.what();
    }
    return "no ContextError";
}

} // namespace

TEST_CASE("contexts of either back end work one after the other in one process") {
    releaseTestContext();
    for (const Backend backend : {Backend::OsMesa, Backend::Egl, Backend::OsMesa, Backend::Egl,
                                  Backend::Egl, Backend::Auto}) {
        const GlCheck check;
        const auto context = createHeadlessContext(backend, {.debug = true});
        CAPTURE(context->backend());
        if (backend != Backend::Auto)
            CHECK(context->backend() == (backend == Backend::Egl ? "EGL" : "OSMesa"));

        GLint major = 0, minor = 0, profile = 0;
        glGetIntegerv(GL_MAJOR_VERSION, &major);
        glGetIntegerv(GL_MINOR_VERSION, &minor);
        glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
        CHECK(10 * major + minor >= 45);
        CHECK(profile == GL_CONTEXT_CORE_PROFILE_BIT);

        GpuTexture texture("kept in this context", PixelFormat::RGBA32F, {3, 2});
        const Image<glm::vec4> image({3, 2}, {1, 2, 3, 4});
        texture.write(image);
        CHECK_CLOSE(texture.read<glm::vec4>(), image, Tolerance{});
    }
}

TEST_CASE("glInfo tells the driver apart from a software rasterizer") {
    const GlInfo info = glInfo(testContext());
    CHECK(info.backend == testContext().backend());
    CHECK(info.softwareRasterizer == (info.renderer.find("llvmpipe") != std::string::npos));
    CHECK(info.computeImageUnits >= 8); // what OpenGL 4.5 promises
    CHECK_FALSE(info.vendor.empty());
    CHECK(info.version.find('.') != std::string::npos);
}

TEST_CASE("every context has its origin at the upper left and depth from 0 to 1") {
    testContext();
    GLint origin = 0, depth = 0;
    glGetIntegerv(GL_CLIP_ORIGIN, &origin);
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &depth);
    CHECK(origin == GL_UPPER_LEFT);
    CHECK(depth == GL_ZERO_TO_ONE);
}

TEST_CASE("an error of OpenGL is logged where it happens, and counted") {
    testContext();
    const LogCapture log;
    const ExpectGlMessages expected;
    glEnable(GL_TEXTURE_2D); // not in a core profile
    CHECK(expected.count() == 1);
    REQUIRE(log.messages.size() == 1);
    CHECK(log.messages.front().starts_with("OpenGL: "));
    CHECK(log.messages.front().find('\n') == std::string::npos);
    CHECK(glGetError() == GL_INVALID_ENUM);
}

TEST_CASE("messages come as they happen in a context for debugging, and only there") {
    releaseTestContext();
    const auto isDebugContext = [] {
        GLint flags = 0;
        glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
        return (flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0;
    };
    for (const Backend backend : {Backend::OsMesa, Backend::Egl}) {
        const auto context = createHeadlessContext(backend, {.debug = true});
        CAPTURE(context->backend());
        CHECK(glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE);
        CHECK(glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS) == GL_TRUE);
        CHECK(isDebugContext() == (backend == Backend::Egl)); // OSMesa makes none
    }
    const auto context = createHeadlessContext(Backend::Egl);
    CHECK(glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE);
    CHECK((glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS) == GL_TRUE) == isDebugContext());
}

TEST_CASE("messages from threads of the driver are all counted") {
    testContext();
    const ExpectGlMessages expected;
    void* callback = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
    REQUIRE(callback);
    constexpr int kThreads = 4, kEach = 20'000;
    const int errors = glErrorCount();
    const LogSink before = setLogSink({});
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < kThreads; ++i)
            threads.emplace_back([callback] {
                for (int j = 0; j < kEach; ++j)
                    reinterpret_cast<GLDEBUGPROC>(callback)(
                        GL_DEBUG_SOURCE_API, GL_DEBUG_TYPE_ERROR, 1, GL_DEBUG_SEVERITY_HIGH, -1,
                        "from another thread", nullptr);
            });
    }
    setLogSink(before);
    CHECK(expected.count() == kThreads * kEach);
    CHECK(glErrorCount() == errors + kThreads * kEach);
}

TEST_CASE("a context is made on the device of EGL that was chosen, and on no other") {
    releaseTestContext();
    const int count = int(eglDevices().size());
    REQUIRE(count > 0);
    for (const Backend backend : {Backend::Egl, Backend::Auto}) {
        CHECK(createHeadlessContext(backend, {.device = 0})->backend() == "EGL");
        CHECK(contextErrorOf([&] { createHeadlessContext(backend, {.device = count}); }) ==
              "libEGL.so.1 has no device " + std::to_string(count));
    }
}

TEST_CASE("markers and groups of the program itself are not counted") {
    testContext();
    const LogCapture log;
    const int before = glMessageCount();
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "a pass");
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_MARKER, 0,
                         GL_DEBUG_SEVERITY_NOTIFICATION, -1, "here");
    glPopDebugGroup();
    CHECK(glMessageCount() == before);
    CHECK(log.messages.empty());
}

TEST_CASE("a driver below 4.5 is refused in one line that names what it offers") {
    releaseTestContext(); // this replaces the functions that the context uses
    CHECK(contextErrorOf([] { initializeGl(oldDriver, "test"); }) ==
          "this driver offers OpenGL 4.3 (Mesa 11.2); 4.5 is needed");
}

TEST_CASE("a driver without functions is refused") {
    releaseTestContext();
    CHECK(contextErrorOf([] {
              initializeGl([](const char*) -> GLADapiproc { return nullptr; }, "test");
          }) == "test gives no OpenGL functions");
}

TEST_CASE("a library that is missing, or lacks a function, is named") {
    CHECK(contextErrorOf([] { RuntimeLibrary("libnone.so.9"); }) ==
          "libnone.so.9 cannot be opened");
    CHECK(contextErrorOf([] {
              RuntimeLibrary("libc.so.6").function<void()>("no_such_function");
          }) == "libc.so.6 has no function no_such_function");
}
