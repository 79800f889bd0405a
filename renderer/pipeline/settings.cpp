// SPDX-License-Identifier: MIT
#include "renderer/pipeline/settings.h"

#include "renderer/base/error.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

constexpr std::array<std::string_view, 2> kKernelNames{"b3-5x5", "box-3x3"};
constexpr std::array<std::string_view, 4> kLambdaFetchNames{"nearest", "bilinear", "max", "light"};
constexpr std::array<std::string_view, 3> kHistoryLawNames{"effective", "frames", "power"};
constexpr std::array<std::string_view, 2> kLambdaUseNames{"blend", "confidence"};
constexpr std::array<std::string_view, 2> kMagnitudeNames{"signed", "absolute"};
constexpr std::array<std::string_view, 2> kChangeOfNames{"luminance", "channels"};
constexpr std::array<std::string_view, 2> kStrideNames{"doubling", "linear"};
constexpr std::array<std::string_view, 2> kPlacementNames{"merged", "extra"};
constexpr std::array<std::string_view, 4> kToneMapperNames{"aces", "agx", "neutral", "none"};
constexpr std::array<std::string_view, 2> kAntiAliasingNames{"off", "taa"};
constexpr std::array<std::string_view, 2> kTaaOrderNames{"before", "after"};
constexpr std::array<std::string_view, 2> kSwitchNames{"off", "on"};

constexpr std::string_view kSvgf = "Schied et al. 2017";
constexpr std::string_view kAsvgf = "Schied et al. 2018";
constexpr std::string_view kMeasured = "own choice, by measurement";

