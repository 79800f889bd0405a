// SPDX-License-Identifier: MIT
#include "app/workbench/camera_flight.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("flying goes along the camera's axes, by speed times time, and diagonals are no faster") {
    const Camera start = lookAt({0, 1, 5}, {0, 1, 0});
    Camera camera = start;
    fly(camera, {.move = {0, 0, 1}}, 2.0f, 0.5);
    CHECK(glm::distance(camera.position, glm::vec3(0, 1, 4)) < 1e-5f);
    fly(camera, {.move = {1, 0, 0}, .fast = true}, 2.0f, 0.5);
    CHECK(glm::distance(camera.position, glm::vec3(kFastFactor, 1, 4)) < 1e-5f);
    camera = start;
    fly(camera, {.move = {1, 0, 1}}, 2.0f, 0.5);
    CHECK(glm::distance(camera.position, start.position) == doctest::Approx(1.0));
    fly(camera, {}, 2.0f, 0.5);
    CHECK(camera.orientation == start.orientation);
}

TEST_CASE("looking turns right and up, keeps the horizon level and never passes the zenith") {
    Camera camera = lookAt({0, 1, 5}, {0, 1, 0});
    fly(camera, {.look = {0.3f, 0.0f}}, 1.0f, 0.0);
    CHECK(camera.forward().x == doctest::Approx(std::sin(0.3f)));
    fly(camera, {.look = {0.0f, 0.2f}}, 1.0f, 0.0);
    CHECK(camera.forward().y == doctest::Approx(std::sin(0.2f)));
    for (int i = 0; i < 50; ++i) {
        fly(camera, {.look = {0.1f, 0.5f}}, 1.0f, 0.0);
        const glm::vec3 right = camera.orientation * glm::vec3(1, 0, 0);
        const glm::vec3 up = camera.orientation * glm::vec3(0, 1, 0);
        REQUIRE(std::abs(right.y) < 1e-4f);
        REQUIRE(up.y > 0.0f);
    }
    CHECK(camera.forward().y > 0.999f);
    CHECK(glm::length(camera.orientation) == doctest::Approx(1.0));
}

TEST_CASE("the wheel changes the speed step by step, and not without end") {
    const float extent = 10.0f, speed = defaultSpeed(extent);
    CHECK(speed > 0.0f);
    CHECK(defaultSpeed(2.0f * extent) > speed);
    CHECK(changedSpeed(speed, 1.0f, extent) > speed);
    CHECK(changedSpeed(changedSpeed(speed, 1.0f, extent), -1.0f, extent) == doctest::Approx(speed));
    const float most = changedSpeed(speed, 1e3f, extent),
                least = changedSpeed(speed, -1e3f, extent);
    CHECK(changedSpeed(most, 1.0f, extent) == most);
    CHECK(changedSpeed(least, -1.0f, extent) == least);
    CHECK(least > 0.0f);
    CHECK(std::isfinite(most));
}
