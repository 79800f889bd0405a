// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/procedural.h"
#include "renderer/scene/shapes.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

struct Triangle {
    glm::dvec3 a, b, c;
};

std::vector<Triangle> worldTriangles(const Scene& scene, double seconds = 0.0) {
    const Pose pose = poseAt(scene, seconds);
    std::vector<Triangle> triangles;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::dmat4 world(pose.worldFromNode[instance.node]);
        const auto at = [&](std::uint32_t i) {
            return glm::dvec3(world * glm::dvec4(mesh.positions[i], 1.0));
        };
        for (const glm::uvec3& t : mesh.triangles) {
            triangles.push_back({at(t.x), at(t.y), at(t.z)});
        }
    }
    return triangles;
}

/// The distance to the nearest triangle along a ray, from either side; infinite if there is none.
/// Moeller and Trumbore 1997.
double hit(const std::vector<Triangle>& triangles, glm::dvec3 from, glm::dvec3 direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles) {
        const glm::dvec3 e = t.b - t.a, f = t.c - t.a, p = glm::cross(direction, f);
        const double determinant = glm::dot(e, p);
        if (determinant == 0.0) {
            continue;
        }
        const glm::dvec3 s = from - t.a, q = glm::cross(s, e);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double distance = glm::dot(f, q) / determinant;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-6) {
            nearest = std::min(nearest, distance);
        }
    }
    return nearest;
}

glm::dvec3 randomDirection(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double y = 2.0 * unit(random) - 1.0, turn = 2.0 * std::numbers::pi * unit(random);
    const double r = std::sqrt(1.0 - y * y);
    return {r * std::cos(turn), y, r * std::sin(turn)};
}

const Light& lightNamed(const Scene& scene, const std::string& name) {
    const auto found = std::find_if(scene.lights.begin(), scene.lights.end(),
                                    [&](const Light& light) { return light.name == name; });
    REQUIRE_MESSAGE(found != scene.lights.end(), name);
    return *found;
}

/// The box around a light, in the world.
Bounds boxOf(const Scene& scene, const Light& light) {
    Scene alone = scene;
    alone.instances.clear();
    for (const std::uint32_t i : light.instances) {
        alone.instances.push_back(scene.instances[i]);
    }
    return boundsOf(alone, poseAt(alone, 0.0));
}

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances) {
        count += scene.meshes[instance.mesh].triangles.size();
    }
    return count;
}

/// The volume that a closed mesh encloses, positive if its triangles face outwards.
double volumeOf(const Mesh& mesh) {
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        volume +=
            glm::dot(glm::dvec3(mesh.positions[t.x]),
                     glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z]))) /
            6.0;
    }
    return volume;
}

/// Whether every edge, by the places of its ends, is run once in each direction.
bool isClosed(const Mesh& mesh) {
    using Place = std::tuple<float, float, float>;
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i] + 0.0f; // no negative zero
        return Place(p.x, p.y, p.z);
    };
    for (const glm::uvec3& t : mesh.triangles) {
        for (int c = 0; c < 3; ++c) {
            ++edges[{place(t[c]), place(t[(c + 1) % 3])}];
        }
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        const auto opposite = edges.find({edge.first.second, edge.first.first});
        return opposite != edges.end() && opposite->second == edge.second;
    });
}

} // namespace

TEST_CASE("shapes have the volume of what they approach, faces outwards, and rings no seam") {
    constexpr double kPi = std::numbers::pi;
    Mesh box, room, sphere, torus, knot;
    addBox(box, {-1, 0, 2}, {1, 3, 3});
    CHECK(volumeOf(box) == doctest::Approx(6.0));
    CHECK(isClosed(box));
    addBox(room, {-1, 0, 2}, {1, 3, 3}, Facing::Inward);
    CHECK(volumeOf(room) == doctest::Approx(-6.0));
    addSphere(sphere, {5, 6, 7}, 2.0f, 64);
    CHECK(volumeOf(sphere) == doctest::Approx(4.0 / 3.0 * kPi * 8.0).epsilon(0.01)); // 64 sides
    addTorus(torus, {5, 6, 7}, 2.0f, 0.5f, 96, 48);
    CHECK(volumeOf(torus) == doctest::Approx(2 * kPi * kPi * 2.0 * 0.25).epsilon(0.01));
    CHECK(isClosed(torus));
    addTorusKnot(knot, {0, 0, 0}, 1.0f, 0.1f, 2, 3, 300, 20);
    CHECK(volumeOf(knot) > 0.0);
    CHECK(isClosed(knot));
}

