#pragma once

#include "renderer/passes/lighting_pass.h"

#include <span>
#include <string_view>

namespace afterglow {

/// Which light is traced, and how it is divided into signals that are filtered by themselves.
enum class Signal { Shadows, AmbientOcclusion, Both, Separate };

/// One signal of a frame.
struct SignalInfo {
    std::string_view name; ///< "shadows"; of the light as a whole "both"
    LightingPass::Rays rays;

    bool operator==(const SignalInfo&) const = default;
};

/// What a frame's light is divided into: 1 to kMaxSignals, in the order of their numbers.
std::span<const SignalInfo> signalsOf(Signal division);
/// Whether any of them has rays that can reach the surroundings.
bool seesSurroundings(Signal division);

std::span<const Signal> allSignals();
std::span<const std::string_view> signalNames(); ///< shadows, ao, both, separate
std::string_view nameOf(Signal signal);
Signal signalFromName(std::string_view name); ///< UsageError names the nearest known

} // namespace afterglow
