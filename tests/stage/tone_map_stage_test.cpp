// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "renderer/gl/buffer.h"
#include "renderer/passes/tonemap_pass.h"
#include "shared/frame.h"
#include "tests/reference/composite.h"
#include "tests/stage/mutants.h"
#include "tests/stage/upload.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr std::array kToneMappers{gpu::kToneAces, gpu::kToneAgx, gpu::kToneNeutral, gpu::kToneNone};

/// 22 stops from left to right, grays in the first row and then ever more saturated colors; black
/// in a corner.
Image<glm::vec4> chart() {
    Image<glm::vec4> colors({61, 37});
    for (int y = 0; y < 37; ++y)
        for (int x = 0; x < 61; ++x) {
            const float value = std::exp2(-14.0f + 22.0f * float(x) / 60.0f);
            const float saturation = float(y) / 36.0f, hue = 1.7f * float(y);
            const glm::vec3 tint =
                1.0f - saturation * (0.5f + 0.5f * glm::vec3(std::cos(hue), std::cos(hue + 2.1f),
                                                             std::cos(hue + 4.2f)));
            colors({x, y}) = glm::vec4(value * tint, 1.0f);
        }
    colors({0, 36}) = glm::vec4(0.0f);
    return colors;
}

/// Into floats, so that no rounding to 8 bits hides anything.
Image<glm::vec4> shown(ShaderLibrary& shaders, const Image<glm::vec4>& colors, int toneMapper,
                       float stops) {
    gpu::FrameUniforms uniforms{};
    uniforms.size = colors.size();
    GpuBuffer block("frame", sizeof uniforms);
    block.write(std::array{uniforms});
    GpuTimer timer(true);
    FrameContext context{.timer = timer, .uniforms = &block};
    const GpuTexture composed = upload("composed", colors);
    GpuTexture display = upload("display", Image<glm::vec4>(colors.size(), glm::vec4(-1234.5f)));
    TonemapPass(shaders).run(context, {composed}, display, toneMapper,
                             {std::exp2(stops), 1, 0.0f, 0.0f});
    return display.read<glm::vec4>();
}

Image<glm::dvec4> expected(const Image<glm::vec4>& colors, int toneMapper, double stops) {
    Image<glm::dvec4> out(colors.size());
    for (std::size_t i = 0; i < out.pixels().size(); ++i)
        out.pixels()[i] = glm::dvec4(
            reference::display(glm::dvec3(colors.pixels()[i]), stops, toneMapper) / 255.0, 1.0);
    return out;
}

Measure measureWith(int toneMapper) {
    return [toneMapper](ShaderLibrary& shaders) {
        Verdict verdict;
        const Image<glm::vec4> colors = chart();
        for (const float stops : {0.0f, -3.0f, 2.5f})
            verdict.add(shown(shaders, colors, toneMapper, stops),
                        expected(colors, toneMapper, stops));
        return verdict;
    };
}

} // namespace

TEST_CASE("every tone mapper is its formula") {
    const GlCheck noGlMessages;
    const Image<glm::vec4> colors = chart();
    for (const int toneMapper : kToneMappers)
        for (const float stops : {0.0f, -3.0f, 2.5f}) {
            CAPTURE(toneMapper);
            CAPTURE(stops);
            // Powers near 0 lose digits; 1e-5 is a 400th of a level.
            CHECK_CLOSE(shown(testShaders(), colors, toneMapper, stops),
                        expected(colors, toneMapper, stops), Tolerance{.max = 1e-5});
        }
}

TEST_CASE("a tone mapper keeps gray gray, black black, and never darkens what gets brighter") {
    for (const int toneMapper : kToneMappers) {
        CAPTURE(toneMapper);
        // The channels that the one like AgX mixes do not quite add up to 1.
        const double tint = toneMapper == gpu::kToneAgx ? 1e-3 : 1e-12; // a quarter of a level
        double last = 0.0;
        for (int i = 0; i <= 1000; ++i) {
            const glm::dvec3 out =
                reference::toneMap(toneMapper, glm::dvec3(std::exp2(0.02 * i - 12.0)));
            CHECK(out.g >= last);
            CHECK(out.g <= 1.0);
            CHECK(std::abs(out.r - out.g) <= tint);
            CHECK(std::abs(out.b - out.g) <= tint);
            last = out.g;
        }
        CHECK(last > 0.99);
        CHECK(glm::length(reference::toneMap(toneMapper, glm::dvec3(0.0))) == 0.0);
    }
}

