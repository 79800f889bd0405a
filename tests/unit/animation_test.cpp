#include "renderer/scene/scene.h"

#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

glm::vec4 xyzw(glm::quat q) {
    return {q.x, q.y, q.z, q.w};
}

glm::quat turnAboutY(float angle) {
    return glm::angleAxis(angle, glm::vec3(0, 1, 0));
}

/// A parent that moves, a child that turns, a grandchild, and a node by itself.
Scene family() {
    Scene scene;
    scene.nodes.resize(4);
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {1, 0, 0};
    scene.nodes[2].parent = 1;
    scene.nodes[2].translation = {0, 0, -2};
    scene.tracks = {{0,
                     Track::Path::Translation,
                     Track::Interpolation::Linear,
                     {1.0, 2.0, 4.0},
                     {{0, 0, 0, 0}, {0, 3, 0, 0}, {0, 3, 8, 0}}},
                    {1,
                     Track::Path::Rotation,
                     Track::Interpolation::Linear,
                     {0.0, 2.0},
                     {xyzw(turnAboutY(0.0f)), xyzw(turnAboutY(2.0f))}}};
    return scene;
}

glm::vec3 placeOf(const Scene& scene, double seconds, std::size_t node) {
    return glm::vec3(poseAt(scene, seconds).worldFromNode.at(node)[3]);
}

} // namespace

TEST_CASE("keys are met, values between them are in proportion, and the ends are held") {
    const Scene scene = family();
    CHECK(placeOf(scene, -5.0, 0) == glm::vec3(0, 0, 0));
    CHECK(placeOf(scene, 1.0, 0) == glm::vec3(0, 0, 0));
    CHECK(placeOf(scene, 1.5, 0) == glm::vec3(0, 1.5f, 0));
    CHECK(placeOf(scene, 2.0, 0) == glm::vec3(0, 3, 0));
    CHECK(placeOf(scene, 3.0, 0) == glm::vec3(0, 3, 4));
    CHECK(placeOf(scene, 4.0, 0) == glm::vec3(0, 3, 8));
    CHECK(placeOf(scene, 400.0, 0) == glm::vec3(0, 3, 8));
    CHECK(duration(scene) == 4.0);
    CHECK(duration(Scene{}) == 0.0);
}

TEST_CASE("a step holds its value up to the next key") {
    Scene scene = family();
    scene.tracks[0].interpolation = Track::Interpolation::Step;
    CHECK(placeOf(scene, 1.999, 0) == glm::vec3(0, 0, 0));
    CHECK(placeOf(scene, 2.0, 0) == glm::vec3(0, 3, 0));
    CHECK(placeOf(scene, 3.999, 0) == glm::vec3(0, 3, 0));
}

TEST_CASE("rotations turn at an even rate, the shorter way round") {
    Scene scene = family();
    for (const float sign : {1.0f, -1.0f}) {
        // q and -q are one rotation; the way between them must not depend on the sign.
        scene.tracks[1].values[1] = sign * xyzw(turnAboutY(2.0f));
        for (double t = 0.0; t <= 2.0; t += 0.125) {
            CAPTURE(t);
            const glm::mat4 world = poseAt(scene, t).worldFromNode[1];
            const glm::vec3 x = glm::vec3(world[0]);
            CHECK(glm::distance(x, glm::vec3(std::cos(t), 0, -std::sin(t))) < 1e-6f);
            CHECK(glm::determinant(glm::mat3(world)) == doctest::Approx(1.0));
        }
    }
}

TEST_CASE("children follow their parents, and those that move are known") {
    const Scene scene = family();
    const double t = 2.0;
    const glm::vec3 expected(1.0 - 2.0 * std::sin(2.0), 3.0, -2.0 * std::cos(2.0));
    CHECK(glm::distance(placeOf(scene, t, 2), expected) < 1e-5f);
    CHECK(movingNodes(scene) == std::vector<bool>{true, true, true, false});
    Scene less = scene;
    less.tracks.erase(less.tracks.begin());
    CHECK(movingNodes(less) == std::vector<bool>{false, true, true, false});
}

TEST_CASE("scale comes before rotation, rotation before translation, and a matrix instead of all") {
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[0].translation = {10, 0, 0};
    scene.nodes[0].rotation = turnAboutY(glm::radians(90.0f));
    scene.tracks = {{0,
                     Track::Path::Scale,
                     Track::Interpolation::Linear,
                     {0.0, 1.0},
                     {{1, 1, 1, 0}, {3, 1, 1, 0}}}};
    const glm::mat4 matrix = glm::translate(glm::mat4(1), glm::vec3(1, 2, 3));
    scene.nodes[1].matrix = matrix;
    const Pose pose = poseAt(scene, 0.5);
    const glm::vec3 p = pose.worldFromNode[0] * glm::vec4(1, 0, 0, 1);
    CHECK(glm::distance(p, glm::vec3(10, 0, -2)) < 1e-5f);
    CHECK(pose.worldFromNode[1] == matrix);
}

TEST_CASE("a pose depends on the time alone, to the bit, whatever was asked before") {
    const Scene scene = family();
    const Pose first = poseAt(scene, 1.2345);
    for (const double other : {9.0, 0.0, 1.2344, 2.0}) {
        poseAt(scene, other);
    }
    const Pose again = poseAt(scene, 1.2345);
    CHECK(std::memcmp(first.worldFromNode.data(), again.worldFromNode.data(),
                      first.worldFromNode.size() * sizeof(glm::mat4)) == 0);
}
