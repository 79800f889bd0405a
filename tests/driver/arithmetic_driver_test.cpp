// A compiler may contract products with sums in one program and not in another, and in one of two
// computations of the same thing. What must be exact has to be so all the same.

#include "renderer/scene/procedural.h"
#include "tests/driver/rewritten_shaders.h"
#include "tests/driver/workload.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

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
        const auto motion = frames.targets().motion.read<glm::vec4>();
        for (const glm::vec4& m : motion.pixels())
            moved += m.x != 0.0f || m.y != 0.0f;
    }
    CHECK(frames.rewritten.changed() > 0);
    return moved;
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
        CHECK(moved > 10);
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
        const auto gradient = frames.targets().filters[0].gradientSamples.read<glm::vec4>();
        for (const glm::vec4& g : gradient.pixels())
            REQUIRE(g.x == 0.0f);
    }
    CHECK(carried > 500);
    CHECK(frames.rewritten.changed() >= 4);
}