// Three or four lines a tunable. A test walks the table and the structs and fails when a member is
// missing. clang-format would break it into one value a line.
// clang-format off
#define AFTERGLOW_FIELD(member) [](FilterSettings& s) -> Field::Ref { return &s.member; }
#define AFTERGLOW_FRAME_FIELD(member) nullptr, [](FrameSettings& s) -> Field::Ref { return &s.member; }
const std::array kFields = std::to_array<Field>({
    {"temporal", "alpha", "Alpha",
     "Weight of the newest frame where nothing changed: small means little noise and much "
     "lag.",
     "", kSvgf, 0.005, 1.0, true, {}, AFTERGLOW_FIELD(denoiser.temporal.alpha)},
    {"temporal", "alphaMoments", "Alpha of the moments",
     "The same for the moments of luminance, from which the variance is estimated.",
     "", kSvgf, 0.005, 1.0, true, {}, AFTERGLOW_FIELD(denoiser.temporal.alphaMoments)},
    {"temporal", "maxHistory", "Longest history",
     "The history length is counted up to this.",
     "frames", "own choice", 1.0, 1024.0, true, {}, AFTERGLOW_FIELD(denoiser.temporal.maxHistory)},
    {"temporal", "historyLaw", "History law",
     "How the history length follows alpha: the effective sample count, frames whatever "
     "lambda is (Q2VKPT), or frames cut by the tenth power of 1 - lambda before alpha is taken "
     "from them (Q2RTX).",
     "", "Q2RTX; chosen by measurement, docs/results.md", 0.0, 2.0, false, kHistoryLawNames,
     AFTERGLOW_FIELD(denoiser.temporal.historyLaw)},
    {"temporal", "depthTolerance", "Depth tolerance",
     "A surface is the same one as before if its depth differs by at most this many times "
     "the change that its slope predicts over a pixel.",
     "", "own choice", 0.1, 10.0, true, {}, AFTERGLOW_FIELD(denoiser.temporal.depthTolerance)},
    {"temporal", "normalTolerance", "Normal tolerance",
     "Least cosine between the normals of a surface in two frames.",
     "", "own choice", 0.0, 1.0, false, {}, AFTERGLOW_FIELD(denoiser.temporal.normalTolerance)},
    {"temporal", "minHistory", "Shortest history for variance",
     "Below this the variance is estimated in space.",
     "frames", kSvgf, 1.0, 16.0, false, {}, AFTERGLOW_FIELD(denoiser.minHistory)},
    {"temporal", "varianceExponent", "Variance exponent",
     "The variance that guides the spatial filter is that of one sample over the history length to "
     "this power: 0 as published, 1 that of the mean of independent samples. Of filter counted, and "
     "with the history law effective.",
     "", kMeasured, 0.0, 2.0, false, {}, AFTERGLOW_FIELD(denoiser.varianceExponent)},
    {"temporal", "shortHistoryBoost", "Short-history boost",
     "The variance is larger by this over the squared history length: fewer specks in the first "
     "frames after an event, a softer picture there.",
     "", kMeasured, 0.0, 32.0, false, {}, AFTERGLOW_FIELD(denoiser.shortHistoryBoost)},
    {"temporal", "lambdaUse", "Lambda use",
     "What lambda does: it blends alpha towards 1, or its complement squared is a confidence "
     "that cuts the history length (NRD; always so in the filter confidence).",
     "", kAsvgf, 0.0, 1.0, false, kLambdaUseNames, AFTERGLOW_FIELD(denoiser.temporal.lambdaUse)},
    {"temporal", "clampSigmas", "Clamp",
     "Filter clamp (Karis 2014, Salvi 2016): how far a history may be from the mean of the raw "
     "signal around.",
     "standard deviations", kMeasured, 0.1, 8.0, true, {},
     AFTERGLOW_FIELD(denoiser.temporal.clampSigmas)},
    {"temporal", "clampRadius", "Clamp radius",
     "Filter clamp: the mean is taken over (2 r + 1)^2 pixels.",
     "pixels", kMeasured, 0.0, 8.0, false, {}, AFTERGLOW_FIELD(denoiser.temporal.clampRadius)},
    {"temporal", "lowPercentile", "Low percentile",
     "Filter percentile (after merian): a history darker than this share of the raw pixels of "
     "its 8x8 tile has changed.",
     "", kMeasured, 0.0, 1.0, false, {}, AFTERGLOW_FIELD(denoiser.percentiles.lowPercentile)},
    {"temporal", "highPercentile", "High percentile",
     "Filter percentile: a history brighter than this share of them has changed.",
     "", kMeasured, 0.0, 1.0, false, {}, AFTERGLOW_FIELD(denoiser.percentiles.highPercentile)},
    {"temporal", "percentileSlope", "Percentile slope",
     "Filter percentile: lambda for each width of the range that a history is outside of it.",
     "", kMeasured, 0.05, 64.0, true, {}, AFTERGLOW_FIELD(denoiser.temporal.percentileSlope)},

    {"counted", "reactivity", "Reactivity",
     "Filter counted: how many pixels the spatial filter averages afterwards. More means less lag, "
     "and more noise after a change.",
     "pixels", kMeasured, 20.0, 2000.0, true, {}, AFTERGLOW_FIELD(denoiser.temporal.reactivity)},
    {"counted", "historyDuringChange", "History during a change",
     "Filter counted: while light changes anywhere, no history counts for more.",
     "samples", kMeasured, 1.0, 1024.0, true, {},
     AFTERGLOW_FIELD(denoiser.temporal.historyDuringChange)},
    {"counted", "historyBetweenPixels", "History between pixels",
     "Filter counted: a history that is interpolated counts for no more, since it is blurred again "
     "and again.",
     "samples", kMeasured, 1.0, 1024.0, true, {},
     AFTERGLOW_FIELD(denoiser.temporal.historyBetweenPixels)},
    {"counted", "countReusedOnce", "Count reused samples once",
     "Filter counted: a gradient sample that is in the history already adds nothing to it.",
     "", kMeasured, 0.0, 1.0, false, kSwitchNames,
     AFTERGLOW_FIELD(denoiser.temporal.countReusedOnce)},
    {"counted", "scaleHistory", "Scale the history",
     "Filter counted: where one factor explains a change, a lamp that is dimmed, the history is "
     "multiplied by it and kept.",
     "", kMeasured, 0.0, 1.0, false, kSwitchNames, AFTERGLOW_FIELD(denoiser.scaleHistory)},
    {"counted", "scaleDoubt", "Doubt of the factor",
     "Filter counted: how much what that factor does not explain speaks against it.",
     "", kMeasured, 0.1, 1000.0, true, {}, AFTERGLOW_FIELD(denoiser.scaleDoubt)},

    {"gradient", "gradientOver", "Gradient over",
     "Whether a change is one of luminance, or the largest of the channels': a color that changes "
     "is seen. Of filters asvgf and counted.",
     "", kAsvgf, 0.0, 1.0, false, kChangeOfNames, AFTERGLOW_FIELD(denoiser.gradientOver)},
    {"gradient", "gradientIterations", "Gradient iterations",
     "A-trous iterations of the reconstruction of the temporal gradient.",
     "", kAsvgf, 0.0, 7.0, false, {}, AFTERGLOW_FIELD(denoiser.gradientIterations)},
    {"gradient", "gradientKernel", "Gradient kernel",
     "Taps of each of these iterations.",
     "", kAsvgf, 0.0, 1.0, false, kKernelNames, AFTERGLOW_FIELD(denoiser.gradientKernel)},
    {"gradient", "gradientStrides", "Gradient strides",
     "Distance between taps from iteration to iteration: doubling, or one more each (NRD; "
     "always so in the filter confidence).",
     "", kAsvgf, 0.0, 1.0, false, kStrideNames, AFTERGLOW_FIELD(denoiser.gradientStrides)},
    {"gradient", "gradientMagnitude", "Gradient magnitude",
     "Whether noise of both signs cancels in the reconstruction, or each change counts by its "
     "size (NRD; always so in the filter confidence).",
     "", kAsvgf, 0.0, 1.0, false, kMagnitudeNames, AFTERGLOW_FIELD(denoiser.gradient.magnitude)},
    {"gradient", "gradientLuminanceStop", "Luminance stop (gradient)",
     "Whether the reconstruction stops at edges of luminance, or at those of geometry alone (NRD; "
     "always so in the filter confidence).",
     "", kAsvgf, 0.0, 1.0, false, kSwitchNames, AFTERGLOW_FIELD(denoiser.gradientLuminanceStop)},
    {"gradient", "lambdaFetch", "Lambda fetch",
     "How lambda, known per 3x3 stratum, is fetched at a pixel: of its stratum, bilinear, the"
     " largest of the 3x3 strata around, or their mean weighted by their light.",
     "", "own choice; largest as in the authors' code", 0.0, 3.0, false, kLambdaFetchNames,
     AFTERGLOW_FIELD(denoiser.temporal.lambdaFetch)},
    {"gradient", "gradientSigmaLuminance", "Sigma luminance (gradient)",
     "Edge stop of the reconstruction, in standard deviations of the stratum's luminance.",
     "", kSvgf, 0.1, 64.0, true, {}, AFTERGLOW_FIELD(denoiser.gradientEdges.sigmaLuminance)},
    {"gradient", "gradientSigmaNormal", "Sigma normal (gradient)",
     "Edge stop of the reconstruction: exponent of the cosine between normals.",
     "", kSvgf, 1.0, 512.0, true, {}, AFTERGLOW_FIELD(denoiser.gradientEdges.sigmaNormal)},
    {"gradient", "gradientSigmaDepth", "Sigma depth (gradient)",
     "Edge stop of the reconstruction, in multiples of the depth change that the slope "
     "predicts.",
     "", kSvgf, 0.05, 16.0, true, {}, AFTERGLOW_FIELD(denoiser.gradientEdges.sigmaDepth)},
    {"gradient", "deltaFloor", "Delta floor",
     "Where the filtered Delta is below it, lambda is 0: there is no light to speak of.",
     "radiance", "Schied 2018, released code", 0.0, 0.1, false, {},
     AFTERGLOW_FIELD(denoiser.gradient.deltaFloor)},
    {"gradient", "forceLambda", "Force lambda",
     "This lambda everywhere, in [0, 1]; negative: as measured.",
     "", "for experiments", -1.0, 1.0, false, {}, AFTERGLOW_FIELD(denoiser.gradient.forceLambda)},
    {"gradient", "alwaysCarrySamples", "Always carry samples",
     "Merges gradient samples also where the filter does not use them, so that filters can "
     "be compared on the very same raw signal.",
     "", "for experiments", 0.0, 1.0, false, kSwitchNames,
     AFTERGLOW_FIELD(denoiser.alwaysCarrySamples)},

    {"spatial", "atrousIterations", "A-trous iterations",
     "Iterations of the spatial filter; each doubles the distance between taps.",
     "", kSvgf, 0.0, 7.0, false, {}, AFTERGLOW_FIELD(denoiser.atrousIterations)},
    {"spatial", "kernel", "Kernel",
     "Taps of each of these iterations.",
     "", kSvgf, 0.0, 1.0, false, kKernelNames, AFTERGLOW_FIELD(denoiser.kernel)},
    {"spatial", "feedbackIteration", "Feedback iteration",
     "Whose result becomes the next frame's history: 1 as published; 0, the unfiltered blend, has a "
     "fifth less error.",
     "", kMeasured, 0.0, 7.0, false, {}, AFTERGLOW_FIELD(denoiser.feedbackIteration)},
    {"spatial", "sigmaLuminance", "Sigma luminance",
     "Edge stop, in standard deviations of the local luminance.",
     "", kSvgf, 0.1, 64.0, true, {}, AFTERGLOW_FIELD(denoiser.edges.sigmaLuminance)},
    {"spatial", "sigmaNormal", "Sigma normal",
     "Edge stop: exponent of the cosine between normals.",
     "", kSvgf, 1.0, 512.0, true, {}, AFTERGLOW_FIELD(denoiser.edges.sigmaNormal)},
    {"spatial", "sigmaDepth", "Sigma depth",
     "Edge stop, in multiples of the depth change that the slope predicts.",
     "", kSvgf, 0.05, 16.0, true, {}, AFTERGLOW_FIELD(denoiser.edges.sigmaDepth)},

    {"lighting", "signal", "Signal",
     "Which rays are traced, and whether they are filtered as one signal or each by itself.",
     "", kAsvgf, 0.0, double(signalNames().size() - 1), false, signalNames(), AFTERGLOW_FRAME_FIELD(lighting.signal)},
    {"lighting", "aoRadius", "Occlusion radius",
     "Length of the ambient occlusion rays.",
     "of the scene's extent", "own choice", 0.001, 1.0, true, {},
     AFTERGLOW_FRAME_FIELD(lighting.aoRadius)},
    {"lighting", "signalClamp", "Signal clamp",
     "Upper bound of each channel of the raw signal; gradient and filter see the same bound.",
     "radiance", "own choice", 1.0, 10000.0, true, {}, AFTERGLOW_FRAME_FIELD(lighting.signalClamp)},
    {"lighting", "regularization", "Regularization",
     "Least alpha of the second surface of a path: fewer fireflies, blurred reflections in it. 0: off. "
     "In references it falls with the number of samples.",
     "GGX alpha", "Kaplanyan and Dachsbacher 2013", 0.0, 1.0, false, {},
     AFTERGLOW_FRAME_FIELD(lighting.regularization)},
    {"lighting", "gradientSamples", "Gradient samples",
     "Merged into the raw signal, in place of a ninth of its new samples, or traced beside it by "
     "a ninth more rays, so that the raw signal is the same whatever the filter.",
     "", kAsvgf, 0.0, 1.0, false, kPlacementNames, AFTERGLOW_FRAME_FIELD(lighting.gradientSamples)},

    {"display", "exposure", "Exposure",
     "Of the display image only; nothing is measured after it.",
     "stops", "own choice", -8.0, 8.0, false, {}, AFTERGLOW_FRAME_FIELD(display.exposure)},
    {"display", "autoExposure", "Automatic exposure",
     "Takes the mean of the logarithms of luminance to middle gray, 0.18; the exposure by hand is "
     "added.",
     "", "Reinhard et al. 2002", 0.0, 1.0, false, kSwitchNames, AFTERGLOW_FRAME_FIELD(display.autoExposure)},
    {"display", "exposureFrames", "Adaptation",
     "Time constant with which the automatic exposure follows the picture.",
     "frames", "own choice", 0.1, 600.0, true, {}, AFTERGLOW_FRAME_FIELD(display.exposureFrames)},
    {"display", "exposureLimit", "Exposure limit",
     "The automatic exposure stays within so many stops of both signs.",
     "stops", "own choice", 0.0, 16.0, false, {}, AFTERGLOW_FRAME_FIELD(display.exposureLimit)},
    {"display", "toneMapper", "Tone mapper",
     "From exposed radiance to the display: ACES (Narkowicz' fit), like AgX, Khronos' PBR neutral, "
     "or none, which cuts off what is above 1.",
     "", "own choice", 0.0, 3.0, false, kToneMapperNames, AFTERGLOW_FRAME_FIELD(display.toneMapper)},

    {"anti-aliasing", "antiAliasing", "Anti-aliasing",
     "Temporal: every frame looks through another place of each pixel, and the frames are averaged "
     "where their surfaces went. Filters see those places as well; experiments measure at the "
     "pixels' centers, without it.",
     "", "Karis 2014", 0.0, 1.0, false, kAntiAliasingNames, AFTERGLOW_FRAME_FIELD(display.antiAliasing)},
    {"anti-aliasing", "taaBlend", "Blend",
     "Least weight of the newest frame in the anti-aliased picture.",
     "", "Karis 2014", 0.01, 1.0, true, {}, AFTERGLOW_FRAME_FIELD(display.taaBlend)},
    {"anti-aliasing", "taaClip", "Clip",
     "How far the anti-aliased history may be from the mean of this frame around the pixel.",
     "standard deviations", "Salvi 2016", 0.25, 16.0, true, {}, AFTERGLOW_FRAME_FIELD(display.taaClip)},
    {"anti-aliasing", "taaOrder", "Order",
     "Whether frames are averaged before the tone mapper, weighted by luminance, or after it.",
     "", "own choice, by measurement", 0.0, 1.0, false, kTaaOrderNames, AFTERGLOW_FRAME_FIELD(display.taaOrder)},
});
#undef AFTERGLOW_FIELD
#undef AFTERGLOW_FRAME_FIELD
// clang-format on

