// SPDX-License-Identifier: MIT
#include "app/commands/list.h"

#include "app/commands/arguments.h"
#include "app/commands/headless.h"
#include "app/measure/metric.h"
#include "app/scenario/experiment.h"
#include "app/scenario/presets.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/procedural.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include <fmt/format.h>

namespace afterglow {

namespace {

constexpr std::array<std::string_view, 8> kKinds{"scenes", "experiments", "filters",  "presets",
                                                 "aovs",   "contexts",    "settings", "metrics"};

struct Line {
    std::string name, text;
};

void print(const std::vector<Line>& lines) {
    std::size_t width = 0;
    for (const Line& line : lines)
        width = std::max(width, line.name.size());
    for (const Line& line : lines)
        std::printf("%-*s  %s\n", int(width), line.name.c_str(), line.text.c_str());
}

std::string shortest(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::vector<Line> sceneLines() {
    std::vector<Line> lines;
    for (const auto& scene : proceduralScenes())
        lines.push_back({std::string(scene.name), std::string(scene.description)});
    return lines;
}

std::vector<Line> experimentLines() {
    std::vector<Line> lines;
    for (const auto& experiment : builtInExperiments())
        lines.push_back({std::string(experiment.name), std::string(experiment.description)});
    return lines;
}

std::vector<Line> filterLines() {
    std::vector<Line> lines;
    for (Filter filter : allFilters())
        lines.push_back({std::string(nameOf(filter)), std::string(describe(filter))});
    return lines;
}

std::vector<Line> presetLines() {
    std::vector<Line> lines;
    for (const Preset& preset : presets())
        lines.push_back({preset.name, preset.description + " (" + preset.source + ")"});
    return lines;
}

std::vector<Line> aovLines() {
    std::vector<Line> lines;
    for (const AovInfo& aov : aovs()) {
        std::string makers;
        for (Filter filter : allFilters())
            if (isMadeBy(aov, FilterSettings{filter, {}}))
                makers += (makers.empty() ? "" : ", ") + std::string(nameOf(filter));
        lines.push_back(
            {std::string(aov.name),
             std::string(aov.meaning) + " [" + std::string(aov.channels) + "; " + makers + "]"});
    }
    return lines;
}

std::vector<Line> contextLines() {
    std::vector<Line> lines;
    for (const ContextInfo& context : contexts())
        lines.push_back({std::string(context.name), std::string(context.meaning)});
    const std::vector<std::string> devices = eglDevices();
    for (std::size_t i = 0; i < devices.size(); ++i)
        lines.push_back({"device " + std::to_string(i), devices[i] + " [egl, auto]"});
    return lines;
}

// The default, the range or the choices, the unit.
std::vector<Line> settingLines() {
    std::vector<Line> lines;
    Settings defaults;
    for (const Field& field : fields()) {
        const Field::Ref ref = field.in(defaults);
        std::string range;
        if (!field.choices.empty()) {
            range = std::string(field.choices[std::size_t(*std::get<int*>(ref))]) + "; one of ";
            for (std::size_t i = 0; i < field.choices.size(); ++i)
                range += (i ? ", " : "") + std::string(field.choices[i]);
        } else {
            const double value = std::holds_alternative<float*>(ref)
                                     ? double(*std::get<float*>(ref))
                                     : double(*std::get<int*>(ref));
            char text[32];
            std::snprintf(text, sizeof text, "%g", value);
            range = std::string(text) + "; " + shortest(field.min) + " to " + shortest(field.max);
            if (!field.unit.empty())
                range += " " + std::string(field.unit);
        }
        lines.push_back({std::string(field.key), std::string(field.meaning) + " [" + range + "]"});
    }
    return lines;
}

std::vector<Line> metricLines() {
    std::vector<Line> lines;
    for (const Metric& metric : metrics()) {
        std::string text(metric.tip);
        if (!metric.unit.empty())
            text += fmt::format(" [{}]", metric.unit);
        lines.push_back({std::string(metric.key), text});
    }
    return lines;
}

} // namespace

std::span<const std::string_view> listKinds() {
    return kKinds;
}

void runList(std::string_view kind) {
    using Lines = std::vector<Line> (*)();
    constexpr std::array<Lines, kKinds.size()> makers{sceneLines,   experimentLines, filterLines,
                                                      presetLines,  aovLines,        contextLines,
                                                      settingLines, metricLines};
    const auto found = std::ranges::find(kKinds, kind);
    if (found == kKinds.end())
        throw UsageError(unknownName("list", kind, {kKinds.begin(), kKinds.end()}));
    print(makers[std::size_t(found - kKinds.begin())]());
}

} // namespace afterglow
