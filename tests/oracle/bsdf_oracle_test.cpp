// SPDX-License-Identifier: MIT
#include <random>

#include <doctest/doctest.h>

#include "tests/oracle/path_scenes.h"

using namespace afterglow;
using namespace afterglow::reference;
using namespace afterglow::test;

// The surfaces of docs/pipeline.md, "Paths", as the reference has them, against quadrature.

namespace {

const glm::dvec3 kUp(0.0, 0.0, 1.0), kTangent(1.0, 0.0, 0.0);

glm::dvec3 towards(double cosine) {
    return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
}

MaterialFactors metal(double roughness) {
    return {glm::dvec3(1.0), 1.0, roughness};
}
MaterialFactors whiteDielectric(double roughness) {
    return {glm::dvec3(1.0), 0.0, roughness};
}

/// The light that the specular lobe sends back of a white sky: f_s (n . l) over the hemisphere, by
/// microfacets that need not be visible.
double specularAlbedo(const Bsdf& bsdf) {
    return meanOverNormals(bsdf.alpha(), 200, [&](const glm::dvec3& h) {
        const double hv = glm::dot(h, bsdf.view());
        const glm::dvec3 l = 2.0 * hv * h - bsdf.view();
        const double density =
            normalDensity(h.z, h.x * h.x + h.y * h.y, bsdf.alpha()) * h.z / (4.0 * hv);
        return hv > 0.0 && l.z > 0.0 ? bsdf.at(l).specular.x * l.z / density : 0.0;
    });
}

} // namespace

TEST_CASE("the table of albedos is the quadrature of the lobe, to 0.0135 at its texels") {
    double largest = 0.0, finest = 0.0;
    for (const int r : {0, 2, 5, 11, 20, 31})
        for (const int c : {0, 1, 3, 8, 15, 31}) {
            const double cosine = std::max(c / 31.0, 1e-3), roughness = r / 31.0;
            const Bsdf white(metal(roughness), kUp, kUp, towards(cosine));
            const Bsdf black({glm::dvec3(0.0), 1.0, roughness}, kUp, kUp, towards(cosine));
            const SplitAlbedo& texel = albedoTable().texel(r, c);
            const SplitAlbedo fine = albedoOverGrid(white.alpha(), cosine, 256);
            largest = std::max({largest, std::abs(texel.a - fine.a), std::abs(texel.b - fine.b)});
            finest = std::max({finest, std::abs(fine.a + fine.b - specularAlbedo(white)),
                               std::abs(fine.b - specularAlbedo(black))});
        }
    MESSAGE("32x32 against 256x256 visible normals ", largest, ", those against all normals ",
            finest);
    // 32 values of u1 end at 0.984: the far ends of the lobe, which G2 cuts most, have no share.
    CHECK(largest < 0.0135);
    CHECK(finest < 1.5e-3); // two quadratures of one integral, with a horizon through their grids
    // All normals alike, seen from above: the integral of c / (1 + c).
    const Bsdf rough(metal(1.0), kUp, kUp, kUp);
    CHECK(std::abs(specularAlbedo(rough) - (1.0 - std::numbers::ln2)) < 1e-4);
    CHECK(std::abs(albedoOverGrid(1.0, 1.0, 256).of(glm::dvec3(1.0)).x -
                   (1.0 - std::numbers::ln2)) < 2e-3);
}

TEST_CASE("under a white sky no surface gives back more than it gets, but for the table's error") {
    double most = 0.0, mostAtGrazing = 0.0, table = 0.0, tableAtGrazing = 0.0, least = 1.0;
    for (const double roughness : {0.0, 0.05, 0.1, 0.15, 0.3, 0.6, 1.0})
        for (const double cosine : {1e-3, 5e-3, 1.0 / 64, 0.03, 0.06, 0.11, 0.25, 0.6, 1.0})
            for (const MaterialFactors& material : {metal(roughness), whiteDielectric(roughness)}) {
                const Bsdf bsdf(material, kUp, kUp, towards(cosine));
                const double specular = specularAlbedo(bsdf);
                const double whole = specular + bsdf.albedo().diffuse.x;
                const bool isGrazing = cosine < 1.0 / 31;
                double& highest = isGrazing ? mostAtGrazing : most;
                highest = std::max(highest, whole);
                double& error = isGrazing ? tableAtGrazing : table;
                error = std::max(error, std::abs(specular - bsdf.albedo().specular.x));
                least = std::min(least, whole);
            }
    MESSAGE("most ", most, ", at grazing angles ", mostAtGrazing, ", least ", least,
            ", interpolation ", table, ", at grazing angles ", tableAtGrazing);
    CHECK(table < 0.009);
    CHECK(most < 1.0035);
    // Between the two last texels of the cosine, 0.001 and 1/31, the albedo of smooth surfaces has
    // a dip that the line between them cuts off.
    CHECK(tableAtGrazing < 0.078);
    CHECK(mostAtGrazing < 1.078);
    // Light that would meet a second facet is missing, at most this much.
    CHECK(least > 1.0 - std::numbers::ln2 - 1e-3);
}

