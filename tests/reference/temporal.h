// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "renderer/image/color.h"
#include "shared/bindings.h"
#include "shared/denoise_params.h"
#include "tests/reference/counted.h"
#include "tests/reference/edge_stops.h"

namespace afterglow::reference {

struct TemporalInputs {
    const Image<glm::vec4>& raw;
    const Image<glm::uvec4>& visibility;
    const Image<glm::uvec4>& previousVisibility;
    const Image<glm::vec4>& guides;
    const Image<glm::vec4>& previousGuides;
    const Image<glm::vec2>& slope;
    const Image<glm::vec4>& motion;
    const Image<glm::vec4>& previousColor;
    const Image<glm::vec4>& previousMoments;
    const Image<float>& lambda;
    bool historyValid;
    const Image<glm::vec4>* luminanceRange = nullptr; ///< needed with kLambdaFromRange
    const Image<glm::vec4>* change = nullptr;         ///< with kLambdaCounts and kLambdaLight
    std::uint32_t changed = 0;                        ///< with kLambdaCounts
    const Image<glm::uvec4>* samples = nullptr;       ///< with kLambdaCounts
};
struct TemporalResult {
    Image<glm::dvec4> accumulated, moments, control;
    /// Least distance of a validity decision from its threshold; a comparison in a
    /// smaller precision is fair only where this is well above that precision.
    double margin = std::numeric_limits<double>::infinity();
};

/// History of a surface point in the frame before.
struct History {
    glm::dvec3 color{0.0};
    glm::dvec2 moments{0.0};
    double length = 0.0; ///< frames
    int reason = gpu::kHistoryKept;
};

/// Whether the previous frame's pixel `tap` shows the surface of p: kHistoryKept, or why not.
inline int judgeTap(const TemporalInputs& in, const gpu::TemporalParams& params, glm::ivec2 p,
                    glm::ivec2 tap, double& margin) {
    if (!in.previousVisibility.contains(tap))
        return gpu::kHistoryOffScreen;
    const bool isSky = isBackground(in.previousGuides(tap)) || in.previousVisibility(tap).x == 0;
    if (isSky || in.previousVisibility(tap).x != in.visibility(p).x)
        return gpu::kHistoryInstance;

    const glm::dvec2 slope = glm::abs(glm::dvec2(in.slope(p)));
    const double expected = in.motion(p).z;
    const double allowed = double(params.depthTolerance) * (slope.x + slope.y) + 0.005 * expected;
    const double difference = std::abs(double(in.previousGuides(tap).w) - expected);
    margin = std::min(margin, std::abs(difference - allowed));
    if (!(difference <= allowed))
        return gpu::kHistoryDepth;

    const double cosine = glm::dot(glm::dvec3(in.previousGuides(tap)), glm::dvec3(in.guides(p)));
    margin = std::min(margin, std::abs(cosine - double(params.normalTolerance)));
    if (!(cosine >= double(params.normalTolerance)))
        return gpu::kHistoryNormal;
    return gpu::kHistoryKept;
}

/// The four taps around the place where the surface of p was. Schied et al. 2017, section 4.1.
inline History findHistory(const TemporalInputs& in, const gpu::TemporalParams& params,
                           glm::ivec2 p, double& margin) {
    if (!in.historyValid)
        return {.reason = gpu::kHistoryNone};
    if (in.motion(p).w == 0.0f)
        return {.reason = gpu::kHistoryOffScreen};

    const glm::dvec2 position = glm::dvec2(p) + glm::dvec2(in.motion(p));
    const glm::dvec2 corner = glm::floor(position);
    const glm::dvec2 part = position - corner;
    History sum;
    double valid = 0.0, largest = -1.0;
    for (const glm::ivec2 k : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
        const glm::ivec2 tap = glm::ivec2(corner) + k;
        const double b = (k.x ? part.x : 1.0 - part.x) * (k.y ? part.y : 1.0 - part.y);
        const int reason = judgeTap(in, params, p, tap, margin);
        if (b > largest) {
            largest = b;
            sum.reason = reason;
        }
        if (reason != gpu::kHistoryKept)
            continue;
        valid += b;
        sum.color += b * glm::dvec3(in.previousColor(tap));
        sum.moments += b * glm::dvec2(in.previousMoments(tap));
        sum.length += b * double(in.previousMoments(tap).z);
    }
    margin = std::min(margin, std::abs(valid - 0.01));
    if (valid < 0.01)
        return {.reason = sum.reason};
    return {sum.color / valid, sum.moments / valid, sum.length / valid, gpu::kHistoryKept};
}

/// Lambda, known per stratum, at pixel p. `change` is needed with kLambdaLight.
inline double fetchLambda(const Image<float>& lambda, glm::ivec2 p, int fetch,
                          const Image<glm::vec4>* change = nullptr) {
    return fetchOfStrata(
        lambda.size(), p, fetch, [&](glm::ivec2 s) { return double(lambda(s)); },
        [&](glm::ivec2 s) { return change ? double((*change)(s).w) : 1.0; });
}

/// Lambda from the distance between the luminance of the history and the range that the raw frame
/// has in the tiles around pixel p.
inline double rangeLambda(const Image<glm::vec4>& ranges, glm::ivec2 p, const History& history,
                          double slope) {
    if (history.length == 0.0)
        return 0.0;
    const int edge = int(gpu::kTileSize);
    // Tile t has its center at 8 t + 4, pixel p at p + 1/2.
    const glm::dvec2 position = (glm::dvec2(p) + 0.5 - 0.5 * edge) / double(edge);
    const glm::ivec2 corner(glm::floor(position));
    const glm::dvec2 part = position - glm::dvec2(corner);
    double low = 0.0, high = 0.0, total = 0.0;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const glm::dvec4 range(
                ranges(glm::clamp(corner + glm::ivec2(x, y), glm::ivec2(0), ranges.size() - 1)));
            const double w = std::abs(1 - x - part.x) * std::abs(1 - y - part.y) * range.z;
            low += w * range.x;
            high += w * range.y;
            total += w;
        }
    low /= total;
    high /= total;
    const double l = luminance(history.color);
    const double outside = l < low ? low - l : l > high ? l - high : 0.0;
    return std::min(1.0, slope * outside / (high - low + 1e-4));
}

