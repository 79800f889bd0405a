// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/measure/metric.h"
#include "app/scenario/experiment.h"
#include "app/scenario/presets.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/procedural.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace afterglow {

namespace {

struct Line {
    std::string name, text;
};
using Lines = std::vector<Line>;

/// Returns one line per row: its name and its description.
template <class Rows>
Lines described(const Rows& rows) {
    Lines lines;
    for (const auto& row : rows)
        lines.push_back({std::string(row.name), std::string(row.description)});
    return lines;
}

Lines filterLines() {
    Lines lines;
    for (Filter filter : allFilters())
        lines.push_back({std::string(nameOf(filter)), std::string(describe(filter))});
    return lines;
}

Lines presetLines() {
    Lines lines;
    for (const Preset& preset : presets())
        lines.push_back({preset.name, fmt::format("{} ({})", preset.description, preset.source)});
    return lines;
}

Lines aovLines() {
    Lines lines;
    for (const AovInfo& aov : aovs()) {
        std::vector<std::string_view> makers;
        for (Filter filter : allFilters())
            if (isMadeBy(aov, FilterSettings{filter, {}}))
                makers.push_back(nameOf(filter));
        lines.push_back(
            {std::string(aov.name),
             fmt::format("{} [{}; {}]", aov.meaning, aov.channels, fmt::join(makers, ", "))});
    }
    return lines;
}

Lines contextLines() {
    Lines lines;
    for (const ContextInfo& context : contexts())
        lines.push_back({std::string(context.name), std::string(context.meaning)});
    const std::vector<std::string> devices = eglDevices();
    for (std::size_t i = 0; i < devices.size(); ++i)
        lines.push_back({fmt::format("device {}", i), devices[i] + " [egl, auto]"});
    return lines;
}

// The default, the range or the choices, the unit.
Lines settingLines() {
    Lines lines;
    Settings defaults;
    for (const Field& field : fields()) {
        const Field::Ref ref = field.in(defaults);
        std::string range;
        if (!field.choices.empty())
            range = fmt::format("{}; one of {}", field.choices[std::size_t(*std::get<int*>(ref))],
                                fmt::join(field.choices, ", "));
        else
            range = fmt::format("{:g}; {} to {}{}{}",
                                std::visit([](const auto* value) { return double(*value); }, ref),
                                field.min, field.max, field.unit.empty() ? "" : " ", field.unit);
        lines.push_back({std::string(field.key), fmt::format("{} [{}]", field.meaning, range)});
    }
    return lines;
}

Lines metricLines() {
    Lines lines;
    for (const Metric& metric : metrics())
        lines.push_back(
            {std::string(metric.key),
             fmt::format("{}{}", metric.tip,
                         metric.unit.empty() ? "" : fmt::format(" [{}]", metric.unit))});
    return lines;
}

struct ListKind {
    const char* name;
    Lines (*lines)();
};
constexpr std::array kKinds{ListKind{"scenes", [] { return described(proceduralScenes()); }},
                            ListKind{"experiments", [] { return described(builtInExperiments()); }},
                            ListKind{"filters", filterLines},
                            ListKind{"presets", presetLines},
                            ListKind{"aovs", aovLines},
                            ListKind{"contexts", contextLines},
                            ListKind{"settings", settingLines},
                            ListKind{"metrics", metricLines}};

/// The command list: prints names and meanings of scenes, filters, settings and other choices.
class List final : public Command {
public:
    explicit List(Options& options) {
        std::vector<std::string> names;
        for (const ListKind& kind : kKinds)
            names.emplace_back(kind.name);
        Kind<std::string> kind = oneOf("list", names);
        kind.word = "";
        options.require("WHAT", what_, kind, fmt::format("{}", fmt::join(names, ", ")));
        options.setFooter(R"(Examples:
  afterglow list scenes
  afterglow list settings)");
    }

    void run(HiddenContextFactory) override {
        const Lines lines = std::ranges::find(kKinds, what_, &ListKind::name)->lines();
        std::size_t width = 0;
        for (const Line& line : lines)
            width = std::max(width, line.name.size());
        for (const Line& line : lines)
            fmt::print("{:{}}  {}\n", line.name, width, line.text);
    }

private:
    std::string what_;
};

} // namespace

const CommandRow kListCommand{"list", "Tells what there is to choose from", make<List>};

} // namespace afterglow
