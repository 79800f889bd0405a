#include "app/workbench/pixel_facts.h"

#include "renderer/filters/svgf_filter.h"
#include "renderer/image/color.h"
#include "shared/bindings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afterglow {
namespace {

constexpr int kStratum = int(gpu::kStratumSize);

// As shaders/lib/seed.glsl packs it.
PixelSeed unpackSeed(std::uint32_t seed) {
    return {{int(seed & 127u), int(seed >> 7 & 127u)}, seed >> 14};
}

/// Two numbers of 16 bits.
glm::ivec2 unpackPlace(std::uint32_t packed) {
    return {int(packed & 0xffffu), int(packed >> 16)};
}

glm::vec3 bitsAsFloats(const glm::uvec4& bits) {
    return {glm::uintBitsToFloat(bits.x), glm::uintBitsToFloat(bits.y),
            glm::uintBitsToFloat(bits.z)};
}

/// The four pixels around a position, and their bilinear weights, in the order of the shaders.
struct Corner {
    glm::ivec2 pixel{0};
    float weight = 0.0f;
};
std::array<Corner, 4> cornersAt(glm::vec2 position) {
    const glm::ivec2 first(glm::floor(position));
    const glm::vec2 f = position - glm::vec2(first);
    std::array<Corner, 4> corners;
    for (int i = 0; i < 4; ++i) {
        const glm::ivec2 place(i & 1, i >> 1);
        corners[std::size_t(i)] = {first + place, (place.x == 1 ? f.x : 1.0f - f.x) *
                                                      (place.y == 1 ? f.y : 1.0f - f.y)};
    }
    return corners;
}

/// shaders/denoise/temporal.comp, one pixel at a time.
class TemporalPixel {
public:
    TemporalPixel(const RenderTargets& shared, const ImageSet& own, const PixelFacts& facts)
        : t_(shared), own_(own), facts_(facts) {}

    std::optional<FetchedHistory> history() const {
        if (facts_.reason == gpu::kHistoryNone || facts_.motion.w == 0.0f)
            return {};
        FetchedHistory history;
        history.position = glm::clamp(glm::vec2(facts_.pixel) + glm::vec2(facts_.motion),
                                      glm::vec2(-4.0f), glm::vec2(t_.size) + 4.0f);
        float weights = 0.0f;
        const std::array<Corner, 4> corners = cornersAt(history.position);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto& [q, weight] = corners[i];
            history.taps[i] = {q, weight, reasonAt(q)};
            if (history.taps[i].reason != gpu::kHistoryKept || weight == 0.0f)
                continue;
            history.length += weight * own_.previous(svgf::kMoments).readAt<glm::vec4>(q).z;
            weights += weight;
        }
        history.length = weights < gpu::kLeastWeight ? 0.0f : history.length / weights;
        return history;
    }

    /// The stratum that lambda was fetched from, where it is that of one.
    std::optional<glm::ivec2> lambdaFrom() const {
        const int fetch = facts_.plan.temporal.lambdaFetch;
        if (fetch == gpu::kLambdaBilinear)
            return {};
        glm::ivec2 from = facts_.stratum;
        if (fetch == gpu::kLambdaNearest)
            return from;
        float largest = lambdaAt(from);
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const glm::ivec2 s =
                    glm::clamp(facts_.stratum + glm::ivec2(x, y), glm::ivec2(0), t_.strata - 1);
                if (const float lambda = lambdaAt(s); lambda > largest) {
                    largest = lambda;
                    from = s;
                }
            }
        return from;
    }

    /// Low and high end of the raw luminance around.
    glm::vec2 range() const {
        const float tileSize = float(gpu::kTileSize);
        const glm::vec2 position = (glm::vec2(facts_.pixel) + 0.5f) / tileSize - 0.5f;
        glm::vec2 sum(0.0f);
        float weights = 0.0f;
        for (const auto& [q, share] : cornersAt(position)) {
            const glm::ivec2 tile = glm::clamp(q, glm::ivec2(0), tilesOf(t_.size) - 1);
            const auto found = own_.find(svgf::kLuminanceRange)->readAt<glm::vec4>(tile);
            sum += share * found.z * glm::vec2(found);
            weights += share * found.z;
        }
        return sum / std::max(weights, 1e-6f);
    }

private:
    int reasonAt(glm::ivec2 q) const {
        if (q.x < 0 || q.y < 0 || q.x >= t_.size.x || q.y >= t_.size.y)
            return gpu::kHistoryOffScreen;
        if (t_.previousVisibility.readAt<glm::uvec4>(q).x != facts_.instance)
            return gpu::kHistoryInstance;
        const gpu::TemporalParams& params = facts_.plan.temporal;
        const float tolerance =
            params.depthTolerance * (std::abs(facts_.slope.x) + std::abs(facts_.slope.y)) +
            gpu::kDepthEpsilon * facts_.motion.z;
        const auto guide = t_.previousGuides.readAt<glm::vec4>(q);
        if (std::abs(guide.w - facts_.motion.z) > tolerance)
            return gpu::kHistoryDepth;
        return glm::dot(glm::vec3(guide), facts_.normal) >= params.normalTolerance
                   ? gpu::kHistoryKept
                   : gpu::kHistoryNormal;
    }
    float lambdaAt(glm::ivec2 s) const { return own_.find(svgf::kLambda)->readAt<float>(s); }

    const RenderTargets& t_;
    const ImageSet& own_;
    const PixelFacts& facts_;
};

