// SPDX-License-Identifier: MIT
#pragma once

// What Workbench is made of. Seen by its own .cpp files alone.

#include "app/workbench/instruments.h"
#include "app/workbench/pictures.h"
#include "app/workbench/workbench.h"

#include <functional>
#include <set>

namespace afterglow {

struct Workbench::Impl {
    Impl(Workbench& owner, ShaderLibrary& library, const GlInfo& info, WorkbenchFolders places);

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
    Pictures::Sources sources() { return {renderer, state, capture, oracle}; }

    // What was requested, in workbench_files.cpp.
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

    Workbench& owner;
    ViewState& state; ///< the owner's
    ShaderLibrary& shaders;
    GlInfo gl;
    WorkbenchFolders folders;
    Renderer renderer;
    Pictures pictures;
    Instruments instruments;
    OracleView oracle;
    PassCapture capture;
    PresetStore presets;
    FrameRecorder recorder;

    PassTimings timings;
    std::uint64_t timedFrame = 0;      ///< of the renderer's timer, whose times were looked at last
    std::uint64_t renderedFrames = 0;  ///< as the renderer's timer counts them
    std::uint64_t lastCompiling = 0;   ///< the last of them with settings that were new
    std::set<std::string> compiledFor; ///< settings of panes that a frame was rendered with
    FrameStats stats;
    double raysPerSecond = 0.0;
    double sinceFrame = 0.0, sinceStats = 0.0, sinceReload = 0.0; ///< seconds
    ProbeLog log;
    std::array<std::optional<ReasonCounts>, kFilterStates> reasons;
    std::optional<Inspection> inspection;
    std::optional<HistoryCheckpoint> checkpoint;
    std::optional<SceneFrame> now, before; ///< of the last two frames
    std::optional<SceneFrame> checkpointFrame;
    std::uint32_t nowSeed = 0;
    FrameSettings nowSettings; ///< of the last frame
    bool capturesAll = false;  ///< every pass of the next frame
    std::vector<std::string> shaderErrors;
    std::optional<std::string> copied;
    struct Suspended {
        ViewState state;
        Scene scene;
    };
    std::optional<Suspended> suspended; ///< what was there before the experiment that is played
};

} // namespace afterglow