TEST_CASE("the weights of directions have the quadrature of the lobes as their mean") {
    double worst = 0.0;
    for (const double roughness : {0.0, 0.2, 0.5, 0.8, 1.0})
        for (const double cosine : {0.02, 0.15, 0.4, 0.75, 1.0})
            for (const bool isMetal : {true, false}) {
                CAPTURE(roughness);
                CAPTURE(cosine);
                CAPTURE(isMetal);
                const Bsdf bsdf(isMetal ? metal(roughness) : whiteDielectric(roughness), kUp, kUp,
                                towards(cosine));
                const auto [diffuse, specular] =
                    meansOf<2>(24, 256, [&](const PathNumbers& n, int) {
                        const glm::dvec3 l = bsdf.direction(kTangent, n.u[3], n.u[4], n.u[5]);
                        if (!bsdf.scatters(l))
                            return std::array{0.0, 0.0};
                        const Lobes weight = bsdf.at(l) * (l.z / bsdf.density(l));
                        return std::array{weight.diffuse.x, weight.specular.x};
                    });
                const double expected = specularAlbedo(bsdf);
                worst = std::max({worst, specular.error, diffuse.error});
                CAPTURE(specular.mean);
                CAPTURE(specular.error);
                CAPTURE(expected);
                CHECK(specular.agrees(expected, 1e-4));
                CAPTURE(diffuse.mean);
                CAPTURE(diffuse.error);
                CHECK(diffuse.agrees(bsdf.albedo().diffuse.x, 1e-12));
            }
    MESSAGE("largest standard error ", worst);
    CHECK(worst < 5e-3);
}

TEST_CASE("the density of the visible normals' directions integrates to 1 over the sphere") {
    for (const double roughness : {0.0, 0.3, 0.7, 1.0})
        for (const double cosine : {0.02, 0.3, 0.9}) {
            CAPTURE(roughness);
            CAPTURE(cosine);
            const Bsdf bsdf(metal(roughness), kUp, kUp, towards(cosine));
            const auto mass = [&](bool below) {
                return meanOverNormals(bsdf.alpha(), 200, [&](const glm::dvec3& h) {
                    const double hv = glm::dot(h, bsdf.view());
                    const glm::dvec3 l = 2.0 * hv * h - bsdf.view();
                    const double density =
                        normalDensity(h.z, h.x * h.x + h.y * h.y, bsdf.alpha()) * h.z / (4.0 * hv);
                    return hv > 0.0 && (l.z <= 0.0) == below ? bsdf.density(l) / density : 0.0;
                });
            };
            const double lost = mass(true);                   // below the horizon
            CHECK(std::abs(mass(false) + lost - 1.0) < 1e-3); // measured: 2e-4
            const int n = 512;
            int below = 0;
            for (int i = 0; i < n * n; ++i)
                below +=
                    bsdf.direction(kTangent, (i / n + 0.5) / n, (i % n + 0.5) / n, 0.5).z <= 0.0;
            CHECK(std::abs(below / double(n * n) - lost) < 2e-3); // both grids cut the horizon
        }
}

