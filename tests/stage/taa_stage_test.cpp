// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "renderer/gl/buffer.h"
#include "renderer/passes/taa_pass.h"
#include "shared/frame.h"
#include "tests/reference/taa.h"
#include "tests/stage/mutants.h"
#include "tests/stage/stage_runner.h"
#include "tests/stage/upload.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// Colors around those of a plausible frame, and a history of them with 0 to 10 frames.
struct Case {
    RandomFrame frame;
    Image<glm::vec4> color, history;
    gpu::TaaParams params{0.1f, 1.25f, 1.0f, 1};
    bool historyValid = true;
    std::optional<float> stops = {}; ///< of the automatic exposure

    Case(glm::ivec2 size, std::uint32_t seed)
        : frame(size, seed), color(frame.signal), history(frame.previousColor) {
        for (std::size_t i = 0; i < color.pixels().size(); ++i) {
            // The garbage of the background is light like any other here, not brighter than 4.
            color.pixels()[i] = glm::min(color.pixels()[i], glm::vec4(4.0f));
            glm::vec4& kept = history.pixels()[i];
            kept = glm::min(kept, glm::vec4(4.0f));
            kept.a = frame.previousMoments.pixels()[i].z;
            // Some histories near to the picture, which are not clipped; one so bright that its
            // weight is at its bound.
            if (i % 3 == 0)
                kept = glm::vec4(1.02f * glm::vec3(color.pixels()[i]), kept.a);
            if (i == 7)
                color.pixels()[i] = glm::vec4(3e4f, 1e4f, 2e4f, 1.0f);
        }
    }
};

Image<glm::vec4> run(ShaderLibrary& shaders, const Case& c) {
    gpu::FrameUniforms uniforms{};
    uniforms.size = c.frame.size;
    uniforms.historyValid = c.historyValid ? 1 : 0;
    GpuBuffer block("frame", sizeof uniforms);
    block.write(std::array{uniforms});
    GpuTimer timer(true);
    FrameContext context{.timer = timer, .uniforms = &block};
    const GpuTexture color = upload("color", c.color), guides = upload("guides", c.frame.guides),
                     motion = upload("motion", c.frame.motion),
                     history = upload("history", c.history),
                     exposure = upload("exposure",
                                       Image<glm::vec4>({1, 1}, glm::vec4(c.stops.value_or(0.0f))));
    GpuTexture resolved = upload("resolved", Image<glm::vec4>(c.frame.size, glm::vec4(-1234.5f)));
    TaaPass(shaders).run(context, {color, guides, motion, history, c.stops ? &exposure : nullptr},
                         {resolved}, c.params);
    return resolved.read<glm::vec4>();
}

Image<glm::dvec4> expected(const Case& c) {
    const double factor = double(c.params.exposure) * std::exp2(double(c.stops.value_or(0.0f)));
    return reference::taa(
        {c.color, c.frame.guides, c.frame.motion, c.history, c.historyValid, factor}, c.params);
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const glm::ivec2 size : kStageSizes)
        all.emplace_back(size, 51);
    for (const std::uint32_t seed : {52u, 53u}) {
        Case plain({61, 37}, seed), tight({61, 37}, seed), dark({61, 37}, seed),
            automatic({61, 37}, seed), first({61, 37}, seed);
        plain.params.weighted = 0;
        tight.params = {0.4f, 0.5f, 1.0f, 1};
        dark.params.exposure = 0.125f;
        automatic.stops = 1.5f;
        first.historyValid = false;
        for (const Case& c : {plain, tight, dark, automatic, first})
            all.push_back(c);
    }
    return all;
}

} // namespace

TEST_CASE("anti-aliasing averages what is written in its text") {
    const GlCheck noGlMessages;
    int averaged = 0;
    for (const Case& c : cases()) {
        CAPTURE(c.frame.size.x);
        CAPTURE(c.params.weighted);
        const Image<glm::dvec4> wanted = expected(c);
        // Near its bound a weight of 1e-4 takes four digits off a color.
        CHECK_CLOSE(run(testShaders(), c), wanted, Tolerance{.max = 1e-5, .relative = 1e-4});
        for (const glm::dvec4& pixel : wanted.pixels())
            averaged += pixel.a > 1.0;
    }
    CHECK(averaged > 5000);
}