TEST_CASE("every scene made in code is whole") {
    for (const SceneInfo& info : proceduralScenes()) {
        CAPTURE(info.name);
        const Scene scene = makeProceduralScene(info.name);
        CHECK(scene.name == info.name);
        CHECK(info.description.size() > 10);
        CHECK(scene.cameras.size() == 1);
        CHECK(lightNamed(scene, "key").instances.size() >= 1);
        std::set<std::string> names;
        for (const Light& light : scene.lights) {
            CHECK(names.insert(light.name).second);
        }
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
            CHECK(scene.nodes[i].parent < int(i));
        }
        int bad = 0, against = 0;
        for (const Mesh& mesh : scene.meshes) {
            REQUIRE(mesh.normals.size() == mesh.positions.size());
            for (const glm::vec3& normal : mesh.normals) {
                bad += !(std::abs(glm::length(normal) - 1.0f) < 1e-4f);
            }
            for (const glm::uvec3& t : mesh.triangles) {
                REQUIRE(std::max({t.x, t.y, t.z}) < mesh.positions.size());
                const glm::dvec3 a = mesh.positions[t.x];
                const glm::dvec3 front = glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                                    glm::dvec3(mesh.positions[t.z]) - a);
                bad += !(glm::length(front) > 0.0);
                const glm::dvec3 normals = glm::dvec3(mesh.normals[t.x]) +
                                           glm::dvec3(mesh.normals[t.y]) +
                                           glm::dvec3(mesh.normals[t.z]);
                against += !(glm::dot(front, normals) > 0.0);
            }
        }
        CHECK(bad == 0);
        CHECK(against == 0); // normals are on the side of the front
        for (const Track& track : scene.tracks) {
            REQUIRE(track.times.size() == track.values.size());
            CHECK(
                std::is_sorted(track.times.begin(), track.times.end(), std::less_equal<double>()));
        }
    }
}

TEST_CASE("a scene made twice is the same, bit for bit") {
    const Scene a = makeHall(), b = makeHall();
    REQUIRE(a.meshes.size() == b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        CHECK(a.meshes[i].positions == b.meshes[i].positions);
        CHECK(a.meshes[i].normals == b.meshes[i].normals);
        CHECK(a.meshes[i].triangles == b.meshes[i].triangles);
    }
}

TEST_CASE("the scenes that tests measure have the sizes that are promised") {
    const Scene tiny = makeTiny();
    CHECK(triangleCount(tiny) < 100);
    CHECK(tiny.lights.size() == 1);
    CHECK(duration(tiny) == 0.0);

    const Scene rect = makeRect();
    CHECK(triangleCount(rect) == 4);
    const Bounds light = boxOf(rect, lightNamed(rect, "key"));
    CHECK(light.min == glm::vec3(-0.5f, 2, -0.5f));
    CHECK(light.max == glm::vec3(0.5f, 2, 0.5f));
    const Instance& lamp = rect.instances[rect.lights[0].instances[0]];
    CHECK(rect.materials[lamp.material].emission == glm::vec3(10));
    CHECK(rect.meshes[lamp.mesh].normals[0] == glm::vec3(0, -1, 0));
    CHECK(boundsOf(rect, poseAt(rect, 0)).min == glm::vec3(-10, 0, -10));

    const Scene moving = makeMoving();
    CHECK(duration(moving) == 4.0);
    CHECK(moving.tracks.size() == 1);
    CHECK(moving.nodes[moving.tracks[0].node].name == "mover");
}

TEST_CASE("the edge hides from the floor the part of the light that is promised") {
    const Scene scene = makeEdge();
    std::vector<Triangle> triangles = worldTriangles(scene);
    const Bounds light = boxOf(scene, lightNamed(scene, "key"));
    CHECK(light.min == glm::vec3(-0.2f, 2, -0.2f));
    CHECK(light.max == glm::vec3(0.2f, 2, 0.2f));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> on(-0.19, 0.19), floor(-0.4, 0.4);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 from(floor(random), 0.0, floor(random)), to(on(random), 2.0, on(random));
        if (std::abs(to.x + from.x) < 1e-3) {
            continue;
        }
        const bool seen = hit(triangles, from, to - from) > 0.999;
        CHECK(seen == (to.x < -from.x));
    }
}

