// SPDX-License-Identifier: MIT
#include "app/workbench/camera_flight.h"
#include "app/workbench/transport.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

std::vector<Camera> fiveKeys() {
    return {lookAt({0, 1, 5}, {0, 1, 0}), lookAt({2, 1, 4}, {0, 1, 0}, {.verticalFov = 0.5f}),
            lookAt({4, 3, 0}, {0, 0, 0}), lookAt({0, 2, -5}, {3, 1, 0}, {.verticalFov = 1.2f}),
            lookAt({-3, 1, 0}, {0, 1, 1})};
}

float angleBetween(const glm::quat& a, const glm::quat& b) {
    const glm::quat d = glm::conjugate(a) * b; // exact near zero, where acos is not
    return 2.0f * std::atan2(glm::length(glm::vec3(d.x, d.y, d.z)), std::abs(d.w));
}

} // namespace

TEST_CASE("a camera path goes through its keys, one every three seconds, and around") {
    for (std::size_t count = 2; count <= 5; ++count) {
        auto keys = fiveKeys();
        keys.resize(count);
        for (int i = -3; i < 12; ++i) {
            CAPTURE(count);
            CAPTURE(i);
            const Camera& key = keys[std::size_t((i + 10 * int(count)) % int(count))];
            const Camera camera = onPath(keys, i * kSecondsPerKey);
            CHECK(glm::distance(camera.position, key.position) < 1e-5f);
            CHECK(angleBetween(camera.orientation, key.orientation) < 1e-3f);
            CHECK(camera.lens.verticalFov == doctest::Approx(key.lens.verticalFov));
        }
    }
}

TEST_CASE("a camera path makes no jump and no corner, in place and direction") {
    for (std::size_t count = 2; count <= 5; ++count) {
        auto keys = fiveKeys();
        keys.resize(count);
        float leg = 0.0f, turn = 0.0f, zoom = 0.0f;
        for (std::size_t i = 0; i < count; ++i) {
            const Camera &a = keys[i], &b = keys[(i + 1) % count];
            leg = std::max(leg, glm::distance(a.position, b.position));
            turn = std::max(turn, angleBetween(a.orientation, b.orientation));
            zoom = std::max(zoom, std::abs(a.lens.verticalFov - b.lens.verticalFov));
        }
        // Of the way from key to key in a frame. A Catmull-Rom spline is nowhere faster than 2.5 of
        // its longest leg a key, and smoothstep than 1.5; accelerations are below 10 and 6.
        constexpr float kPart = float(kFixedStep / kSecondsPerKey), kRounding = 4e-6f;
        Camera before = onPath(keys, 0.0), first = onPath(keys, -kFixedStep);
        for (int frame = 1; frame < int(count) * 180 + 90; ++frame) {
            CAPTURE(count);
            CAPTURE(frame);
            const Camera now = onPath(keys, frame * kFixedStep);
            const glm::vec3 step = now.position - before.position,
                            stepBefore = before.position - first.position;
            REQUIRE(glm::length(step) <= 2.5f * leg * kPart);
            REQUIRE(glm::distance(step, stepBefore) <= 10.0f * leg * kPart * kPart + kRounding);
            const float angle = angleBetween(before.orientation, now.orientation),
                        angleBefore = angleBetween(first.orientation, before.orientation);
            REQUIRE(angle <= 1.5f * turn * kPart + kRounding);
            REQUIRE(std::abs(angle - angleBefore) <= 6.0f * turn * kPart * kPart + kRounding);
            REQUIRE(std::abs(now.lens.verticalFov - before.lens.verticalFov) <=
                    1.5f * zoom * kPart + kRounding);
            REQUIRE(glm::length(now.orientation) == doctest::Approx(1.0));
            first = before;
            before = now;
        }
    }
}

TEST_CASE("a sway begins at home and keeps looking at its target, at the keys and between") {
    for (const Camera& home : fiveKeys()) {
        constexpr float kDistance = 2.5f;
        const glm::vec3 target = home.position + kDistance * home.forward();
        const auto keys = swayAround(home, kDistance);
        REQUIRE(keys.size() >= 2);
        CHECK(keys.front() == home);
        const auto off = [&](const Camera& camera) {
            const glm::vec3 toward = glm::normalize(target - camera.position);
            return glm::length(glm::cross(toward, camera.forward())); // the sine of the angle
        };
        float widest = 0.0f;
        for (const Camera& key : keys) {
            CHECK(off(key) < 1e-4f);
            CHECK(glm::distance(key.position, target) < 1.1f * kDistance);
            CHECK(key.lens.verticalFov == home.lens.verticalFov);
            widest = std::max(widest, glm::distance(key.position, home.position));
        }
        CHECK(widest > 0.1f * kDistance);
        // Between keys place and direction do not keep the same pace.
        constexpr float kMost = 0.035f; // radians; measured: 0.0337
        for (double seconds = 0.0; seconds < 4 * kSecondsPerKey; seconds += kFixedStep)
            REQUIRE(off(onPath(keys, seconds)) < kMost);
    }
}
