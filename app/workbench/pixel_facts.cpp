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

/// Pixels of an image, [min, end) of it.
struct Box {
    glm::ivec2 min, end;
    glm::ivec2 size() const { return end - min; }
};

Box stratumBox(glm::ivec2 stratum, glm::ivec2 size) {
    return {stratum * kStratum, glm::min((stratum + 1) * kStratum, size)};
}
Box around(glm::ivec2 stratum, glm::ivec2 strata) {
    return {glm::max(stratum - 1, glm::ivec2(0)), glm::min(stratum + 2, strata)};
}

/// The position of a pixel's center in the image of tiles.
glm::vec2 tilePosition(glm::ivec2 pixel) {
    return (glm::vec2(pixel) + 0.5f) / float(gpu::kTileSize) - 0.5f;
}
/// The tiles that luminance ranges are interpolated between.
Box tileBox(glm::ivec2 pixel, glm::ivec2 size) {
    const glm::ivec2 first(glm::floor(tilePosition(pixel))), last = tilesOf(size) - 1;
    return {glm::clamp(first, glm::ivec2(0), last), glm::clamp(first + 1, glm::ivec2(0), last) + 1};
}

/// Assembles the facts of a pixel from a finished readback.
class Answer {
public:
    Answer(PixelFacts known, glm::ivec2 size, glm::ivec2 strata, const PixelQuery::Regions& at,
           const PixelReadback& readback)
        : f_(std::move(known)), size_(size), strata_(strata), at_(at), readback_(readback) {}

    PixelFacts facts() && {
        addSurface();
        if (f_.plan.carrySamples)
            addSample();
        if (f_.plan.useLambda)
            addGradient();
        if (f_.plan.accumulate)
            addHistory();
        f_.filtered = at(at_.filtered);
        f_.color = glm::vec3(at(at_.composed));
        return std::move(f_);
    }

private:
    template <class Pixel>
    Pixel at(const PixelReadback::Region<Pixel>& region, glm::ivec2 p = glm::ivec2(0)) const {
        return readback_.pixel(region, p);
    }
    glm::vec4 rawAt(glm::ivec2 pixel) const {
        return at(at_.raw, pixel - stratumBox(f_.stratum, size_).min);
    }
    float lambdaAt(glm::ivec2 stratum) const {
        return at(at_.lambda, stratum - around(f_.stratum, strata_).min);
    }

    void addSurface() {
        const glm::uvec4 seen = at(at_.visibility);
        f_.instance = seen.x;
        f_.triangle = seen.y;
        f_.barycentrics = {glm::uintBitsToFloat(seen.z), glm::uintBitsToFloat(seen.w)};
        f_.position = bitsAsFloats(at(at_.surface));
        const glm::vec4 guide = at(at_.guides);
        f_.normal = glm::vec3(guide);
        f_.depth = guide.w;
        f_.slope = at(at_.slope);
        f_.motion = at(at_.motion);
        f_.albedo = glm::vec3(at(at_.albedo));
        f_.emission = glm::vec3(at(at_.emission));
        f_.raw = rawAt(f_.pixel);
        f_.seed = unpackSeed(at(at_.seed));
    }

    void addSample() {
        const glm::uvec4 stored = at(at_.sample);
        f_.fate = stored.w;
        f_.offeredTo = unpackPlace(stored.x) / kStratum;
        if (stored.y == 0)
            return;
        const int place = int(stored.y) - 1;
        CarriedSample sample;
        sample.landing = f_.stratum * kStratum + glm::ivec2(place % kStratum, place / kStratum);
        sample.source = unpackPlace(stored.z);
        sample.before = HistoryTapsPass::pastOf(readback_, at_.past).sampleRaw.a;
        if (!f_.hasExtraSamples)
            sample.now = rawAt(sample.landing).a;
        else if (at_.extraRaw.size.x > 0) // else nobody may have shaded it
            sample.now = at(at_.extraRaw).a;
        f_.sample = sample;
    }

