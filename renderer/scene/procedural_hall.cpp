// SPDX-License-Identifier: MIT
// The hall. X across, Z along; the nave lies between the columns at x = -3 and x = 3, an aisle on
// either side, and the picture looks along -Z. Static parts are merged by material.

#include "renderer/scene/procedural.h"
#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace afterglow {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kFront = 6.0f, kBack = -30.0f; // end walls, z
constexpr float kBay = 4.0f;                   // from column to column
constexpr float kSide = 6.0f;                  // outer walls, |x|
constexpr float kRow = 3.0f;                   // axes of the columns, |x|
constexpr float kPier = 0.35f;                 // half the thickness of what the columns carry
constexpr float kSpring = 4.0f;                // where the arches begin, y
constexpr float kCornice = 6.2f;               // top of the arches' wall; the vault begins, y
constexpr float kArch = kBay / 2 - kPier;      // radius of an arch
constexpr float kVault = kRow - kPier;         // radius of the vault
constexpr int kArchCells = 28;

/// The static parts, one mesh a material.
struct Parts {
    Mesh stone, wall, vault, marble, bronze, clay, glaze, wood, gold, water;
    Mesh tiles[4];
};

/// Returns a number in [0, 1) that looks random and is the same on every machine. PCG's output
/// permutation.
float scatter(std::uint32_t n) {
    n = n * 747796405u + 2891336453u;
    n = ((n >> ((n >> 28u) + 4u)) ^ n) * 277803737u;
    n = (n >> 22u) ^ n;
    return float(n >> 8) / 16777216.0f;
}

/// Adds a surface around a vertical axis: radius and height along a profile from the bottom to the
/// top.
template <class Profile>
void addTurned(Mesh& mesh, glm::dvec3 foot, Profile profile, int around, int along) {
    addSurface(mesh,
               [=](double u, double v) {
                   const double turn = 2 * kPi * u;
                   const glm::dvec2 p = profile(u, v);
                   return foot + glm::dvec3(p.x * std::sin(turn), p.y, p.x * std::cos(turn));
               },
               {.u = around, .v = along, .closedU = true});
}

void addColumn(Mesh& stone, float x, float z) {
    const glm::dvec3 foot(x, 0.0, z);
    addBox(stone, {x - 0.52f, 0.0f, z - 0.52f}, {x + 0.52f, 0.16f, z + 0.52f});
    addTorus(stone, {x, 0.25f, z}, 0.40f, 0.09f, 48, 12);
    addTorus(stone, {x, 0.41f, z}, 0.37f, 0.06f, 48, 10);
    // The shaft: sixteen flutes, a third of it straight, then tapering (entasis).
    addTurned(
        stone, foot,
        [](double u, double v) {
            const double taper = v < 0.33 ? 0.0 : (v - 0.33) / 0.67;
            const double radius = 0.36 - 0.05 * taper * taper;
            const double flute = std::sqrt(std::abs(std::sin(8.0 * 2.0 * kPi * u)));
            return glm::dvec2(radius * (1.0 - 0.075 * flute), 0.45 + 3.1 * v);
        },
        128, 14);
    addTorus(stone, {x, 3.55f, z}, 0.31f, 0.045f, 48, 10);
    // The capital opens like a bell.
    addTurned(
        stone, foot,
        [](double, double v) { return glm::dvec2(0.30 + 0.16 * v * v, 3.58 + 0.26 * v); }, 48, 8);
    addBox(stone, {x - 0.5f, 3.84f, z - 0.5f}, {x + 0.5f, kSpring, z + 0.5f});
}

/// Adds one bay of the wall over the columns, with a round arch in it.
void addArch(Mesh& wall, float rowX, float middleZ) {
    const auto edge = [&](int i, float x) {
        const double turn = kPi * double(i) / kArchCells;
        return glm::vec3(x, kSpring + kArch * std::sin(turn), middleZ + kArch * std::cos(turn));
    };
    for (const float side : {-1.0f, 1.0f}) {
        const float x = rowX + side * kPier;
        const glm::vec3 front(side, 0.0f, 0.0f);
        for (int i = 0; i < kArchCells; ++i) {
            const glm::vec3 p = edge(i, x), q = edge(i + 1, x);
            addQuadFacing(wall, front, p, q, {x, kCornice, q.z}, {x, kCornice, p.z});
        }
        for (const float end : {-1.0f, 1.0f}) {
            const float z0 = middleZ + end * kBay / 2, z1 = middleZ + end * kArch;
            addQuadFacing(wall, front, {x, kSpring, z0}, {x, kSpring, z1}, {x, kCornice, z1},
                          {x, kCornice, z0});
        }
    }
    addSurface(wall,
               [=](double u, double v) {
                   const double turn = kPi * u;
                   return glm::dvec3(rowX - kPier + 2.0 * kPier * v,
                                     kSpring + kArch * std::sin(turn),
                                     middleZ + kArch * std::cos(turn));
               },
               {.u = kArchCells, .v = 1});
}