TEST_CASE("what the tone mappers are known for") {
    // AgX: middle gray becomes half of the encoded range, 10 stops below it is black, 6.5 above
    // white; the slope at middle gray is 2; the sigmoid has no step there.
    CHECK(reference::agxSigmoid(10.0 / 16.5) == 0.5);
    CHECK(reference::agxSigmoid(0.0) == doctest::Approx(0.0));
    CHECK(reference::agxSigmoid(1.0) == doctest::Approx(1.0));
    for (const double step : {-1e-6, 1e-6})
        CHECK((reference::agxSigmoid(10.0 / 16.5 + step) - 0.5) / step == doctest::Approx(2.0));
    CHECK(reference::agx(glm::dvec3(0.18)).g == doctest::Approx(std::pow(0.5, 2.2)).epsilon(1e-3));
    // A pure color that is bright enough turns pale.
    CHECK(reference::agx({50.0, 0.0, 0.0}).g > 0.3);
    // Neutral: a base color under white light of 1 plus its reflection of 4 % comes out as it is.
    for (const glm::dvec3 color : {glm::dvec3(0.2, 0.5, 0.7), {0.1, 0.1, 0.6}}) {
        const glm::dvec3 out = reference::neutral(color + 0.04);
        CHECK(glm::length(out - color) < 1e-12);
    }
    CHECK(reference::neutral({50.0, 0.0, 0.0}).g > 0.5);
}

TEST_CASE("errors planted in the tone mappers do not pass") {
    const std::string file = "lib/tone_map.glsl";
    checkMutants(measureWith(gpu::kToneAces), {{"another curve", file, "2.43", "2.34"},
                                               {"no toe", file, "2.51 * x + 0.03", "2.51 * x"}});
    checkMutants(measureWith(gpu::kToneAgx),
                 {{"channels not mixed", file, "max(kAgxMixed * x,", "max(x,"},
                  {"mixed by the transpose", file, "kAgxMixed * x", "x * kAgxMixed"},
                  {"channels not unmixed", file, "kAgxUnmixed * encoded", "encoded"},
                  {"toe and shoulder exchanged", file, "kAgxToe = 3.0, kAgxShoulder = 3.25",
                   "kAgxToe = 3.25, kAgxShoulder = 3.0", 1e-3},
                  {"middle gray at the middle of the stops", file, "kAgxPivot = 10.0 / 16.5",
                   "kAgxPivot = 0.5"},
                  {"steeper", file, "kAgxSlope = 2.0", "kAgxSlope = 2.4"},
                  {"encoded twice", file, "vec3(2.2)", "vec3(1.0)"}});
    checkMutants(
        measureWith(gpu::kToneNeutral),
        {{"reflection kept", file, "vec3 color = x - offset", "vec3 color = x", 5e-3},
         {"no toe", file, "? least - least * least / (4.0 * kNeutralReflection)", "? least", 5e-3},
         {"saturation kept", file, "vec3(compressed), gray)", "vec3(compressed), 0.0)"},
         {"clipped", file, "peak < kNeutralStart ? color : bright", "color"},
         {"each channel by itself", file, "float peak = max(max(color.r, color.g), color.b)",
          "float peak = color.g"}});
    checkMutants(
        measureWith(gpu::kToneNone),
        {{"exposure forgotten", "post/tonemap.comp", "exposureOf(params.exposure)",
          "exposureOf(1.0)"},
         {"ACES in its place", file, "TONE_MAPPER == kToneAces", "TONE_MAPPER >= kToneAces"}});
}
