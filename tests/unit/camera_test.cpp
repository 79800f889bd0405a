// SPDX-License-Identifier: MIT
#include "renderer/scene/camera.h"

#include <cmath>
#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

glm::vec3 project(const Camera& camera, float aspect, glm::vec3 world) {
    const glm::vec4 clip =
        camera.clipFromView(aspect) * camera.viewFromWorld() * glm::vec4(world, 1.0f);
    return glm::vec3(clip) / clip.w;
}

} // namespace

TEST_CASE("depth is 1 at the near plane, 0 at the far one, and falls in between") {
    for (const float far : {10.0f, 1e4f, std::numeric_limits<float>::infinity()}) {
        CAPTURE(far);
        Camera camera;
        camera.lens = {.verticalFov = 0.9f, .near = 0.25f, .far = far};
        CHECK(project(camera, 1.5f, {0, 0, -0.25f}).z == doctest::Approx(1.0));
        if (std::isinf(far)) {
            CHECK(project(camera, 1.5f, {0, 0, -1e9f}).z == doctest::Approx(0.0));
            CHECK(project(camera, 1.5f, {0, 0, -1e9f}).z > 0.0f);
        } else {
            CHECK(std::abs(project(camera, 1.5f, {0, 0, -far}).z) < 1e-6f);
        }
        float before = 2.0f;
        for (float d = 0.25f; d < 9.0f; d *= 1.25f) {
            const float depth = project(camera, 1.5f, {0, 0, -d}).z;
            CHECK(depth < before);
            before = depth;
        }
    }
}

TEST_CASE("the edges of the picture are at the field of view, up is up and right is right") {
    Camera camera;
    camera.lens.verticalFov = 0.8f;
    const float aspect = 16.0f / 9.0f, top = std::tan(0.4f);
    const glm::vec3 up = project(camera, aspect, {0, 3 * top, -3});
    CHECK(up.y == doctest::Approx(1.0));
    CHECK(up.x == doctest::Approx(0.0));
    CHECK(project(camera, aspect, {3 * top * aspect, 0, -3}).x == doctest::Approx(1.0));
}

TEST_CASE("a camera that looks at a point has it in the middle, upright") {
    for (const glm::vec3 target :
         {glm::vec3(3, 4, 5), glm::vec3(-7, 0.5f, 0), glm::vec3(1, 9, 1)}) {
        const glm::vec3 eye(1, 2, 1);
        const Camera camera = lookAt(eye, target);
        const glm::vec3 p = project(camera, 1.3f, target);
        CHECK(std::abs(p.x) < 1e-5f);
        CHECK(std::abs(p.y) < 1e-5f);
        CHECK(glm::distance(camera.forward(), glm::normalize(target - eye)) < 1e-5f);
        CHECK(glm::length(camera.orientation) == doctest::Approx(1.0));
        // Level: to its right is neither up nor down, and its top is not below.
        CHECK(std::abs((camera.orientation * glm::vec3(1, 0, 0)).y) < 1e-5f);
        CHECK((camera.orientation * glm::vec3(0, 1, 0)).y >= -1e-5f);
    }
}

TEST_CASE("looking straight up or down, or at oneself, still gives a camera") {
    for (const glm::vec3 target : {glm::vec3(0, 5, 0), glm::vec3(0, -5, 0), glm::vec3(0, 0, 0)}) {
        const Camera camera = lookAt(glm::vec3(0), target);
        CHECK(glm::length(camera.orientation) == doctest::Approx(1.0));
        if (glm::length(target) > 0.0f) {
            CHECK(glm::distance(camera.forward(), glm::normalize(target)) < 1e-5f);
        }
    }
}

TEST_CASE("the view matrix moves the eye to the origin and keeps lengths") {
    const Camera camera = lookAt({10, -20, 30}, {1, 2, 3});
    const glm::mat4 view = camera.viewFromWorld();
    CHECK(glm::length(glm::vec3(view * glm::vec4(camera.position, 1))) < 1e-5f);
    CHECK(glm::distance(glm::vec3(view * glm::vec4(1, 2, 3, 1)),
                        glm::vec3(0, 0, -glm::distance(camera.position, glm::vec3(1, 2, 3)))) <
          1e-4f); // 36 m in 24 bits
    CHECK(glm::determinant(glm::mat3(view)) == doctest::Approx(1.0));
}
