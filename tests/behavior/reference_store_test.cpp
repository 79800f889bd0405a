// SPDX-License-Identifier: MIT
// The error that references state, and that one from a cache is the one that was converged.

#include "app/measure/reference.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"
#include "tests/support/studio.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/warnings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kOddSize{61, 37};

ReferenceMaker thisMaker() {
    return ReferenceMaker(testShaders(), glInfo(testContext()));
}

} // namespace

TEST_CASE("the error that a reference states is up to twice the one it has, and not less") {
    const GlCheck noGlMessages;
    // Samples of a Halton sequence converge faster than independent ones, about as N^-0.8 where
    // there are shadows, and the estimate from halves supposes N^-0.5.
    for (const auto& scene : {makeCornell(), makeRooms()}) {
        Studio studio(scene, {48, 27});
        const auto lit = [&](std::uint32_t seed, int samples, double& residual) {
            FrameInput input = studio.at(0.0);
            input.seed = seed; // of another seed: the longer one would contain the shorter
            residual = converge(studio.renderer, input, input, studio.settings, samples).residual;
            return litRadiance(studio.renderer);
        };
        double residual = 0.0, longResidual = 0.0;
        const auto truth = lit(9, 4096, longResidual);
        const Mask foreground = foregroundOf(studio.renderer);
        for (const int samples : {64, 256}) {
            double actual = 0.0, stated = 0.0;
            for (const std::uint32_t seed : {1u, 2u, 3u}) {
                const auto shorter = lit(seed, samples, residual);
                actual += std::pow(rmse(shorter, truth, &foreground), 2.0);
                stated += residual * residual + longResidual * longResidual;
            }
            const double ratio = std::sqrt(stated / actual);
            MESSAGE(scene.name, ", ", samples, " samples: stated ", std::sqrt(stated / 3.0),
                    ", actual ", std::sqrt(actual / 3.0), ", ratio ", ratio);
            CHECK(ratio > 1.0);
            CHECK(ratio < 2.2);
        }
    }
}

TEST_CASE("a reference from memory or from a folder is, bit for bit, the one that was converged") {
    const GlCheck noGlMessages;
    const TemporaryFolder folder;
    Studio studio(makeMoving(), kOddSize);
    const FrameInput now = studio.at(1.1), then = studio.at(1.0);
    int told = 0;
    const auto tell = [&](int samples) { told += samples; };
    const auto display = [&] { return studio.targets().filters[0].display.read<glm::u8vec4>(); };

    ReferenceStore fresh(thisMaker(), ReferenceCache(folder.path()));
    const Reference made = converge(studio.renderer, now, then, studio.settings, 40, tell, &fresh);
    const auto shown = display();
    const auto lit = litRadiance(studio.renderer);
    CHECK(told == 40);
    CHECK_FALSE(made.cached);
    CHECK(made.samples == 40);
    CHECK(made.rays > 40 * 61 * 37 / 2);
    CHECK(made.rays <= 2 * 40 * 61 * 37);
    CHECK(made.residual > 0.0);
    CHECK(differingPixels(made.signals[0], studio.reference(now, then, 40)) == 0);

    ReferenceStore other(thisMaker(), ReferenceCache(folder.path()));
    for (ReferenceStore* store : {&fresh, &other, &other}) {
        studio.reference(then, 1); // something else in between
        told = 0;
        const Reference again =
            converge(studio.renderer, now, then, studio.settings, 40, tell, store);
        CHECK(told == 40);
        CHECK(again.cached);
        CHECK(differingPixels(again.signals[0], made.signals[0]) == 0);
        CHECK(again.residual == made.residual);
        CHECK(again.rays == made.rays);
        CHECK(again.milliseconds == made.milliseconds);
        CHECK(differingPixels(display(), shown) == 0);
        CHECK(differingPixels(litRadiance(studio.renderer), lit) == 0);
    }
    CHECK(fresh.counts().converged == 1);
    CHECK(fresh.counts().fromMemory == 1);
    CHECK(other.counts().converged == 0);
    CHECK(other.counts().fromCache == 1);
    CHECK(other.counts().fromMemory == 1);
    // Another light of the same surfaces is another reference.
    CHECK_FALSE(converge(studio.renderer, now, now, studio.settings, 40, {}, &other).cached);
}

TEST_CASE("a damaged entry is converged again and mended") {
    const GlCheck noGlMessages;
    const TemporaryFolder folder;
    Studio studio(makeTiny(), kOddSize);
    const FrameInput input = studio.at(0.0);
    const auto get = [&] {
        ReferenceStore store(thisMaker(), ReferenceCache(folder.path()));
        const Reference reference =
            converge(studio.renderer, input, input, studio.settings, 8, {}, &store);
        CHECK(store.counts().converged + store.counts().fromCache == 1);
        return reference;
    };
    const Reference made = get();
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        if (entry.path().extension() == ".exr")
            std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
    {
        const Warnings warnings;
        const Reference again = get();
        CHECK_FALSE(again.cached);
        CHECK(differingPixels(again.signals[0], made.signals[0]) == 0);
        REQUIRE(warnings.texts.size() == 1);
        CHECK(warnings.texts[0].find(".exr") != std::string::npos);
    }
    CHECK(get().cached);
}

TEST_CASE("the fingerprint of the shaders is that of their text") {
    std::vector<std::string_view> lighting{"lighting/"}, more{"lighting/", "scene/"}, none{"x/"};
    const ShaderLibrary& library = testShaders();
    const std::string fingerprint = library.fingerprint(lighting);
    CHECK(fingerprint == library.fingerprint(lighting));
    CHECK(fingerprint != library.fingerprint(more));
    CHECK(fingerprint != library.fingerprint(none));
    const ShaderLibrary defined(ShaderSource::embedded(), {{"SOMETHING", "1"}});
    const ShaderLibrary plain(ShaderSource::embedded());
    CHECK(defined.fingerprint(lighting) != plain.fingerprint(lighting));
}
