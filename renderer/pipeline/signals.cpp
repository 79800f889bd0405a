// SPDX-License-Identifier: MIT
#include "renderer/pipeline/signals.h"

#include "renderer/base/names.h"
#include "renderer/resources/render_targets.h"

#include <algorithm>
#include <array>

namespace afterglow {
namespace {

constexpr SignalInfo kShadows{"shadows", {.shadows = true, .ambientOcclusion = false}};
constexpr SignalInfo kAo{"ao", {.shadows = false, .ambientOcclusion = true}};
constexpr SignalInfo kBoth{"both", {.shadows = true, .ambientOcclusion = true}};
constexpr LightingPass::Rays kNoRays{.shadows = false, .ambientOcclusion = false};
constexpr std::array kWholePaths{SignalInfo{"path", kNoRays}};
constexpr std::array kLobes{SignalInfo{"diffuse", kNoRays}, SignalInfo{"specular", kNoRays}};
constexpr std::array kSegments{SignalInfo{"direct", kNoRays}, SignalInfo{"indirect", kNoRays}};
constexpr std::array kShadowsAlone{kShadows};
constexpr std::array kAoAlone{kAo};
constexpr std::array kTogether{kBoth};
constexpr std::array kApart{kShadows, kAo};
static_assert(kApart.size() <= kMaxSignals);

struct Row {
    Signal division;
    std::string_view name;
    std::span<const SignalInfo> signals;
    std::optional<PathPass::Division> paths{};
};
constexpr std::array kRows{Row{Signal::Shadows, "shadows", kShadowsAlone},
                           Row{Signal::AmbientOcclusion, "ao", kAoAlone},
                           Row{Signal::Both, "both", kTogether},
                           Row{Signal::Separate, "separate", kApart},
                           Row{Signal::Path, "path", kWholePaths, PathPass::Division::Whole},
                           Row{Signal::Split, "split", kLobes, PathPass::Division::Lobes},
                           Row{Signal::Bounce, "bounce", kSegments, PathPass::Division::Segments}};
constexpr auto kSignals = [] {
    std::array<Signal, kRows.size()> all{};
    for (std::size_t i = 0; i < kRows.size(); ++i)
        all[i] = kRows[i].division;
    return all;
}();
constexpr auto kNames = [] {
    std::array<std::string_view, kRows.size()> all{};
    for (std::size_t i = 0; i < kRows.size(); ++i)
        all[i] = kRows[i].name;
    return all;
}();

} // namespace

std::span<const SignalInfo> signalsOf(Signal division) {
    return kRows[std::size_t(division)].signals;
}

std::optional<PathPass::Division> pathsOf(Signal division) {
    return kRows[std::size_t(division)].paths;
}

bool seesSurroundings(Signal division) {
    return pathsOf(division).has_value() ||
           std::ranges::any_of(signalsOf(division), [](const SignalInfo& signal) {
               return signal.rays.ambientOcclusion;
           });
}

std::span<const Signal> allSignals() {
    return kSignals;
}

std::span<const std::string_view> signalNames() {
    return kNames;
}

std::string_view nameOf(Signal signal) {
    return kRows[std::size_t(signal)].name;
}

Signal signalFromName(std::string_view name) {
    for (const Row& row : kRows)
        if (row.name == name)
            return row.division;
    throwUnknownName("signal", name, kNames);
}

} // namespace afterglow