    void addGradient() {
        const glm::vec4 measured = at(at_.gradientSample);
        StratumGradient gradient;
        gradient.measured = glm::vec2(measured);
        gradient.reconstructed =
            f_.plan.gradientIterations > 0 ? glm::vec2(at(at_.gradient)) : gradient.measured;
        gradient.mean = measured.z;
        gradient.variance = measured.w;
        gradient.lambda = lambdaAt(f_.stratum);
        f_.gradient = gradient;
    }

    void addHistory() {
        const glm::vec4 control = at(at_.control);
        f_.lambda = control.x;
        f_.alpha = control.y;
        f_.reason = int(control.w);
        const glm::vec4 moments = at(at_.moments);
        f_.moments = glm::vec2(moments);
        f_.length = moments.z;
        f_.accumulated = at(at_.accumulated);
        f_.historyLuminance = f_.accumulated.a;
        if (!f_.isSurface())
            return;
        f_.fetched = history();
        if (f_.plan.useLambda)
            f_.lambdaFrom = lambdaFrom();
        if (f_.plan.usePercentiles)
            f_.range = range();
    }

    // From here on: shaders/denoise/temporal.comp, one pixel at a time.

    std::optional<FetchedHistory> history() const {
        if (f_.reason == gpu::kHistoryNone || f_.motion.w == 0.0f)
            return {};
        FetchedHistory history;
        history.position = glm::clamp(glm::vec2(f_.pixel) + glm::vec2(f_.motion), glm::vec2(-4.0f),
                                      glm::vec2(size_) + 4.0f);
        float weights = 0.0f;
        const std::array<Corner, 4> corners = cornersAt(history.position);
        const auto taps = HistoryTapsPass::pastOf(readback_, at_.past).taps;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto& [q, weight] = corners[i];
            history.taps[i] = {q, weight, reasonAt(q, taps[i])};
            if (history.taps[i].reason != gpu::kHistoryKept || weight == 0.0f)
                continue;
            history.length += weight * taps[i].moments.z;
            weights += weight;
        }
        history.length = weights < gpu::kLeastWeight ? 0.0f : history.length / weights;
        return history;
    }

    int reasonAt(glm::ivec2 q, const HistoryTapsPass::Tap& tap) const {
        if (q.x < 0 || q.y < 0 || q.x >= size_.x || q.y >= size_.y)
            return gpu::kHistoryOffScreen;
        if (tap.instance != f_.instance)
            return gpu::kHistoryInstance;
        const gpu::TemporalParams& params = f_.plan.temporal;
        const float tolerance =
            params.depthTolerance * (std::abs(f_.slope.x) + std::abs(f_.slope.y)) +
            gpu::kDepthEpsilon * f_.motion.z;
        if (std::abs(tap.guides.w - f_.motion.z) > tolerance)
            return gpu::kHistoryDepth;
        return glm::dot(glm::vec3(tap.guides), f_.normal) >= params.normalTolerance
                   ? gpu::kHistoryKept
                   : gpu::kHistoryNormal;
    }

    /// The stratum that lambda was fetched from, where it is that of one.
    std::optional<glm::ivec2> lambdaFrom() const {
        const int fetch = f_.plan.temporal.lambdaFetch;
        if (fetch == gpu::kLambdaBilinear)
            return {};
        glm::ivec2 from = f_.stratum;
        if (fetch == gpu::kLambdaNearest)
            return from;
        float largest = lambdaAt(from);
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const glm::ivec2 s =
                    glm::clamp(f_.stratum + glm::ivec2(x, y), glm::ivec2(0), strata_ - 1);
                if (const float lambda = lambdaAt(s); lambda > largest) {
                    largest = lambda;
                    from = s;
                }
            }
        return from;
    }

    /// Low and high end of the raw luminance around.
    glm::vec2 range() const {
        const Box tiles = tileBox(f_.pixel, size_);
        glm::vec2 sum(0.0f);
        float weights = 0.0f;
        for (const auto& [q, share] : cornersAt(tilePosition(f_.pixel))) {
            const glm::ivec2 tile = glm::clamp(q, tiles.min, tiles.end - 1);
            const glm::vec4 found = at(at_.luminanceRange, tile - tiles.min);
            sum += share * found.z * glm::vec2(found);
            weights += share * found.z;
        }
        return sum / std::max(weights, 1e-6f);
    }

    PixelFacts f_;
    glm::ivec2 size_, strata_;
    const PixelQuery::Regions& at_;
    const PixelReadback& readback_;
};

} // namespace

