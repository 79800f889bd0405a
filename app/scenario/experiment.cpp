// SPDX-License-Identifier: MIT
#include "app/scenario/experiment.h"

#include "app/base/embedded.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"

#include <filesystem>

namespace afterglow {

std::vector<ExperimentInfo> builtInExperiments() {
    std::vector<ExperimentInfo> infos;
    for (const EmbeddedFile& file : embeddedExperiments()) {
        const Experiment experiment = parseExperiment(file.bytes, file.name);
        infos.push_back({experiment.name, experiment.description});
    }
    return infos;
}

Experiment loadExperiment(std::string_view nameOrPath) {
    const std::filesystem::path path(nameOrPath);
    if (nameOrPath.find('/') != nameOrPath.npos || nameOrPath.ends_with(".json"))
        return parseExperiment(readFile(path), nameOrPath);

    std::vector<std::string_view> known;
    for (const EmbeddedFile& file : embeddedExperiments()) {
        const std::string_view name = file.name.substr(0, file.name.rfind('.'));
        if (name == nameOrPath)
            return parseExperiment(file.bytes, file.name);
        known.push_back(name);
    }
    throw UsageError(unknownName("experiment", nameOrPath, known) +
                     "; the name of a file ends in .json");
}

Timeline shortened(const Timeline& timeline, int frames) {
    std::vector<TimelineEvent> events = timeline.events();
    std::erase_if(events, [&](const TimelineEvent& event) { return frameOf(event) >= frames; });
    return Timeline(frames, std::move(events));
}

} // namespace afterglow
