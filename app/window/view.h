// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/settings.h"

#include <cstdint>
#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace afterglow {

/// What `afterglow view` was asked for.
struct ViewOptions {
    std::string scene;  ///< a scene or an experiment, by name or path; empty: the last one, or hall
    std::string camera; ///< name of a scene camera; empty: the first
    std::optional<glm::ivec2> size; ///< of the window, in screen coordinates; empty: as it was last
    Settings settings;              ///< filter and every --set already applied
    std::uint32_t seed = 0;
    int frames = 0;      ///< closes after so many rendered frames; 0: stays until closed
    bool animate = true; ///< the scene's animation starts running
    std::optional<std::string> screenshot; ///< PNG of the window, written after the last frame
    std::optional<std::string> shaders;    ///< a folder; they are reloaded as its files change
    bool resetSettings = false;            ///< forgets what was remembered of earlier runs
    int uiCost = 0; ///< measures so many frames with and without the interface, prints, and ends
    bool debugContext = false; ///< the driver checks every call and reports to the log
};

/// Opens the window and returns when it has been closed.
void runView(const ViewOptions& options);

} // namespace afterglow
