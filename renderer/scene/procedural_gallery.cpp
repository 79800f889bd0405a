// SPDX-License-Identifier: MIT
// The gallery: what light does on its way over one more surface.

#include "renderer/scene/procedural.h"
#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"

namespace afterglow {

namespace {

constexpr float kHalf = 2.5f;                        // side walls, |x|
constexpr float kHeight = 2.8f;                      // ceilings, y
constexpr float kFront = 1.5f;                       // behind the camera, z
constexpr float kNear = -4.0f, kFar = -4.2f;         // the wall between the rooms, z
constexpr float kEnd = -7.2f;                        // the end of the second room, z
constexpr float kDoorLow = -1.7f, kDoorHigh = -0.6f; // the doorway, x
constexpr float kDoorTop = 2.1f;                     // the doorway, y

/// Adds both sides of the wall between the rooms, with a doorway in it.
void addDividingWall(Mesh& wall) {
    const glm::vec2 pieces[][2] = {{{-kHalf, 0.0f}, {kDoorLow, kHeight}},
                                   {{kDoorHigh, 0.0f}, {kHalf, kHeight}},
                                   {{kDoorLow, kDoorTop}, {kDoorHigh, kHeight}}};
    for (const auto& [low, high] : pieces)
        for (const float z : {kNear, kFar})
            addQuadFacing(wall, {0, 0, z == kNear ? 1.0f : -1.0f}, {low.x, low.y, z},
                          {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z});
    // The reveal of the doorway.
    addQuadFacing(wall, {1, 0, 0}, {kDoorLow, 0, kNear}, {kDoorLow, 0, kFar},
                  {kDoorLow, kDoorTop, kFar}, {kDoorLow, kDoorTop, kNear});
    addQuadFacing(wall, {-1, 0, 0}, {kDoorHigh, 0, kNear}, {kDoorHigh, 0, kFar},
                  {kDoorHigh, kDoorTop, kFar}, {kDoorHigh, kDoorTop, kNear});
    addQuadFacing(wall, {0, -1, 0}, {kDoorLow, kDoorTop, kNear}, {kDoorLow, kDoorTop, kFar},
                  {kDoorHigh, kDoorTop, kFar}, {kDoorHigh, kDoorTop, kNear});
}

/// Adds walls and ceiling of a room without its floor; the sides at z0 and z1 where they are there.
void addRoom(Mesh& wall, float z0, float z1) {
    for (const float side : {-1.0f, 1.0f})
        addQuadFacing(wall, {-side, 0, 0}, {side * kHalf, 0, z0}, {side * kHalf, 0, z1},
                      {side * kHalf, kHeight, z1}, {side * kHalf, kHeight, z0});
    addQuadFacing(wall, {0, -1, 0}, {-kHalf, kHeight, z0}, {kHalf, kHeight, z0},
                  {kHalf, kHeight, z1}, {-kHalf, kHeight, z1});
}

void addEnd(Mesh& wall, float z, float front) {
    addQuadFacing(wall, {0, 0, front}, {-kHalf, 0, z}, {kHalf, 0, z}, {kHalf, kHeight, z},
                  {-kHalf, kHeight, z});
}

void addLights(SceneBuilder& scene) {
    // In the ceiling of the first room: an irradiance of about 12 * 0.49 / 7 = 0.8 on its floor.
    Mesh key;
    addQuadFacing(key, {0, -1, 0}, {-0.1f, kHeight - 0.02f, -2.4f}, {0.6f, kHeight - 0.02f, -2.4f},
                  {0.6f, kHeight - 0.02f, -1.7f}, {-0.1f, kHeight - 0.02f, -1.7f});
    scene.light("key", std::move(key), {12.0f, 11.0f, 9.5f});

    // A sign on the wall between the rooms; its mirror image lies in the floor.
    Mesh sign;
    addQuadFacing(sign, {0, 0, 1}, {0.5f, 0.9f, kNear + 0.02f}, {1.7f, 0.9f, kNear + 0.02f},
                  {1.7f, 1.5f, kNear + 0.02f}, {0.5f, 1.5f, kNear + 0.02f});
    scene.light("sign", std::move(sign), {2.2f, 4.5f, 6.0f});

    // In the second room, on the wall beside the doorway and turned away from it: the first room
    // gets none of its light but from the surfaces that it shines on.
    Mesh next;
    addQuadFacing(next, {0, 0, -1}, {0.2f, 0.8f, kFar - 0.02f}, {1.8f, 0.8f, kFar - 0.02f},
                  {1.8f, 2.2f, kFar - 0.02f}, {0.2f, 2.2f, kFar - 0.02f});
    scene.light("next room", std::move(next), {26.0f, 20.0f, 13.0f});
}

} // namespace

Scene makeGallery() {
    SceneBuilder scene("gallery");
    const std::uint32_t still = scene.node("gallery");
    Mesh walls, end, floors, plinths;
    addRoom(walls, kFront, kNear);
    addRoom(walls, kFar, kEnd);
    addEnd(walls, kFront, -1.0f);
    addDividingWall(walls);
    addEnd(end, kEnd, 1.0f);
    addQuadFacing(floors, {0, 1, 0}, {-kHalf, 0, kFront}, {kHalf, 0, kFront}, {kHalf, 0, kEnd},
                  {-kHalf, 0, kEnd});
    addBox(plinths, {1.1f, 0.0f, -2.9f}, {1.6f, 0.7f, -2.4f});
    addBox(plinths, {-2.2f, 0.0f, -2.2f}, {-1.7f, 0.5f, -1.7f});
    scene.add(std::move(walls), scene.material("plaster", {0.72f, 0.70f, 0.66f}), still);
    scene.add(std::move(end), scene.material("end wall", {0.70f, 0.52f, 0.30f}), still);
    scene.add(std::move(floors), scene.material("polished stone", {0.22f, 0.21f, 0.20f}, 0.12f),
              still);
    scene.add(std::move(plinths), scene.material("plinth", {0.55f, 0.55f, 0.53f}), still);

    Mesh gold, mirror, glaze;
    addSphere(gold, {1.35f, 1.0f, -2.65f}, 0.3f, 64);
    addSphere(mirror, {-1.95f, 0.8f, -1.95f}, 0.3f, 64);
    addSphere(glaze, {0.45f, 0.3f, -2.7f}, 0.3f, 64);
    scene.add(std::move(gold), scene.material("gold", {1.0f, 0.78f, 0.34f}, 0.3f, 1.0f), still);
    scene.add(std::move(mirror), scene.material("mirror", glm::vec3(0.95f), 0.0f, 1.0f), still);
    scene.add(std::move(glaze), scene.material("glaze", {0.55f, 0.06f, 0.05f}, 0.2f), still);

    // A door that is shut where it stands, and a screen, red on one side and white on the other.
    Mesh door, red, white;
    addBox(door, {-0.57f, 0.005f, -0.03f}, {0.57f, 2.12f, 0.03f});
    scene.add(std::move(door), scene.material("door", {0.42f, 0.28f, 0.16f}, 0.5f),
              scene.node("door", {-1.15f, 0.0f, kFar - 0.06f}));
    const std::uint32_t screen = scene.node("screen", {-0.55f, 0.0f, -3.1f});
    addBox(red, {-0.55f, 0.02f, 0.0f}, {0.55f, 1.3f, 0.02f});
    addBox(white, {-0.55f, 0.02f, -0.02f}, {0.55f, 1.3f, -0.001f});
    scene.add(std::move(red), scene.material("screen red", {0.75f, 0.05f, 0.04f}), screen);
    scene.add(std::move(white), scene.material("screen white", {0.75f, 0.75f, 0.75f}), screen);

    addLights(scene);
    scene.camera(lookAt({0.35f, 1.45f, 1.2f}, {-0.1f, 0.75f, -3.0f}, {.verticalFov = 0.95f}));
    scene.ambient(glm::vec3(0.0f));
    return std::move(scene).finish();
}

} // namespace afterglow