void addVault(Parts& parts) {
    addSurface(parts.vault,
               [](double u, double v) {
                   const double turn = kPi * u;
                   return glm::dvec3(kVault * std::cos(turn), kCornice + kVault * std::sin(turn),
                                     kFront + (kBack - kFront) * v);
               },
               {.u = 40, .v = 36});
    for (float z = kFront; z > kBack - 1.0f; z -= kBay) {
        addSurface(parts.stone,
                   [=](double u, double v) {
                       const double turn = kPi * u, around = 2 * kPi * v;
                       const double radius = kVault - 0.02 + 0.13 * std::cos(around);
                       return glm::dvec3(radius * std::cos(turn),
                                         kCornice + radius * std::sin(turn),
                                         z - 0.5 * kBay + 0.17 * std::sin(around));
                   },
                   {.u = 40, .v = 12, .closedV = true});
    }
    for (const float side : {-1.0f, 1.0f}) {
        // A cornice along the foot of the vault.
        const float x = side * kVault;
        addBox(parts.stone, {std::min(x, x - side * 0.14f), kCornice - 0.16f, kBack},
               {std::max(x, x - side * 0.14f), kCornice, kFront});
    }
}

void addAisle(Parts& parts, float side) {
    const float inner = side * kVault, outer = side * kSide;
    addQuadFacing(parts.wall, {-side, 0, 0}, {outer, 0, kFront}, {outer, 0, kBack},
                  {outer, kCornice, kBack}, {outer, kCornice, kFront});
    addQuadFacing(parts.wall, {0, -1, 0}, {inner, kCornice, kFront}, {inner, kCornice, kBack},
                  {outer, kCornice, kBack}, {outer, kCornice, kFront});
    // Coffers: beams across and along.
    const float low = std::min(side * (kRow + kPier), outer);
    const float high = std::max(side * (kRow + kPier), outer);
    for (float z = kFront - 1.0f; z > kBack; z -= 1.0f) {
        addBox(parts.wood, {low, kCornice - 0.2f, z - 0.09f}, {high, kCornice, z + 0.09f});
    }
    for (int i = 1; i < 3; ++i) {
        const float x = low + (high - low) * float(i) / 3.0f;
        addBox(parts.wood, {x - 0.09f, kCornice - 0.19f, kBack}, {x + 0.09f, kCornice, kFront});
    }
    // A bench of stone along the wall, and a half pillar at each column.
    addBox(parts.stone, {std::min(outer, outer - side * 0.5f), 0.0f, kBack},
           {std::max(outer, outer - side * 0.5f), 0.45f, kFront});
    for (float z = kFront - kBay; z > kBack + 1.0f; z -= kBay) {
        addBox(parts.stone, {std::min(outer, outer - side * 0.22f), 0.45f, z - 0.3f},
               {std::max(outer, outer - side * 0.22f), kCornice - 0.2f, z + 0.3f});
    }
}

void addFloor(Parts& parts) {
    std::uint32_t n = 0;
    for (float z = kBack; z < kFront; z += 1.0f) {
        for (float x = -kSide; x < kSide; x += 1.0f, ++n) {
            // A checker of light and dark, each in two shades.
            const int checker = (int(x + kSide) + int(z - kBack)) & 1;
            Mesh& tiles = parts.tiles[2 * checker + (scatter(n) < 0.5f ? 0 : 1)];
            addQuad(tiles, {x, 0, z + 1}, {x + 1, 0, z + 1}, {x + 1, 0, z}, {x, 0, z});
        }
    }
}

/// Adds a frame of stone on a wall around a window, given by its low and high corner; `out` is the
/// direction into the hall.
void addFrame(Mesh& stone, glm::vec3 low, glm::vec3 high, glm::vec3 out) {
    const glm::vec3 across = glm::abs(glm::cross(out, glm::vec3(0, 1, 0)));
    const glm::vec3 width = 0.18f * across, height(0.0f, 0.18f, 0.0f);
    const auto bar = [&](glm::vec3 a, glm::vec3 b) {
        const glm::vec3 c = b + 0.2f * out;
        addBox(stone, glm::min(a, c), glm::max(a, c));
    };
    const glm::vec3 flatHigh(high.x, low.y, high.z), flatLow(low.x, high.y, low.z);
    bar(low - width - height, flatHigh + width);
    bar(flatLow - width, high + width + height);
    bar(low - width, flatLow);
    bar(flatHigh, high + width);
}