std::size_t indexOf(std::string_view kind, std::string_view name,
                    std::span<const std::string_view> known) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end())
        throwUnknownName(kind, name, known);
    return std::size_t(found - known.begin());
}

const Field& fieldByKey(std::string_view key) {
    const auto found = std::ranges::find(kFields, key, &Field::key);
    if (found == kFields.end()) {
        std::vector<std::string_view> keys;
        for (const Field& field : kFields)
            keys.push_back(field.key);
        throwUnknownName("setting", key, keys);
    }
    return *found;
}

/// The shortest decimal that is this number, in its own precision.
template <class Number>
std::string shortNumber(Number value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

void setNumber(Settings& settings, const Field& field, double value) {
    if (!(value >= field.min && value <= field.max))
        throw UsageError("setting '" + std::string(field.key) + "' is in [" +
                         shortNumber(field.min) + ", " + shortNumber(field.max) + "], not " +
                         shortNumber(value));
    const Field::Ref ref = field.in(settings);
    if (float* const* number = std::get_if<float*>(&ref))
        **number = float(value);
    else if (value != std::floor(value))
        throw UsageError("setting '" + std::string(field.key) + "' is a whole number, not " +
                         shortNumber(value));
    else
        *std::get<int*>(ref) = int(value);
}

} // namespace

