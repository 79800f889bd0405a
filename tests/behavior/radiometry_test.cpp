// SPDX-License-Identifier: MIT
// The light itself against closed forms.

#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace afterglow;
using namespace afterglow::test;

namespace {

using Polygon = std::vector<glm::dvec3>;

/// Irradiance at `point` from a uniform Lambertian polygon of unit radiance that lies above the
/// horizon. Lambert 1760; Arvo 1995, "Applications of Irradiance Tensors", equation for the first
/// moment.
double irradianceOf(const Polygon& polygon, glm::dvec3 point, glm::dvec3 normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(polygon[i] - point);
        const glm::dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()] - point);
        const glm::dvec3 axis = glm::cross(a, b);
        const double sine = glm::length(axis);
        if (sine > 0.0)
            sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(axis / sine, normal);
    }
    return std::abs(sum) / 2.0;
}

/// The part of a polygon on the positive side of a plane (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& polygon, glm::dvec3 planePoint, glm::dvec3 planeNormal) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(a - planePoint, planeNormal),
                     db = glm::dot(b - planePoint, planeNormal);
        if (da >= 0.0)
            result.push_back(a);
        if ((da >= 0.0) != (db >= 0.0))
            result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

/// The corners of the one quadrilateral light of a scene, in order around it.
Polygon lightPolygon(const Scene& scene) {
    REQUIRE(scene.lights.size() == 1);
    REQUIRE(scene.lights[0].instances.size() == 1);
    const Instance& instance = scene.instances[scene.lights[0].instances[0]];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 m(poseAt(scene, 0.0).worldFromNode[instance.node]);
    // Sorted by angle around the middle, in the plane of the first triangle.
    Polygon corners;
    for (const glm::vec3& p : mesh.positions) {
        const glm::dvec3 world(m * glm::dvec4(p, 1.0));
        bool known = false;
        for (const glm::dvec3& other : corners)
            known = known || glm::length(other - world) < 1e-6;
        if (!known)
            corners.push_back(world);
    }
    REQUIRE(corners.size() == 4);
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& c : corners)
        middle += c / 4.0;
    const glm::dvec3 x = glm::normalize(corners[0] - middle);
    const glm::dvec3 n =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const glm::dvec3 y = glm::cross(n, x);
    std::ranges::sort(corners, {}, [&](const glm::dvec3& c) {
        return std::atan2(glm::dot(c - middle, y), glm::dot(c - middle, x));
    });
    return corners;
}

glm::dvec3 emissionOf(const Scene& scene) {
    return scene.materials[scene.instances[scene.lights[0].instances[0]].material].emission;
}

} // namespace

TEST_CASE("irradiance under a rectangular light is that of the closed form") {
    const GlCheck noGlMessages;
    const Scene scene = makeRect();
    const Polygon light = lightPolygon(scene);
    const glm::dvec3 radiance = emissionOf(scene);
    Sequence sequence(scene, {33, 21}, settingsOf(Filter::None, Signal::Shadows));
    const Image<glm::vec4> signal = sequence.reference(4096);
    const Image<glm::uvec4> surface = sequence.targets().surfaces.surface.read<glm::uvec4>();
    const Image<glm::vec4> guides = sequence.targets().surfaces.guides.read<glm::vec4>();
    int compared = 0;
    double largest = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < signal.pixels().size(); ++i) {
        if (guides.pixels()[i].w == 0.0f || guides.pixels()[i].y < 0.99f)
            continue; // the floor alone
        const glm::dvec3 point(glm::uintBitsToFloat(glm::uvec3(surface.pixels()[i])));
        const double expected = irradianceOf(light, point, {0.0, 1.0, 0.0}) * radiance.g;
        if (expected < 1e-4 * radiance.g)
            continue;
        const double error = double(signal.pixels()[i].g) * M_PI / expected - 1.0;
        largest = std::max(largest, std::abs(error));
        sum += error;
        ++compared;
    }
    MESSAGE(compared, " points, largest relative error ", largest, ", mean ", sum / compared);
    CHECK(compared > 300);
    CHECK(largest < 0.01);                  // noise of 4096 samples
    CHECK(std::abs(sum / compared) < 5e-4); // no bias
}

TEST_CASE("the penumbra behind a straight edge is the analytic ramp") {
    const GlCheck noGlMessages;
    const Scene scene = makeEdge();
    const Polygon light = lightPolygon(scene);
    const glm::dvec3 radiance = emissionOf(scene);
    // The occluder covers x > 0 at y = 1; see makeEdge().
    const glm::dvec3 edgePoint(0.0, 1.0, 0.0), edgeDirection(0.0, 0.0, 1.0),
        openSide(-1.0, 0.0, 0.0);
    Sequence sequence(scene, {64, 40}, settingsOf(Filter::None, Signal::Shadows));
    const Image<glm::vec4> signal = sequence.reference(4096);
    const Image<glm::uvec4> surface = sequence.targets().surfaces.surface.read<glm::uvec4>();
    const Image<glm::vec4> guides = sequence.targets().surfaces.guides.read<glm::vec4>();
    int penumbra = 0, umbra = 0, open = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < signal.pixels().size(); ++i) {
        const glm::dvec3 point(glm::uintBitsToFloat(glm::uvec3(surface.pixels()[i])));
        if (guides.pixels()[i].w == 0.0f || std::abs(point.y) > 1e-4)
            continue;
        // The plane through the point and the edge parts the visible light from the hidden.
        glm::dvec3 normal = glm::normalize(glm::cross(edgeDirection, edgePoint - point));
        if (glm::dot(normal, openSide) < 0.0)
            normal = -normal;
        const Polygon visible = clip(light, point, normal);
        const double all = irradianceOf(light, point, {0.0, 1.0, 0.0});
        const double expected =
            visible.size() < 3 ? 0.0 : irradianceOf(visible, point, {0.0, 1.0, 0.0});
        const double fraction = expected / all;
        (fraction == 0.0 ? umbra : fraction > 0.999 ? open : penumbra) += 1;
        const double measured = double(signal.pixels()[i].g) * M_PI / radiance.g / all;
        largest = std::max(largest, std::abs(measured - fraction));
    }
    MESSAGE(umbra, " points in the umbra, ", penumbra, " in the penumbra, ", open,
            " in the open; largest error ", largest, " of the open irradiance");
    CHECK(umbra > 100);
    CHECK(penumbra > 100);
    CHECK(open > 100);
    CHECK(largest <
          0.01); // 4096 samples: a standard deviation of at most 0.5 / 64, less by stratification
}
