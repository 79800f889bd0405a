// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/passes/lighting_pass.h"
#include "renderer/passes/path_pass.h"

#include <span>
#include <string_view>

namespace afterglow {

/// A division of the traced light into signals; each signal is filtered by itself.
enum class Signal { Shadows, AmbientOcclusion, Both, Separate, Path, Split, Bounce };

/// One signal of a frame.
struct SignalInfo {
    std::string_view name;   ///< "shadows"; of the light as a whole "both"
    LightingPass::Rays rays; ///< none of a signal of paths

    bool operator==(const SignalInfo&) const = default;
};

/// Returns the signals of a frame, 1 to kMaxSignals, in the order of their numbers.
std::span<const SignalInfo> signalsOf(Signal division);
/// Returns how paths make the signals; empty: no paths are traced.
std::optional<PathPass::Division> pathsOf(Signal division);
/// Returns whether any signal has rays that can reach the surroundings.
bool seesSurroundings(Signal division);

std::span<const Signal> allSignals();
std::span<const std::string_view> signalNames(); ///< shadows, ao, both, separate, path, ...
std::string_view nameOf(Signal signal);
Signal signalFromName(std::string_view name); ///< UsageError names the nearest known

} // namespace afterglow
