// SPDX-License-Identifier: MIT
#include "tests/support/glossy_scene.h"

#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"
#include "tests/support/scene_parts.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace afterglow::test {

namespace {

Mesh ball(float radius) {
    Mesh mesh;
    addSphere(mesh, {0.0f, 0.0f, 0.0f}, radius, 8);
    return mesh;
}

void setFactors(Scene& scene, std::string_view name, float metallic, float roughness) {
    Material& material = *std::ranges::find(scene.materials, name, &Material::name);
    material.metallic = metallic;
    material.roughness = roughness;
}

Node& nodeNamed(Scene& scene, std::string_view name) {
    return *std::ranges::find(scene.nodes, name, &Node::name);
}

} // namespace

Scene makeGlossy() {
    SceneBuilder scene("glossy");
    const std::uint32_t still = scene.node("set");
    scene.add(square(2.0f, 1.0f), scene.material("ground", {0.6f, 0.5f, 0.4f}), still);
    Mesh back, side;
    addQuad(back, {-2, 0, -1.5f}, {2, 0, -1.5f}, {2, 1.8f, -1.5f}, {-2, 1.8f, -1.5f});
    addQuad(side, {-2, 0, 1}, {-2, 0, -1.5f}, {-2, 1.8f, -1.5f}, {-2, 1.8f, 1});
    scene.add(back, scene.material("pane", {0.9f, 0.9f, 0.85f}), still);
    scene.add(side, scene.material("iron", {0.9f, 0.6f, 0.4f}), still);

    scene.add(ball(0.45f), scene.material("chrome", {0.95f, 0.93f, 0.9f}),
              scene.node("chrome", {-0.9f, 0.46f, -0.3f}));
    scene.add(ball(0.4f), scene.material("brass", {0.9f, 0.7f, 0.3f}),
              scene.node("brass", {0.1f, 0.41f, -0.6f}));
    scene.add(ball(0.5f), scene.material("lacquer", {0.7f, 0.1f, 0.08f}),
              scene.node("lacquer", {0.9f, 0.56f, -0.2f}));
    const std::uint32_t paper = scene.material("paper", {0.2f, 0.4f, 0.8f});
    scene.makeDoubleSided(paper);
    scene.add(square(0.3f, 1.0f), paper, scene.node("sheet", {0.1f, 0.3f, 0.9f}));
    scene.add(square(0.15f, 1.0f), paper, scene.node("shade", {-0.1f, 2.05f, 0.3f}));
    Mesh box;
    addBox(box, {-0.2f, -0.15f, -0.2f}, {0.2f, 0.15f, 0.2f});
    const std::uint32_t mover = scene.node("mover");
    scene.add(box, scene.material("mover", {0.5f, 0.8f, 0.6f}), mover);

    scene.light("key", square(0.3f, -1.0f), {9.0f, 8.0f, 6.0f});
    const std::uint32_t glow = scene.glow("fan", {4.0f, 3.0f, 5.0f});
    scene.makeDoubleSided(glow);
    const std::uint32_t fan = scene.node("fan", {1.1f, 1.4f, 0.3f});
    Mesh blades; // two triangles that are not in one plane
    blades.positions = {{-0.4f, 0, -0.4f}, {-0.3f, 0, 0.4f}, {0.4f, 0.2f, 0.3f}, {0.3f, 0, -0.4f}};
    blades.normals.assign(4, {0, 1, 0});
    blades.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.add(blades, glow, fan);
    scene.light("turned away", square(0.25f, 1.0f), {2.0f, 5.0f, 9.0f});
    scene.light("spare", square(0.2f, -1.0f), {3.0f, 9.0f, 3.0f});

    const auto move = [&](std::uint32_t node, Track::Path path, glm::vec4 from, glm::vec4 to) {
        scene.track({.node = node,
                     .path = path,
                     .interpolation = Track::Interpolation::Linear,
                     .times = {0.0, 1.0},
                     .values = {from, to}});
    };
    move(mover, Track::Path::Translation, {-0.5f, 0.5f, 0.7f, 0}, {-0.1f, 0.7f, 0.5f, 0});
    move(mover, Track::Path::Rotation, turn({1, 0, 0}, 0.4f), turn({1, 1, 0}, 1.9f));
    move(fan, Track::Path::Rotation, turn({0, 0, 1}, 0.9f), turn({0, 0, 1}, 2.4f));
    scene.camera(lookAt({0.7f, 1.5f, 3.0f}, {-0.1f, 0.6f, -0.2f}, {.far = 40.0f}));
    scene.ambient({0.2f, 0.3f, 0.4f});

    Scene out = std::move(scene).finish();
    setFactors(out, "ground", 0.0f, 0.3f);
    setFactors(out, "pane", 1.0f, 0.05f);
    setFactors(out, "iron", 1.0f, 1.0f);
    setFactors(out, "chrome", 1.0f, 0.0f);
    setFactors(out, "brass", 1.0f, 0.3f);
    setFactors(out, "lacquer", 0.0f, 0.1f);
    setFactors(out, "paper", 0.0f, 0.6f);
    setFactors(out, "mover", 0.5f, 0.5f);
    for (const Light& light : out.lights)
        for (const std::uint32_t instance : light.instances) {
            Material& lamp = out.materials[out.instances[instance].material];
            lamp.baseColor = glm::vec3(0.5f);
            lamp.roughness = 0.4f;
        }
    nodeNamed(out, "lacquer").scale = {-0.9f, 1.1f, 0.8f};
    nodeNamed(out, "sheet").rotation = glm::angleAxis(1.1f, glm::normalize(glm::vec3(1, 0.3f, 0)));
    nodeNamed(out, "key").translation = {-0.2f, 2.2f, 0.3f};
    nodeNamed(out, "spare").translation = {-1.3f, 1.5f, 0.7f};
    // Front up in its own space, towards +X and down by a mirror and a turn.
    Node& away = nodeNamed(out, "turned away");
    away.translation = {0.7f, 1.3f, -0.9f};
    away.scale = {1.2f, -1.0f, 0.9f};
    away.rotation = glm::angleAxis(1.1f, glm::vec3(0, 0, 1));
    return out;
}

