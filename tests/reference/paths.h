// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tests/reference/path_rays.h"

// One path of two segments and the signals that it gives: docs/pipeline.md, "Paths". Veach 1997,
// chapter 9; Kaplanyan and Dachsbacher 2013, "Path Space Regularization".

namespace afterglow::reference {

struct PathInputs {
    const Scene& source; ///< materials and normals
    const SceneView& scene;
    const std::vector<Emitter>& emitters;
    double extent; ///< of the scene at time 0, meters
    glm::dvec3 ambient;
    double regularization = 0.0; ///< kappa of this sample
    bool withDoubts = false;     ///< also find out what is doubtful, which takes much longer
};

/// kappa of sample k = 0, 1, ... of a reference.
inline double regularizationOf(double kappa, std::uint32_t k) {
    return kappa * std::pow(double(k) + 1.0, -1.0 / 6.0);
}

/// Returns the eye of a sample; one whose seed is of another frame is a gradient sample.
inline glm::dvec3 eyeOf(const Seed& seed, std::uint32_t frame, const glm::dvec3& eye,
                        const glm::dvec3& previousEye) {
    return seed.frame == frame % (1u << 18) ? eye : previousEye;
}

/// Numbers 0 to 8 of a seed.
struct PathNumbers {
    std::array<double, 9> u{};
    bool doubtful = false; ///< one is so near the jump from 1 to 0 that rounding decides

    PathNumbers() = default;
    PathNumbers(const Random& random, const Seed& seed) {
        for (std::uint32_t d = 0; d < 9; ++d) {
            u[d] = random.number(seed, d);
            doubtful = doubtful || (d != 4 && random.distanceToWrap(seed, d) < 1e-6);
        }
    }
};

/// The light of a path, before any division.
struct PathParts {
    Lobes albedo;   ///< D and E of x1
    Lobes direct;   ///< N: light samples of x1, weighted against the direction
    Lobes bounced;  ///< R without S: an x2 that emits, weighted against light samples; surroundings
    Lobes indirect; ///< W S
};

struct PathSample {
    PathParts parts;
    /// The change of the parts under shifts as small as 32-bit rounding; if asked for.
    PathParts spread;
    bool doubtful = false; ///< so near a decision that 32 bits may decide otherwise; if asked for