/// The history color held within so many deviations of the raw signal around p. Karis 2014, Salvi
/// 2016.
inline glm::dvec3 clampHistory(const TemporalInputs& in, const gpu::TemporalParams& params,
                               glm::ivec2 p, glm::dvec3 color) {
    std::vector<glm::dvec3> around;
    for (int y = -params.clampRadius; y <= params.clampRadius; ++y)
        for (int x = -params.clampRadius; x <= params.clampRadius; ++x) {
            const glm::ivec2 q = p + glm::ivec2(x, y);
            if (in.raw.contains(q) && !isBackground(in.guides(q)))
                around.push_back(glm::dvec3(in.raw(q)));
        }
    if (around.empty())
        return color;
    for (int channel = 0; channel < 3; ++channel) {
        double mean = 0.0, variance = 0.0;
        for (const glm::dvec3& value : around)
            mean += value[channel] / double(around.size());
        for (const glm::dvec3& value : around)
            variance += (value[channel] - mean) * (value[channel] - mean) / double(around.size());
        const double reach = double(params.clampSigmas) * std::sqrt(variance);
        color[channel] = std::clamp(color[channel], mean - reach, mean + reach);
    }
    return color;
}

/// The history length after a frame was blended in with weight `alpha`.
inline double nextLength(int law, double length, double alpha) {
    if (length == 0.0)
        return 1.0;
    if (law == gpu::kHistoryEffective)
        return 1.0 / ((1.0 - alpha) * (1.0 - alpha) / length + alpha * alpha);
    return length + 1.0;
}

