// SPDX-License-Identifier: MIT
#pragma once

// Members of Renderer. Seen by its own .cpp files alone.

#include "renderer/passes/composite_pass.h"
#include "renderer/passes/exposure_pass.h"
#include "renderer/passes/forward_project_pass.h"
#include "renderer/passes/gradient_pass.h"
#include "renderer/passes/reference_pass.h"
#include "renderer/passes/surface_pass.h"
#include "renderer/passes/taa_pass.h"
#include "renderer/passes/tonemap_pass.h"
#include "renderer/passes/visibility_pass.h"
#include "renderer/pipeline/renderer.h"

#include <map>
#include <stdexcept>

namespace afterglow {

struct Renderer::Impl {
    Impl(ShaderLibrary& library, const GlInfo& gl)
        : shaders(library), software(gl.softwareRasterizer), timer(gl.softwareRasterizer),
          visibility(shaders), forwardProject(shaders), surface(shaders), lighting(shaders),
          paths(shaders), strata(shaders), composite(shaders), autoExposure(shaders), taa(shaders),
          tonemap(shaders), reference(shaders) {
        programsOf(familyOf(Filter::Svgf)); // compiled before the first frame
    }

    void requireScene() const {
        if (!sceneGpu || targets.size.x == 0)
            throw std::logic_error("Renderer: setScene() and resize() come before a frame");
    }
    FrameContext context() { return {.timer = timer, .uniforms = &frame.block()}; }
    enum class Needed { FrameAndFilter, Filter, Paths };
    void requireMemoryFor(glm::ivec2 size, Needed what) const;
    /// Returns the factor of a signal: of light on white surfaces the albedo.
    const GpuTexture& demodulation(std::size_t signal) const {
        return division ? targets.signals.at(signal).divisor : targets.surfaces.albedo;
    }
    /// Returns how what a signal shows has moved.
    const GpuTexture& motionOf(std::size_t signal) const {
        const GpuTexture& own = targets.signals.at(signal).motion;
        return own.size().x > 0 ? own : targets.surfaces.motion;
    }
    static RanFilter ranFilterOf(const FilterSettings& settings);
    SignalFilter& programsOf(const FilterFamily& family);
    void begin(const FrameInput& input, const FrameSettings& settings, glm::vec2 jitter);
    void setLights(const FrameInput& input);
    void setSignals(const FrameSettings& settings);
    void startStates(std::span<const FilterRun> runs);
    void startState(std::size_t state, const FilterFamily& family);

    void carrySamples(FrameContext& context, bool beside);
    /// Makes what signals of paths are multiplied with in the end.
    void divide(FrameContext& context);
    /// One sample of each signal on these surfaces, for each signal into `raw` of it.
    void trace(const FrameContext& context, const Surfaces& surfaces, const GpuTexture& seeds,
               GpuTexture& (*raw)(SignalTargets&));
    void traceSamplesBeside(const FrameContext& context);
    void filter(const FrameContext& context, const FilterRun& run);
    FilterInput filterInput(std::size_t signal) const;
    void compose(FrameContext& context, std::size_t state);
    void expose(FrameContext context, std::size_t state, const DisplaySettings& display);
    const GpuTexture& antiAlias(FrameContext& context, FilterTargets& shown,
                                const GpuTexture& color, const GpuTexture* exposure,
                                const gpu::TaaParams& params);
    const GpuTexture& present(FrameContext& context, std::size_t state,
                              const DisplaySettings& display);
    const GpuTexture& presentReference(FrameContext& context, DisplaySettings display);
    void placeSurfaces(FrameContext& context, double seconds);
    void beginReferenceSample();

    ShaderLibrary& shaders;
    bool software;
    GpuTimer timer;
    VisibilityPass visibility;
    ForwardProjectPass forwardProject;
    SurfacePass surface;
    LightingPass lighting;
    PathPass paths;
    StrataPass strata;
    CompositePass composite;
    ExposurePass autoExposure;
    TaaPass taa;
    TonemapPass tonemap;
    ReferencePass reference;
    std::map<const FilterFamily*, std::unique_ptr<SignalFilter>> programs;

    Scene scene;
    SceneStats sceneStats;
    std::unique_ptr<SceneGpu> sceneGpu;
    std::optional<Pose> previousPose;
    FrameData frame;
    RenderTargets targets;
    PassListener* listener = nullptr;

    bool samplesBeside = false; ///< gradient samples of the last frame are not in the picture
    std::span<const SignalInfo> signals = signalsOf(Signal::Both);
    std::optional<PathPass::Division> division; ///< of paths; empty: light on white surfaces
    /// Of the last frame, by state.
    struct State {
        std::optional<RanFilter> ran;
        std::array<const GpuTexture*, kMaxSignals> results{}; ///< by signal; null: nothing yet
    };
    std::array<State, kFilterStates> states;

    struct Reference {
        FrameSettings settings;
        const Surfaces* surfaces = nullptr; ///< that are lit
        int samples = 0;
    };
    std::optional<Reference> converging;
};

} // namespace afterglow
