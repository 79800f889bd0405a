// SPDX-License-Identifier: MIT
#include "renderer/scene/gltf_import.h"
#include "renderer/scene/scene.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

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

/// A file whose node moves up by a meter at every key; the first key is at 0.
Scene stairs(const std::vector<float>& times, const char* interpolation) {
    GltfBuilder builder;
    const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    builder.shape({{"attributes", {{"POSITION", positions}}}});
    std::vector<float> places;
    for (std::size_t i = 0; i < times.size(); ++i)
        places.insert(places.end(), {0.0f, float(i), 0.0f});
    const int input = builder.floats(times, "SCALAR"), output = builder.floats(places, "VEC3");
    builder.document["animations"].push_back(
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    const TemporaryFolder folder;
    std::ofstream(folder / "stairs.gltf") << builder.gltf();
    return importGltf(folder / "stairs.gltf");
}

} // namespace

TEST_CASE("a key on a frame acts in that frame and not before, at every rate") {
    for (const int rate : {24, 25, 30, 50, 60, 90, 120}) {
        CAPTURE(rate);
        std::vector<float> times;
        for (int frame = 0; frame <= 10 * rate; ++frame)
            times.push_back(float(frame / double(rate)));
        const Scene step = stairs(times, "STEP"), linear = stairs(times, "LINEAR");
        for (int frame = 0; frame <= 10 * rate; ++frame) {
            CAPTURE(frame);
            const double seconds = frame / double(rate);
            REQUIRE(placeOf(step, seconds, 0).y == float(frame));
            REQUIRE(placeOf(linear, seconds, 0).y == float(frame));
            const double before = (frame - 0.001) / double(rate);
            REQUIRE(placeOf(step, before, 0).y == std::max(float(frame - 1), 0.0f));
        }
    }
}

TEST_CASE("a linear track has no jump around its keys") {
    // 6/60 s, stored as a float, is 1.5e-9 s above the time of the frame.
    const Scene scene = stairs({0.0f, 6.0f / 60.0f, 1.0f}, "LINEAR");
    const double key = 6.0f / 60.0f, slope = 10.0; // meters a second, before the key
    float previous = placeOf(scene, key - 4e-8, 0).y;
    for (int i = -399; i <= 400; ++i) {
        const double seconds = key + i * 1e-10;
        const float y = placeOf(scene, seconds, 0).y;
        REQUIRE(y >= previous);
        // Half a step between two floats around the key, 3.7e-9 s, is what the rounding may skip.
        REQUIRE(std::abs(y - (1.0 + slope * std::min(0.0, seconds - key))) < 1e-7);
        previous = y;
    }
}

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
