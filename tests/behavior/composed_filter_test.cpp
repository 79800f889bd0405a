// SPDX-License-Identifier: MIT
// Filters compose: one may filter what another has made, with the lambda of the noise.

#include "renderer/filters/svgf_filter.h"
#include "renderer/resources/frame_data.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <vector>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("a filter on another one's result has the lambda of the noise and images of its own") {
    const GlCheck noGlMessages;
    constexpr glm::ivec2 kSize{61, 37};
    Sequence sequence(makeProceduralScene("cornell"), kSize,
                      settingsOf(Filter::Asvgf, Signal::Shadows));
    sequence.run(5);
    for (LightState& light : sequence.lights)
        light.power = 0.5f;
    sequence.next();

    // Two of a family in one set, as a filter that is composed of them would declare it.
    const auto own = svgfFamily().images;
    std::vector<ImageDecl> declared(own.begin(), own.end());
    declared.insert(declared.end(), own.begin(), own.end());
    ImageSet images(declared, kSize);
    FilterImages second = FilterImages(images).from(own.size());
    FrameData frame;
    frame.begin(sequence.camera, kSize);
    frame.end();
    frame.begin(sequence.camera, kSize); // there is a frame before
    GpuTimer timer(true);
    FrameContext context{.timer = timer, .uniforms = &frame.block()};
    const RenderTargets& t = sequence.targets();
    const GpuTexture& denoised = sequence.renderer().filteredSignal();
    const FilterInput in{.surfaces = t.surfaces,
                         .previousVisibility = t.previousVisibility,
                         .previousGuides = t.previousGuides,
                         .motion = t.surfaces.motion,
                         .samples = t.samples,
                         .strataGuides = t.strataGuides,
                         .strataSlope = t.strataSlope,
                         .signal = t.signals[0],
                         .newest = denoised};
    SvgfPlan plan = makePlan(sequence.settings);
    plan.atrousIterations = plan.feedbackIteration = 0; // accumulation alone
    SvgfFilter filter(testShaders());
    const auto blend = filter.run(context, in, plan, second).read<glm::vec4>();

    const auto lambda = images.find(own.size() + svgf::kLambda)->read<float>();
    CHECK(differingPixels(lambda, imageOf(t, svgf::kLambda).read<float>()) == 0);
    int changed = 0;
    for (const float l : lambda.pixels())
        changed += l > 0.2f;
    CHECK(changed > 100);
    for (const std::size_t untouched : {svgf::kLambda, svgf::kControl, svgf::kAccumulated})
        CHECK(images.find(untouched) == nullptr);

    // Without a history the first frame is the denoised picture itself.
    const auto given = denoised.read<glm::vec4>();
    const auto guides = t.surfaces.guides.read<glm::vec4>();
    int surfaces = 0;
    for (std::size_t i = 0; i < given.pixels().size(); ++i) {
        if (guides.pixels()[i].w == 0.0f)
            continue;
        ++surfaces;
        REQUIRE(glm::vec3(blend.pixels()[i]) == glm::vec3(given.pixels()[i]));
    }
    CHECK(surfaces > 1000);

    // And the next one blends with it.
    images.swapHistories();
    const auto next = filter.run(context, in, plan, second).read<glm::vec4>();
    const auto control = images.find(own.size() + svgf::kControl)->read<glm::vec4>();
    int blended = 0;
    for (const glm::vec4& c : control.pixels())
        blended += c.w == float(gpu::kHistoryKept) && c.y > 0.0f && c.y < 1.0f;
    CHECK(blended > 500);
    CHECK(differingPixels(next, given) > 0); // its alpha is the luminance of the history
}
