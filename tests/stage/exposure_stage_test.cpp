// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "renderer/gl/buffer.h"
#include "renderer/passes/exposure_pass.h"
#include "renderer/resources/image_set.h"
#include "shared/frame.h"
#include "tests/reference/exposure.h"
#include "tests/stage/mutants.h"
#include "tests/stage/stage_runner.h"
#include "tests/stage/upload.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr double kFrames = 3.0;

struct Case {
    Image<glm::vec4> composed, guides;
    std::optional<double> previous = 0.75;
    double limit = 8.0;
    bool historyValid = true;
};

/// Radiance over many stops, some of it black; garbage in the background.
Case caseOf(glm::ivec2 size, std::uint32_t seed, float brightness) {
    RandomFrame frame(size, seed);
    Case out{.composed = frame.raw, .guides = frame.guides};
    for (std::size_t i = 0; i < out.composed.pixels().size(); ++i) {
        const float stops = float((i * 7919u) % 13u) - 6.0f;
        out.composed.pixels()[i] *= brightness * std::exp2(stops);
        if (out.guides.pixels()[i].w == 0.0f)
            out.composed.pixels()[i] = glm::vec4(900.0f);
    }
    return out;
}

Image<glm::vec4> run(ShaderLibrary& shaders, const Case& c) {
    gpu::FrameUniforms uniforms{};
    uniforms.size = c.composed.size();
    uniforms.historyValid = c.historyValid ? 1 : 0;
    GpuBuffer block("frame", sizeof uniforms);
    block.write(std::array{uniforms});
    GpuTimer timer(true);
    FrameContext context{.timer = timer, .uniforms = &block};
    const GpuTexture composed = upload("composed", c.composed), guides = upload("guides", c.guides);
    Image<glm::vec4> before({1, 1}, glm::vec4(0.0f));
    if (c.previous)
        before({0, 0}) = glm::vec4(float(*c.previous), 50.0f, 70.0f, 1.0f);
    const GpuTexture previous = upload("previous", before);
    GpuTexture sums =
        upload("sums", Image<glm::vec4>(tilesOf(c.composed.size()), glm::vec4(-1234.5f)));
    GpuTexture exposure = upload("exposure", Image<glm::vec4>({1, 1}, glm::vec4(-1234.5f)));
    ExposurePass(shaders).run(context, {composed, guides, previous}, {sums, exposure},
                              {float(1.0 - std::exp(-1.0 / kFrames)), float(c.limit), 0.0f, 0.0f});
    return exposure.read<glm::vec4>();
}

Image<glm::dvec4> expected(const Case& c) {
    const bool follows = c.previous && c.historyValid;
    const reference::Exposure e = reference::exposure(
        c.composed, c.guides, follows ? &*c.previous : nullptr, kFrames, c.limit);
    return Image<glm::dvec4>({1, 1}, glm::dvec4(e.stops, e.mean, e.pixels, 1.0));
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const glm::ivec2 size : kStageSizes)
        all.push_back(caseOf(size, 41, 1.0f));
    all.push_back(caseOf({200, 130}, 42, 0.3f)); // more tiles than threads
    for (const float brightness : {1e-3f, 1e3f}) // beyond the limit on both sides
        all.push_back(caseOf({61, 37}, 43, brightness));
    all[all.size() - 1].limit = all[all.size() - 2].limit = 2.0;
    all.push_back(caseOf({61, 37}, 44, 0.2f));
    all.back().previous.reset();
    all.push_back(caseOf({61, 37}, 44, 0.2f));
    all.back().historyValid = false;
    for (const bool follows : {true, false}) { // nothing but background
        all.push_back(caseOf({16, 9}, 45, 1.0f));
        all.back().historyValid = follows;
        for (glm::vec4& guide : all.back().guides.pixels())
            guide.w = 0.0f;
    }
    return all;
}

} // namespace

TEST_CASE("the automatic exposure takes the mean logarithm of the foreground to middle gray") {
    const GlCheck noGlMessages;
    for (const Case& c : cases()) {
        CAPTURE(c.composed.size().x);
        // Sums of some thousands of logarithms in 32 bits.
        CHECK_CLOSE(run(testShaders(), c), expected(c), Tolerance{.max = 1e-5});
    }
}

TEST_CASE("the automatic exposure has the same bits in every run") {
    const Case c = caseOf({200, 130}, 46, 1.0f);
    CHECK_CLOSE(run(testShaders(), c), run(testShaders(), c), Tolerance{});
}

TEST_CASE("a step of the light is followed by 1 - 1/e of it in the time constant") {
    const Image<glm::vec4> guides({1, 1}, glm::vec4(1.0f));
    double stops = 0.0;
    for (int i = 0; i < 20; ++i)
        stops = reference::exposure(Image<glm::vec4>({1, 1}, glm::vec4(0.18f / 4.0f)), guides,
                                    &stops, 20.0, 8.0)
                    .stops;
    CHECK(stops == doctest::Approx(2.0 * (1.0 - std::exp(-1.0))));
}

TEST_CASE("errors planted in the automatic exposure do not pass") {
    const std::string first = "post/log_luminance.comp", second = "post/exposure.comp";
    checkMutants(
        [](ShaderLibrary& shaders) {
            Verdict verdict;
            for (const Case& c : cases())
                verdict.add(run(shaders, c), expected(c));
            return verdict;
        },
        {{"background counted", first, "fetch(guides, ivec2(x, y)).w != 0.0",
          "fetch(guides, ivec2(x, y)).w != 7.0"},
         {"mean of luminance", first, "log2(max(l, exp2(kDarkest)))", "max(l, exp2(kDarkest))"},
         {"black without end", first, "max(l, exp2(kDarkest))", "max(l, 1e-30)"},
         {"partial tiles left out", first, "min(first + int(kTileSize), size)",
          "first + int(kTileSize) * ivec2(lessThanEqual(first + int(kTileSize), size))"},
         {"64 tiles and no more", second, "tile < tiles.x * tiles.y",
          "tile < min(tiles.x * tiles.y, 64)"},
         {"another gray", second, "kMiddleGray = 0.18", "kMiddleGray = 0.5"},
         {"without a limit", second, "clamp(log2(kMiddleGray) - mean, -params.limit, params.limit)",
          "log2(kMiddleGray) - mean"},
         {"at once", second, "hasPrevious ? params.adaptation : 1.0", "1.0"},
         {"from zero", second, "hasPrevious ? previous.x : 0.0", "0.0"},
         {"histories without end", second, "frame.historyValid != 0u && previous.w != 0.0",
          "previous.w != 0.0"},
         {"back to zero before the sky", second, "(target - start) : start",
          "(target - start) : 0.0"}});
}
