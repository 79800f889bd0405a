// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/stage/scene_judges.h"
#include "tests/support/sequence.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

void check(const SurfaceVerdict& verdict) {
    MESSAGE(verdict.surfaces, " surfaces, ", verdict.moved, " moved, ", verdict.turnedOver,
            " seen from behind, ", verdict.excused, " excused; position ", verdict.position,
            ", normals ", verdict.geometric, " ", verdict.shading, ", depth ", verdict.depth,
            ", slope ", verdict.slope, ", motion ", verdict.motion, ", its depth ",
            verdict.motionDepth, ", material ", verdict.material);
    // Sums of a few products in 32 bits; in brackets what llvmpipe has.
    CHECK(verdict.position < 5e-7);    // [6e-8]
    CHECK(verdict.geometric < 7e-5);   // [4.3e-5] steps of 1/32767 on the octahedron
    CHECK(verdict.shading < 1e-6);     // [1.3e-7]
    CHECK(verdict.depth < 2e-6);       // [2.5e-7]
    CHECK(verdict.slope < 2e-6);       // [1.4e-7]
    CHECK(verdict.motion < 2e-4);      // [1.3e-5] the difference of two places in the picture
    CHECK(verdict.motionDepth < 2e-6); // [2.2e-7]
    CHECK(verdict.material < 1e-6);    // [0]
    CHECK(verdict.wrong == 0);
    CHECK(verdict.excused <= verdict.surfaces / 200);
}

} // namespace

TEST_CASE(
    "position, normals, depth, slope and motion are those of the triangle, from frame to frame") {
    const GlCheck noGlMessages;
    struct Case {
        std::string scene;
        glm::ivec2 size;
        float meters; ///< of the camera's way from frame to frame
    };
    for (const Case& c : {Case{"tiny", {61, 37}, 0.05f}, Case{"cornell", {61, 37}, 0.02f},
                          Case{"moving", {61, 37}, 0.0f}, Case{"oddities", {61, 37}, 0.06f},
                          Case{"oddities", {16, 9}, 0.0f}, Case{"tiny", {5, 3}, 0.05f},
                          Case{"hall", {16, 9}, 0.1f}}) {
        CAPTURE(c.scene);
        CAPTURE(c.size.x);
        // A-SVGF merges samples that do not lie on centers of pixels.
        SceneFrames frames(sceneNamed(c.scene), c.size, settingsOf(Filter::Asvgf));
        const Camera start = frames.camera;
        int moved = 0;
        for (int i = 0; i < 4; ++i) {
            CAPTURE(i);
            shake(frames, start, i, c.meters);
            frames.seconds = 0.2 * i;
            const SurfaceVerdict verdict = judgeSurface(frames, frames.next());
            check(verdict);
            CHECK((i > 0 || verdict.moved == 0));
            moved += verdict.moved;
        }
        CHECK(moved > 0);
    }
}

TEST_CASE("what lay behind the previous camera has no motion, and is said to have none") {
    const GlCheck noGlMessages;
    SceneFrames frames(sceneNamed("oddities"), {61, 37}, settingsOf(Filter::Svgf));
    const Camera start = frames.camera;
    frames.next();
    // From the middle of the scene back to its front: half of what is seen was behind the eye.
    frames.camera.position = start.position + 3.6f * start.forward();
    frames.next();
    frames.camera = start;
    const SceneFrame frame = frames.next();
    const SurfaceVerdict verdict = judgeSurface(frames, frame);
    MESSAGE(verdict.behind, " of ", verdict.surfaces, " were behind");
    CHECK(verdict.wrong == 0);
    CHECK(verdict.behind > 20);
    CHECK(verdict.behind < verdict.surfaces);
    int moved = 0;
    for (const glm::vec4& motion : frame.motion.pixels())
        moved += motion.w == 0.0f && glm::vec2(motion) != glm::vec2(0.0f);
    CHECK(moved == 0);
}

TEST_CASE("a lamp's face is as bright as the user made it, black when off") {
    const GlCheck noGlMessages;
    SceneFrames frames(sceneNamed("oddities"), {61, 37}, settingsOf(Filter::None, Signal::Shadows));
    frames.camera = lookAt({1.5f, 0.2f, 2.2f}, {-0.3f, 1.7f, 0.2f}, {.verticalFov = 1.3f});
    frames.light("plain") = {.on = true, .power = 0.25f, .tint = {1.0f, 0.5f, 2.0f}};
    frames.light("fan").on = false;
    const SceneFrame frame = frames.next();
    check(judgeSurface(frames, frame));
    int seen[3] = {};
    for (std::size_t i = 0; i < frame.visibility.pixels().size(); ++i) {
        const std::uint32_t instance = frame.visibility.pixels()[i].x;
        for (std::size_t slot = 0; slot < 3; ++slot)
            for (const std::uint32_t lit : frames.scene().lights[slot].instances)
                seen[slot] += instance == lit + 1;
    }
    MESSAGE("pixels of the lamps: ", seen[0], " ", seen[1], " ", seen[2]);
    for (const int pixels : seen)
        CHECK(pixels > 0);
}
