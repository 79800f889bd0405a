// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

#include "tests/reference/random.h"
#include "tests/reference/scene_view.h"

// One noisy sample of the demodulated signal: docs/pipeline.md, "Lighting". Schied et al. 2018,
// section 5; the basis is that of Duff et al. 2017, "Building an Orthonormal Basis, Revisited".

namespace afterglow::reference {

/// An emissive triangle as it stands now, and its share of the power that all have at time 0.
struct Emitter {
    Triangle triangle;
    glm::dvec3 radiance{0.0}; ///< times what the user made of the light
    double probability = 0.0, cumulative = 0.0;
};

/// The corners counter-clockwise seen from the front: in a mirrored instance the second and the
/// third change places. Which of them is which decides the point that two random numbers name.
inline Triangle facingFront(Triangle triangle) {
    if (glm::dot(glm::cross(triangle.edge1(), triangle.edge2()), triangle.front) < 0.0)
        std::swap(triangle.corners[1], triangle.corners[2]);
    return triangle;
}

/// In the order of slots, of the instances of a slot, of the triangles of an instance.
inline std::vector<Emitter> emittersOf(const Scene& scene, const SceneView& rest,
                                       const SceneView& now,
                                       const std::vector<glm::dvec3>& lightScales) {
    std::vector<Emitter> emitters;
    double total = 0.0;
    for (std::size_t slot = 0; slot < scene.lights.size(); ++slot)
        for (const std::uint32_t index : scene.lights[slot].instances) {
            const Instance& instance = scene.instances[index];
            const Material& material = scene.materials[instance.material];
            const glm::dvec3 emission(material.emission);
            const double sides = material.doubleSided ? 2.0 : 1.0;
            for (std::uint32_t t = 0; t < scene.meshes[instance.mesh].triangles.size(); ++t) {
                const double luminance =
                    0.2126 * emission.r + 0.7152 * emission.g + 0.0722 * emission.b;
                const double power = sides * luminance * rest.at(index, t).area();
                emitters.push_back(
                    {facingFront(now.at(index, t)), emission * lightScales[slot], power, 0.0});
                total += power;
            }
        }
    double sum = 0.0;
    for (Emitter& emitter : emitters) {
        emitter.probability /= total;
        sum += emitter.probability;
        emitter.cumulative = sum;
    }
    return emitters;
}

struct LightingInputs {
    const SceneView& scene;
    const std::vector<Emitter>& emitters;
    const Random& random;
    double extent;   ///< of the scene at time 0, meters
    double aoRadius; ///< in extents
    double signalClamp;
    glm::dvec3 ambient;
    bool shadows, ambientOcclusion;
    bool withDoubts = false; ///< also find out what is doubtful, which takes much longer
};

struct LightSample {
    glm::dvec3 value{0.0};
    bool doubtful = false;   ///< so near a decision that 32 bits may decide otherwise; if asked for
    std::size_t emitter = 0; ///< the one that was picked
    bool shadowed = false, occluded = false;
};

/// The least distance between two pieces of straight line, each from p along d.
inline double distanceOfSegments(const glm::dvec3& p, const glm::dvec3& d, const glm::dvec3& q,
                                 const glm::dvec3& e) {
    const double a = glm::dot(d, d), b = glm::dot(d, e), c = glm::dot(e, e);
    const glm::dvec3 r = p - q;
    const auto toPoint = [](const glm::dvec3& point, const glm::dvec3& from,
                            const glm::dvec3& along) {
        const double square = glm::dot(along, along);
        const double t =
            square > 0.0 ? std::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) : 0.0;
        return glm::length(point - from - t * along);
    };
    double least = std::min(std::min(toPoint(p, q, e), toPoint(p + d, q, e)),
                            std::min(toPoint(q, p, d), toPoint(q + e, p, d)));
    const double denominator = a * c - b * b;
    if (denominator > 1e-12 * a * c) {
        const double s = (b * glm::dot(e, r) - c * glm::dot(d, r)) / denominator;
        const double t = (a * glm::dot(e, r) - b * glm::dot(d, r)) / denominator;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
            least = std::min(least, glm::length(r + s * d - t * e));
    }
    return least;
}

/// Whether anything lies on the way from o along `way`; every triangle in turn, either side.
inline bool blocked(const SceneView& scene, const glm::dvec3& o, const glm::dvec3& way) {
    for (const Triangle& triangle : scene.triangles) {
        const auto hit = meetPlane(triangle, o, way);
        if (hit && hit->t > 0.0 && hit->t < 1.0 && hit->inside() >= 0.0)
            return true;
    }
    return false;
}

/// Whether a small shift of the way may change the answer: it passes an edge within `margin`, or
/// ends within a hundredth of that of a surface.
inline bool nearlyBlocked(const SceneView& scene, const glm::dvec3& o, const glm::dvec3& way,
                          double margin) {
    const double length = glm::length(way);
    for (const Triangle& triangle : scene.triangles) {
        for (int k = 0; k < 3; ++k)
            if (distanceOfSegments(o, way, triangle.corners[k],
                                   triangle.corners[(k + 1) % 3] - triangle.corners[k]) < margin)
                return true;
        const auto hit = meetPlane(triangle, o, way);
        if (hit && hit->inside() >= 0.0 &&
            std::min(std::abs(hit->t), std::abs(hit->t - 1.0)) * length < 0.01 * margin)
            return true;
    }
    return false;
}

