// SPDX-License-Identifier: MIT
// The ground truth of a frame, which is computed a little at a time.

#include "app/measure/truth.h"
#include "renderer/gl/errors.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"
#include "tests/support/studio.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kOddSize{61, 37};
constexpr int kSamples = 12;

ReferenceMaker thisMaker() {
    return ReferenceMaker(testShaders(), glInfo(testContext()));
}

GroundTruth::Request requestOf(const Studio& studio, const FrameInput& now,
                               const std::optional<FrameInput>& before) {
    return {.now = now, .before = before, .settings = studio.settings, .samples = kSamples};
}

/// Does it in portions of the lengths given, one after the other and over again.
Truth made(Renderer& renderer, const GroundTruth::Request& request,
           const std::vector<double>& portions, ReferenceStore* store = nullptr) {
    GroundTruth truth(renderer, request, store);
    CHECK(truth.progress() == 0.0);
    for (std::size_t i = 0; !truth.isDone(); ++i) {
        const double before = truth.progress();
        CHECK(truth.advance(portions[i % portions.size()]) > 0);
        CHECK(truth.progress() > before);
    }
    CHECK(truth.progress() == 1.0);
    CHECK(truth.advance(1.0) == 0);
    return truth.take();
}

void checkEqual(const Truth& a, const Truth& b) {
    CHECK(differingPixels(a.lit, b.lit) == 0);
    CHECK(differingPixels(a.display, b.display) == 0);
    CHECK(differingPixels(a.foreground, b.foreground) == 0);
    CHECK(a.residual == b.residual);
    REQUIRE(a.signals.size() == b.signals.size());
    for (std::size_t i = 0; i < a.signals.size(); ++i) {
        CHECK(differingPixels(a.signals[i].luminance, b.signals[i].luminance) == 0);
        CHECK(differingPixels(a.signals[i].variance, b.signals[i].variance) == 0);
        CHECK(differingPixels(a.signals[i].before, b.signals[i].before) == 0);
    }
}

} // namespace

TEST_CASE("a ground truth has the same bits whatever its portions are, and from a store as well") {
    const GlCheck noGlMessages;
    Studio studio(makeMoving(), kOddSize, Signal::Separate);
    std::vector<LightState> dimmed = studio.allOn;
    dimmed[0].power = 0.25f;
    const auto request = requestOf(studio, studio.at(1.1, dimmed), studio.at(1.0));
    const Truth atOnce = made(studio.renderer, request, {1e9});
    REQUIRE(atOnce.signals.size() == 2);
    CHECK(atOnce.residual > 0.0);
    CHECK(differingPixels(atOnce.signals[0].before, atOnce.signals[0].luminance) > 100);
    checkEqual(made(studio.renderer, request, {0.0}), atOnce); // a sample each
    checkEqual(made(studio.renderer, request, {0.0, 0.0, 1e9, 1.0}), atOnce);
    ReferenceStore store(thisMaker());
    for (int i = 0; i < 2; ++i)
        checkEqual(made(studio.renderer, request, {5.0}, &store), atOnce);
    CHECK(store.counts().converged == 2);
    CHECK(store.counts().fromMemory == 2);
}

TEST_CASE("the light of the frame before is another reference only where something has changed") {
    const GlCheck noGlMessages;
    Studio studio(makeMoving(), kOddSize);
    std::vector<LightState> off = studio.allOn, offAndDimmed = off;
    off[0].on = offAndDimmed[0].on = false;
    offAndDimmed[0].power = 0.5f;
    FrameInput aside = studio.at(1.0);
    aside.camera.position.x += 0.1f;
    const auto changes = [&](const FrameInput& now, const std::optional<FrameInput>& before) {
        const Truth truth = made(studio.renderer, requestOf(studio, now, before), {1e9});
        const StrataTruth first = truth.idealLambda(0, 1e-4f);
        const StrataTruth later = truth.idealLambda(0, 1e-4f, false);
        CHECK(std::ranges::all_of(later.lambda.pixels(), [](float l) { return l == 0.0f; }));
        const bool changed = truth.signals[0].before.size().x > 0;
        CHECK((differingPixels(first.lambda, later.lambda) > 0) == changed);
        return changed;
    };
    CHECK(changes(studio.at(1.0), studio.at(1.0, off)));
    CHECK(changes(studio.at(1.0), studio.at(0.9))); // a box moves
    CHECK_FALSE(changes(studio.at(1.0), studio.at(1.0)));
    CHECK_FALSE(changes(studio.at(1.0), std::nullopt));
    CHECK_FALSE(changes(studio.at(1.0), aside)); // the camera alone
    CHECK_FALSE(changes(studio.at(1.0, off), studio.at(1.0, offAndDimmed)));
    CHECK_FALSE(changes(studio.at(1.0), studio.at(1.0, {}))); // lights at nominal power
}

TEST_CASE("a reference that was made while OpenGL failed is not kept") {
    releaseTestContext();
    const TemporaryFolder folder;
    for (const bool fails : {true, false, false}) {
        const ExpectGlMessages expected;
        releaseTestContext();
        Studio studio(makeTiny(), kOddSize);
        if (fails)
            glEnable(GL_TEXTURE_2D); // not in a core profile
        CHECK(hasContextFailed() == fails);
        ReferenceStore store(thisMaker(), ReferenceCache(folder.path()));
        const bool wasThere = !std::filesystem::is_empty(folder.path());
        const FrameInput input = studio.at(0.0);
        for (int i = 0; i < 2; ++i)
            converge(studio.renderer, input, input, studio.settings, 2, {}, &store);
        CHECK(store.counts().converged == (fails ? 2 : wasThere ? 0 : 1));
        CHECK(store.counts().fromCache == int(wasThere));
        CHECK(std::filesystem::is_empty(folder.path()) == fails);
    }
}
