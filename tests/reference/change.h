// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include "renderer/image/color.h"
#include "tests/reference/gradient.h"

// The change of light by channel: "Change of light" in docs/pipeline.md.

namespace afterglow::reference {

/// Keeps the least distance of a decision from its threshold, relative to what was compared. A
/// comparison in a smaller precision is fair only where that is well above this precision.
class Margin {
public:
    void add(double value, double threshold) {
        const double scale = std::max(std::abs(value), std::abs(threshold));
        if (scale > 0.0) // two zeros are equal in every precision
            least_ = std::min(least_, std::abs(value - threshold) / scale);
    }
    void addDistance(double distance) { least_ = std::min(least_, std::abs(distance)); }
    double least() const { return least_; }

private:
    double least_ = std::numeric_limits<double>::infinity();
};

struct LightPairs {
    Image<glm::dvec4> before, now, products;
    std::uint32_t changed = 0; ///< strata whose sample has another light
    Margin margin{};
};

/// Pixel of the frame where the sample of stratum s landed.
inline glm::ivec2 landingOf(const Image<glm::uvec4>& samples, glm::ivec2 s) {
    const int edge = int(gpu::kStratumSize);
    const int place = int(samples(s).y) - 1;
    return edge * s + glm::ivec2(place % edge, place / edge);
}

/// Of each stratum the light of its sample in both frames, and mean and variance of its luminance.
/// `sampleRaw`, one texel a stratum, holds the light of samples that are not in the picture.
inline LightPairs lightPairs(const GradientInputs& in,
                             const Image<glm::vec4>* sampleRaw = nullptr) {
    const Image<glm::dvec4> luminances = gradient(in);
    const glm::ivec2 strata = luminances.size();
    LightPairs out{Image<glm::dvec4>(strata), Image<glm::dvec4>(strata), Image<glm::dvec4>(strata)};
    for (int sy = 0; sy < strata.y; ++sy)
        for (int sx = 0; sx < strata.x; ++sx) {
            const glm::ivec2 s{sx, sy};
            glm::dvec3 a(0.0), b(0.0);
            const glm::uvec4 sample = in.samples(s);
            const bool hasSample = sample.y != 0;
            if (hasSample) {
                const glm::ivec2 source(int(sample.z & 0xffffu), int(sample.z >> 16));
                a = glm::dvec3(in.previousRaw(source));
                b = glm::dvec3(sampleRaw ? (*sampleRaw)(s) : in.raw(landingOf(in.samples, s)));
            }
            bool changed = false;
            for (int c = 0; c < 3; ++c) {
                const double allowed = 1e-3 * (std::max(a[c], b[c]) + 1e-3);
                const double difference = std::abs(b[c] - a[c]);
                changed = changed || difference > allowed;
                // A difference is exact to a rounding of its terms, not of itself.
                if (hasSample && std::max(a[c], b[c]) > 0.0)
                    out.margin.addDistance((difference - allowed) / std::max(a[c], b[c]));
            }
            out.changed += changed ? 1 : 0;
            out.before(s) = glm::dvec4(a, hasSample ? 1.0 : 0.0);
            out.now(s) = glm::dvec4(b, luminances(s).z);
            out.products(s) =
                glm::dvec4(glm::dot(a, a), glm::dot(a, b), glm::dot(b, b), luminances(s).w);
        }
    return out;
}

struct LightPairImages { ///< as LightPairs, as the device holds them
    const Image<glm::vec4>&before, &now, &products;
};

/// One a-trous iteration over light pairs. A sigmaLuminance of 0 stands for no luminance stop.
inline LightPairs lightPairsAtrous(const LightPairImages& in, const Image<glm::vec4>& strataGuides,
                                   const Image<glm::vec2>& strataSlope, Kernel kernel,
                                   const gpu::EdgeStopping& params) {
    const glm::ivec2 strata = in.now.size();
    const auto mean = [&](glm::ivec2 s) {
        return params.sigmaLuminance > 0.0f ? double(in.now(s).a) : 0.0;
    };
    // Three numbers at a time, with the variance that all of them have in common.
    const auto filter = [&](auto numbersAt) {
        Image<glm::vec4> image(strata);
        for (int y = 0; y < strata.y; ++y)
            for (int x = 0; x < strata.x; ++x)
                image({x, y}) = glm::vec4(numbersAt(glm::ivec2(x, y)), in.products({x, y}).a);
        return atrousIteration(image, strataGuides, strataSlope, kernel, params, mean,
                               int(gpu::kStratumSize));
    };
    LightPairs out{filter([&](glm::ivec2 s) { return glm::vec3(in.before(s)); }),
                   filter([&](glm::ivec2 s) { return glm::vec3(in.now(s)); }),
                   filter([&](glm::ivec2 s) { return glm::vec3(in.products(s)); })};
    const Image<glm::dvec4> others =
        filter([&](glm::ivec2 s) { return glm::vec3(in.before(s).a, in.now(s).a, 0.0f); });
    for (std::size_t i = 0; i < others.pixels().size(); ++i) {
        out.before.pixels()[i].a = others.pixels()[i].x;
        out.now.pixels()[i].a = others.pixels()[i].y;
    }
    return out;
}

struct ChangeResult {
    Image<double> lambda;
    Image<glm::dvec4> change; ///< E, v, scale, weight
    Margin margin{};
};

/// Returns by how much light has changed, and whether by one factor.
inline ChangeResult change(const LightPairImages& in, const gpu::ChangeParams& params) {
    const glm::ivec2 strata = in.now.size();
    ChangeResult out{Image<double>(strata), Image<glm::dvec4>(strata)};
    const double floor = params.deltaFloor;
    for (int sy = 0; sy < strata.y; ++sy)
        for (int sx = 0; sx < strata.x; ++sx) {
            const glm::ivec2 p{sx, sy};
            const glm::dvec3 a(in.before(p)), b(in.now(p));
            const double samples = in.before(p).a;
            const double n = std::max(samples, 1e-6);
            const double aa = in.products(p).x, ab = in.products(p).y, bb = in.products(p).z;
            const double m = std::max(luminance(a), luminance(b));
            const double sumA = a.r + a.g + a.b, sumB = b.r + b.g + b.b;

            double lambda = 0.0;
            out.margin.add(m, floor);
            if (m > floor) {
                if (params.over == gpu::kChangeOfChannels)
                    for (int c = 0; c < 3; ++c)
                        lambda = std::max(lambda, std::abs(b[c] - a[c]) /
                                                      (std::max(a[c], b[c]) + 0.02 * m));
                else
                    lambda = std::abs(luminance(b) - luminance(a)) / m;
                lambda = std::min(1.0, lambda);
            }

            double brightest = 0.0; // K
            for (int c = 0; c < 3; ++c)
                brightest += std::max(a[c], b[c]) * std::max(a[c], b[c]);
            brightest = brightest / (n * n) + 1e-12;
            const double spread = std::max(
                {0.0, aa / n - glm::dot(a, a) / (n * n), bb / n - glm::dot(b, b) / (n * n)});
            const double v = spread * n * n / (std::max(glm::dot(a, a), glm::dot(b, b)) + 1e-12);

            out.margin.add(sumA, floor);
            const double s = sumA > floor ? sumB / sumA : 1.0;
            const double unexplained =
                std::max(0.0, bb - 2.0 * s * ab + s * s * aa) / (n * brightest); // rho
            double believed = lambda * lambda /
                              (lambda * lambda + double(params.scaleDoubt) * unexplained + 1e-12);
            if (params.scaleHistory == 0)
                believed = 0.0;
            const double larger = std::max(sumA, sumB);
            if (larger > 0.0)
                out.margin.addDistance(std::abs(sumB - sumA) / larger - 4e-6);
            double scale = 1.0;
            if (std::abs(sumB - sumA) > 4e-6 * larger) {
                const double little = 1e-3 * m + 1e-6;
                const double factor = std::clamp((sumB + little) / (sumA + little), 0.0, 8.0);
                scale = 1.0 + believed * (factor - 1.0);
            }
            double weight = samples > 0.0 ? m : 0.0;
            if (params.forceLambda >= 0.0f) {
                lambda = params.forceLambda;
                believed = 0.0;
                scale = weight = 1.0;
            }
            out.lambda(p) = lambda;
            out.change(p) = glm::dvec4(lambda * lambda * (1.0 - believed), v, scale, weight);
        }
    return out;
}

} // namespace afterglow::reference
