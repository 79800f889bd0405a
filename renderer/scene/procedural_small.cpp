// SPDX-License-Identifier: MIT
// The small scenes: the Cornell box and those that tests measure. Their numbers are promised in
// procedural.h.

#include "renderer/scene/procedural.h"
#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"

namespace afterglow {

namespace {

/// Returns a rectangle at height y, its front up or down.
Mesh level(float y, glm::vec2 lowXz, glm::vec2 highXz, float front) {
    Mesh mesh;
    addQuadFacing(mesh, {0.0f, front, 0.0f}, {lowXz.x, y, lowXz.y}, {highXz.x, y, lowXz.y},
                  {highXz.x, y, highXz.y}, {lowXz.x, y, highXz.y});
    return mesh;
}

Mesh floorOf(float halfSize) {
    return level(0.0f, glm::vec2(-halfSize), glm::vec2(halfSize), 1.0f);
}

Mesh lampOf(float y, float halfSize, glm::vec2 center = glm::vec2(0.0f)) {
    return level(y, center - halfSize, center + halfSize, -1.0f);
}

/// Returns an upright prism over a quadrilateral, given by its corners (x, z).
Mesh prism(const glm::vec2 (&base)[4], float height) {
    Mesh mesh;
    const auto at = [&](int i, float y) { return glm::vec3(base[i % 4].x, y, base[i % 4].y); };
    const glm::vec3 middle = 0.25f * (at(0, 0) + at(1, 0) + at(2, 0) + at(3, 0));
    addQuadFacing(mesh, {0, 1, 0}, at(0, height), at(1, height), at(2, height), at(3, height));
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 outward = 0.5f * (at(i, 0) + at(i + 1, 0)) - middle;
        addQuadFacing(mesh, outward, at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height));
    }
    return mesh;
}

void addTinySet(SceneBuilder& scene) {
    const std::uint32_t still = scene.node("set");
    scene.add(floorOf(2.0f), scene.material("floor", {0.7f, 0.68f, 0.62f}), still);
    Mesh wall;
    addQuad(wall, {-2, 0, -2}, {2, 0, -2}, {2, 2.5f, -2}, {-2, 2.5f, -2});
    scene.add(std::move(wall), scene.material("wall", {0.35f, 0.5f, 0.6f}), still);
    // One meter square seen from 2.5 m: an irradiance of about 12 / 2.5^2 = 1.9 on the floor.
    scene.light("key", lampOf(2.5f, 0.5f), glm::vec3(12.0f));
    scene.camera(lookAt({1.6f, 1.7f, 4.2f}, {0.0f, 0.6f, 0.0f}));
}

Mesh tinyBox() {
    Mesh mesh;
    addBox(mesh, {-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f});
    return mesh;
}

} // namespace

Scene makeTiny() {
    SceneBuilder scene("tiny");
    addTinySet(scene);
    const std::uint32_t box = scene.node("box", {0.3f, 0.3f, 0.1f});
    scene.add(tinyBox(), scene.material("box", {0.75f, 0.3f, 0.2f}), box);
    return std::move(scene).finish();
}

Scene makeMoving() {
    SceneBuilder scene("moving");
    addTinySet(scene);
    // A hand's breadth above the floor, so that its shadow is seen beneath it.
    const std::uint32_t mover = scene.node("mover", {-0.8f, 0.5f, 0.1f});
    scene.add(tinyBox(), scene.material("box", {0.75f, 0.3f, 0.2f}), mover);
    scene.track(
        {.node = mover,
         .path = Track::Path::Translation,
         .interpolation = Track::Interpolation::Linear,
         .times = {0.0, 2.0, 4.0},
         .values = {{-0.8f, 0.5f, 0.1f, 0}, {0.8f, 0.5f, 0.1f, 0}, {-0.8f, 0.5f, 0.1f, 0}}});
    return std::move(scene).finish();
}

Scene makeRect() {
    SceneBuilder scene("rect");
    scene.add(floorOf(10.0f), scene.material("floor", glm::vec3(0.5f)), scene.node("set"));
    scene.light("key", lampOf(2.0f, 0.5f), glm::vec3(10.0f));
    scene.camera(lookAt({0.0f, 1.6f, 3.5f}, {0.0f, 0.0f, 0.0f}));
    scene.ambient(glm::vec3(0.0f));
    return std::move(scene).finish();
}

