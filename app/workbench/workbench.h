// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/frame_recorder.h"
#include "app/workbench/instruments.h"
#include "app/workbench/pass_timings.h"
#include "app/workbench/pictures.h"
#include "app/workbench/preset_store.h"

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

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
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    ViewState state; ///< changed by whoever likes to, between rounds

    /// One round: does what is wanted and renders a frame if it is time for one. `view`: pixels of
    /// the window's part for pictures; empty: nothing is rendered. Returns whether a frame was.
    bool advance(double wallSeconds, glm::ivec2 view);

    /// Waits for the measurements of the last frame: probes, counters, inspector. Without this call
    /// they arrive with the next frame, or in the next round where no frame is rendered; at once
    /// where time stands still.
    void finishMeasuring() { collect(); }

    /// Returns the seconds until advance() has work to do if nothing else happens.
    double secondsUntilFrame() const;

    /// What a pane shows now: RGBA8, sRGB-encoded; null before the first frame. In a difference,
    /// that of the first pane of the pair.
    const GpuTexture* picture(std::size_t pane);
    glm::ivec2 imageSize() const; ///< of the rendered image; 0 before the first frame
    PictureLegend legend(std::size_t pane);

    const Renderer& renderer() const { return renderer_; }
    const Scene& scene() const { return renderer_.scene(); }
    const GlInfo& gl() const { return gl_; }
    /// Of the device's work for frames, and for nothing else.
    const PassTimings& timings() const { return timings_; }
    const FrameStats& stats() const { return stats_; } ///< of a recent frame
    /// Of a frame, in the time that the device worked for it.
    double raysPerSecond() const { return raysPerSecond_; }
    const ProbeLog& probeLog() const { return log_; } ///< see finishMeasuring()
    /// Of the last measured frame, of a pane that is shown; kept up to date while the inspector is
    /// open.
    std::optional<ReasonCounts> reasons(std::size_t pane) const { return reasons_.at(pane); }
    const PassCapture& passes() const { return capture_; }
    const OracleView& oracle() const { return oracle_; }
    std::optional<double> oracleRmse(std::size_t pane) { return oracle_.rmse(pane); }
    /// While the inspector is open.
    const std::optional<Inspection>& inspection() const { return inspection_; }
    const PresetStore& presets() const { return presets_; }
    const FrameRecorder& recorder() const { return recorder_; }
    /// From the last attempt to reload.
    std::span<const std::string> shaderErrors() const { return shaderErrors_; }
    std::size_t imageBytes() const; ///< of all images on the device

    /// Opens a scene or an experiment by name or path; what is wrong with it becomes a notice.
    void open(const std::string& nameOrPath);
    /// Whether a name or path means an experiment: one that is built in, or a .json file.
    static bool isExperiment(const std::string& nameOrPath);
    /// Opens the scene of a stop of the tour and sets up what it shows; past the last stop the tour
    /// ends. `view`: as for advance().
    void enterTourStop(std::size_t index, glm::ivec2 view);

    // The clipboard is the window's.
    /// Text that was asked to be copied, once.
    std::optional<std::string> takeCopied() { return std::exchange(copied_, {}); }
    void paste(const std::string& text); ///< a preset, for the active pane
    /// Writes a picture with the next free name; what comes of it becomes a notice.
    void save(const Image<glm::u8vec4>& picture);

private:
    // The order of a round, in workbench.cpp.
    void renderFrame(double wallSeconds, glm::ivec2 view);
    SceneFrame prepareFrame(glm::ivec2 view);
    void render(const SceneFrame& frame);
    void noteTimes();
    void measure(const SceneFrame& frame);
    void collect();
    void followFreeze();
    void stepPass(int step);
    void inspectPixel(bool rendered);
    Pictures::Sources sources() { return {renderer_, state, capture_, oracle_}; }

    // Serve requests for files; in workbench_files.cpp.
    void serveRequests();
    void saveImageFiles();
    void saveCurves();
    void saveTake();
    void savePreset(const std::string& name);
    void recordFrames();
    void fitRange();
    /// `opened`: what was asked for, a scene or an experiment in it.
    void enter(Scene scene, const std::string& sceneName, const std::string& opened);
    void replaceScene(Scene scene);
    void forgetMeasured(); ///< curves and inspections, also those on their way
    void openExperiment(const std::string& nameOrPath);
    void leaveExperiment();
    std::string curvesText() const;
    Image<glm::u8vec4> composedView();
    /// Does something with files; an Error becomes a notice.
    void attempt(const std::function<void()>& action);

    ShaderLibrary& shaders_;
    GlInfo gl_;
    WorkbenchFolders folders_;
    Renderer renderer_;
    Pictures pictures_;
    Instruments instruments_;
    OracleView oracle_;
    PassCapture capture_;
    PresetStore presets_;
    FrameRecorder recorder_;

    PassTimings timings_;
    std::uint64_t timedFrame_ = 0;     ///< of the renderer's timer, whose times were looked at last
    std::uint64_t renderedFrames_ = 0; ///< as the renderer's timer counts them
    std::uint64_t lastCompiling_ = 0;  ///< the last of them with settings that were new
    std::set<std::string> compiledFor_; ///< settings of panes that a frame was rendered with
    FrameStats stats_;
    double raysPerSecond_ = 0.0;
    double sinceFrame_ = 0.0, sinceStats_ = 0.0, sinceReload_ = 0.0; ///< seconds
    ProbeLog log_;
    std::array<std::optional<ReasonCounts>, kFilterStates> reasons_;
    std::optional<Inspection> inspection_;
    std::optional<HistoryCheckpoint> checkpoint_;
    std::optional<SceneFrame> now_, before_; ///< of the last two frames
    std::optional<SceneFrame> checkpointFrame_;
    std::uint32_t nowSeed_ = 0;
    FrameSettings nowSettings_; ///< of the last frame
    bool capturesAll_ = false;  ///< every pass of the next frame
    std::vector<std::string> shaderErrors_;
    std::optional<std::string> copied_;
    struct Suspended {
        ViewState state;
        Scene scene;
    };
    std::optional<Suspended> suspended_; ///< what was there before the experiment that is played
};

} // namespace afterglow