void addPedestal(Parts& parts, float x, float z, float height) {
    addBox(parts.marble, {x - 0.5f, 0.0f, z - 0.5f}, {x + 0.5f, 0.15f, z + 0.5f});
    addBox(parts.marble, {x - 0.38f, 0.15f, z - 0.38f}, {x + 0.38f, height - 0.1f, z + 0.38f});
    addBox(parts.marble, {x - 0.46f, height - 0.1f, z - 0.46f}, {x + 0.46f, height, z + 0.46f});
}

void addThings(Parts& parts) {
    // Statues: knots and stacked rings on pedestals, the largest at the end of the nave.
    addPedestal(parts, 0.0f, -22.0f, 1.1f);
    addTorusKnot(parts.bronze, {0.0f, 2.08f, -22.0f}, 0.57f, 0.15f, 2, 3, 240, 20);
    addPedestal(parts, 4.5f, -4.0f, 1.0f);
    addTorusKnot(parts.glaze, {4.5f, 1.62f, -4.0f}, 0.34f, 0.10f, 3, 2, 200, 16);
    addPedestal(parts, -4.6f, -12.0f, 1.0f);
    for (int i = 0; i < 5; ++i) {
        addTorus(parts.marble, {-4.6f, 1.1f + 0.17f * float(i), -12.0f}, 0.34f - 0.055f * float(i),
                 0.09f, 48, 14);
    }
    addSphere(parts.bronze, {-4.6f, 2.03f, -12.0f}, 0.16f, 32);

    // Near the camera, right: spheres and blocks by the foot of a column.
    addSphere(parts.clay, {1.75f, 0.42f, -1.1f}, 0.42f, 64);
    addSphere(parts.marble, {1.15f, 0.2f, -0.45f}, 0.2f, 48);
    addSphere(parts.glaze, {2.05f, 0.27f, -0.3f}, 0.27f, 48);
    addBox(parts.stone, {-2.5f, 0.0f, -3.7f}, {-1.85f, 0.5f, -3.05f});
    addSphere(parts.glaze, {-2.17f, 0.78f, -3.37f}, 0.28f, 48);
    addTorus(parts.bronze, {-1.4f, 0.1f, -4.6f}, 0.35f, 0.1f, 64, 20);

    // A basin in the nave: a bowl of bronze on a foot of marble, filled to its rim.
    const glm::dvec3 basin(-0.9, 0.0, -8.4);
    addTurned(
        parts.marble, basin,
        [](double, double v) { return glm::dvec2(0.42 - 0.24 * std::sin(kPi * v), 0.5 * v); }, 64,
        16);
    addTurned(
        parts.bronze, basin,
        [](double, double v) { return glm::dvec2(1.05 * std::sqrt(v), 0.48 + 0.27 * v * v); }, 96,
        24);
    addTorus(parts.bronze, {-0.9f, 0.75f, -8.4f}, 1.05f, 0.045f, 96, 14);
    addTurned(
        parts.water, basin, [](double, double v) { return glm::dvec2(1.04 * (1.0 - v), 0.745); },
        96, 1);
    addSphere(parts.gold, {2.35f, 0.2f, -2.0f}, 0.2f, 64);

    // Jars along the right aisle and the nave.
    for (int i = 0; i < 6; ++i) {
        const glm::dvec3 foot(i % 2 ? 5.1 : 1.9, 0.0, -8.0 - 3.1 * i);
        const double size = 0.8 + 0.4 * scatter(900u + std::uint32_t(i));
        addTurned(
            i % 3 == 0   ? parts.clay
            : i % 3 == 1 ? parts.glaze
                         : parts.marble,
            foot,
            [=](double, double v) {
                const double belly = 0.13 + 0.24 * std::pow(std::sin(kPi * (0.08 + 0.84 * v)), 1.5);
                return size *
                       glm::dvec2(belly * std::sqrt(1.0 - std::pow(v, 12.0)), 1.1 * v); // closed
            },
            48, 24);
    }
}

