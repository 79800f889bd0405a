// SPDX-License-Identifier: MIT
#include <map>

#include <doctest/doctest.h>

#include "tests/oracle/path_scenes.h"

using namespace afterglow;
using namespace afterglow::reference;
using namespace afterglow::test;

// The paths of docs/pipeline.md, as the reference traces them, against closed forms.

namespace {

/// The inside of a sphere of radius 1, an icosahedron whose faces were split `splits` times; what
/// is within `lampAngle` of +Y shines with radiance 1. Smooth normals.
Scene insideOfSphere(int splits, double lampAngle, const Material& wall) {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    std::vector<glm::dvec3> points;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-golden, golden})
            for (const glm::dvec3& p :
                 {glm::dvec3(a, b, 0.0), glm::dvec3(0.0, a, b), glm::dvec3(b, 0.0, a)})
                points.push_back(glm::normalize(p));
    std::vector<glm::uvec3> faces;
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k)
                if (std::min({glm::dot(points[i], points[j]), glm::dot(points[j], points[k]),
                              glm::dot(points[k], points[i])}) > 0.4)
                    faces.push_back({i, j, k});
    for (int s = 0; s < splits; ++s) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, isNew] =
                middles.try_emplace(std::minmax(a, b), std::uint32_t(points.size()));
            if (isNew)
                points.push_back(glm::normalize(points[a] + points[b]));
            return entry->second;
        };
        std::vector<glm::uvec3> next;
        for (const glm::uvec3& f : faces) {
            const std::uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
            next.insert(next.end(), {{f.x, a, c}, {a, f.y, b}, {c, b, f.z}, {a, b, c}});
        }
        faces = next;
    }
    Mesh meshes[2];
    for (Mesh& mesh : meshes)
        for (const glm::dvec3& p : points) {
            mesh.positions.push_back(glm::vec3(p));
            mesh.normals.push_back(glm::vec3(-p));
        }
    for (glm::uvec3 f : faces) {
        const glm::dvec3 center = points[f.x] + points[f.y] + points[f.z];
        if (glm::dot(glm::cross(points[f.y] - points[f.x], points[f.z] - points[f.x]), center) >
            0.0)
            std::swap(f.y, f.z);
        meshes[glm::normalize(center).y > std::cos(lampAngle)].triangles.push_back(f);
    }
    SceneBuilder scene("sphere");
    scene.add(meshes[0], scene.material("wall", glm::vec3(0.0f)), scene.node("wall"));
    scene.light("key", meshes[1], glm::vec3(1.0f));
    Scene out = std::move(scene).finish();
    for (Material& material : out.materials) {
        material.baseColor = wall.baseColor;
        material.metallic = wall.metallic;
        material.roughness = wall.roughness;
    }
    return out;
}

Bsdf bsdfOf(const PathSurface& surface) {
    return {surface.material, surface.lit.shading, surface.lit.geometric,
            glm::normalize(surface.eye - surface.lit.position)};
}

/// Integrates the lamp of `underLamp` at a surface of the floor, by lobe, on a grid over the lamp.
Lobes lampByQuadrature(const PathScene& scene, const PathSurface& surface, double radiance) {
    constexpr int n = 600;
    const Bsdf bsdf = bsdfOf(surface);
    const glm::dvec3 o = surface.lit.position + 2e-5 * scene.extent * surface.lit.geometric;
    Lobes sum;
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec3 way =
            glm::dvec3(2.0 * (i / n + 0.5) / n - 1.0, 1.0, 2.0 * (i % n + 0.5) / n - 1.0) - o;
        const glm::dvec3 w = glm::normalize(way);
        sum = sum + bsdf.at(w) * (radiance * w.y * w.y / glm::dot(way, way) * 4.0 / (n * n));
    }
    return sum;
}

/// The mean of a function of the cosine over a diffuse hemisphere.
template <class Function>
double diffuseMean(const Function& function) {
    double sum = 0.0;
    for (int i = 0; i < 2000; ++i)
        sum += function(std::sqrt((i + 0.5) / 2000)) / 2000;
    return sum;
}

bool sameBits(const glm::dvec3& a, const glm::dvec3& b) {
    return a == b;
}

} // namespace