Scene makeGlossyFloor(float metallic, float roughness) {
    SceneBuilder scene("glossy floor");
    scene.add(square(4.0f, 1.0f), scene.material("floor", {0.6f, 0.55f, 0.5f}),
              scene.node("floor"));
    Mesh lamp = square(1.0f, -1.0f);
    for (glm::vec3& p : lamp.positions)
        p.y = 2.0f;
    scene.light("key", lamp, glm::vec3(10.0f));
    scene.camera(lookAt({0.0f, 1.5f, 3.0f}, {0.0f, 0.0f, 1.2f}));
    scene.ambient(glm::vec3(0.05f));
    Scene out = std::move(scene).finish();
    setFactors(out, "floor", metallic, roughness);
    return out;
}

Scene makeScreenedLamp() {
    SceneBuilder scene("screened lamp");
    const std::uint32_t still = scene.node("set");
    const std::uint32_t plaster = scene.material("plaster", {0.8f, 0.78f, 0.75f});
    Mesh room, screen;
    addBox(room, {-2.0f, 0.0f, -2.0f}, {2.0f, 2.5f, 2.0f}, Facing::Inward);
    // From wall to wall and up to a gap of a meter.
    addBox(screen, {-2.0f, 0.0f, -0.6f}, {2.0f, 1.5f, -0.5f});
    scene.add(room, plaster, still);
    scene.add(screen, plaster, still);
    // Below the upper edge, facing up: the ceiling sends its light to the other half.
    Mesh lamp = square(0.4f, 1.0f);
    for (glm::vec3& p : lamp.positions)
        p += glm::vec3(0.0f, 0.1f, -1.0f);
    scene.light("key", lamp, glm::vec3(100.0f));
    scene.camera(lookAt({0.0f, 1.2f, 1.9f}, {0.0f, 0.3f, 0.0f}));
    scene.ambient(glm::vec3(0.0f));
    return std::move(scene).finish();
}

Scene makeFurnace(const std::vector<Material>& floors) {
    SceneBuilder scene("furnace");
    const std::uint32_t still = scene.node("set");
    const float half = 0.5f * float(floors.size());
    std::vector<std::uint32_t> materials;
    for (std::size_t i = 0; i < floors.size(); ++i) {
        const float x = float(i) - half;
        Mesh floor;
        addQuadFacing(floor, {0, 1, 0}, {x, 0, -2}, {x + 1, 0, -2}, {x + 1, 0, 2}, {x, 0, 2});
        materials.push_back(scene.material("floor " + std::to_string(i), floors[i].baseColor));
        scene.add(floor, materials.back(), still);
    }
    Mesh lamp = square(0.2f, -1.0f);
    for (glm::vec3& p : lamp.positions)
        p.y = -1.0f;
    scene.light("key", lamp, glm::vec3(10.0f));
    // Half of the angles are grazing ones.
    scene.camera(lookAt({0.0f, 0.9f, 3.4f}, {0.0f, 0.0f, 0.2f}, {.verticalFov = 0.9f}));
    scene.ambient(glm::vec3(1.0f));
    Scene out = std::move(scene).finish();
    for (std::size_t i = 0; i < floors.size(); ++i) {
        out.materials[materials[i]].metallic = floors[i].metallic;
        out.materials[materials[i]].roughness = floors[i].roughness;
    }
    return out;
}

} // namespace afterglow::test