int FetchedHistory::usedTaps() const {
    return int(std::ranges::count_if(taps, [](const HistoryTap& t) { return t.weight > 0.0f; }));
}
int FetchedHistory::validTaps() const {
    return int(std::ranges::count_if(taps, [](const HistoryTap& t) {
        return t.weight > 0.0f && t.reason == gpu::kHistoryKept;
    }));
}

void PixelQuery::ask(Renderer& renderer, std::size_t state, const FrameSettings& settings,
                     glm::ivec2 pixel, std::size_t signal, PixelReadback& readback) {
    const RenderTargets& t = renderer.targets();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= t.size.x || pixel.y >= t.size.y)
        throw std::logic_error("the inspector looks at pixels of the picture only");
    const RanFilter* const ran = renderer.ran(state);
    if (!ran)
        throw std::logic_error("the inspector looks at filters that there are only");
    const SvgfPlan plan = ran->planOrNone();
    const Surfaces& seen = t.surfaces;
    const SignalTargets& noisy = t.signals.at(signal);
    const ImageSet& own = t.filters[state].own.at(signal);
    known_ = {};
    known_.settings = ran->settings;
    known_.plan = plan;
    known_.hasExtraSamples =
        SamplePlacement(settings.lighting.gradientSamples) == SamplePlacement::Extra;
    known_.pixel = pixel;
    known_.stratum = pixel / kStratum;
    size_ = t.size;
    strata_ = t.strata;
    at_ = {};

    const auto get = [&]<class Pixel>(PixelReadback::Region<Pixel>& region,
                                      const GpuTexture& texture, Box box) {
        region = readback.add<Pixel>(texture, box.min, box.size());
    };
    const Box here{pixel, pixel + 1}, stratum{known_.stratum, known_.stratum + 1};
    get(at_.visibility, seen.visibility, here);
    get(at_.surface, seen.surface, here);
    get(at_.guides, seen.guides, here);
    get(at_.slope, seen.slope, here);
    get(at_.motion, seen.motion, here);
    get(at_.albedo, seen.albedo, here);
    get(at_.emission, seen.emission, here);
    get(at_.raw, noisy.raw.current(), stratumBox(known_.stratum, size_));
    get(at_.seed, t.seeds.current(), here);
    get(at_.filtered, renderer.filteredSignal(state, signal), here);
    get(at_.composed, t.filters[state].composed, here);
    if (plan.carrySamples)
        get(at_.sample, t.samples, stratum);
    if (plan.carrySamples && plan.useLambda && known_.hasExtraSamples)
        get(at_.extraRaw, noisy.sampleRaw, stratum);
    if (plan.useLambda) {
        get(at_.gradientSample, *own.find(svgf::kGradientSamples), stratum);
        if (plan.gradientIterations > 0)
            get(at_.gradient, *own.find(svgf::kGradient0), stratum);
        get(at_.lambda, *own.find(svgf::kLambda), around(known_.stratum, strata_));
    }
    if (plan.accumulate) {
        get(at_.control, *own.find(svgf::kControl), here);
        get(at_.moments, *own.find(svgf::kMoments), here);
        get(at_.accumulated, *own.find(svgf::blendOf(plan)), here);
    }
    if (plan.accumulate && plan.usePercentiles)
        get(at_.luminanceRange, *own.find(svgf::kLuminanceRange), tileBox(pixel, size_));
    if (!plan.accumulate && !plan.carrySamples)
        return;
    FrameContext context{renderer.timer()};
    past_.run(context,
              {seen.motion, t.samples, t.previousVisibility, t.previousGuides,
               own.previous(svgf::kMoments), noisy.raw.previous()},
              pixel);
    at_.past = past_.copyTo(readback);
}

PixelFacts PixelQuery::answer(const PixelReadback& readback) const {
    return Answer(known_, size_, strata_, at_, readback).facts();
}

} // namespace afterglow
