// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/frame_recorder.h"
#include "app/workbench/inspection.h"
#include "app/workbench/oracle_view.h"
#include "app/workbench/pass_capture.h"
#include "app/workbench/pass_timings.h"
#include "app/workbench/pictures.h"
#include "app/workbench/preset_store.h"
#include "app/workbench/view_state.h"
#include "renderer/passes/reason_pass.h"
#include "renderer/pipeline/renderer.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace afterglow {

/// Where the workbench finds and leaves files.
struct WorkbenchFolders {
    std::filesystem::path output;  ///< pictures, curves, recordings
    std::filesystem::path presets; ///< of the user
};

/// Everything that happens in the window, without a window: renders the frames that the state asks
/// for, measures them, and does what was requested. Needs a current OpenGL 4.5 context for all of
/// its life.
class Workbench {
public:
    Workbench(ShaderLibrary& shaders, const GlInfo& gl, Scene scene, ViewState initial,
              WorkbenchFolders folders);
    ~Workbench();

    ViewState state; ///< changed by whoever likes to, between rounds

    /// One round: does what is wanted and renders a frame if it is time for one. `view`: pixels of
    /// the window's part for pictures; empty: nothing is rendered. Returns whether a frame was.
    bool advance(double wallSeconds, glm::ivec2 view);

    /// Waits for the measurements of the last frame: probes, counters, inspector. Without this call
    /// they arrive with the next frame, or in the next round where no frame is rendered; at once
    /// where time stands still.
    void finishMeasuring();

    /// Returns the seconds until advance() has work to do if nothing else happens.
    double secondsUntilFrame() const;

    /// What a pane shows now: RGBA8, sRGB-encoded; null before the first frame. In a difference,
    /// that of the first pane of the pair.
    const GpuTexture* picture(std::size_t pane);
    glm::ivec2 imageSize() const; ///< of the rendered image; 0 before the first frame
    PictureLegend legend(std::size_t pane);

    const Renderer& renderer() const;
    const Scene& scene() const;
    const GlInfo& gl() const;
    const PassTimings& timings() const; ///< of the device's work for frames, and for nothing else
    const FrameStats& stats() const;    ///< of a recent frame
    double raysPerSecond() const;       ///< of a frame, in the time that the device worked for it
    const ProbeLog& probeLog() const;   ///< see finishMeasuring()
    /// Of the last measured frame, of a pane that is shown; kept up to date while the inspector is
    /// open.
    std::optional<ReasonCounts> reasons(std::size_t pane) const;
    const PassCapture& passes() const;
    const OracleView& oracle() const;
    std::optional<double> oracleRmse(std::size_t pane);
    const std::optional<Inspection>& inspection() const; ///< while the inspector is open
    const PresetStore& presets() const;
    const FrameRecorder& recorder() const;
    std::span<const std::string> shaderErrors() const; ///< from the last attempt to reload
    std::size_t imageBytes() const;                    ///< of all images on the device

    /// Opens a scene or an experiment by name or path; what is wrong with it becomes a notice.
    void open(const std::string& nameOrPath);
    /// Whether a name or path means an experiment: one that is built in, or a .json file.
    static bool isExperiment(const std::string& nameOrPath);
    /// Opens the scene of a stop of the tour and sets up what it shows; past the last stop the tour
    /// ends. `view`: as for advance().
    void enterTourStop(std::size_t index, glm::ivec2 view);

    // The clipboard is the window's.
    std::optional<std::string> takeCopied(); ///< text that was asked to be copied, once
    void paste(const std::string& text);     ///< a preset, for the active pane
    /// Writes a picture with the next free name; what comes of it becomes a notice.
    void save(const Image<glm::u8vec4>& picture);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace afterglow
