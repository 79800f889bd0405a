// SPDX-License-Identifier: MIT
#include "tests/stage/scene_frames.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "renderer/pipeline/jitter.h"
#include "renderer/scene/procedural.h"
#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"
#include "tests/support/glossy_scene.h"
#include "tests/support/scene_parts.h"
#include "tests/support/source_dir.h"

namespace afterglow::test {

SceneFrames::SceneFrames(Scene scene, glm::ivec2 size, Settings initial, ShaderLibrary& shaders)
    : settings(initial), camera(cameraAt(scene, poseAt(scene, 0.0))), lights(scene.lights.size()),
      scene_(scene), size_(size), rest_(scene, 0.0), renderer_(shaders, glInfo(testContext())) {
    renderer_.setScene(std::move(scene));
    renderer_.resize(size);
}

LightState& SceneFrames::light(std::string_view name) {
    const auto found = std::ranges::find(scene_.lights, name, &Light::name);
    if (found == scene_.lights.end())
        throw std::logic_error("no light named " + std::string(name));
    return lights[std::size_t(found - scene_.lights.begin())];
}

SceneFrame SceneFrames::next() {
    renderer_.render(
        {.camera = camera, .seconds = seconds, .frame = frame, .seed = runSeed, .lights = lights},
        settings);
    SceneFrame out;
    out.scene = reference::SceneView(scene_, seconds);
    out.view = reference::View(camera, size_);
    out.previousScene = started_ ? reference::SceneView(scene_, previousSeconds_) : out.scene;
    out.previousView = started_ ? previousView_ : out.view;
    out.hasHistory = started_;
    out.jitter = glm::dvec2(jitterOf(settings.display, frame));
    for (const LightState& light : lights)
        out.lightScales.push_back(light.on ? glm::dvec3(light.tint) * double(light.power)
                                           : glm::dvec3(0.0));
    out.frame = frame;
    out.runSeed = runSeed;

    const RenderTargets& t = renderer_.targets();
    out.ids = t.ids.read<glm::uvec2>();
    out.visibility = t.surfaces.visibility.read<glm::uvec4>();
    out.previousVisibility = t.previousVisibility.read<glm::uvec4>();
    out.surface = t.surfaces.surface.read<glm::uvec4>();
    out.samples = t.samples.read<glm::uvec4>();
    out.seeds = t.seeds.current().read<std::uint32_t>();
    out.previousSeeds = t.seeds.previous().read<std::uint32_t>();
    out.guides = t.surfaces.guides.read<glm::vec4>();
    out.motion = t.surfaces.motion.read<glm::vec4>();
    out.albedo = t.surfaces.albedo.read<glm::vec4>();
    out.emission = t.surfaces.emission.read<glm::vec4>();
    out.raw = t.signals[0].raw.current().read<glm::vec4>();
    out.previousRaw = t.signals[0].raw.previous().read<glm::vec4>();
    out.filtered = renderer_.filteredSignal().read<glm::vec4>();
    out.composed = t.filters[0].composed.read<glm::vec4>();
    out.slope = t.surfaces.slope.read<glm::vec2>();
    out.display = t.filters[0].display.read<glm::u8vec4>();

    started_ = true;
    previousSeconds_ = seconds;
    previousView_ = out.view;
    ++frame;
    return out;
}

Scene sceneOfOddities() {
    SceneBuilder scene("oddities");
    const std::uint32_t ground = scene.node("ground");
    scene.add(square(1.5f, 1.0f), scene.material("ground", {0.6f, 0.5f, 0.4f}), ground);

    const std::uint32_t shrunk = scene.node("shrunk", {0.2f, 0.0f, 0.0f});
    const std::uint32_t egg = scene.node("egg", {-0.9f, 0.7f, 0.1f}, int(shrunk));
    Mesh ball;
    addSphere(ball, {0.0f, 0.0f, 0.0f}, 0.5f, 12);
    const std::uint32_t metal = scene.material("metal", {0.9f, 0.7f, 0.3f});
    scene.add(ball, metal, egg);

    const std::uint32_t mirrored = scene.node("mirrored", {0.8f, 0.5f, -0.4f});
    scene.add(ball, scene.material("glaze", {0.2f, 0.4f, 0.7f}), mirrored);

    const std::uint32_t sheet = scene.node("sheet", {0.1f, 0.25f, 0.9f});
    const std::uint32_t paper = scene.material("paper", {0.8f, 0.8f, 0.8f});
    scene.makeDoubleSided(paper);
    scene.add(square(0.25f, 1.0f), paper, sheet);

    const std::uint32_t mover = scene.node("mover", {0.3f, 1.0f, 0.2f});
    Mesh ring;
    addTorus(ring, {0.0f, 0.0f, 0.0f}, 0.3f, 0.1f, 12, 8);
    scene.add(ring, scene.material("ring", {0.7f, 0.2f, 0.2f}), mover);

    scene.light("plain", square(0.3f, -1.0f), {9.0f, 8.0f, 6.0f});
    // Front up in its own space, turned down by a mirror below.
    scene.light("mirrored lamp", square(0.2f, 1.0f), {2.0f, 5.0f, 9.0f});
    const std::uint32_t fan = scene.node("fan", {1.1f, 1.2f, 0.7f});
    const std::uint32_t glow = scene.glow("fan", {4.0f, 3.0f, 5.0f});
    scene.makeDoubleSided(glow);
    scene.add(square(0.2f, 1.0f), glow, fan);

    scene.track({.node = mover,
                 .path = Track::Path::Translation,
                 .interpolation = Track::Interpolation::Linear,
                 .times = {0.0, 1.0},
                 .values = {{0.3f, 1.0f, 0.2f, 0.0f}, {-0.5f, 1.2f, 0.6f, 0.0f}}});
    scene.track({.node = mover,
                 .path = Track::Path::Rotation,
                 .interpolation = Track::Interpolation::Linear,
                 .times = {0.0, 1.0},
                 .values = {turn({1, 0, 0}, 0.4f), turn({1, 1, 0}, 1.9f)}});
    scene.track({.node = fan,
                 .path = Track::Path::Rotation,
                 .interpolation = Track::Interpolation::Linear,
                 .times = {0.0, 1.0},
                 .values = {turn({0, 0, 1}, 0.9f), turn({0, 0, 1}, 2.4f)}});
    scene.camera(lookAt({0.9f, 1.9f, 3.4f}, {0.0f, 0.6f, 0.0f}, {.far = 40.0f}));
    scene.ambient({0.2f, 0.3f, 0.4f});

    Scene out = std::move(scene).finish();
    const auto node = [&](std::string_view name) -> Node& {
        return *std::ranges::find(out.nodes, name, &Node::name);
    };
    node("shrunk").scale = {0.8f, 1.1f, 0.9f};
    node("egg").scale = {0.7f, 1.2f, 1.0f};
    node("egg").rotation = glm::angleAxis(0.5f, glm::normalize(glm::vec3(1, 2, 0.5f)));
    node("mirrored").scale = {-0.9f, 1.1f, 0.8f};
    node("sheet").rotation = glm::angleAxis(1.1f, glm::normalize(glm::vec3(1, 0.3f, 0)));
    node("plain").translation = {-0.2f, 2.4f, 0.1f};
    node("mirrored lamp").translation = {-1.0f, 1.9f, 0.5f};
    node("mirrored lamp").scale = {1.3f, -1.0f, 0.8f};
    node("mirrored lamp").rotation = glm::angleAxis(0.3f, glm::vec3(0, 0, 1));
    out.materials[metal].metallic = 1.0f;
    return out;
}

Scene sceneNamed(std::string_view name) {
    if (name == "oddities")
        return sceneOfOddities();
    return name == "glossy" ? makeGlossy() : makeProceduralScene(name);
}

const reference::Random& randomOf(std::uint32_t runSeed) {
    static const auto tile = reference::readTile(sourceDir() / "assets/noise/blue_noise_128.pgm");
    static std::map<std::uint32_t, reference::Random> runs;
    return runs.try_emplace(runSeed, tile, runSeed).first->second;
}

void shake(SceneFrames& frames, const Camera& start, int step, float meters) {
    const float t = float(step);
    frames.camera.position = start.position + meters * t * glm::vec3(0.9f, 0.2f, -0.5f);
    const float angle = meters > 0.0f ? 0.011f * t : 0.0f;
    frames.camera.orientation = glm::normalize(
        glm::angleAxis(angle, glm::normalize(glm::vec3(0.1f, 1.0f, 0.0f))) * start.orientation);
}

} // namespace afterglow::test
