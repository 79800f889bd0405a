#include "renderer/pipeline/aov.h"

#include "renderer/base/error.h"

#include <array>

namespace afterglow {

namespace {

using Pixels = Image<glm::vec4>;

template <class Pixel, class Convert>
Pixels convert(const Image<Pixel>& from, Convert&& pixel) {
    Pixels to(from.size());
    for (std::size_t i = 0; i < to.pixels().size(); ++i)
        to.pixels()[i] = pixel(from.pixels()[i]);
    return to;
}

Pixels channelsOf(const GpuTexture& texture, int first, int count) {
    return convert(texture.read<glm::vec4>(), [=](const glm::vec4& p) {
        glm::vec4 kept(0.0f);
        for (int i = 0; i < count; ++i)
            kept[i] = p[first + i];
        return kept;
    });
}

struct Row {
    AovInfo info;
    Pixels (*read)(const Renderer&);
    bool (*madeBy)(const DenoisePlan&);
};

bool always(const DenoisePlan&) {
    return true;
}
bool whereAccumulated(const DenoisePlan& plan) {
    return plan.accumulate;
}
bool whereFiltered(const DenoisePlan& plan) {
    return plan.atrousIterations > 0;
}
bool whereAdaptive(const DenoisePlan& plan) {
    return plan.useLambda;
}
bool whereCarried(const DenoisePlan& plan) {
    return plan.carrySamples;
}
// With nothing fed back from the spatial filter the blend is the history itself.
bool whereBlendIsKept(const DenoisePlan& plan) {
    return plan.feedbackIteration > 0;
}

const std::array kRows{
    Row{{.name = "color",
         .meaning = "linear radiance: the filtered signal times albedo, plus emission",
         .channels = "RGB"},
        [](const Renderer& r) { return channelsOf(r.targets().composed, 0, 3); },
        always},
    Row{{.name = "filtered",
         .meaning = "the signal after the filter, without albedo, radiance",
         .channels = "RGB"},
        [](const Renderer& r) { return channelsOf(r.filteredSignal(), 0, 3); },
        always},
    Row{{.name = "raw",
         .meaning = "the signal as traced, one sample a pixel, without albedo, radiance",
         .channels = "RGB"},
        [](const Renderer& r) { return channelsOf(r.targets().raw.current(), 0, 3); },
        always},
    Row{{.name = "accumulated",
         .meaning = "the signal after temporal and before spatial filtering, radiance",
         .channels = "RGB",
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.targets().accumulated, 0, 3); },
        whereBlendIsKept},
    Row{{.name = "variance",
         .meaning = "variance of the filtered signal's luminance, as estimated, radiance squared",
         .channels = "Y",
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.filteredSignal(), 3, 1); },
        whereFiltered},
    Row{{.name = "albedo",
         .meaning = "diffuse reflectance of the surface, [0, 1]",
         .channels = "RGB"},
        [](const Renderer& r) { return channelsOf(r.targets().albedo, 0, 3); },
        always},
    Row{{.name = "emission",
         .meaning = "what the surface itself emits, radiance",
         .channels = "RGB"},
        [](const Renderer& r) { return channelsOf(r.targets().emission, 0, 3); },
        always},
    Row{{.name = "normal", .meaning = "world-space shading normal, unit length", .channels = "XYZ"},
        [](const Renderer& r) { return channelsOf(r.targets().guides.current(), 0, 3); },
        always},
    Row{{.name = "depth",
         .meaning = "distance along the view axis, metres; 0 is background",
         .channels = "Y"},
        [](const Renderer& r) { return channelsOf(r.targets().guides.current(), 3, 1); },
        always},
    Row{{.name = "position", .meaning = "of the surface in the world, metres", .channels = "XYZ"},
        [](const Renderer& r) {
            return convert(r.targets().surface.read<glm::uvec4>(), [](const glm::uvec4& p) {
                return glm::vec4(glm::uintBitsToFloat(glm::uvec3(p)), 0.0f);
            });
        },
        always},
    Row{{.name = "slope",
         .meaning = "change of depth along x and y, metres per pixel",
         .channels = "XY"},
        [](const Renderer& r) {
            return convert(r.targets().slope.read<glm::vec2>(),
                           [](const glm::vec2& p) { return glm::vec4(p, 0.0f, 0.0f); });
        },
        always},
    Row{{.name = "motion",
         .meaning = "from the pixel to where its surface was a frame ago, pixels",
         .channels = "XY"},
        [](const Renderer& r) { return channelsOf(r.targets().motion, 0, 2); },
        always},
    Row{{.name = "instance",
         .meaning = "number of the instance from 1; 0 is background",
         .channels = "Y"},
        [](const Renderer& r) {
            return convert(r.targets().visibility.current().read<glm::uvec4>(),
                           [](const glm::uvec4& p) { return glm::vec4(float(p.x), 0, 0, 0); });
        },
        always},
    Row{{.name = "moments",
         .meaning = "running means of the raw luminance and of its square",
         .channels = "XY",
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.targets().moments.current(), 0, 2); },
        whereAccumulated},
    Row{{.name = "history",
         .meaning = "effective length of the history, frames",
         .channels = "Y",
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.targets().moments.current(), 2, 1); },
        whereAccumulated},
    Row{{.name = "alpha",
         .meaning = "weight of the newest frame in the blend, [0, 1]",
         .channels = "Y",
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.targets().control, 1, 1); },
        whereAccumulated},
    Row{{.name = "reason",
         .meaning = "why there is no history: 0 there is, 1 first frame, 2 off screen, 3 another "
                    "instance, 4 depth, 5 normal",
         .channels = "Y",
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.targets().control, 3, 1); },
        whereAccumulated},
    Row{{.name = "lambda",
         .meaning = "relative temporal change as fetched at the pixel, [0, 1]",
         .channels = "Y",
         .needsGradient = true,
         .needsHistory = true},
        [](const Renderer& r) { return channelsOf(r.targets().control, 0, 1); },
        whereAdaptive},
    Row{{.name = "lambda-strata",
         .meaning = "relative temporal change per stratum of 3x3 pixels, [0, 1]",
         .channels = "Y",
         .perStratum = true,
         .needsGradient = true},
        [](const Renderer& r) {
            return convert(r.targets().lambda.read<float>(),
                           [](float p) { return glm::vec4(p, 0.0f, 0.0f, 0.0f); });
        },
        whereAdaptive},
    Row{{.name = "gradient",
         .meaning = "change of luminance at each stratum's sample and the larger of the two "
                    "luminances, as measured, radiance",
         .channels = "XY",
         .perStratum = true,
         .needsGradient = true},
        [](const Renderer& r) { return channelsOf(r.targets().gradientSamples, 0, 2); },
        whereAdaptive},
    Row{{.name = "samples",
         .meaning = "where in the stratum its gradient sample landed, 1 + x + 3y; 0 is none",
         .channels = "Y",
         .perStratum = true,
         .needsGradient = true},
        [](const Renderer& r) {
            return convert(r.targets().samples.read<glm::uvec4>(),
                           [](const glm::uvec4& p) { return glm::vec4(float(p.y), 0, 0, 0); });
        },
        whereCarried},
};

const std::array kInfos = [] {
    std::array<AovInfo, kRows.size()> infos;
    for (std::size_t i = 0; i < kRows.size(); ++i)
        infos[i] = kRows[i].info;
    return infos;
}();

const Row& rowOf(const AovInfo& aov) {
    for (const Row& row : kRows)
        if (row.info.name == aov.name)
            return row;
    throw std::logic_error("no AOV named " + std::string(aov.name));
}

} // namespace

std::span<const AovInfo> aovs() {
    return kInfos;
}

const AovInfo& aovByName(std::string_view name) {
    std::vector<std::string_view> known;
    for (const AovInfo& aov : kInfos) {
        if (aov.name == name)
            return aov;
        known.push_back(aov.name);
    }
    throwUnknownName("AOV", name, known);
}

bool isMadeBy(const AovInfo& aov, Filter filter, const DenoiserSettings& settings) {
    return rowOf(aov).madeBy(makePlan(filter, settings));
}

Image<glm::vec4> readAov(const Renderer& renderer, const AovInfo& aov) {
    return rowOf(aov).read(renderer);
}

} // namespace afterglow
