// SPDX-License-Identifier: MIT
#include "app/workbench/pixel_facts.h"

#include "renderer/filters/svgf_filter.h"
#include "shared/bindings.h"

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

double numberOf(float value, int, bool) {
    return value;
}
template <glm::length_t count>
double numberOf(const glm::vec<count, float>& value, int channel, bool) {
    return value[channel];
}
double numberOf(const glm::uvec4& value, int channel, bool isFloatBits) {
    return isFloatBits ? double(glm::uintBitsToFloat(value[channel])) : double(value[channel]);
}

} // namespace

PixelQuery::Texel PixelQuery::texelOf(const AovInfo& aov, const AovSource& source, glm::ivec2 texel,
                                      PixelReadback& readback) {
    Texel result{&aov, source.channel, source.isFloatBits, {}};
    switch (source.texture.format()) {
    case PixelFormat::R32F: result.at = readback.add<float>(source.texture, texel); break;
    case PixelFormat::RG32F: result.at = readback.add<glm::vec2>(source.texture, texel); break;
    case PixelFormat::RGBA32F: result.at = readback.add<glm::vec4>(source.texture, texel); break;
    default: result.at = readback.add<glm::uvec4>(source.texture, texel);
    }
    return result;
}

void PixelQuery::ask(Renderer& renderer, std::size_t state, glm::ivec2 pixel, std::size_t signal,
                     PixelReadback& readback) {
    const RenderTargets& t = renderer.targets();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= t.size.x || pixel.y >= t.size.y)
        throw std::logic_error("the inspector looks at pixels of the picture only");
    auto [context, in, own] = renderer.filterCall(state, signal);
    const RanFilter& ran = *renderer.ran(state);
    const SvgfPlan plan = ran.planOrNone();
    const glm::ivec2 stratum = pixel / kStratum;
    known_ = {};
    known_.plan = plan;
    known_.samplesBeside = in.samplesBeside;
    known_.pixel = pixel;
    known_.stratum = stratum;

    at_ = {};
    at_.visibility = readback.add<glm::uvec4>(t.surfaces.visibility, pixel);
    at_.raw = readback.add<glm::vec4>(in.signal.raw.current(), pixel);
    at_.seed = readback.add<std::uint32_t>(t.seeds.current(), pixel);
    for (const AovInfo& aov : aovs())
        if (isMadeBy(aov, ran.settings))
            at_.images.push_back(texelOf(aov, sourceOf(renderer, aov, state, signal),
                                         aov.perStratum ? stratum : pixel, readback));
    if (plan.carrySamples)
        at_.sample = readback.add<glm::uvec4>(t.samples, stratum);
    // Samples beside the picture are shaded for filters that use them.
    if (plan.carrySamples && (plan.useLambda || !in.samplesBeside))
        at_.gradient =
            gradient_.inspect(context, svgf::gradientInputs(in), plan.gradient, stratum, readback);
    if (plan.accumulate)
        at_.temporal = temporal_.inspect(context, svgf::temporalInputs(in, own),
                                         svgf::temporalParams(in, plan), pixel, readback);
}

PixelFacts PixelQuery::answer(const PixelReadback& readback) const {
    PixelFacts facts = known_;
    const glm::uvec4 seen = readback.pixel(at_.visibility);
    facts.instance = seen.x;
    facts.triangle = seen.y;
    facts.barycentrics = {glm::uintBitsToFloat(seen.z), glm::uintBitsToFloat(seen.w)};
    facts.rawLuminance = readback.pixel(at_.raw).a;
    facts.seed = unpackSeed(readback.pixel(at_.seed));
    for (const Texel& texel : at_.images)
        for (std::size_t i = 0; i < texel.aov->channels.size(); ++i)
            facts.images[texel.aov->name].push_back(std::visit(
                [&](const auto& region) {
                    return numberOf(readback.pixel(region), texel.channel + int(i),
                                    texel.isFloatBits);
                },
                texel.at));
    if (facts.plan.carrySamples) {
        const glm::uvec4 stored = readback.pixel(at_.sample);
        facts.fate = stored.w;
        facts.offeredTo = unpackPlace(stored.x) / kStratum;
        if (stored.y != 0) {
            const int place = int(stored.y) - 1;
            facts.sample = {facts.stratum * kStratum +
                                glm::ivec2(place % kStratum, place / kStratum),
                            unpackPlace(stored.z)};
        }
    }
    if (at_.gradient)
        facts.gradient = readback.pixel(*at_.gradient);
    if (at_.temporal)
        facts.temporal = readback.pixel(*at_.temporal);
    return facts;
}

} // namespace afterglow
