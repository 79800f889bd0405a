// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/errors.h"
#include "renderer/gl/texture_array.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/message_of.h"

#include <latch>
#include <optional>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// Debug output off, as in a context that reports nothing.
class Silence {
public:
    Silence() { glDisable(GL_DEBUG_OUTPUT); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;
    ~Silence() { glEnable(GL_DEBUG_OUTPUT); }
};

void misuse() {
    glEnable(GL_TEXTURE_2D); // not in a core profile
}

/// More than any device has: 8 TiB, of which this driver may say so at once.
void allocateTooMuch() {
    const auto texture = GlObject<TextureKind>::create("huge", GLenum(GL_TEXTURE_2D_ARRAY));
    glTextureStorage3D(texture.id(), 1, GL_RGBA32F, 16384, 16384, 2048);
}

} // namespace

TEST_CASE("storage that the driver has no memory for is an error that says what was wanted") {
    testContext();
    const ExpectGlMessages expected;
    CHECK(messageOf<Error>([] {
              GpuTextureArray("huge", PixelFormat::RGBA32F, {16384, 16384}, 2048);
          }) == "texture huge: the driver has no memory for 2048 layers of 16384 x 16384 pixels of "
                "RGBA32F with 1 levels, 8388608.0 MiB");
    CHECK(messageOf<Error>([] { GpuBuffer("huge", std::size_t(1) << 55); }) ==
          "buffer huge: the driver has no memory for 36028797018963968 bytes, 34359738368.0 "
          "MiB");
    // The largest single texture; a GPU may have it.
    if (glInfo(testContext()).softwareRasterizer)
        CHECK(messageOf<Error>([] {
                  GpuTexture("large", PixelFormat::RGBA32F, {16384, 16384});
              }) == "texture large: the driver has no memory for 16384 x 16384 pixels of RGBA32F, "
                    "4096.0 MiB");
    CHECK(glGetError() == GL_NO_ERROR); // its own error is told, and gone
    CHECK_NOTHROW(GpuTexture("small", PixelFormat::RGBA32F, {4, 4}));
}

TEST_CASE("an error from before an allocation is not taken for its own, and stays counted") {
    testContext();
    const ExpectGlMessages expected;
    struct Case {
        bool isSilent;
        void (*act)();
    };
    for (const auto& [isSilent, act] : {Case{false, misuse}, Case{false, allocateTooMuch},
                                        Case{true, misuse}, Case{true, allocateTooMuch}}) {
        CAPTURE(isSilent);
        const int before = glErrorCount();
        {
            std::optional<Silence> silence;
            if (isSilent)
                silence.emplace();
            act(); // without a look at what became of it
        }
        CHECK_NOTHROW(GpuTexture("small", PixelFormat::RGBA32F, {4, 4}));
        CHECK(glErrorCount() == before + 1);
        CHECK_NOTHROW(GpuBuffer("small", 16));
        sweepGlErrors();
        CHECK(glErrorCount() == before + 1);
    }
}

TEST_CASE("an allocation that fails for want of anything but memory is counted as any error") {
    testContext();
    const ExpectGlMessages expected;
    const int before = glErrorCount();
    CHECK_NOTHROW(allocateGl("texture", "nothing", 0, misuse));
    CHECK(glErrorCount() == before + 1);
    CHECK(messageOf<Error>([] { allocateGl("texture", "a lot", 3 << 19, allocateTooMuch); }) ==
          "texture: the driver has no memory for a lot, 1.5 MiB");
}

TEST_CASE("errors that threads note at one time are all counted") {
    constexpr int kThreads = 2, kEach = 1'000'000;
    const int before = glErrorCount();
    {
        std::latch start(kThreads);
        std::vector<std::jthread> threads;
        for (int i = 0; i < kThreads; ++i)
            threads.emplace_back([&start] {
                start.arrive_and_wait();
                for (int j = 0; j < kEach; ++j)
                    noteReportedGlError("from another thread");
            });
    }
    CHECK(glErrorCount() == before + kThreads * kEach);
}

TEST_CASE("errors are counted once, whether the driver reports them or only keeps them") {
    testContext();
    const ExpectGlMessages expected;
    const int before = glErrorCount();
    misuse();
    CHECK(glErrorCount() == before + 1); // reported
    sweepGlErrors();
    CHECK(glErrorCount() == before + 1);
    CHECK(glGetError() == GL_NO_ERROR);
    {
        const Silence silence;
        misuse();
        CHECK(glErrorCount() == before + 1);
        sweepGlErrors();
        CHECK(glErrorCount() == before + 2);
    }
    sweepGlErrors();
    CHECK(glErrorCount() == before + 2);
    CHECK_FALSE(firstGlError().empty());

    // A message of another type is none.
    for (const GLenum type : {GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR})
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, GL_DEBUG_SEVERITY_HIGH, -1,
                             "another type");
    CHECK(glErrorCount() == before + 2);
}
