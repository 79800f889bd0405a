#pragma once

#include "renderer/base/names.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string_view>
#include <variant>

namespace afterglow {

enum class Filter { None, Fixed, Svgf, Asvgf, Clamp, Percentile, Confidence };
enum class Signal { Shadows, AmbientOcclusion, Both };
/// Where gradient samples are shaded: in the picture, in place of new samples of the pixels that
/// they land on, or beside it, by rays of their own.
enum class SamplePlacement { Merged, Extra };

/// The names on the command line and in files: none, fixed, svgf, asvgf, clamp, percentile,
/// confidence; shadows, ao, both.
std::string_view nameOf(Filter filter);
std::string_view nameOf(Signal signal);
std::string_view describe(Filter filter); ///< one sentence
std::span<const Filter> allFilters();
Filter filterFromName(std::string_view name); ///< UsageError names the nearest known
Signal signalFromName(std::string_view name); ///< UsageError names the nearest known

/// Ranges, units, meaning and source of every member: fields().
struct DenoiserSettings {
    gpu::TemporalParams temporal{.alpha = 0.2f,
                                 .alphaMoments = 0.2f,
                                 .maxHistory = 128.0f,
                                 .depthTolerance = 2.0f,
                                 .normalTolerance = 0.9f,
                                 .lambdaFetch = gpu::kLambdaMax,
                                 .historyLaw = gpu::kHistoryPower,
                                 .lambdaSource = gpu::kLambdaFromNothing, // set by the plan
                                 .lambdaUse = gpu::kLambdaBlends,
                                 .percentileSlope = 4.0f,
                                 .clampSigmas = 1.0f,
                                 .clampRadius = 2};
    gpu::PercentileParams percentiles{
        .lowPercentile = 0.1f, .highPercentile = 0.9f, .unused0 = 0.0f, .unused1 = 0.0f};
    gpu::GradientParams gradient{.deltaFloor = 1e-4f,
                                 .forceLambda = -1.0f,
                                 .magnitude = gpu::kGradientSigned,
                                 .unused0 = 0.0f};
    gpu::EdgeStopping edges{
        .sigmaLuminance = 4.0f, .sigmaNormal = 128.0f, .sigmaDepth = 1.0f, .step = 1};
    gpu::EdgeStopping gradientEdges{
        .sigmaLuminance = 4.0f, .sigmaNormal = 128.0f, .sigmaDepth = 1.0f, .step = 1};
    float minHistory = 4.0f;
    int atrousIterations = 5;
    int feedbackIteration = 1; ///< whose result becomes the history; 0: the unfiltered blend
    int gradientIterations = 5;
    int kernel = int(Kernel::B3Spline5x5);
    int gradientKernel = int(Kernel::Box3x3);
    int gradientStrides = gpu::kStridesDouble;
    int gradientLuminanceStop = 1;
    int alwaysCarrySamples = 0; ///< gradient samples also where the filter does not use them
};

struct LightingSettings {
    int signal = int(Signal::Both);
    float aoRadius = 0.04f;     ///< in extents of the scene
    float signalClamp = 100.0f; ///< radiance
    int gradientSamples = int(SamplePlacement::Merged);
};

struct DisplaySettings {
    float exposure = 0.0f; ///< stops
};

/// Every tunable of the renderer. Changing one never clears a history.
struct Settings {
    Filter filter = Filter::Asvgf;
    DenoiserSettings denoiser;
    LightingSettings lighting;
    DisplaySettings display;
};

/// One tunable: the one place where its name, range, unit, meaning and source are written down.
/// Sliders, JSON keys, range checks and help are made from it.
struct Field {
    using Ref = std::variant<float*, int*>;
    std::string_view group;   ///< "temporal", "spatial", "gradient", "lighting", "display"
    std::string_view key;     ///< JSON key, unique: "alpha"
    std::string_view label;   ///< for a person
    std::string_view meaning; ///< one sentence
    std::string_view unit;    ///< may be empty
    std::string_view source;  ///< where the default comes from
    double min = 0.0, max = 1.0;
    bool logarithmic = false;
    std::span<const std::string_view> choices; ///< names of the values of an enumeration, from 0
    Ref (*ref)(Settings&) = nullptr;
};
std::span<const Field> fields();

/// Sets one field by key from text ("alpha", "0.1"; "lambdaFetch", "bilinear").
/// UsageError names an unknown key (and the nearest known), a bad value and the allowed range.
void setField(Settings& settings, std::string_view key, std::string_view value);

nlohmann::json toJson(const Settings& settings);
/// Replaces the members that are named; UsageError names an unknown key or a value out of range.
void applyJson(Settings& settings, const nlohmann::json& json);

} // namespace afterglow