TEST_CASE("the hall is large, closed, and its mover crosses the shadow of a column") {
    const Scene scene = makeHall();
    CHECK(triangleCount(scene) > 100000);
    CHECK(triangleCount(scene) < 250000);
    CHECK(scene.instances.size() < 30);
    for (const char* name :
         {"key", "fill", "lantern near", "lantern middle", "lantern far", "behind wall"}) {
        lightNamed(scene, name);
    }
    CHECK(scene.lights.size() == 6);
    CHECK(duration(scene) == 12.0);

    // From the camera, every ray ends on something: there is no gap to the outside.
    const std::vector<Triangle> triangles = worldTriangles(scene);
    const Camera camera = cameraAt(scene, poseAt(scene, 0.0));
    std::mt19937 random(6);
    int escaped = 0;
    for (int i = 0; i < 300; ++i) {
        escaped += std::isinf(hit(triangles, camera.position, randomDirection(random)));
    }
    CHECK(escaped == 0);

    // The key is seen from the mover at some times and hidden at others.
    Scene still = scene;
    const auto mover = std::uint32_t(std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                                  [](const Node& n) { return n.name == "mover"; }) -
                                     scene.nodes.begin());
    REQUIRE(movingNodes(scene)[mover]);
    std::erase_if(still.instances, [&](const Instance& i) { return i.node == mover; });
    const std::vector<Triangle> others = worldTriangles(still);
    const Bounds key = boxOf(scene, lightNamed(scene, "key"));
    const glm::dvec3 middle = 0.5 * (glm::dvec3(key.min) + glm::dvec3(key.max));
    int lit = 0, dark = 0;
    for (double t = 0.0; t < 12.0; t += 0.25) {
        const glm::dvec3 from(poseAt(scene, t).worldFromNode[mover][3]);
        (hit(others, from, middle - from) > 0.99 ? lit : dark) += 1;
        // And it does not pass through anything on its way.
        for (int i = 0; i < 20; ++i) {
            CHECK(hit(others, from, randomDirection(random)) > 0.56);
        }
    }
    CHECK(lit > 10);
    CHECK(dark > 2);
}

TEST_CASE("a light behind a wall is sealed off: no ray from its room comes out") {
    for (const char* name : {"hall", "rooms"}) {
        CAPTURE(name);
        const Scene scene = makeProceduralScene(name);
        const std::vector<Triangle> triangles = worldTriangles(scene);
        const Bounds hidden = boxOf(scene, lightNamed(scene, "behind wall"));
        const glm::dvec3 from =
            0.5 * (glm::dvec3(hidden.min) + glm::dvec3(hidden.max)) - glm::dvec3(0, 0.5, 0);
        const glm::dvec3 eye(cameraAt(scene, poseAt(scene, 0.0)).position);
        std::mt19937 random(8);
        double farthest = 0.0;
        for (int i = 0; i < 400; ++i) {
            farthest = std::max(farthest, hit(triangles, from, randomDirection(random)));
        }
        CHECK(farthest < 4.7); // half the diagonal of either room and a little
        CHECK(hit(triangles, from, eye - from) < 1.0);
    }
}

