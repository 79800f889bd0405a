// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "renderer/pipeline/renderer.h"
#include "tests/reference/random.h"
#include "tests/reference/scene_view.h"
#include "tests/support/gl_fixture.h"

namespace afterglow::test {

/// One frame as the renderer made it, and the moment it shows in double precision.
struct SceneFrame {
    reference::SceneView scene, previousScene;
    reference::View view, previousView;
    std::vector<glm::dvec3> lightScales; ///< by slot
    std::uint32_t frame = 0, runSeed = 0;
    bool hasHistory = false;
    glm::dvec2 jitter{0.0}; ///< of all pixels, from their centers

    Image<glm::uvec2> ids;
    Image<glm::uvec4> visibility, previousVisibility, surface, samples;
    Image<std::uint32_t> seeds, previousSeeds;
    Image<glm::vec4> guides, motion, albedo, emission, raw, previousRaw, filtered, composed;
    Image<glm::vec2> slope;
    Image<glm::u8vec4> display;
};

/// A renderer of a scene whose every image is read back.
class SceneFrames {
public:
    SceneFrames(Scene scene, glm::ivec2 size, Settings settings,
                ShaderLibrary& shaders = testShaders());

    Settings settings;
    Camera camera;
    std::vector<LightState> lights; ///< by slot
    double seconds = 0.0;
    std::uint32_t frame = 0; ///< of the next frame
    std::uint32_t runSeed = 1;

    const Scene& scene() const { return scene_; }
    const reference::SceneView& rest() const { return rest_; }           ///< at time 0
    const RenderTargets& targets() const { return renderer_.targets(); } ///< of the last frame
    LightState& light(std::string_view name);

    SceneFrame next();

private:
    Scene scene_;
    glm::ivec2 size_;
    reference::SceneView rest_;
    Renderer renderer_;
    bool started_ = false;
    double previousSeconds_ = 0.0;
    reference::View previousView_;
};

/// What the scenes made in code do not have: nodes in nodes, uneven scales, a mirrored sphere, a
/// mirrored lamp, a two-sided lamp that turns, a metal, a mover with smooth normals, a far plane,
/// and background.
Scene sceneOfOddities();

/// A scene made in code by its name, "oddities", or "glossy".
Scene sceneNamed(std::string_view name);

/// The renderer's own noise, as a reference reads it.
const reference::Random& randomOf(std::uint32_t runSeed);

/// Moves the camera as a hand would, some way and some turn; not at all for 0 meters.
void shake(SceneFrames& frames, const Camera& start, int step, float meters);

} // namespace afterglow::test
