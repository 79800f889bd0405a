// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/base/names.h"
#include "renderer/filters/filter_table.h"
#include "renderer/pipeline/signals.h"
#include "shared/post_params.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string_view>
#include <variant>

namespace afterglow {

/// Where gradient samples are shaded: in the picture, in place of new samples of the pixels that
/// they land on, or beside it, by rays of their own.
enum class SamplePlacement { Merged, Extra };

struct LightingSettings {
    int signal = int(Signal::Both);
    float aoRadius = 0.04f;       ///< in extents of the scene
    float signalClamp = 100.0f;   ///< radiance
    float regularization = 0.25f; ///< least alpha (GGX) of the second surface of a path
    int gradientSamples = int(SamplePlacement::Merged);
};

/// The anti-aliasing: none, or over time, with jittered frames.
enum class AntiAliasing { Off, Taa };
/// The color in which TAA averages frames: linear radiance, or display values.
enum class TaaOrder { BeforeToneMap, AfterToneMap };

struct DisplaySettings {
    float exposure = 0.0f; ///< stops
    int autoExposure = 0;
    float exposureFrames = 20.0f; ///< time constant of the adaptation
    float exposureLimit = 4.0f;   ///< stops
    int toneMapper = gpu::kToneAces;
    int antiAliasing = int(AntiAliasing::Off);
    float taaBlend = 0.1f;
    float taaClip = 1.25f; ///< standard deviations
    int taaOrder = int(TaaOrder::BeforeToneMap);
};

/// The settings that all filters of a frame share.
struct FrameSettings {
    LightingSettings lighting;
    DisplaySettings display;
};

/// Every tunable of a picture: of its frame, and of its filter. Changing one never clears a
/// history.
struct Settings : FrameSettings, FilterSettings {};

/// One tunable: the one place where its name, range, unit, meaning and source are written down.
/// Sliders, JSON keys, range checks and help are made from it.
struct Field {
    using Ref = std::variant<float*, int*>;
    std::string_view group;   ///< "temporal", "spatial", "gradient", "lighting", ...
    std::string_view key;     ///< JSON key, unique: "alpha"
    std::string_view label;   ///< for a person
    std::string_view meaning; ///< one sentence
    std::string_view unit;    ///< may be empty
    std::string_view source;  ///< where the default comes from
    double min = 0.0, max = 1.0;
    bool logarithmic = false;
    std::span<const std::string_view> choices; ///< names of the values of an enumeration, from 0
    /// Returns the member of the settings; one of the two is null.
    Ref (*inFilter)(FilterSettings&) = nullptr;
    Ref (*inFrame)(FrameSettings&) = nullptr;

    bool isFrameWide() const { return inFrame != nullptr; }
    Ref in(FrameSettings& frame, FilterSettings& filter) const {
        return inFrame ? inFrame(frame) : inFilter(filter);
    }
    Ref in(Settings& settings) const { return in(settings, settings); }
};
std::span<const Field> fields();

/// Returns a filter as it begins, in a frame as it begins.
Settings defaultSettings(Filter filter);
/// Changes the filter. Settings of the old one that are at its defaults follow to those of the new
/// one; what was changed stays.
void setFilter(FilterSettings& settings, Filter filter);

/// Sets one field by key from text ("alpha", "0.1"; "lambdaFetch", "bilinear").
/// UsageError names an unknown key (and the nearest known), a bad value and the allowed range.
void setField(Settings& settings, std::string_view key, std::string_view value);

nlohmann::json toJson(const Settings& settings);
/// Replaces the members that are named; UsageError names an unknown key or a value out of range.
void applyJson(Settings& settings, const nlohmann::json& json);

} // namespace afterglow