/// A history ready to be blended with the new frame, and the weights of that frame.
struct Blend {
    glm::dvec3 color;
    glm::dvec2 moments;
    double alpha, alphaMoments;
    double length; ///< afterwards, before its limit
};

/// Of the counted history. `color` is that of the history after any clamp.
inline Blend countedBlend(const TemporalInputs& in, const gpu::TemporalParams& params, glm::ivec2 p,
                          const History& history, glm::dvec3 color) {
    if (history.length == 0.0)
        return {color, history.moments, 1.0, 1.0, 1.0};
    const CountedHistory counted = count({color, history.moments, history.length},
                                         {in.lambda, *in.change, in.changed, *in.samples}, params,
                                         p, glm::dvec2(p) + glm::dvec2(in.motion(p)));
    const double length = counted.samples + counted.newSample;
    const double alpha = counted.newSample / length;
    return {counted.color, counted.moments, alpha, std::max(alpha, double(params.alphaMoments)),
            length};
}

/// Of every other filter. Schied et al. 2018, section 4.4.
inline Blend plainBlend(const gpu::TemporalParams& params, const History& history, glm::dvec3 color,
                        double lambda) {
    // Confidence shortens the history; otherwise lambda blends.
    const bool cuts = params.lambdaUse == gpu::kLambdaCuts;
    const double confidence = cuts ? (1.0 - lambda) * (1.0 - lambda) : 1.0;
    const double blend = cuts ? 0.0 : lambda;
    double kept = history.length * glm::mix(confidence, 1.0, 1.0 / (1.0 + history.length));
    if (params.historyLaw == gpu::kHistoryPower)
        kept *= std::pow(1.0 - blend, 10.0);
    const auto adapted = [&](double alpha) {
        return (1.0 - blend) * std::max(alpha, 1.0 / (kept + 1.0)) + blend;
    };
    const double alpha = adapted(params.alpha);
    return {color, history.moments, alpha, adapted(params.alphaMoments),
            nextLength(params.historyLaw, kept, alpha)};
}

/// History and the new frame blended. Schied et al. 2017, section 4.1.
inline TemporalResult temporal(const TemporalInputs& in, const gpu::TemporalParams& params) {
    const glm::ivec2 size = in.raw.size();
    TemporalResult out{Image<glm::dvec4>(size), Image<glm::dvec4>(size), Image<glm::dvec4>(size)};
    for (int py = 0; py < size.y; ++py)
        for (int px = 0; px < size.x; ++px) {
            const glm::ivec2 p{px, py};
            if (isBackground(in.guides(p)))
                continue;
            const History history = findHistory(in, params, p, out.margin);
            double lambda = 0.0;
            if (params.lambdaSource == gpu::kLambdaFromGradient)
                lambda = fetchLambda(in.lambda, p, params.lambdaFetch, in.change);
            else if (params.lambdaSource == gpu::kLambdaFromRange)
                lambda = rangeLambda(*in.luminanceRange, p, history, params.percentileSlope);

            const bool counts = params.lambdaUse == gpu::kLambdaCounts;
            if (counts && (in.changed == 0 || history.length == 0.0))
                lambda = 0.0; // the strata are not asked
            const glm::dvec3 color = clampHistory(in, params, p, history.color);
            const Blend blend = counts ? countedBlend(in, params, p, history, color)
                                       : plainBlend(params, history, color, lambda);
            const double l = in.raw(p).a;
            const glm::dvec2 moments = glm::mix(blend.moments, {l, l * l}, blend.alphaMoments);
            const double length = std::min(double(params.maxHistory), blend.length);
            out.accumulated(p) =
                glm::dvec4(glm::mix(blend.color, glm::dvec3(in.raw(p)), blend.alpha),
                           history.length > 0.0 ? luminance(history.color) : 0.0);
            out.moments(p) = glm::dvec4(moments, length, 0.0);
            out.control(p) = glm::dvec4(lambda, blend.alpha, length, history.reason);
        }
    return out;
}

} // namespace afterglow::reference