std::span<const Field> fields() {
    return kFields;
}

Settings defaultSettings(Filter filter) {
    return {{}, {filter, defaultsOf(filter)}};
}

void setFilter(FilterSettings& settings, Filter filter) {
    FrameSettings unused;
    FilterSettings before{settings.filter, defaultsOf(settings.filter)};
    FilterSettings after{filter, defaultsOf(filter)};
    for (const Field& field : kFields) {
        if (field.isFrameWide())
            continue;
        const auto follow = [&]<class Number>(Number* now) {
            const auto of = [&](FilterSettings& other) {
                return *std::get<Number*>(field.in(unused, other));
            };
            if (*now == of(before))
                *now = of(after);
        };
        std::visit(follow, field.in(unused, settings));
    }
    settings.filter = filter;
}

void setField(Settings& settings, std::string_view key, std::string_view value) {
    const Field& field = fieldByKey(key);
    if (!field.choices.empty()) {
        setNumber(settings, field,
                  double(indexOf("value of '" + std::string(key) + "'", value, field.choices)));
        return;
    }
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size())
        throw UsageError("setting '" + std::string(key) + "' is a number, not '" +
                         std::string(value) + "'");
    setNumber(settings, field, number);
}

nlohmann::json toJson(const Settings& settings) {
    nlohmann::json json;
    json["filter"] = nameOf(settings.filter);
    Settings copy = settings;
    for (const Field& field : kFields) {
        const Field::Ref ref = field.in(copy);
        if (float* const* number = std::get_if<float*>(&ref))
            json[std::string(field.key)] = std::stod(shortNumber(**number));
        else if (!field.choices.empty())
            json[std::string(field.key)] = field.choices[std::size_t(*std::get<int*>(ref))];
        else
            json[std::string(field.key)] = *std::get<int*>(ref);
    }
    return json;
}

void applyJson(Settings& settings, const nlohmann::json& json) {
    if (!json.is_object())
        throw UsageError("settings are a JSON object, not " + std::string(json.type_name()));
    Settings result = settings;
    if (const auto filter = json.find("filter"); filter != json.end()) {
        if (!filter->is_string())
            throw UsageError("setting 'filter' is a name, not " + jsonText(*filter));
        setFilter(result, filterFromName(filter->get<std::string>()));
    }
    for (const auto& [key, value] : json.items()) {
        if (key == "filter") {
            continue; // it comes first, since the others change its defaults
        } else if (value.is_string()) {
            setField(result, key, value.get<std::string>());
        } else if (value.is_number()) {
            setNumber(result, fieldByKey(key), value.get<double>());
        } else {
            throw UsageError("setting '" + key + "' is a number or a name, not " + jsonText(value));
        }
    }
    settings = result;
}

} // namespace afterglow
