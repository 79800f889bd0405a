// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "tests/reference/scene_view.h"

// The surface behind a visibility sample: docs/pipeline.md, "Surface".

namespace afterglow::reference {

inline glm::dvec2 barycentrics(const glm::uvec4& visibility) {
    return {std::bit_cast<float>(std::uint32_t(visibility.z)),
            std::bit_cast<float>(std::uint32_t(visibility.w))};
}

/// The place on a scene's triangle that a visibility sample names. Not for background.
inline glm::dvec3 pointOf(const SceneView& scene, const glm::uvec4& visibility) {
    return scene.at(visibility.x - 1, visibility.y).at(barycentrics(visibility));
}

/// Octahedral, two 16-bit signed parts of one, x in the lower half. Cigolle et al. 2014.
inline glm::dvec3 decodeNormal(std::uint32_t bits) {
    const auto part = [](std::uint32_t half) {
        return std::max(-1.0, double(std::int16_t(half)) / 32767.0);
    };
    const glm::dvec2 e(part(bits & 0xffffu), part(bits >> 16));
    glm::dvec3 v(e, 1.0 - std::abs(e.x) - std::abs(e.y));
    if (v.z < 0.0) {
        v.x = (1.0 - std::abs(e.y)) * (e.x < 0.0 ? -1.0 : 1.0);
        v.y = (1.0 - std::abs(e.x)) * (e.y < 0.0 ? -1.0 : 1.0);
    }
    return glm::normalize(v);
}

struct SurfaceSample {
    glm::dvec3 position{0.0};
    glm::dvec3 geometricNormal{0.0}, shadingNormal{0.0};
    double depth = 0.0;
    glm::dvec2 slope{0.0};
    glm::dvec4 motion{0.0};
    glm::dvec3 albedo{0.0}, emission{0.0};
    /// Cosine between the plane and the view ray: slopes and motion are as exact as this allows.
    double facing = 1.0;
    /// How near the shading normal is to a right angle with the geometric one, where it turns over.
    double sideMargin = 1.0;
};

struct SurfaceInputs {
    const Scene& scene;
    const SceneView& now;
    const SceneView& before;
    const View& view;
    const View& previousView;
    const std::vector<glm::dvec3>& lightScales; ///< by slot
};

inline SurfaceSample surfaceOf(const SurfaceInputs& in, const glm::uvec4& visibility) {
    SurfaceSample out;
    if (visibility.x == 0)
        return out;
    const std::uint32_t index = visibility.x - 1;
    const Triangle& triangle = in.now.at(index, visibility.y);
    const glm::dvec2 b = barycentrics(visibility);
    out.position = triangle.at(b);

    const glm::dvec3 toEye = glm::normalize(in.view.eye - out.position);
    out.facing = std::abs(glm::dot(triangle.front, toEye));
    out.geometricNormal = glm::dot(triangle.front, toEye) < 0.0 ? -triangle.front : triangle.front;
    const Instance& instance = in.scene.instances[index];
    const Mesh& mesh = in.scene.meshes[instance.mesh];
    const glm::uvec3 vertices = mesh.triangles[visibility.y];
    const glm::dvec3 own = (1.0 - b.x - b.y) * glm::dvec3(mesh.normals[vertices.x]) +
                           b.x * glm::dvec3(mesh.normals[vertices.y]) +
                           b.y * glm::dvec3(mesh.normals[vertices.z]);
    out.shadingNormal = glm::normalize(in.now.normalMatrices[index] * own);
    const double side = glm::dot(out.shadingNormal, out.geometricNormal);
    out.sideMargin = std::abs(side);
    if (side < 0.0)
        out.shadingNormal = -out.shadingNormal;

    // On the plane n . X = k the view ray of place p meets depth k' / (n . ray(p)): 1/z is linear.
    out.depth = in.view.depth(out.position);
    const glm::dvec2 place = in.view.pixel(out.position);
    const double along = glm::dot(triangle.front, in.view.ray(place));
    const auto change = [&](const glm::dvec2& step) {
        const double rate =
            glm::dot(triangle.front, in.view.ray(place + step) - in.view.ray(place)) / along;
        return std::clamp(-out.depth * rate, -out.depth, out.depth);
    };
    out.slope = {change({1.0, 0.0}), change({0.0, 1.0})};

    const glm::dvec3 past = pointOf(in.before, visibility);
    out.motion.z = in.previousView.depth(past);
    if (out.motion.z > 0.0)
        out.motion = {in.previousView.pixel(past) - place, out.motion.z, 1.0};

    const Material& material = in.scene.materials[instance.material];
    out.albedo = glm::dvec3(material.baseColor);
    out.emission = glm::dvec3(material.emission);
    for (std::size_t slot = 0; slot < in.scene.lights.size(); ++slot)
        for (const std::uint32_t lit : in.scene.lights[slot].instances)
            if (lit == index)
                out.emission *= in.lightScales[slot];
    return out;
}

} // namespace afterglow::reference