void addMover(SceneBuilder& scene) {
    const std::uint32_t mover = scene.node("mover", {1.8f, 1.1f, -2.2f});
    Mesh ball, ring, cubes;
    addSphere(ball, glm::vec3(0.0f), 0.3f, 64);
    addTorus(ring, glm::vec3(0.0f), 0.46f, 0.05f, 80, 16);
    for (int i = 0; i < 4; ++i) {
        const double turn = 0.5 * kPi * i;
        const glm::vec3 p(0.46 * std::sin(turn), 0.0, 0.46 * std::cos(turn));
        addBox(cubes, p - 0.1f, p + 0.1f);
    }
    scene.add(std::move(ball), scene.material("mover ball", {0.75f, 0.72f, 0.66f}, 0.25f), mover);
    scene.add(std::move(ring), scene.material("mover ring", {0.95f, 0.68f, 0.30f}, 0.2f, 1.0f),
              mover);
    scene.add(std::move(cubes), scene.material("mover cubes", {0.62f, 0.13f, 0.09f}), mover);

    // A loop out of the left aisle, between the columns at z = 2 and z = -2 (the middle of the bay
    // is z = 0), and round the nave. It passes the shadow that the column at (-3, -2) has from the
    // key.
    constexpr int kKeys = 96;
    constexpr double kPeriod = 12.0;
    Track path{mover, Track::Path::Translation, Track::Interpolation::Linear, {}, {}};
    Track spin{mover, Track::Path::Rotation, Track::Interpolation::Linear, {}, {}};
    for (int i = 0; i <= kKeys; ++i) {
        const double turn = 2 * kPi * double(i % kKeys) / kKeys; // the loop closes exactly
        const double x = -1.2 + 3.0 * std::cos(turn);
        const double free = glm::smoothstep(-1.8, 0.5, x);
        const double z = free * (-2.2 + 1.2 * std::sin(turn));
        path.times.push_back(kPeriod * i / kKeys);
        path.values.emplace_back(x, 1.1 + 0.12 * std::sin(2 * turn), z, 0.0);
    }
    for (int i = 0; i <= 8; ++i) {
        // Two turns about an axis that leans; each key an eighth of the loop, a quarter turn.
        const glm::quat q =
            glm::angleAxis(float(0.5 * kPi * i), glm::normalize(glm::vec3(0.2f, 1, 0.1f)));
        spin.times.push_back(kPeriod * i / 8.0);
        spin.values.emplace_back(q.x, q.y, q.z, q.w);
    }
    scene.track(std::move(path));
    scene.track(std::move(spin));
}

void addLights(SceneBuilder& scene, Parts& parts) {
    // The key: 1.4 x 2 m, high in the wall of the left aisle in the middle of a bay. On the floor
    // of the nave (7.2 m away, cosines 0.83 and 0.55) E = L * 2.8 * 0.46 / 52 = 0.025 L, about 2.3;
    // times an albedo of 0.5 over pi, a radiance of 0.4. Shadows fan out from the columns.
    const float x = -kSide + 0.02f;
    Mesh key;
    addQuadFacing(key, {1, 0, 0}, {x, 3.0f, -4.7f}, {x, 3.0f, -3.3f}, {x, 5.0f, -3.3f},
                  {x, 5.0f, -4.7f});
    scene.light("key", std::move(key), {125.0f, 92.0f, 56.0f});
    addFrame(parts.stone, {-kSide, 3.0f, -4.7f}, {-kSide, 5.0f, -3.3f}, {1, 0, 0});

    // The fill: the window that ends the view.
    const float z = kBack + 0.02f;
    Mesh fill;
    addQuadFacing(fill, {0, 0, 1}, {-1.2f, 2.2f, z}, {1.2f, 2.2f, z}, {1.2f, 6.2f, z},
                  {-1.2f, 6.2f, z});
    scene.light("fill", std::move(fill), {8.0f, 12.0f, 17.0f});
    addFrame(parts.stone, {-1.2f, 2.2f, kBack}, {1.2f, 6.2f, kBack}, {0, 0, 1});

    // Lanterns: balls of 0.14 m on rods. At 3 m, E = L * pi * 0.14^2 / 9 = 0.0068 L, about 0.6.
    const struct {
        const char* name;
        glm::vec3 place;
        float ceiling;
    } lanterns[] = {{"lantern near", {4.6f, 3.2f, 0.0f}, kCornice},
                    {"lantern middle", {4.6f, 3.2f, -12.0f}, kCornice},
                    {"lantern far", {-4.6f, 3.2f, -20.0f}, kCornice}};
    for (const auto& lantern : lanterns) {
        Mesh ball;
        addSphere(ball, lantern.place, 0.14f, 16);
        scene.light(lantern.name, std::move(ball), {105.0f, 62.0f, 24.0f});
        const glm::vec3 p = lantern.place;
        addBox(parts.bronze, {p.x - 0.012f, p.y + 0.17f, p.z - 0.012f},
               {p.x + 0.012f, lantern.ceiling, p.z + 0.012f});
        addTorus(parts.bronze, p, 0.17f, 0.015f, 32, 8);
    }

    // The sealed room beyond the right wall, with nothing but its light and a ball.
    Mesh room;
    addBox(room, {6.4f, 0.0f, -10.0f}, {9.4f, 3.5f, -6.0f}, Facing::Inward);
    addSphere(room, {7.9f, 0.5f, -8.0f}, 0.5f, 32);
    scene.add(std::move(room), scene.material("side room", {0.7f, 0.7f, 0.7f}),
              scene.node("side room"));
    Mesh hidden;
    addQuadFacing(hidden, {0, -1, 0}, {7.4f, 3.48f, -8.5f}, {8.4f, 3.48f, -8.5f},
                  {8.4f, 3.48f, -7.5f}, {7.4f, 3.48f, -7.5f});
    scene.light("behind wall", std::move(hidden), glm::vec3(20.0f));
}

} // namespace