TEST_CASE("inside a sphere every place gets the same light, and the same of it once more") {
    // Every patch sees every other with the form factor dA / (4 pi R^2). So the lamp gives
    // E = L A / 4 everywhere; and what each patch sends on of that comes to all alike: of the
    // diffuse lobe rho (1 - Ebar), of the specular one Ebar, its mean over cosines.
    constexpr int kSplits = 3;
    double sagitta = 0.0;
    for (const auto& [base, roughness] : {std::pair(0.5, 1.0), {0.9, 1.0}, {1.0, 0.6}}) {
        CAPTURE(base);
        CAPTURE(roughness);
        Material wall;
        wall.baseColor = glm::vec3(float(base));
        wall.roughness = float(roughness);
        const PathScene sphere(insideOfSphere(kSplits, 0.35, wall));
        double lampArea = 0.0, whole = 0.0;
        for (const Triangle& triangle : sphere.view.triangles) {
            sagitta =
                std::max(sagitta, 1.0 - std::abs(glm::dot(triangle.front, triangle.corners[0])));
            whole += triangle.area();
            lampArea += triangle.instance == 1 ? triangle.area() : 0.0;
        }
        const MaterialFactors material = factorsOf(wall);
        const double irradiance = 0.25 * lampArea;
        const double specular = diffuseMean([&](double c) {
            return albedoTable().at(material.roughness, c).of(material.normalReflectance()).x;
        });
        const double expected = irradiance * (material.diffuseReflectance().x * (1.0 - specular));
        const double both = expected + irradiance * specular;

        const PathInputs in = sphere.inputs(glm::dvec3(100.0)); // there is no way out
        const glm::dvec3 eye(0.2, -0.3, 0.25);
        int escaped = 0;
        const auto [direct, once, all] = meansOf<3>(96, 32, [&](const PathNumbers& numbers, int b) {
            const std::size_t walls = sphere.view.firstOfInstance[1];
            const Triangle& triangle = sphere.view.triangles[mixBits(b + 5u) % walls];
            const PathSurface x1 =
                surfaceOn(sphere.scene, sphere.view, triangle, glm::dvec2(0.3, 0.4), eye);
            const PathSample path = tracePath(in, x1, numbers);
            escaped += path.escaped;
            const double toIrradiance = std::numbers::pi / path.parts.albedo.diffuse.x;
            return std::array{(path.parts.direct + path.parts.bounced).diffuse.x * toIrradiance,
                              path.weight.diffuse.x * path.sentBack.diffuse.x * toIrradiance,
                              path.parts.indirect.diffuse.x * toIrradiance};
        });
        MESSAGE("lamp ", lampArea, ", E ", direct.mean / irradiance, " +- ",
                direct.error / irradiance, ", diffuse bounce ", once.mean / expected, " +- ",
                once.error / expected, ", whole bounce ", all.mean / both, " +- ", all.error / both,
                ", area ", whole / (4.0 * std::numbers::pi));
        // A mesh of sagitta 0.4 % has 0.6 % less area and shades grazing light at its edges.
        CHECK(escaped == 0);
        CHECK(direct.agrees(irradiance, 0.015 * irradiance));
        CHECK(once.agrees(expected, 0.015 * expected));
        CHECK(all.agrees(both, 0.015 * both));
        CHECK(direct.error < 0.01 * irradiance);
        CHECK(once.error < 0.02 * expected);
        CHECK(all.error < 0.02 * both);
    }
    MESSAGE("sagitta ", sagitta);
    CHECK(sagitta < 0.008);
}

TEST_CASE("light samples alone, directions alone and both weighted have one mean") {
    constexpr double kRadiance = 3.0;
    const PathScene scene(underLamp(kRadiance));
    for (const auto& [metallic, roughness] :
         {std::pair(1.0, 0.3), {1.0, 0.5}, {1.0, 1.0}, {0.0, 0.4}, {0.0, 1.0}, {0.5, 0.6}}) {
        CAPTURE(metallic);
        CAPTURE(roughness);
        const PathSurface x1 =
            floorSurface({glm::dvec3(0.8), metallic, roughness}, {1.2, 0.9, 0.3});
        const Lobes expected = lampByQuadrature(scene, x1, kRadiance);
        const PathInputs in = scene.inputs();
        const auto means = meansOf<6>(48, 128, [&](const PathNumbers& numbers, int) {
            const PathSample path = tracePath(in, x1, numbers);
            const Lobes both = path.parts.direct + path.parts.bounced;
            return std::array{
                path.directAlone.diffuse.x,  path.bouncedAlone.diffuse.x,  both.diffuse.x,
                path.directAlone.specular.x, path.bouncedAlone.specular.x, both.specular.x};
        });
        for (int i = 0; i < 6; ++i) {
            CAPTURE(i);
            const double wanted = i < 3 ? expected.diffuse.x : expected.specular.x;
            CAPTURE(wanted);
            CAPTURE(means[i].mean);
            CAPTURE(means[i].error);
            CHECK(means[i].agrees(wanted, 2e-4 * wanted)); // the grid of the quadrature
            if (i % 3 == 2)
                CHECK(means[i].error <= 0.02 * std::max(wanted, 0.01));
        }
        MESSAGE("metallic ", metallic, ", roughness ", roughness, ": specular ",
                expected.specular.x, ", errors ", means[3].error, " light, ", means[4].error,
                " direction, ", means[5].error, " both");
    }
}