    Lobes directAlone;       ///< N as if there were no other way to find a light
    Lobes bouncedAlone;      ///< likewise of x2
    Lobes weight;            ///< W
    Lobes sentBack;          ///< S, by the lobe of x2
    glm::dvec3 l{0.0};       ///< the direction
    std::size_t emitter = 0; ///< the one that was picked for x1
    bool specular = false;   ///< the lobe that gave the direction
    bool shadowed = false, left = false, escaped = false, hitLight = false;
    glm::dvec3 x2{0.0};
};

/// With respect to solid angle, of the light samples of one triangle. c: the cosine at the light.
inline double lightDensity(const Emitter& emitter, double distanceSquare, double c) {
    return c > 0.0 ? emitter.probability * distanceSquare / (emitter.triangle.area() * c) : 0.0;
}

struct LightArrival {
    Lobes value; ///< scattered, over the density of the sample alone
    double density = 0.0;
    glm::dvec3 w{0.0};
    std::size_t emitter = 0;
    bool shadowed = false;
};

/// Light of one sample that a surface scatters. `first`: which number picks the light.
inline LightArrival lightSample(const PathInputs& in, const LitSurface& lit, const Bsdf& bsdf,
                                const PathNumbers& numbers, int first, bool& doubtful) {
    LightArrival out;
    if (in.emitters.empty())
        return out;
    const double u0 = numbers.u[first], u1 = numbers.u[first + 1], u2 = numbers.u[first + 2];
    while (out.emitter + 1 < in.emitters.size() && !(in.emitters[out.emitter].cumulative > u0))
        ++out.emitter;
    for (const Emitter& other : in.emitters)
        doubtful = doubtful || std::abs(other.cumulative - u0) < 1e-5;

    const Emitter& emitter = in.emitters[out.emitter];
    const Triangle& lamp = emitter.triangle;
    const double root = std::sqrt(u1);
    const glm::dvec3 o = lit.position + 2e-5 * in.extent * lit.geometric;
    const glm::dvec3 way =
        lamp.corners[0] + root * (1.0 - u2) * lamp.edge1() + root * u2 * lamp.edge2() - o;
    out.w = glm::normalize(way);
    const double facing = -glm::dot(out.w, lamp.front);
    out.density = lightDensity(emitter, glm::dot(way, way),
                               lamp.doubleSided ? std::abs(facing) : std::max(0.0, facing));
    doubtful = doubtful || std::abs(glm::dot(lit.geometric, out.w)) < 1e-5;
    if (!(out.density > 0.0))
        return out;
    const Lobes value =
        bsdf.at(out.w) * (emitter.radiance * (glm::dot(lit.shading, out.w) / out.density));
    if (value.sum() == glm::dvec3(0.0))
        return out;
    out.shadowed = blocked(in.scene, o, 0.9995 * way);
    doubtful =
        doubtful || (in.withDoubts && nearlyBlocked(in.scene, o, 0.9995 * way, 1e-4 * in.extent));
    if (!out.shadowed)
        out.value = value;
    return out;
}

/// The radiance of a triangle against a ray along l, and the density of light samples there.
struct Emission {
    glm::dvec3 radiance{0.0};
    double density = 0.0;
};
inline Emission emissionAt(const PathInputs& in, const RayHit& closest, const glm::dvec3& l) {
    const Triangle& triangle = *closest.triangle;
    const double facing = -glm::dot(triangle.front, l);
    const double c = triangle.doubleSided ? std::abs(facing) : facing;
    if (!(c > 0.0))
        return {};
    for (const Emitter& emitter : in.emitters)
        if (emitter.triangle.instance == triangle.instance &&
            emitter.triangle.triangle == triangle.triangle)
            return {emitter.radiance, lightDensity(emitter, closest.hit.t * closest.hit.t, c)};
    const Instance& instance = in.source.instances[triangle.instance];
    return {glm::dvec3(in.source.materials[instance.material].emission), 0.0};
}

/// The part of the path behind x1, along `out.l` from o.
inline void followDirection(const PathInputs& in, const PathNumbers& numbers, const glm::dvec3& o,
                            double density, PathSample& out) {
    const RayHit closest = closestHit(in.scene, o, out.l);
    out.doubtful = out.doubtful || (in.withDoubts && nearlyAnotherHit(in.scene, o, out.l, closest,
                                                                      1e-4 * in.extent));
    if (!closest.triangle) {
        out.escaped = true;
        out.parts.bounced = out.bouncedAlone = out.weight * in.ambient;
        return;
    }
    const Emission emission = emissionAt(in, closest, out.l);
    out.hitLight = emission.radiance != glm::dvec3(0.0);
    out.bouncedAlone = out.weight * emission.radiance;
    out.parts.bounced = out.bouncedAlone * (density / (density + emission.density));

    const PathSurface x2 = surfaceOn(in.source, in.scene, *closest.triangle, closest.hit.b, o);
    out.x2 = x2.lit.position;
    out.doubtful = out.doubtful || std::abs(glm::dot(x2.lit.shading, x2.lit.geometric)) < 1e-5;
    const Bsdf bsdf(x2.material, x2.lit.shading, x2.lit.geometric, -out.l, in.regularization);
    out.sentBack = lightSample(in, x2.lit, bsdf, numbers, 6, out.doubtful).value;
    out.parts.indirect = out.weight * out.sentBack.sum();
}

/// The path that nine numbers give.
inline PathSample pathOf(const PathInputs& in, const PathSurface& x1, const PathNumbers& numbers) {
    PathSample out;
    out.doubtful = numbers.doubtful;
    const LitSurface& lit = x1.lit;
    const Bsdf bsdf(x1.material, lit.shading, lit.geometric, glm::normalize(x1.eye - lit.position));
    out.parts.albedo = bsdf.albedo();

    const LightArrival light = lightSample(in, lit, bsdf, numbers, 0, out.doubtful);
    out.emitter = light.emitter;
    out.shadowed = light.shadowed;
    out.directAlone = light.value;
    if (light.density > 0.0)
        out.parts.direct = light.value * (light.density / (light.density + bsdf.density(light.w)));

    bool signIsDoubtful = false;
    const glm::dvec3 t = tangentOf(lit, signIsDoubtful);
    out.specular = numbers.u[5] < bsdf.specularShare();
    out.l = bsdf.direction(t, numbers.u[3], numbers.u[4], numbers.u[5]);
    const double along = glm::dot(lit.shading, out.l), above = glm::dot(lit.geometric, out.l);
    // Seen along the normal the frame of visible normals has no direction of its own.
    out.doubtful = out.doubtful || signIsDoubtful ||
                   std::abs(numbers.u[5] - bsdf.specularShare()) < 1e-5 || std::abs(along) < 1e-4 ||
                   std::abs(above) < 1e-4 || (out.specular && 1.0 - bsdf.cosine() < 1e-10);
    if (!bsdf.scatters(out.l)) {
        out.left = true;
        return out;
    }
    const double density = bsdf.density(out.l);
    out.weight = bsdf.at(out.l) * (along / density);
    followDirection(in, numbers, lit.position + 2e-5 * in.extent * lit.geometric, density, out);
    return out;
}

inline void raiseTo(Lobes& most, const Lobes& a, const Lobes& b) {
    most.diffuse = glm::max(most.diffuse, glm::abs(a.diffuse - b.diffuse));
    most.specular = glm::max(most.specular, glm::abs(a.specular - b.specular));
}

/// Returns the change of the parts under shifts of the inputs by a few 32-bit roundings: numbers by
/// 3e-7 (sums of three below 1), directions by 1.2e-7, places by that times extent.
inline PathParts spreadOf(const PathInputs& in, const PathSurface& x1, const PathNumbers& numbers,
                          const PathParts& parts) {
    PathInputs plain = in;
    plain.withDoubts = false;
    PathParts spread;
    spread.albedo = parts.albedo;
    for (std::uint32_t k = 0; k < 8; ++k) {
        std::uint32_t next = 0;
        const auto shift = [&] { return mixBits(k * 64 + next++) & 0x8000u ? 1.0 : -1.0; };
        const auto shifts = [&] { return glm::dvec3(shift(), shift(), shift()); };
        PathNumbers moved = numbers;
        for (double& u : moved.u)
            u = std::clamp(u + 3e-7 * shift(), 0.0, 1.0 - 1.0 / 16777216.0);
        PathSurface surface = x1;
        surface.lit.position += 1.2e-7 * in.extent * shifts();
        surface.eye += 1.2e-7 * in.extent * shifts();
        surface.lit.shading = glm::normalize(surface.lit.shading + 1.2e-7 * shifts());
        const PathParts other = pathOf(plain, surface, moved).parts;
        raiseTo(spread.direct, other.direct, parts.direct);
        raiseTo(spread.bounced, other.bounced, parts.bounced);
        raiseTo(spread.indirect, other.indirect, parts.indirect);
    }
    return spread;
}

/// The path of a visibility sample.
inline PathSample tracePath(const PathInputs& in, const PathSurface& x1,
                            const PathNumbers& numbers) {
    PathSample out = pathOf(in, x1, numbers);
    if (in.withDoubts)
        out.spread = spreadOf(in, x1, numbers, out.parts);
    return out;
}

enum class Division { Path, Split, Bounce };

struct DividedSignal {
    glm::dvec3 value, divisor;
};

/// The signals of a division, in the order of the text. Of a spread: their tolerances.
inline std::vector<DividedSignal> signalsOf(Division division, const PathParts& parts,
                                            double signalClamp) {
    const auto divided = [&](const glm::dvec3& sum, const glm::dvec3& albedo) {
        const glm::dvec3 divisor = glm::max(albedo, glm::dvec3(1e-3));
        glm::dvec3 value = sum / divisor;
        for (int k = 0; k < 3; ++k)
            value[k] = std::isfinite(value[k]) ? std::clamp(value[k], 0.0, signalClamp) : 0.0;
        return DividedSignal{value, divisor};
    };
    const Lobes all = parts.direct + parts.bounced + parts.indirect;
    const glm::dvec3 whole = parts.albedo.sum();
    switch (division) {
    case Division::Path: return {divided(all.sum(), whole)};
    case Division::Split:
        return {divided(all.diffuse, parts.albedo.diffuse),
                divided(all.specular, parts.albedo.specular)};
    case Division::Bounce:
        return {divided((parts.direct + parts.bounced).sum(), whole),
                divided(parts.indirect.sum(), whole)};
    }
    return {};
}

} // namespace afterglow::reference
