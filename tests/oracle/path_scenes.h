// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"
#include "tests/reference/paths.h"
#include "tests/support/source_dir.h"

namespace afterglow::test {

/// A scene at time 0, as paths see it.
struct PathScene {
    explicit PathScene(Scene made)
        : scene(std::move(made)), view(scene, 0.0), extent(view.extent()),
          emitters(reference::emittersOf(
              scene, view, view, std::vector<glm::dvec3>(scene.lights.size(), glm::dvec3(1.0)))) {}

    reference::PathInputs inputs(const glm::dvec3& ambient = glm::dvec3(0.0)) const {
        return {scene, view, emitters, extent, ambient};
    }

    Scene scene;
    reference::SceneView view;
    double extent;
    std::vector<reference::Emitter> emitters;
};

/// A floor at y = 0 and above it a lamp of 2 x 2 m at y = 1 that faces it.
inline Scene underLamp(double radiance) {
    SceneBuilder scene("under a lamp");
    Mesh floor, lamp;
    addQuadFacing(floor, {0, 1, 0}, {-3, 0, -3}, {3, 0, -3}, {3, 0, 3}, {-3, 0, 3});
    addQuadFacing(lamp, {0, -1, 0}, {-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1});
    scene.add(floor, scene.material("floor", glm::vec3(0.5f)), scene.node("floor"));
    scene.light("key", lamp, glm::vec3(float(radiance)));
    return std::move(scene).finish();
}

inline reference::PathSurface floorSurface(const reference::MaterialFactors& material,
                                           const glm::dvec3& eye) {
    return {{{0.1, 0.0, 0.05}, {0, 1, 0}, {0, 1, 0}, glm::dmat3(1.0)}, material, eye};
}

struct Estimate {
    double mean = 0.0, error = 0.0; ///< standard error of the mean

    bool agrees(double expected, double tolerance = 0.0) const {
        return std::abs(mean - expected) <= 4.0 * error + tolerance;
    }
};

/// Calls a function with the program's own random numbers and the number of the batch. A batch is a
/// pixel of a run, which shifts every number by itself: batches are independent.
template <class Function>
void forEachPath(int batches, std::uint32_t frames, Function&& function) {
    static const auto tile = reference::readTile(sourceDir() / "assets/noise/blue_noise_128.pgm");
    for (int b = 0; b < batches; ++b) {
        const reference::Random random(tile, std::uint32_t(b) * 7919u + 1u);
        for (std::uint32_t f = 0; f < frames; ++f)
            function(reference::PathNumbers(random, {{b * 37u % 128u, b * 91u % 128u}, f}), b);
    }
}

/// The means of what a function makes of those numbers, and their errors from those of batches.
template <std::size_t Count, class Function>
std::array<Estimate, Count> meansOf(int batches, std::uint32_t frames, const Function& function) {
    std::vector<std::array<double, Count>> means(std::size_t(batches), std::array<double, Count>{});
    forEachPath(batches, frames, [&](const reference::PathNumbers& numbers, int b) {
        const std::array<double, Count> values = function(numbers, b);
        for (std::size_t i = 0; i < Count; ++i)
            means[b][i] += values[i] / frames;
    });
    std::array<Estimate, Count> out;
    for (std::size_t i = 0; i < Count; ++i) {
        double squares = 0.0;
        for (const auto& mean : means)
            out[i].mean += mean[i] / batches;
        for (const auto& mean : means)
            squares += (mean[i] - out[i].mean) * (mean[i] - out[i].mean);
        out[i].error = std::sqrt(squares / (double(batches) * (batches - 1)));
    }
    return out;
}

/// The mean over normals h spread as D_h (n . h), around +Z, of a function of h: a grid of n values
/// of the slope and n of the azimuth. What it weighs is no visible normal: nothing of the sampling
/// is used.
template <class Function>
double meanOverNormals(double alpha, int n, const Function& function) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        // Denser at the end where slopes grow without bound: du = 2 (1 - x) dx.
        const double x = (i + 0.5) / n, rest = (1.0 - x) * (1.0 - x);
        const double slope = alpha * std::sqrt((1.0 - rest) / rest);
        const double z = 1.0 / std::sqrt(1.0 + slope * slope), r = slope * z;
        for (int j = 0; j < n; ++j) {
            const double angle = 2.0 * std::numbers::pi * (j + 0.5) / n;
            sum +=
                2.0 * (1.0 - x) * function(glm::dvec3(r * std::cos(angle), r * std::sin(angle), z));
        }
    }
    return sum / (double(n) * n);
}

} // namespace afterglow::test
