// SPDX-License-Identifier: MIT
// A frame like the one before makes no object of OpenGL, compiles nothing and waits for nothing
// that it reads back: all of that belongs to the first frames, and to what asks for numbers.

#include "renderer/scene/procedural.h"
#include "tests/driver/gl_override.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <optional>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// Counts the calls of one function while it lives. `Tag` tells apart functions of one type.
template <int Tag, class Function>
class CountedCalls;

template <int Tag, class Result, class... Arguments>
class CountedCalls<Tag, Result(GLAPIENTRY*)(Arguments...)> {
public:
    using Function = Result(GLAPIENTRY*)(Arguments...);

    explicit CountedCalls(Function& loaded) {
        calls = 0;
        override.emplace(loaded, count);
    }
    CountedCalls(const CountedCalls&) = delete;
    CountedCalls& operator=(const CountedCalls&) = delete;
    ~CountedCalls() { override.reset(); }

    static int inline calls = 0;

private:
    static Result GLAPIENTRY count(Arguments... arguments) {
        ++calls;
        return override->before()(arguments...);
    }
    static inline std::optional<GlOverride<Function>> override;
};

#define COUNTED(function) CountedCalls<__LINE__, decltype(function)> function##Calls(function)

} // namespace

TEST_CASE("a frame like the one before makes, compiles and reads back nothing") {
    testContext();
    for (const bool extra : {false, true})
        for (const Filter filter : {Filter::Fixed, Filter::Svgf, Filter::Asvgf, Filter::Clamp,
                                    Filter::Percentile, Filter::Confidence}) {
            CAPTURE(int(filter));
            CAPTURE(extra);
            Settings settings = settingsOf(filter);
            settings.lighting.gradientSamples =
                int(extra ? SamplePlacement::Extra : SamplePlacement::Merged);
            Sequence sequence(makeProceduralScene("moving"), {40, 23}, settings);
            sequence.secondsPerFrame = 0.02;
            sequence.run(3);

            COUNTED(glad_glCreateTextures);
            COUNTED(glad_glCreateBuffers);
            COUNTED(glad_glNamedBufferStorage);
            COUNTED(glad_glTextureStorage2D);
            COUNTED(glad_glCreateFramebuffers);
            COUNTED(glad_glCompileShader);
            COUNTED(glad_glLinkProgram);
            COUNTED(glad_glGetNamedBufferSubData);
            COUNTED(glad_glGetTextureImage);
            COUNTED(glad_glGetTextureSubImage);
            COUNTED(glad_glReadPixels);
            COUNTED(glad_glDispatchCompute);
            sequence.run(2);
            CHECK(glad_glCreateTexturesCalls.calls == 0);
            CHECK(glad_glCreateBuffersCalls.calls == 0);
            CHECK(glad_glNamedBufferStorageCalls.calls == 0);
            CHECK(glad_glTextureStorage2DCalls.calls == 0);
            CHECK(glad_glCreateFramebuffersCalls.calls == 0);
            CHECK(glad_glCompileShaderCalls.calls == 0);
            CHECK(glad_glLinkProgramCalls.calls == 0);
            CHECK(glad_glGetNamedBufferSubDataCalls.calls == 0);
            CHECK(glad_glGetTextureImageCalls.calls == 0);
            CHECK(glad_glGetTextureSubImageCalls.calls == 0);
            CHECK(glad_glReadPixelsCalls.calls == 0);
            CHECK(glad_glDispatchComputeCalls.calls >= 10); // they are counted
        }
}
