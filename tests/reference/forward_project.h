// SPDX-License-Identifier: MIT
#pragma once

#include "shared/denoise_params.h"
#include "tests/reference/random.h"
#include "tests/reference/surface.h"

// Forward projection: docs/pipeline.md. Schied et al. 2018, section 4.1.

namespace afterglow::reference {

struct ForwardInputs {
    const SceneView& scene; ///< of frame i
    const View& view;
    const Image<glm::uvec4>& previousVisibility;
    const Image<std::uint32_t>& previousSeeds;
    const Image<glm::uvec4>& visibility; ///< of frame i, before anything is merged into it
    const Image<std::uint32_t>& seeds;   ///< likewise
    std::uint32_t frame;                 ///< i
    std::uint32_t runSeed;
};

/// Why a candidate came to nothing.
enum class Fate {
    Background,
    WasGradient,
    NoInstance,
    OffScreen,
    OtherInstance,
    OtherDepth,
    Landed
};
constexpr int kFates = 7;

/// As the program calls it, before the race is decided.
inline std::uint32_t codeOf(Fate fate) {
    switch (fate) {
    case Fate::Background: return gpu::kFateBackground;
    case Fate::WasGradient: return gpu::kFateWasSample;
    case Fate::OffScreen: return gpu::kFateOffScreen;
    case Fate::NoInstance:
    case Fate::OtherInstance: return gpu::kFateInstance;
    case Fate::OtherDepth: return gpu::kFateDepth;
    case Fate::Landed: return gpu::kFateCarried;
    }
    return gpu::kFateNone;
}

/// What becomes of the candidate of one stratum.
struct Candidate {
    glm::ivec2 source{0};
    Fate fate = Fate::Background;
    glm::ivec2 landing{0};
    glm::dvec2 place{0.0}; ///< where it lands, in pixels
    std::uint32_t key = 0;
    bool doubtful = false; ///< so near a threshold that 32 bits may decide otherwise
};

struct ForwardResult {
    Image<glm::uvec4> samples, visibility;
    Image<std::uint32_t> seeds;
    Image<std::uint8_t> doubtful;     ///< strata in which a doubtful candidate landed, or may have
    Image<std::uint8_t> doubtfulFate; ///< strata whose own candidate may have had another fate
    int fates[kFates] = {};
    int contested = 0; ///< strata in which more than one candidate landed
    int doubts = 0;    ///< doubtful candidates
};

/// The nearest that a decision may come to its threshold: pixels.
constexpr double kLandingMargin = 1e-3;

inline Candidate follow(const ForwardInputs& in, glm::ivec2 stratum) {
    const glm::ivec2 size = in.visibility.size(), strata = (size + 2) / 3;
    const glm::ivec2 first = 3 * stratum, extent = glm::min(size - first, glm::ivec2(3));
    const std::uint32_t pixels = std::uint32_t(extent.x * extent.y);
    const std::uint32_t number =
        hash3(std::uint32_t(stratum.x) | std::uint32_t(stratum.y) << 16, in.frame - 1, in.runSeed) %
        pixels;
    Candidate out;
    out.source = first + glm::ivec2(int(number) % extent.x, int(number) / extent.x);
    out.key = mixBits(std::uint32_t(stratum.y * strata.x + stratum.x) ^ mixBits(in.frame));

    const glm::uvec4 sample = in.previousVisibility(out.source);
    if (sample.x == 0)
        return out;
    if (unpackSeed(in.previousSeeds(out.source)).frame != (in.frame - 1) % (1u << 18)) {
        out.fate = Fate::WasGradient;
        return out;
    }
    if (sample.x > in.scene.instances()) {
        out.fate = Fate::NoInstance;
        return out;
    }

    const glm::dvec3 point = pointOf(in.scene, sample);
    const glm::dvec4 c = in.view.clip(point);
    const double pixelOfClip = 2.0 / std::max(size.x, size.y);
    out.fate = Fate::OffScreen;
    // The distance, in pixels, to the nearest side of the frustum.
    const double toSide = std::min(c.w - std::abs(c.x), c.w - std::abs(c.y)) / std::abs(c.w);
    out.doubtful = std::abs(toSide) < kLandingMargin * pixelOfClip || std::abs(c.w) < 1e-6 ||
                   std::abs(c.w - c.z) < 1e-6 * in.view.near;
    if (c.w <= 0.0) {
        out.doubtful = std::abs(c.w) < 1e-6;
        return out;
    }
    out.place = in.view.pixel(point);
    if (!(std::abs(c.x) < c.w && std::abs(c.y) < c.w && c.z >= 0.0 && c.z <= c.w))
        return out;
    out.landing = glm::ivec2(glm::floor(out.place));
    const glm::dvec2 part = out.place - glm::floor(out.place);
    out.doubtful =
        out.doubtful || std::min({part.x, part.y, 1.0 - part.x, 1.0 - part.y}) < kLandingMargin;

    const glm::uvec4 seen = in.visibility(out.landing);
    out.fate = Fate::OtherInstance;
    if (seen.x != sample.x)
        return out;
    const Triangle& triangle = in.scene.at(seen.x - 1, seen.y);
    const glm::dvec3 ray = in.view.ray(out.place);
    const double facing = std::abs(glm::dot(triangle.front, glm::normalize(ray)));
    const auto hit = meetPlane(triangle, in.view.eye, ray);
    // Where "edge-on" begins, the text does not say.
    const bool edgeOn = facing < 1e-3 || !hit;
    const double depth = edgeOn ? in.view.depth(pointOf(in.scene, seen)) : hit->t;
    const double difference = std::abs(depth - c.w) / c.w;
    out.doubtful = out.doubtful || edgeOn || std::abs(difference - 0.01) < 1e-5 + 1e-6 / facing;
    out.fate = difference <= 0.01 ? Fate::Landed : Fate::OtherDepth;
    return out;
}

/// All strata. `frame` must have one before it.
inline ForwardResult forwardProject(const ForwardInputs& in) {
    const glm::ivec2 size = in.visibility.size(), strata = (size + 2) / 3;
    ForwardResult out{Image<glm::uvec4>(strata, glm::uvec4(0u)), in.visibility, in.seeds,
                      Image<std::uint8_t>(strata, 0), Image<std::uint8_t>(strata, 0)};
    Image<Candidate> offered(strata);
    Image<std::uint32_t> best(strata, 0u);
    Image<Candidate> winner(strata);
    for (int y = 0; y < strata.y; ++y)
        for (int x = 0; x < strata.x; ++x) {
            const Candidate candidate = offered({x, y}) = follow(in, {x, y});
            ++out.fates[int(candidate.fate)];
            if (candidate.doubtful) {
                ++out.doubts;
                for (const glm::dvec2 step : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
                    const glm::ivec2 q(glm::floor(candidate.place + step * kLandingMargin));
                    if (in.visibility.contains(q))
                        out.doubtful(q / 3) = 1;
                }
            }
            if (candidate.fate != Fate::Landed || candidate.key == 0)
                continue;
            const glm::ivec2 target = candidate.landing / 3;
            out.contested += best(target) != 0;
            if (candidate.key > best(target)) {
                best(target) = candidate.key;
                winner(target) = candidate;
            }
        }
    for (int y = 0; y < strata.y; ++y)
        for (int x = 0; x < strata.x; ++x) {
            const glm::ivec2 s{x, y};
            const Candidate& own = offered(s);
            const bool landed = own.fate == Fate::Landed;
            const bool lost = landed && own.key != best(own.landing / 3);
            out.samples(s).w = lost ? gpu::kFateLostRace : codeOf(own.fate);
            const bool fell =
                landed || own.fate == Fate::OtherInstance || own.fate == Fate::OtherDepth;
            const auto packed = [](glm::ivec2 p) {
                return std::uint32_t(p.x) | std::uint32_t(p.y) << 16;
            };
            out.samples(s).x = fell ? packed(own.landing) : 0u;
            out.doubtfulFate(s) = own.doubtful || (landed && out.doubtful(own.landing / 3)) ? 1 : 0;
            if (best(s) == 0)
                continue;
            const Candidate& from = winner(s);
            const glm::ivec2 q = from.landing, part = q - 3 * s;
            out.visibility(q) = in.previousVisibility(from.source);
            out.seeds(q) = in.previousSeeds(from.source);
            out.samples(s).y = std::uint32_t(1 + part.x + 3 * part.y);
            out.samples(s).z = packed(from.source);
        }
    return out;
}

} // namespace afterglow::reference