Scene makeHall() {
    SceneBuilder scene("hall");
    Parts parts;
    addFloor(parts);
    for (const float side : {-1.0f, 1.0f}) {
        for (float z = kFront - kBay; z > kBack + 1.0f; z -= kBay) {
            addColumn(parts.stone, side * kRow, z);
        }
        for (float z = kFront - kBay / 2; z > kBack; z -= kBay) {
            addArch(parts.wall, side * kRow, z);
        }
        addAisle(parts, side);
    }
    addVault(parts);
    const float top = kCornice + kVault + 0.1f;
    addQuadFacing(parts.wall, {0, 0, 1}, {-kSide, 0, kBack}, {kSide, 0, kBack}, {kSide, top, kBack},
                  {-kSide, top, kBack});
    addQuadFacing(parts.wall, {0, 0, -1}, {-kSide, 0, kFront}, {kSide, 0, kFront},
                  {kSide, top, kFront}, {-kSide, top, kFront});
    addThings(parts);
    addLights(scene, parts);

    const std::uint32_t still = scene.node("hall");
    const auto put = [&](Mesh& mesh, const char* name, glm::vec3 color, float roughness = 1.0f,
                         float metallic = 0.0f) {
        scene.add(std::move(mesh), scene.material(name, color, roughness, metallic), still);
    };
    put(parts.stone, "stone", {0.68f, 0.62f, 0.52f});
    put(parts.wall, "wall", {0.62f, 0.55f, 0.46f});
    put(parts.vault, "vault", {0.55f, 0.55f, 0.56f});
    put(parts.marble, "marble", {0.78f, 0.77f, 0.74f}, 0.3f);
    put(parts.bronze, "bronze", {0.70f, 0.45f, 0.20f}, 0.3f, 1.0f);
    put(parts.gold, "gold", {1.0f, 0.78f, 0.34f}, 0.15f, 1.0f);
    put(parts.water, "water", {0.02f, 0.035f, 0.04f}, 0.02f);
    put(parts.clay, "clay", {0.62f, 0.22f, 0.13f});
    put(parts.glaze, "glaze", {0.10f, 0.26f, 0.42f}, 0.12f);
    put(parts.wood, "wood", {0.30f, 0.19f, 0.11f}, 0.6f);
    put(parts.tiles[0], "tile light a", {0.62f, 0.58f, 0.51f}, 0.22f);
    put(parts.tiles[1], "tile light b", {0.55f, 0.51f, 0.45f}, 0.22f);
    put(parts.tiles[2], "tile dark a", {0.34f, 0.31f, 0.28f}, 0.16f);
    put(parts.tiles[3], "tile dark b", {0.28f, 0.25f, 0.23f}, 0.16f);

    addMover(scene);
    // A little right of the middle, at the height of the eyes, looking slightly left and up.
    scene.camera(lookAt({0.85f, 1.75f, 5.2f}, {-0.45f, 2.35f, -8.0f}, {.verticalFov = 0.92f}));
    scene.ambient({0.13f, 0.14f, 0.17f});
    return std::move(scene).finish();
}

} // namespace afterglow
