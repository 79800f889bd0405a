// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "renderer/image/color.h"
#include "shared/bindings.h"
#include "shared/denoise_params.h"
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
};
struct TemporalResult {
    Image<glm::dvec4> accumulated, moments, control;
    /// How near the nearest of all validity decisions came to its threshold; a comparison in a
    /// smaller precision is fair only where this is well above that precision.
    double margin = std::numeric_limits<double>::infinity();
};

/// What the previous frame remembers about a surface point.
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

/// Lambda, known per stratum, at pixel p.
inline double fetchLambda(const Image<float>& lambda, glm::ivec2 p, int fetch) {
    const auto at = [&](glm::ivec2 s) {
        return double(lambda(glm::clamp(s, glm::ivec2(0), lambda.size() - 1)));
    };
    const glm::ivec2 own = p / int(gpu::kStratumSize);
    if (fetch == gpu::kLambdaNearest)
        return at(own);
    if (fetch == gpu::kLambdaMax) {
        double largest = 0.0;
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                largest = std::max(largest, at(own + glm::ivec2(x, y)));
        return largest;
    }
    // Stratum s has its center at 3 s + 3/2, pixel p at p + 1/2.
    const glm::dvec2 position = (glm::dvec2(p) + 0.5 - 1.5) / 3.0;
    const glm::ivec2 corner(glm::floor(position));
    const glm::dvec2 part = position - glm::dvec2(corner);
    return glm::mix(glm::mix(at(corner), at(corner + glm::ivec2(1, 0)), part.x),
                    glm::mix(at(corner + glm::ivec2(0, 1)), at(corner + 1), part.x), part.y);
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
inline double nextLength(int law, double length, double alpha, double lambda) {
    if (length == 0.0)
        return 1.0;
    switch (law) {
    case gpu::kHistoryFrames: return length + 1.0;
    case gpu::kHistoryPower: return length * std::pow(1.0 - lambda, 10.0) + 1.0;
    default: return 1.0 / ((1.0 - alpha) * (1.0 - alpha) / length + alpha * alpha);
    }
}

/// History and the new frame blended. Schied et al. 2017, section 4.1; the weight is that of
/// Schied et al. 2018, section 4.4.
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
                lambda = fetchLambda(in.lambda, p, params.lambdaFetch);
            else if (params.lambdaSource == gpu::kLambdaFromRange)
                lambda = rangeLambda(*in.luminanceRange, p, history, params.percentileSlope);

            // Confidence shortens the history; otherwise lambda blends.
            const bool cuts = params.lambdaUse == gpu::kLambdaCuts;
            const double confidence = cuts ? (1.0 - lambda) * (1.0 - lambda) : 1.0;
            const double kept =
                history.length * glm::mix(confidence, 1.0, 1.0 / (1.0 + history.length));
            const double blend = cuts ? 0.0 : lambda;
            const auto adapted = [&](double alpha) {
                const double a = std::max(alpha, 1.0 / (kept + 1.0));
                return (1.0 - blend) * a + blend;
            };
            const double alpha = adapted(params.alpha);
            const double alphaMoments = adapted(params.alphaMoments);

            const double l = in.raw(p).a;
            const glm::dvec2 moments = glm::mix(history.moments, {l, l * l}, alphaMoments);
            const double length = std::min(double(params.maxHistory),
                                           nextLength(params.historyLaw, kept, alpha, blend));
            const glm::dvec3 color = clampHistory(in, params, p, history.color);
            out.accumulated(p) = glm::dvec4(glm::mix(color, glm::dvec3(in.raw(p)), alpha),
                                            history.length > 0.0 ? luminance(history.color) : 0.0);
            out.moments(p) = glm::dvec4(moments, length, 0.0);
            out.control(p) = glm::dvec4(lambda, alpha, length, history.reason);
        }
    return out;
}

} // namespace afterglow::reference
