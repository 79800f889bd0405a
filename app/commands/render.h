// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/arguments.h"
#include "app/commands/headless.h"
#include "renderer/pipeline/settings.h"

#include <optional>

namespace afterglow {

/// What `afterglow render` was asked for.
struct RenderOptions {
    std::string scene;
    std::string camera; ///< name of a scene camera; empty: the first
    Settings settings;
    glm::ivec2 size{640, 360};
    int frames = 32;
    std::uint32_t seed = 0;
    double rate = 60.0;   ///< frames a second of scene time
    bool animate = false; ///< the scene's own animation plays; otherwise time stands still at 0
    ContextWish context;
    std::vector<LightEvent> lights;
    std::vector<std::string> aovs;
    std::string format = "png"; ///< of AOVs: "pfm", else EXR; display images are always PNG
    std::optional<int> samples; ///< instead of frames: the converged image of so many a pixel
    int every = 1;              ///< writes frames 0, every, 2 every, ...
    bool lastOnly = false;      ///< writes only the last frame
    std::string out;
};

/// Writes frames, AOVs and run.json. Prints a summary on standard output.
void runRender(const RenderOptions& options, HiddenContextFactory hiddenContext);

} // namespace afterglow
