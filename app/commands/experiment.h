#pragma once

#include "app/commands/headless.h"

#include <optional>
#include <string>

namespace afterglow {

/// What `afterglow experiment` was asked for.
struct ExperimentOptions {
    std::string experiment;         ///< the name of a built-in one, or a file
    std::optional<glm::ivec2> size; ///< instead of the experiment's own
    std::optional<int> frames;      ///< likewise; events at later frames do not happen
    std::optional<int> samples;     ///< of each reference, per pixel, likewise
    ContextChoice context = ContextChoice::Auto;
    std::string out;
};

/// Runs it and prints a table and where the contact sheet lies.
void runExperimentCommand(const ExperimentOptions& options, HiddenContextFactory hiddenContext);

} // namespace afterglow