TEST_CASE("a scene without light or camera gets the promised ones") {
    Scene scene;
    scene.nodes.resize(1);
    scene.meshes.resize(1);
    addBox(scene.meshes[0], {1, 2, 3}, {3, 5, 9});
    scene.materials.resize(1);
    scene.instances.push_back({0, 0, 0});
    completeScene(scene);
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].name == "default light");
    const float extent = 7.0f; // sqrt(2^2 + 3^2 + 6^2)
    const Bounds light = boxOf(scene, scene.lights[0]);
    CHECK(light.max.x - light.min.x == doctest::Approx(extent / 4));
    CHECK(light.max.z - light.min.z == doctest::Approx(extent / 4));
    CHECK(light.min.y == doctest::Approx(5 + extent / 4));
    CHECK(0.5f * (light.min.x + light.max.x) == doctest::Approx(2));
    const Instance& lamp = scene.instances[scene.lights[0].instances[0]];
    CHECK(scene.materials[lamp.material].emission == glm::vec3(20));
    const Mesh& square = scene.meshes[lamp.mesh];
    for (const glm::uvec3& t : square.triangles) {
        CHECK(glm::cross(square.positions[t.y] - square.positions[t.x],
                         square.positions[t.z] - square.positions[t.x])
                  .y < 0.0f);
    }
    // All corners of the box are in the picture, a square one even.
    REQUIRE(scene.cameras.size() == 1);
    const Camera camera = cameraAt(scene, poseAt(scene, 0.0));
    for (int i = 0; i < 8; ++i) {
        const glm::vec4 corner(i & 1 ? 1 : 3, i & 2 ? 2 : 5, i & 4 ? 3 : 9, 1);
        const glm::vec4 clip = camera.clipFromView(1.0f) * camera.viewFromWorld() * corner;
        CHECK(std::abs(clip.x) < clip.w);
        CHECK(std::abs(clip.y) < clip.w);
        CHECK(clip.z < clip.w);
    }
}

TEST_CASE("lights are one a node, with names of their own") {
    Scene scene;
    scene.nodes.resize(4);
    scene.nodes[0].name = scene.nodes[1].name = "lamp";
    scene.meshes.resize(1);
    addBox(scene.meshes[0], {0, 0, 0}, {1, 1, 1});
    scene.materials.resize(2);
    scene.materials[1].emission = {0, 0, 1};
    scene.instances = {{0, 1, 0}, {0, 0, 0}, {0, 1, 1}, {0, 1, 0}, {0, 1, 3}, {0, 0, 2}};
    completeScene(scene);
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].name == "lamp");
    CHECK(scene.lights[0].instances == std::vector<std::uint32_t>{0, 3});
    CHECK(scene.lights[1].name == "lamp 2");
    CHECK(scene.lights[2].name == "light");
    // Completing what is complete changes nothing.
    Scene again = scene;
    completeScene(again);
    CHECK(again.lights.size() == 3);
    CHECK(again.nodes.size() == scene.nodes.size());
    CHECK(again.cameras.size() == scene.cameras.size());
}

TEST_CASE("an empty scene can be completed") {
    Scene scene;
    completeScene(scene);
    CHECK(scene.lights.size() == 1);
    CHECK(scene.cameras.size() == 1);
    const Bounds bounds = boundsOf(Scene{}, Pose{});
    CHECK(bounds.extent() == 0.0f);
}

TEST_CASE("a camera below scaled, mirrored and turned nodes keeps its direction and no scale") {
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[0].scale = {-2, 3, 0.5f};
    scene.nodes[0].translation = {1, 2, 3};
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {1, 1, 1};
    scene.cameras.push_back({"eye", 1, {}});
    const Camera camera = cameraAt(scene, poseAt(scene, 0.0));
    CHECK(camera.position == glm::vec3(-1, 5, 3.5f));
    CHECK(glm::distance(camera.forward(), glm::vec3(0, 0, -1)) < 1e-6f);
    CHECK(glm::distance(camera.orientation * glm::vec3(0, 1, 0), glm::vec3(0, 1, 0)) < 1e-6f);
    CHECK(glm::length(camera.orientation) == doctest::Approx(1.0));
}

TEST_CASE("a scene is found by its name or its path, and a wrong name gets advice") {
    CHECK(loadScene("tiny").name == "tiny");
    const std::string path = (sourceDir() / "assets/scenes/cornell.gltf").string();
    CHECK(loadScene(path).name == "cornell");
    CHECK(
        messageOf<UsageError>([] { loadScene("cornel"); }) ==
        "no scene or file named 'cornel'; did you mean 'cornell'? (known: hall, cornell, gallery, "
        "rooms, moving, tiny, rect, edge)");
    CHECK(messageOf<UsageError>([] { loadScene("hull"); }).find("did you mean 'hall'?") !=
          std::string::npos);
    CHECK(messageOf<UsageError>([] { loadScene(""); }) != "");
    CHECK(messageOf<InputError>([] { loadScene("no/such.gltf"); }) ==
          "no/such.gltf: there is no such file");
    CHECK(messageOf<InputError>([] { loadScene("such.glb"); }) ==
          "such.glb: there is no such file");
    CHECK_THROWS_AS(makeProceduralScene("nothing"), UsageError);
}
