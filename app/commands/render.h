// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/shared_options.h"
#include "app/scenario/timeline.h"
#include "renderer/pipeline/aov.h"

namespace afterglow {

inline constexpr glm::ivec2 kRenderSize{640, 360};
inline constexpr int kRenderFrames = 32;
inline constexpr double kRenderRate = 60.0;

/// The options of `afterglow render`, with --export and without.
struct RenderOptions {
    std::string source; ///< a scene; with --export also an experiment
    std::string out;
    std::optional<Variant> filter; ///< or A-SVGF
    SettingsGroup picture;
    // Defaults of these come from the experiment, where there is one.
    std::optional<int> frames;
    std::optional<glm::ivec2> size;
    std::optional<std::uint32_t> seed;
    ContextGroup context;
    std::vector<LightEvent> lights;
    std::string camera;   ///< empty: the first of the scene
    bool animate = false; ///< the scene's own animation plays; otherwise time stands still at 0
    std::optional<double> rate; ///< frames a second of scene time
    std::vector<const AovInfo*> aovs;
    std::string format = "png"; ///< of AOVs: "pfm", else EXR; display images are always PNG

    std::string floatFormat() const { return format == "pfm" ? "pfm" : "exr"; }
    Settings settings() const {
        return picture.changed(settingsOf(filter.value_or(variantOf(Filter::Asvgf)), Signal::Both));
    }
};

/// Returns the index of a camera of the scene; the empty name is the first.
std::size_t cameraIndex(const Scene& scene, std::string_view name);

/// Throws UsageError for what --export cannot do.
void checkExport(const RenderOptions& options);

/// Writes what a denoiser needs of every frame, and export.json.
void exportForDenoiser(const RenderOptions& options, HiddenContextFactory hiddenContext);

} // namespace afterglow
