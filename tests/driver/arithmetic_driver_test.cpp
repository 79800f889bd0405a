// SPDX-License-Identifier: MIT
// A compiler may contract products with sums in one program and not in another, and in one of two
// computations of the same thing. What must be exact has to be so all the same.

#include "renderer/scene/procedural.h"
#include "renderer/scene/scene_builder.h"
#include "tests/driver/rewritten_shaders.h"
#include "tests/driver/workload.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{61, 37};

/// The shaders whose products are rough.
using Rough = std::set<std::string_view>;

const Rough kPlacing{"scene/resolve.comp", "scene/surface.comp", "denoise/forward_claim.comp",
                     "denoise/forward_merge.comp"};

std::string roughIn(const Rough& rough, std::string_view name, std::string text) {
    return rough.count(name) ? withRoughProducts(std::move(text)) : text;
}

/// A renderer with shaders that are compiled for it, rewritten.
struct Frames {
    Frames(Scene scene, const RewrittenShaders::Rewrite& rewrite)
        : camera(cameraAt(scene, poseAt(scene, 0.0))), shaders(freshShaders()), rewritten(rewrite),
          renderer(shaders, glInfo(testContext())) {
        renderer.setScene(std::move(scene));
        renderer.resize(kSize);
    }
    void next() {
        renderer.render(
            {.camera = camera, .seconds = 0.7, .frame = frame++, .seed = 1, .lights = {}},
            settingsOf(Filter::Asvgf));
    }
    const RenderTargets& targets() const { return renderer.targets(); }
    Image<glm::vec4> gradientSamples() const {
        return renderer.filterImage("gradient_sample").texture->read<glm::vec4>();
    }

    Camera camera;
    std::uint32_t frame = 0;
    ShaderLibrary shaders;
    RewrittenShaders rewritten;
    Renderer renderer;
};

/// Pixels whose motion is not exactly 0 in frames in which nothing moves.
int movedPixels(const char* scene, const RewrittenShaders::Rewrite& rewrite) {
    Frames frames(makeProceduralScene(scene), rewrite);
    int moved = 0;
    for (int i = 0; i < 3; ++i) {
        frames.next();
        const auto motion = frames.targets().surfaces.motion.read<glm::vec4>();
        for (const glm::vec4& m : motion.pixels())
            moved += m.x != 0.0f || m.y != 0.0f;
    }
    CHECK(frames.rewritten.changed() > 0);
    return moved;
}

/// A square of 18 meters around a point, seen from where `front` points to.
Mesh square(glm::vec3 center, float front) {
    Mesh mesh;
    for (const glm::vec2 corner : {glm::vec2(-9, -9), {9, -9}, {9, 9}, {-9, 9}}) {
        mesh.positions.push_back(center + glm::vec3(front * corner.x, corner.y, 0.0f));
        mesh.normals.push_back({0.0f, 0.0f, front});
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// A wall right before the camera.
Scene wall() {
    SceneBuilder scene("wall");
    scene.add(square({0, 0, 0}, 1.0f), scene.material("wall", {0.5f, 0.5f, 0.5f}),
              scene.node("wall"));
    scene.light("key", square({0, 0, 9}, -1.0f), glm::vec3(1.0f));
    scene.camera(lookAt({0, 0, 3}, {0, 0, 0}, {.verticalFov = 1.0f}));
    return std::move(scene).finish();
}

struct Strata {
    int carried = 0; ///< strata with a sample
    int outside = 0; ///< of those, whose place is not in the stratum or whose source is no pixel
};

/// Gradient samples while the camera goes sideways by half a pixel a frame: all land on the border
/// between two pixels, and rounding decides.
Strata strataAtBorders(const RewrittenShaders::Rewrite& rewrite) {
    Frames frames(wall(), rewrite);
    const float pixel = 2.0f * 3.0f * std::tan(0.5f) / float(kSize.y); // meters on the wall
    Strata strata;
    for (int i = 0; i < 12; ++i) {
        (i % 2 == 0 ? frames.camera.position.x : frames.camera.position.y) += 0.5f * pixel;
        frames.next();
        const auto samples = frames.targets().samples.read<glm::uvec4>();
        for (int y = 0; y < samples.size().y; ++y)
            for (int x = 0; x < samples.size().x; ++x) {
                const glm::uvec4 sample = samples({x, y});
                if (sample.y == 0)
                    continue;
                const glm::ivec2 source(sample.z & 0xffffu, sample.z >> 16);
                const glm::ivec2 landed(3 * x + int(sample.y - 1) % 3,
                                        3 * y + int(sample.y - 1) / 3);
                ++strata.carried;
                strata.outside += sample.y > 9 || landed.x >= kSize.x || landed.y >= kSize.y ||
                                  source.x >= kSize.x || source.y >= kSize.y;
            }
    }
    return strata;
}

} // namespace

TEST_CASE("where nothing moves the motion is exactly 0, however products are rounded") {
    const GlCheck noGlMessages;
    for (const char* scene : {"cornell", "hall"}) {
        CAPTURE(std::string(scene));
        CHECK(movedPixels(scene, [](std::string_view name, std::string text) {
                  return roughIn({"scene/surface.comp"}, name, std::move(text));
              }) == 0);
    }
}

TEST_CASE("one variable that is not `precise`, and products rounded differently show as motion") {
    const GlCheck noGlMessages;
    // Of those that hold products; the others guard against contraction with what comes after.
    for (const std::string variable : {"float sum", "vec3 point", "vec4 clip", "vec2 pixel"}) {
        CAPTURE(variable);
        const int moved = movedPixels("hall", [&](std::string_view name, std::string text) {
            return name == "scene/surface.comp"
                       ? withRoughProducts(replaced(std::move(text), "precise " + variable + " =",
                                                    variable + " ="))
                       : text;
        });
        CHECK(moved > 0);
    }
}

TEST_CASE("where nothing changes every gradient is exactly 0, however products are rounded") {
    const GlCheck noGlMessages;
    Frames frames(makeProceduralScene("cornell"), [](std::string_view name, std::string text) {
        return roughIn(kPlacing, name, std::move(text));
    });
    int carried = 0;
    for (int i = 0; i < 6; ++i) {
        frames.next();
        carried += int(frames.renderer.readStats().gradientSamples);
        const auto gradient = frames.gradientSamples();
        for (const glm::vec4& g : gradient.pixels())
            REQUIRE(g.x == 0.0f);
    }
    CHECK(carried > 500);
    CHECK(frames.rewritten.changed() >= 4);
}

TEST_CASE("every gradient sample lies in its stratum, however products are rounded") {
    const GlCheck noGlMessages;
    for (const Rough& rough : {Rough{}, Rough{"denoise/forward_merge.comp"},
                               Rough{"denoise/forward_claim.comp"}, kPlacing}) {
        CAPTURE(rough.size());
        const Strata strata = strataAtBorders([&](std::string_view name, std::string text) {
            return roughIn(rough, name, std::move(text));
        });
        CHECK(strata.carried > 1000);
        CHECK(strata.outside == 0);
    }
}