Scene makeEdge() {
    SceneBuilder scene("edge");
    const std::uint32_t still = scene.node("set");
    scene.add(floorOf(10.0f), scene.material("floor", glm::vec3(0.5f)), still);
    const std::uint32_t screen = scene.material("screen", glm::vec3(0.2f));
    scene.makeDoubleSided(screen);
    scene.add(level(1.0f, {0.0f, -10.0f}, {10.0f, 10.0f}, 1.0f), screen, still);
    scene.light("key", lampOf(2.0f, 0.2f), glm::vec3(50.0f));
    // Below the screen, so that the whole penumbra is seen.
    scene.camera(lookAt({-0.9f, 0.8f, 1.2f}, {0.0f, 0.0f, 0.0f}));
    scene.ambient(glm::vec3(0.0f));
    return std::move(scene).finish();
}

Scene makeRooms() {
    SceneBuilder scene("rooms");
    const std::uint32_t still = scene.node("set");
    const std::uint32_t plaster = scene.material("plaster", {0.7f, 0.68f, 0.65f});
    const std::uint32_t clay = scene.material("clay", {0.6f, 0.35f, 0.25f});
    Mesh rooms, things;
    for (const float middle : {-2.1f, 2.1f}) {
        // The walls of each room are the inner faces of one solid; between the rooms 0.2 m of it.
        addBox(rooms, {middle - 2.0f, 0.0f, -2.0f}, {middle + 2.0f, 3.0f, 2.0f}, Facing::Inward);
        addBox(things, {middle - 0.9f, 0.0f, -0.9f}, {middle - 0.2f, 0.9f, -0.2f});
        addSphere(things, {middle + 0.6f, 0.4f, 0.1f}, 0.4f, 32);
    }
    scene.add(std::move(rooms), plaster, still);
    scene.add(std::move(things), clay, still);
    // 1 m square, 3 m up: an irradiance of about 16 / 9 on the floor.
    scene.light("key", lampOf(2.98f, 0.5f, {-2.1f, 0.0f}), {16.0f, 14.5f, 12.0f});
    scene.light("behind wall", lampOf(2.98f, 0.5f, {2.1f, 0.0f}), {12.0f, 14.0f, 16.0f});
    scene.camera(lookAt({-0.6f, 1.7f, 1.75f}, {-2.5f, 0.9f, -0.7f}, {.verticalFov = 1.05f}));
    return std::move(scene).finish();
}

Scene makeCornell() {
    SceneBuilder scene("cornell");
    constexpr float kHalf = 0.278f, kHeight = 0.5488f, kDepth = 0.5592f;
    const std::uint32_t still = scene.node("box");
    const std::uint32_t white = scene.material("white", {0.73f, 0.73f, 0.73f});
    const std::uint32_t red = scene.material("red", {0.63f, 0.065f, 0.05f});
    const std::uint32_t green = scene.material("green", {0.14f, 0.45f, 0.091f});

    const glm::vec3 a(-kHalf, 0, 0), b(kHalf, 0, 0), c(kHalf, 0, -kDepth), d(-kHalf, 0, -kDepth);
    const glm::vec3 up(0, kHeight, 0);
    Mesh walls, left, right;
    addQuad(walls, a, b, c, d);                     // floor
    addQuad(walls, d + up, c + up, b + up, a + up); // ceiling
    addQuad(walls, d, c, c + up, d + up);           // back
    addQuad(left, a, d, d + up, a + up);
    addQuad(right, c, b, b + up, c + up);
    scene.add(std::move(walls), white, still);
    scene.add(std::move(left), red, still);
    scene.add(std::move(right), green, still);

    // Measured positions of the two blocks: Cornell University Program of Computer Graphics,
    // "Cornell Box Data", millimetres, there with x to the left and z into the picture.
    const auto place = [](float x, float z) { return glm::vec2(kHalf - x / 1000, -z / 1000); };
    scene.add(prism({place(130, 65), place(82, 225), place(240, 272), place(290, 114)}, 0.165f),
              white, still);
    scene.add(prism({place(423, 247), place(265, 296), place(314, 456), place(472, 406)}, 0.33f),
              white, still);

    // 0.0137 m^2 seen from 0.549 m: irradiance on the floor is 0.045 of the radiance, so about 2.
    scene.light("key", level(kHeight - 0.001f, place(343, 332), place(213, 227), -1.0f),
                {52.0f, 38.0f, 22.0f});
    Mesh panel;
    const float x = kHalf - 0.001f;
    addQuadFacing(panel, {-1, 0, 0}, {x, 0.34f, -0.14f}, {x, 0.34f, -0.24f}, {x, 0.42f, -0.24f},
                  {x, 0.42f, -0.14f});
    scene.light("fill", std::move(panel), {7.0f, 13.0f, 22.0f});
    scene.camera(lookAt({0.0f, 0.273f, 0.8f}, {0.0f, 0.273f, -0.28f},
                        {.verticalFov = 0.686f, .near = 0.01f}));
    scene.ambient(glm::vec3(0.15f));
    return std::move(scene).finish();
}

} // namespace afterglow
