// SPDX-License-Identifier: MIT
#include "renderer/resources/specular_albedo.h"

#include "renderer/base/parallel.h"
#include "shared/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace afterglow {

namespace {

constexpr int kSteps = 32; // of the quadrature, along each random number

/// Returns the half vector that two numbers in [0, 1) name among those that are visible from
/// `view`, which lies in the xz plane. Heitz 2018, "Sampling the GGX Distribution of Visible
/// Normals".
glm::dvec3 visibleNormal(glm::dvec3 view, double alpha, double u, double v) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * view.x, 0.0, view.z));
    const glm::dvec3 t1(0.0, 1.0, 0.0); // orthogonal to it and to z
    const glm::dvec3 t2 = glm::cross(stretched, t1);
    const double radius = std::sqrt(u), angle = 2.0 * std::numbers::pi * v;
    const double x = radius * std::cos(angle);
    const double half = 0.5 * (1.0 + stretched.z);
    const double y =
        (1.0 - half) * std::sqrt(std::max(0.0, 1.0 - x * x)) + half * radius * std::sin(angle);
    const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
    const glm::dvec3 h = x * t1 + y * t2 + z * stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(0.0, h.z)));
}

glm::vec2 termsOf(double roughness, double cosine) {
    const double cosView = std::max(cosine, double(gpu::kLeastCosine));
    const double alpha = std::max(roughness * roughness, double(gpu::kLeastAlpha));
    const auto root = [&](double c) {
        return std::sqrt(c * c * (1.0 - alpha * alpha) + alpha * alpha);
    };
    const glm::dvec3 view(std::sqrt(1.0 - cosView * cosView), 0.0, cosView);
    glm::dvec2 sum(0.0);
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const glm::dvec3 h = visibleNormal(view, alpha, (i + 0.5) / kSteps, (j + 0.5) / kSteps);
            const double cosHalf = std::max(0.0, glm::dot(view, h));
            const double cosLight = 2.0 * cosHalf * h.z - view.z;
            if (cosLight <= 0.0)
                continue;
            const double fresnel = std::pow(1.0 - cosHalf, 5.0);
            const double shadowed = cosLight * (cosView + root(cosView)) /
                                    (cosLight * root(cosView) + cosView * root(cosLight));
            sum += shadowed * glm::dvec2(1.0 - fresnel, fresnel);
        }
    return glm::vec2(sum / double(kSteps * kSteps));
}

} // namespace

Image<glm::vec2> makeSpecularAlbedo() {
    const int size = int(gpu::kAlbedoTableSize);
    Image<glm::vec2> table({size, size});
    parallelFor(std::size_t(size), hardwareThreads(), [&](std::size_t row) {
        for (int x = 0; x < size; ++x)
            table({x, int(row)}) = termsOf(double(x) / (size - 1), double(row) / (size - 1));
    });
    return table;
}

} // namespace afterglow