TEST_CASE("a mirror shows the lamp as bright as it is") {
    const PathScene scene(underLamp(3.0));
    const PathSurface x1 = floorSurface({glm::dvec3(1.0), 1.0, 0.0}, {0.5, 1.0, 0.2});
    const PathInputs in = scene.inputs();
    const glm::dvec3 eye = glm::normalize(x1.eye - x1.lit.position);
    double furthest = 0.0;
    const auto [seen] = meansOf<1>(32, 64, [&](const PathNumbers& numbers, int) {
        const PathSample path = tracePath(in, x1, numbers);
        if (numbers.u[3] < 0.99)
            furthest = std::max(furthest, glm::length(path.x2 - x1.lit.position -
                                                      glm::dvec3(-eye.x, eye.y, -eye.z) / eye.y));
        return std::array{(path.parts.direct + path.parts.bounced).specular.x};
    });
    MESSAGE("radiance ", seen.mean, " +- ", seen.error, ", furthest ", furthest);
    CHECK(seen.agrees(3.0, 0.003)); // 1e-3 of it misses the lamp or meets a second facet
    CHECK(furthest < 0.04);         // 99 % within 0.02 rad, seen from 1.1 m
}

TEST_CASE("without anything around, paths bring the surroundings") {
    const PathScene scene(underLamp(3.0)); // the lamp is below: no ray upwards meets it
    PathSurface x1 = floorSurface({glm::dvec3(0.9, 0.5, 0.1), 0.3, 0.5}, {1.0, 2.5, 0.0});
    x1.lit.position.y = 1.5;
    const Bsdf bsdf = bsdfOf(x1);
    const PathInputs in = scene.inputs(glm::dvec3(1.0, 2.0, 0.5));
    const auto [red, green, blue] = meansOf<3>(32, 128, [&](const PathNumbers& numbers, int) {
        const auto signal = signalsOf(Division::Path, tracePath(in, x1, numbers).parts, 1e9)[0];
        return std::array{signal.value.x, signal.value.y, signal.value.z};
    });
    CHECK(red.agrees(1.0, 0.01)); // the table's interpolation
    CHECK(green.agrees(2.0, 0.02));
    CHECK(blue.agrees(0.5, 0.005));
    CHECK(green.error < 0.02);
    CHECK(bsdf.albedo().diffuse.x > 0.1);
}

TEST_CASE("regularization off is exactly none, and vanishes with samples") {
    for (const double kappa : {0.05, 0.3, 1.0}) {
        CHECK(regularizationOf(kappa, 0) == kappa);
        CHECK(std::abs(regularizationOf(kappa, 63) - 0.5 * kappa) < 1e-15);
        CHECK(std::abs(regularizationOf(kappa, 728) - kappa / 3.0) < 1e-15);
        CHECK(regularizationOf(0.0, 17) == 0.0);
    }
    Material wall;
    wall.baseColor = glm::vec3(0.9f, 0.6f, 0.3f);
    wall.metallic = 0.8f;
    wall.roughness = 0.5f;
    const PathScene sphere(insideOfSphere(1, 0.7, wall));
    const Triangle& triangle = sphere.view.triangles[3];
    const PathSurface x1 =
        surfaceOn(sphere.scene, sphere.view, triangle, {0.2, 0.5}, {0.1, -0.2, 0.3});
    int changed = 0, lit = 0;
    forEachPath(16, 16, [&](const PathNumbers& numbers, int) {
        PathInputs in = sphere.inputs();
        const PathSample plain = tracePath(in, x1, numbers);
        const MaterialFactors material = factorsOf(wall);
        // Below its own width a lobe is not widened: the same bits.
        in.regularization = material.alpha();
        const PathSample narrow = tracePath(in, x1, numbers);
        CHECK(sameBits(narrow.parts.indirect.sum(), plain.parts.indirect.sum()));
        in.regularization = 0.8;
        const PathSample wide = tracePath(in, x1, numbers);
        // The scattering at x1 is unchanged.
        CHECK(sameBits(wide.parts.direct.sum(), plain.parts.direct.sum()));
        CHECK(sameBits(wide.parts.bounced.sum(), plain.parts.bounced.sum()));
        CHECK(sameBits(wide.weight.sum(), plain.weight.sum()));
        CHECK(sameBits(wide.l, plain.l));
        changed += !sameBits(wide.sentBack.specular, plain.sentBack.specular);
        lit += plain.sentBack.sum() != glm::dvec3(0.0);
    });
    CHECK(lit > 100);
    CHECK(changed == lit);
    // The widened lobe is that of the roughness whose square kappa is.
    const glm::dvec3 n(0, 1, 0), v = glm::normalize(glm::dvec3(1, 1, 0)),
                                 l = glm::normalize(glm::dvec3(-0.4, 1.0, 0.3));
    const Bsdf wide({glm::dvec3(0.5), 1.0, 0.1}, n, n, v, 0.25),
        rough({glm::dvec3(0.5), 1.0, 0.5}, n, n, v);
    CHECK(sameBits(wide.at(l).sum(), rough.at(l).sum()));
    CHECK(sameBits(wide.albedo().sum(), rough.albedo().sum()));
}