TEST_CASE("a picture that stays is kept, and its frames are averaged plainly at first") {
    const GlCheck noGlMessages;
    Case c({61, 37}, 54);
    c.params.clip = 16.0f;
    for (glm::vec4& motion : c.frame.motion.pixels())
        motion = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    // No two pixels alike, so that a hundredth more is within the box.
    for (std::size_t i = 0; i < c.color.pixels().size(); ++i)
        c.color.pixels()[i] = 0.5f + 0.4f * glm::sin(float(i) * glm::vec4(7.3f, 2.9f, 11.7f, 0.0f));
    const Image<glm::vec4> one = c.color;
    Image<glm::vec4> two = one;
    for (glm::vec4& pixel : two.pixels())
        pixel *= 1.01f;
    c.historyValid = false;
    c.history = run(testShaders(), c);
    CHECK_CLOSE(
        c.history,
        [&] {
            Image<glm::vec4> counted = one;
            for (glm::vec4& pixel : counted.pixels())
                pixel.a = 1.0f;
            return counted;
        }(),
        Tolerance{}); // the newest frame itself
    c.historyValid = true;
    c.params.weighted = 0;
    c.color = two;
    c.history = run(testShaders(), c);
    c.color = one;
    c.history = run(testShaders(), c);
    Image<glm::dvec4> mean(one.size());
    for (std::size_t i = 0; i < mean.pixels().size(); ++i)
        mean.pixels()[i] = glm::dvec4(glm::dvec3(one.pixels()[i]) * (1.0 + 0.01 / 3.0), 3.0);
    CHECK_CLOSE(c.history, mean, Tolerance{.max = 1e-6});
}

TEST_CASE("fetching by sampler and by image gives the same bits in anti-aliasing") {
    ShaderLibrary bySampler(testShaders().source());
    for (const Case& c : cases())
        CHECK_CLOSE(run(testShaders(), c), run(bySampler, c), Tolerance{});
}

TEST_CASE("errors planted in anti-aliasing do not pass") {
    const std::string file = "post/taa.comp";
    checkMutants(
        [](ShaderLibrary& shaders) {
            Verdict verdict;
            for (Case c : cases()) {
                c.color.pixels()[std::min<std::size_t>(7, c.color.pixels().size() - 1)] =
                    glm::vec4(1.0f); // nothing so bright that it needs a tolerance of its own
                verdict.add(run(shaders, c), expected(c));
            }
            return verdict;
        },
        {{"motion of the pixel itself", file, "depth > 0.0 && depth < least", "depth < -1.0"},
         {"motion of the farthest", file, "depth < least;", "depth > least;"},
         {"background in front", file, "depth > 0.0 && depth < least", "depth < least"},
         {"bilinear", file,
          "x < 1.0 ? 1.0 + x * x * (1.5 * x - 2.5) : 2.0 + x * (x * (2.5 - 0.5 * x) - 4.0)",
          "max(1.0 - x, 0.0)"},
         {"another cubic", file, "(1.5 * x - 2.5)", "(1.25 * x - 2.25)"},
         {"a row too few", file, "part.y > 0.0 ? 2 : 0", "part.y > 0.0 ? 1 : 0"},
         {"ringing", file, "return clamp(sum, low, high)", "return sum"},
         {"history at the pixel", file, "vec2(p) + moved.xy", "vec2(p)"},
         {"motion with the wrong sign", file, "vec2(p) + moved.xy", "vec2(p) - moved.xy"},
         {"history from behind the camera", file, "moved.w != 0.0 && isInside", "isInside"},
         {"history from outside", file,
          "bool isInside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, "
          "frame.size))",
          "bool isInside = true; texel = clamp(texel, ivec2(0), frame.size - 1)"},
         {"histories without end", file, "frame.historyValid != 0u && moved.w", "moved.w"},
         {"not clipped", file, "most > 1.0 ?", "most > 1e30 ?"},
         {"clipped per channel", file, "middle + (c - middle) / most",
          "clamp(c, middle - deviation, middle + deviation)"},
         {"clipped in red, green, blue", file,
          "return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * (c.r - c.b),\n                "
          "0.5 * c.g - 0.25 * (c.r + c.b));",
          "return c;"},
         {"width of the box forgotten", file, "params.clip * deviation", "deviation"},
         {"a smaller neighborhood", file, "int x = -1; x <= 1; ++x) {\n            ivec2 q",
          "int x = 0; x <= 1; ++x) {\n            ivec2 q"},
         {"variance of the uncentered", file, "squares / 9.0 - shift * shift", "squares / 9.0"},
         {"weights forgotten", file, "factor * c / (1.0 + factor * luminance(c))", "factor * c"},
         {"exposure forgotten in the weights", file, "factor = exposureOf(params.exposure)",
          "factor = exposureOf(1.0)"},
         {"the automatic exposure forgotten", "lib/exposure.glsl",
          "byHand * exp2(fetch(exposure, ivec2(0)).x)",
          "byHand * exp2(1e-3 * fetch(exposure, ivec2(0)).x)"},
         {"a fixed weight from the start", file, "max(params.blend, 1.0 / (frames + 1.0))",
          "params.blend"},
         {"frames not counted", file, "newest, frames + 1.0)", "newest, frames)"}});
}
