// SPDX-License-Identifier: MIT
#include "renderer/passes/reason_pass.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "shared/denoise_params.h"
#include "tests/stage/mutants.h"
#include "tests/stage/stage_runner.h"
#include "tests/stage/upload.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

struct Reasons {
    Image<glm::vec4> control, guides;
    Image<glm::uvec4> samples;
};

/// Every reason and every fate, some oftener than others; background has reasons, too.
Reasons randomReasons(glm::ivec2 size, std::uint32_t seed) {
    const RandomFrame frame(size, seed);
    Reasons reasons{Image<glm::vec4>(size), frame.guides, Image<glm::uvec4>(frame.strata)};
    std::mt19937 engine(seed);
    for (glm::vec4& pixel : reasons.control.pixels())
        pixel = {1.0f, 2.0f, 3.0f,
                 float(std::min(engine() % (gpu::kHistoryNormal + 1),
                                engine() % (gpu::kHistoryNormal + 1)))};
    for (glm::uvec4& stratum : reasons.samples.pixels())
        stratum = {5u, 6u, 7u, std::min(engine() % 16u, engine() % 16u)};
    return reasons;
}

ReasonCounts count(ReasonPass& pass, const Reasons& reasons, bool withSamples = true) {
    const GpuTexture control = upload("control", reasons.control);
    const GpuTexture guides = upload("guides", reasons.guides);
    const GpuTexture samples = upload("samples", reasons.samples);
    GpuTimer timer(true);
    FrameContext context{timer};
    pass.run(context, {control, guides, withSamples ? &samples : nullptr});
    return pass.read();
}

ReasonCounts reference(const Reasons& reasons) {
    ReasonCounts counts;
    for (std::size_t i = 0; i < reasons.control.pixels().size(); ++i)
        if (reasons.guides.pixels()[i].w != 0.0f)
            ++counts.history[std::size_t(reasons.control.pixels()[i].w)];
    for (const glm::uvec4& stratum : reasons.samples.pixels())
        ++counts.fates[stratum.w];
    return counts;
}

template <std::size_t N>
std::uint64_t sum(const std::array<std::uint32_t, N>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t(0));
}

} // namespace

TEST_CASE("reasons of pixels and fates of strata are counted, at every size") {
    const GlCheck noGlMessages;
    ReasonPass pass(testShaders());
    CHECK(sum(pass.read().history) + sum(pass.read().fates) == 0);
    for (const glm::ivec2 size : {glm::ivec2(61, 37), {1, 1}, {130, 3}, {400, 201}})
        for (const std::uint32_t seed : {7u, 8u}) {
            CAPTURE(size.x);
            CAPTURE(size.y);
            CAPTURE(seed);
            const Reasons reasons = randomReasons(size, seed);
            const ReasonCounts counts = count(pass, reasons), expected = reference(reasons);
            CHECK(counts.history == expected.history);
            CHECK(counts.fates == expected.fates);

            const auto surfaces = std::ranges::count_if(
                reasons.guides.pixels(), [](const glm::vec4& guide) { return guide.w != 0.0f; });
            CHECK(sum(counts.history) == std::uint64_t(surfaces));
            CHECK(sum(counts.fates) == reasons.samples.pixels().size());
            if (size.x > 8)
                CHECK(std::ranges::count(counts.history, 0u) == 2); // six reasons, all of them
        }
}

TEST_CASE("without gradient samples no fates are counted, not even those of the last time") {
    const GlCheck noGlMessages;
    ReasonPass pass(testShaders());
    const Reasons reasons = randomReasons({61, 37}, 7);
    REQUIRE(sum(count(pass, reasons).fates) > 0);
    const ReasonCounts counts = count(pass, reasons, false);
    CHECK(counts.history == reference(reasons).history);
    CHECK(sum(counts.fates) == 0);
}

TEST_CASE("a code that has no bin of its own is counted in the last") {
    const GlCheck noGlMessages;
    Reasons reasons = randomReasons({61, 37}, 7);
    for (glm::vec4& guide : reasons.guides.pixels())
        guide.w = 1.0f;
    std::ranges::fill(reasons.control.pixels(), glm::vec4(9.0f));
    std::ranges::fill(reasons.samples.pixels(), glm::uvec4(0xffffffffu));
    ReasonPass pass(testShaders());
    const ReasonCounts counts = count(pass, reasons);
    CHECK(counts.history.back() == 61u * 37u);
    CHECK(sum(counts.history) == 61u * 37u);
    CHECK(counts.fates.back() == 21u * 13u);
    CHECK(sum(counts.fates) == 21u * 13u);
}

TEST_CASE("counting refuses images of different sizes") {
    Reasons reasons = randomReasons({8, 8}, 7);
    reasons.control = Image<glm::vec4>({8, 7});
    ReasonPass pass(testShaders());
    CHECK_THROWS_WITH_AS(count(pass, reasons), "ReasonPass: control is not of the size of guides",
                         std::logic_error);
}

TEST_CASE("mistakes in counting show") {
    const GlCheck noGlMessages;
    const Reasons reasons = randomReasons({100, 67}, 7);
    const std::string file = "post/reasons.comp";
    checkMutants(
        [&](ShaderLibrary& shaders) {
            ReasonPass pass(shaders);
            const ReasonCounts counts = count(pass, reasons), expected = reference(reasons);
            Verdict verdict;
            verdict.add(counts.history, expected.history);
            verdict.add(counts.fates, expected.fates);
            return verdict;
        },
        {{"background counts", file, "fetch(guides, p).w != 0.0", "fetch(guides, p).w != -1.0"},
         {"the reason is the history length", file, "fetch(control, p).w", "fetch(control, p).z"},
         {"the fate is the source", file, "fetch(samples, p).w", "fetch(samples, p).z"},
         {"fates are counted among the reasons", file, "kFirstBin = kHistoryBins",
          "kFirstBin = 0u"},
         {"pixels beyond the edge count", file, "lessThan(p, end)", "lessThan(p, end + 1)"},
         {"some pixels of a thread are left out", file, "i < kSteps * kSteps",
          "i < kSteps * kSteps - 1"}});
}