TEST_CASE("directions are spread as their density says") {
    constexpr int kRings = 10, kSectors = 16, kFine = 24, kSamples = 100000;
    std::mt19937 bits(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const double roughness : {0.5, 0.75, 1.0})
        for (const double cosine : {0.05, 0.4, 0.95})
            for (const bool isMetal : {true, false}) {
                CAPTURE(roughness);
                CAPTURE(cosine);
                CAPTURE(isMetal);
                const Bsdf bsdf(isMetal ? metal(roughness) : whiteDielectric(roughness), kUp, kUp,
                                towards(cosine));
                std::array<std::array<int, kSectors>, kRings> counts{};
                for (int i = 0; i < kSamples; ++i) {
                    const double u3 = uniform(bits), u4 = uniform(bits), u5 = uniform(bits);
                    const glm::dvec3 l = bsdf.direction(kTangent, u3, u4, u5);
                    const double turn = std::atan2(l.y, l.x) / (2.0 * std::numbers::pi) + 0.5;
                    if (l.z > 0.0)
                        ++counts[std::min(int(l.z * kRings), kRings - 1)]
                                [std::min(int(turn * kSectors), kSectors - 1)];
                }
                double chiSquare = 0.0;
                int bins = 0;
                for (int i = 0; i < kRings; ++i)
                    for (int j = 0; j < kSectors; ++j) {
                        double mean = 0.0; // bins are of equal solid angle
                        for (int k = 0; k < kFine * kFine; ++k) {
                            const double z = (i + (k / kFine + 0.5) / kFine) / kRings;
                            const double angle = 2.0 * std::numbers::pi *
                                                 ((j + (k % kFine + 0.5) / kFine) / kSectors - 0.5);
                            const double r = std::sqrt(1.0 - z * z);
                            mean += bsdf.density({r * std::cos(angle), r * std::sin(angle), z}) /
                                    (kFine * kFine);
                        }
                        const double expected =
                            kSamples * mean * 2.0 * std::numbers::pi / (kRings * kSectors);
                        if (expected < 10.0)
                            continue;
                        ++bins;
                        chiSquare += std::pow(counts[i][j] - expected, 2.0) / expected;
                    }
                CAPTURE(bins);
                CAPTURE(chiSquare);
                CHECK(bins > 40);
                CHECK(chiSquare < bins + 5.0 * std::sqrt(2.0 * bins));
            }
}

TEST_CASE("at the least roughness directions are those of a mirror, within the width of the lobe") {
    constexpr int n = 256;
    for (const double cosine : {1.0, 0.7, 0.3, 0.1}) {
        CAPTURE(cosine);
        const Bsdf bsdf(metal(0.0), kUp, kUp, towards(cosine));
        CHECK(bsdf.alpha() == 1e-3);
        const glm::dvec3 mirrored(-bsdf.view().x, 0.0, cosine);
        std::vector<double> angles;
        for (int i = 0; i < n * n; ++i)
            angles.push_back(std::asin(std::min(
                1.0, glm::length(glm::cross(mirrored, bsdf.direction(kTangent, (i / n + 0.5) / n,
                                                                     (i % n + 0.5) / n, 0.5))))));
        std::sort(angles.begin(), angles.end());
        const auto quantile = [&](double q) { return angles[std::size_t(q * (n * n - 1))]; };
        if (cosine == 1.0) // tan(theta_h) = alpha sqrt(q / (1 - q)), and light turns by twice that
            for (const double q : {0.1, 0.5, 0.9, 0.99}) {
                const double expected = 2.0 * std::atan(1e-3 * std::sqrt(q / (1.0 - q)));
                CHECK(std::abs(quantile(q) / expected - 1.0) < 0.02); // steps of the grid
            }
        CHECK(quantile(0.5) <= 2.02e-3); // two alpha: a tenth of a degree
        CHECK(quantile(0.99) <= 0.0202);
    }
}

TEST_CASE("a viewer below the horizon of the shading normal sees it as from the horizon") {
    const glm::dvec3 below = glm::normalize(glm::dvec3(0.8, 0.3, -0.2));
    const Bsdf bsdf(metal(0.4), kUp, kUp, below);
    CHECK(std::abs(glm::length(bsdf.view()) - 1.0) < 1e-15);
    CHECK(std::abs(bsdf.cosine() * std::hypot(0.8, 0.3) / glm::length(glm::dvec3(0.8, 0.3, 0.2)) -
                   1e-3) < 1e-8);
    CHECK(std::abs(bsdf.view().x * below.y - bsdf.view().y * below.x) < 1e-15);
    // Its weights still have the mean that they should.
    const auto [mean] = meansOf<1>(24, 256, [&](const PathNumbers& u, int) {
        const glm::dvec3 l = bsdf.direction(kTangent, u.u[3], u.u[4], u.u[5]);
        return std::array{bsdf.scatters(l) ? bsdf.at(l).specular.x * l.z / bsdf.density(l) : 0.0};
    });
    MESSAGE("mean weight ", mean.mean, " +- ", mean.error);
    CHECK(mean.agrees(specularAlbedo(bsdf), 1e-4));
}