/// The surface that is lit, as the images have it; unit normals.
struct LitSurface {
    glm::dvec3 position, geometric, shading;
    glm::dmat3 worldFromObject; ///< linear part of its instance's transform
};

/// Where the basis of Duff et al. changes its sign, by the z of the normal.
constexpr double kBasisTurns = -0.7;

/// A direction along the surface that turns with the instance. `isDoubtful`: rounding decides on
/// which side of kBasisTurns it is.
inline glm::dvec3 tangentOf(const LitSurface& surface, bool& isDoubtful) {
    const glm::dmat3& m = surface.worldFromObject;
    const glm::dvec3 n = glm::normalize(glm::transpose(m) * surface.shading);
    isDoubtful = n.z != kBasisTurns && std::abs(n.z - kBasisTurns) < 1e-5;
    const double sign = n.z < kBasisTurns ? -1.0 : 1.0;
    const double p = -1.0 / (sign + n.z);
    const glm::dvec3 own(1.0 + sign * n.x * n.x * p, sign * n.x * n.y * p, -sign * n.x);
    const glm::dvec3 world = m * own;
    return glm::normalize(world - glm::dot(world, surface.shading) * surface.shading);
}

inline void addShadows(const LightingInputs& in, const LitSurface& surface, const glm::dvec3& o,
                       const Seed& seed, LightSample& out) {
    const double u0 = in.random.number(seed, 0), u1 = in.random.number(seed, 1),
                 u2 = in.random.number(seed, 2);
    while (out.emitter + 1 < in.emitters.size() && !(in.emitters[out.emitter].cumulative > u0))
        ++out.emitter;
    for (const Emitter& other : in.emitters)
        out.doubtful = out.doubtful || std::abs(other.cumulative - u0) < 1e-5;
    for (const std::uint32_t d : {0u, 1u, 2u})
        out.doubtful = out.doubtful || in.random.distanceToWrap(seed, d) < 1e-6;

    const Emitter& emitter = in.emitters[out.emitter];
    const Triangle& lamp = emitter.triangle;
    const double root = std::sqrt(u1);
    const glm::dvec3 target =
        lamp.corners[0] + root * (1.0 - u2) * lamp.edge1() + root * u2 * lamp.edge2();
    const glm::dvec3 d = target - o;
    const glm::dvec3 w = glm::normalize(d);
    const double above = glm::dot(surface.geometric, w);
    const double facing = -glm::dot(w, lamp.front);
    const double lampCosine = lamp.doubleSided ? std::abs(facing) : std::max(0.0, facing);
    out.doubtful = out.doubtful || std::abs(above) < 1e-5;
    if (!(above > 0.0))
        return;
    const glm::dvec3 value =
        emitter.radiance * (std::max(0.0, glm::dot(surface.shading, w)) * lampCosine * lamp.area() /
                            (std::numbers::pi * glm::dot(d, d) * emitter.probability));
    if (value == glm::dvec3(0.0))
        return;
    out.shadowed = blocked(in.scene, o, 0.9995 * d);
    out.doubtful =
        out.doubtful || (in.withDoubts && nearlyBlocked(in.scene, o, 0.9995 * d, 1e-4 * in.extent));
    if (!out.shadowed)
        out.value += value;
}

inline void addAmbient(const LightingInputs& in, const LitSurface& surface, const glm::dvec3& o,
                       const Seed& seed, LightSample& out) {
    const double u3 = in.random.number(seed, 3), u4 = in.random.number(seed, 4);
    out.doubtful = out.doubtful || in.random.distanceToWrap(seed, 3) < 1e-6;
    const double r = std::sqrt(u3), angle = 2.0 * std::numbers::pi * u4;
    bool signIsDoubtful = false;
    const glm::dvec3 t = tangentOf(surface, signIsDoubtful);
    out.doubtful = out.doubtful || signIsDoubtful;
    const glm::dvec3 w = r * std::cos(angle) * t +
                         r * std::sin(angle) * glm::cross(surface.shading, t) +
                         std::sqrt(std::max(0.0, 1.0 - r * r)) * surface.shading;
    const double above = glm::dot(surface.geometric, w);
    out.doubtful = out.doubtful || std::abs(above) < 1e-4;
    if (!(above > 0.0)) {
        out.occluded = true;
        return;
    }
    const glm::dvec3 way = in.aoRadius * in.extent * w;
    out.occluded = blocked(in.scene, o, way);
    out.doubtful =
        out.doubtful || (in.withDoubts && nearlyBlocked(in.scene, o, way, 1e-4 * in.extent));
    if (!out.occluded)
        out.value += in.ambient;
}

/// The signal at a surface.
inline LightSample lightAt(const LightingInputs& in, const LitSurface& surface, const Seed& seed) {
    LightSample out;
    const glm::dvec3 o = surface.position + 2e-5 * in.extent * surface.geometric;
    if (in.shadows)
        addShadows(in, surface, o, seed, out);
    if (in.ambientOcclusion)
        addAmbient(in, surface, o, seed, out);
    out.value = glm::clamp(out.value, glm::dvec3(0.0), glm::dvec3(in.signalClamp));
    return out;
}

} // namespace afterglow::reference