void readSurface(const RenderTargets& t, PixelFacts& facts) {
    const glm::ivec2 p = facts.pixel;
    const auto seen = t.surfaces.visibility.readAt<glm::uvec4>(p);
    facts.instance = seen.x;
    facts.triangle = seen.y;
    facts.barycentrics = {glm::uintBitsToFloat(seen.z), glm::uintBitsToFloat(seen.w)};
    facts.position = bitsAsFloats(t.surfaces.surface.readAt<glm::uvec4>(p));
    const auto guide = t.surfaces.guides.readAt<glm::vec4>(p);
    facts.normal = glm::vec3(guide);
    facts.depth = guide.w;
    facts.slope = t.surfaces.slope.readAt<glm::vec2>(p);
    facts.motion = t.surfaces.motion.readAt<glm::vec4>(p);
    facts.albedo = glm::vec3(t.surfaces.albedo.readAt<glm::vec4>(p));
    facts.emission = glm::vec3(t.surfaces.emission.readAt<glm::vec4>(p));
    facts.seed = unpackSeed(t.seeds.current().readAt<std::uint32_t>(p));
}

void readSample(const RenderTargets& t, const SignalTargets& signal, PixelFacts& facts) {
    const auto stored = t.samples.readAt<glm::uvec4>(facts.stratum);
    facts.fate = stored.w;
    facts.offeredTo = unpackPlace(stored.x) / kStratum;
    if (stored.y == 0)
        return;
    const int place = int(stored.y) - 1;
    CarriedSample sample;
    sample.landing = facts.stratum * kStratum + glm::ivec2(place % kStratum, place / kStratum);
    sample.source = unpackPlace(stored.z);
    sample.before = signal.raw.previous().readAt<glm::vec4>(sample.source).a;
    if (!facts.hasExtraSamples)
        sample.now = signal.raw.current().readAt<glm::vec4>(sample.landing).a;
    else if (facts.plan.useLambda) // else nobody may have shaded it
        sample.now = signal.sampleRaw.readAt<glm::vec4>(facts.stratum).a;
    facts.sample = sample;
}

void readGradient(const ImageSet& own, PixelFacts& facts) {
    const auto measured = own.find(svgf::kGradientSamples)->readAt<glm::vec4>(facts.stratum);
    StratumGradient gradient;
    gradient.measured = glm::vec2(measured);
    gradient.reconstructed =
        facts.plan.gradientIterations > 0
            ? glm::vec2(own.find(svgf::kGradient0)->readAt<glm::vec4>(facts.stratum))
            : gradient.measured;
    gradient.mean = measured.z;
    gradient.variance = measured.w;
    gradient.lambda = own.find(svgf::kLambda)->readAt<float>(facts.stratum);
    facts.gradient = gradient;
}

void readHistory(const RenderTargets& t, const ImageSet& own, PixelFacts& facts) {
    const glm::ivec2 p = facts.pixel;
    const auto control = own.find(svgf::kControl)->readAt<glm::vec4>(p);
    facts.lambda = control.x;
    facts.alpha = control.y;
    facts.reason = int(control.w);
    const auto moments = own.find(svgf::kMoments)->readAt<glm::vec4>(p);
    facts.moments = glm::vec2(moments);
    facts.length = moments.z;
    facts.accumulated = own.find(svgf::blendOf(facts.plan))->readAt<glm::vec4>(p);
    facts.historyLuminance = facts.accumulated.a;
    if (!facts.isSurface())
        return;
    const TemporalPixel temporal(t, own, facts);
    facts.fetched = temporal.history();
    if (facts.plan.useLambda)
        facts.lambdaFrom = temporal.lambdaFrom();
    if (facts.plan.usePercentiles)
        facts.range = temporal.range();
}

} // namespace

int FetchedHistory::usedTaps() const {
    return int(std::ranges::count_if(taps, [](const HistoryTap& t) { return t.weight > 0.0f; }));
}
int FetchedHistory::validTaps() const {
    return int(std::ranges::count_if(taps, [](const HistoryTap& t) {
        return t.weight > 0.0f && t.reason == gpu::kHistoryKept;
    }));
}

PixelFacts pixelFacts(const Renderer& renderer, std::size_t state, const FrameSettings& settings,
                      glm::ivec2 pixel, std::size_t signal) {
    const RenderTargets& t = renderer.targets();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= t.size.x || pixel.y >= t.size.y)
        throw std::logic_error("the inspector looks at pixels of the picture only");
    const RanFilter* const ran = renderer.ran(state);
    if (!ran || !ran->svgf)
        throw std::logic_error("the inspector looks at filters that there are only");
    const SignalTargets& noisy = t.signals.at(signal);
    const ImageSet& own = t.filters[state].own.at(signal);
    PixelFacts facts;
    facts.settings = ran->settings;
    facts.plan = *ran->svgf;
    facts.hasExtraSamples =
        SamplePlacement(settings.lighting.gradientSamples) == SamplePlacement::Extra;
    facts.pixel = pixel;
    facts.stratum = pixel / kStratum;
    readSurface(t, facts);
    facts.raw = noisy.raw.current().readAt<glm::vec4>(pixel);
    if (facts.plan.carrySamples)
        readSample(t, noisy, facts);
    if (facts.plan.useLambda)
        readGradient(own, facts);
    if (facts.plan.accumulate)
        readHistory(t, own, facts);
    facts.filtered = renderer.filteredSignal(state, signal).readAt<glm::vec4>(pixel);
    facts.color = glm::vec3(t.filters[state].composed.readAt<glm::vec4>(pixel));
    return facts;
}

} // namespace afterglow
