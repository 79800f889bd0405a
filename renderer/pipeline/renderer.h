// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/filters/svgf_plan.h"
#include "renderer/gl/gpu_timer.h"
#include "renderer/passes/frame_context.h"
#include "renderer/passes/lighting_pass.h"
#include "renderer/pipeline/light_state.h"
#include "renderer/pipeline/settings.h"
#include "renderer/resources/frame_data.h"
#include "renderer/resources/render_targets.h"
#include "renderer/scene/scene.h"

#include <memory>
#include <optional>

namespace afterglow {

/// Everything that comes from outside for one frame. The frame is a pure function of it, of the
/// settings, of the scene and of the frames before.
struct FrameInput {
    Camera camera;
    double seconds = 0.0;               ///< scene time
    std::uint32_t frame = 0;            ///< frame number, rising by one; seeds follow from it
    std::uint32_t seed = 0;             ///< of the whole run
    std::span<const LightState> lights; ///< by light slot; missing ones are on at nominal power
};

struct FrameStats {
    std::uint64_t rays = 0;            ///< traced in this frame
    std::uint32_t gradientSamples = 0; ///< strata that hold one; 0 if the filter carries none
    std::uint32_t invalidValues = 0;   ///< NaN or infinity replaced; 0 in every healthy frame
};

struct SceneStats {
    std::size_t triangles = 0, instances = 0, lights = 0, lightTriangles = 0;
    std::size_t bvhRecords = 0;
    double bvhBuildMilliseconds = 0.0;
};

/// One of the filters that run on the signals of a frame.
struct FilterRun {
    std::size_t state = 0; ///< whose histories it has: one of kFilterStates
    FilterSettings settings;
};

/// A filter that ran, with what it did.
struct RanFilter {
    FilterSettings settings;
    FilterNeeds needs;
    std::optional<SvgfPlan> svgf; ///< of a filter of that family

    /// Its plan; of other families one that does nothing, but for the samples that it carries.
    SvgfPlan planOrNone() const { return svgf ? *svgf : SvgfPlan{.carrySamples = needs.samples}; }
};

/// What a frame leaves for the next one: all histories, as textures of its own.
struct HistoryCheckpoint {
    struct FilterHistory {
        RanFilter ran;
        std::vector<std::vector<GpuTexture>> images; ///< by signal
        std::optional<GpuTexture> resolved;          ///< of anti-aliasing
    };
    std::span<const SignalInfo> signals;
    std::vector<GpuTexture> images;
    std::array<std::optional<FilterHistory>, kFilterStates> filters; ///< of those that ran
    std::optional<FrameData::View> view;
    std::optional<Pose> pose;
    std::optional<GpuTexture> exposure; ///< that has adapted by itself

    std::size_t bytes() const; ///< on the device
};

/// Owns the order of a frame. Needs a current OpenGL 4.5 context for all of its life.
/// The renderer ends at a texture and never touches the default framebuffer.
class Renderer {
public:
    Renderer(ShaderLibrary& shaders, const GlInfo& gl);
    Renderer(Renderer&&) noexcept;
    ~Renderer();

    /// Uploads the scene and builds its trees; clears all histories.
    void setScene(Scene scene);
    const Scene& scene() const;
    const SceneStats& sceneStats() const;

    /// Any size from 1x1 to the largest texture; clears all histories if the size changes. Error if
    /// the images need more memory than the device has, as far as that is known.
    void resize(glm::ivec2 size);
    glm::ivec2 size() const;
    void resetHistory();

    /// Renders one frame; returns the display image (RGBA8, sRGB-encoded, row 0 on top). The
    /// histories are those of state 0.
    const GpuTexture& render(const FrameInput& input, const Settings& settings);
    /// Renders one frame whose signals several filters see, the same bits each; their states are
    /// different ones. A state that did not run in the frame before starts with a copy of the
    /// histories of the lowest one that did, if that is of the same family. If gradient samples are
    /// merged and one of the filters wants them, all see them.
    void render(const FrameInput& input, const FrameSettings& settings,
                std::span<const FilterRun> runs);

    /// What the last frame leaves for the next one. The same frames rendered again from it have the
    /// same bits.
    HistoryCheckpoint checkpoint() const;
    /// The next frame sees these histories. A checkpoint of another size is std::logic_error.
    void restore(const HistoryCheckpoint& checkpoint);

    /// Hears what each pass makes, from the next frame on; empty: nobody. Must outlive its use.
    void setListener(PassListener* listener);

    /// A reference: the converged signals of one moment, from the same surface samples that the
    /// frame of this number has (those of the pixels' centers, unless edges are smoothed) and many
    /// samples of each signal a pixel, summed in compensated 32-bit float. begin, then add as often
    /// as wanted, then finish. All histories are lost.
    void beginReference(const FrameInput& input, const FrameSettings& settings);
    /// The surfaces that `seen` shows, in the light of `world`: the visibility samples (instance,
    /// triangle, barycentrics) are those of the camera and the pose of `seen`; they are placed by
    /// the pose of `world` and lit by its lights, among its geometry. With the frame before as
    /// `world` this is what the surfaces of this frame reflected one frame ago: E f_{i-1} of
    /// [ASVGF]. Normals are turned to the camera of `seen`, and the seed is that of `seen`; the
    /// camera of `world` is not used. The surfaces of targets() stay those of `seen`.
    void beginReference(const FrameInput& seen, const FrameInput& world,
                        const FrameSettings& settings);
    void addReferenceSamples(int count);
    /// The means so far as filteredSignal() of state 0, and the display image; alpha is the
    /// variance of one sample's luminance.
    const GpuTexture& finishReference();
    /// Makes signals that were converged before those of state 0, and the display image, on the
    /// surfaces of the last frame or beginReference(). Another size or number is std::logic_error.
    const GpuTexture& showReference(std::span<const Image<glm::vec4>> signals,
                                    const FrameSettings& settings);

    const RenderTargets& targets() const;
    std::span<const SignalInfo> signals() const; ///< of the last frame or reference
    /// The denoised (or raw, or converged) demodulated signal of the last frame. A state that has
    /// not run is std::logic_error.
    const GpuTexture& filteredSignal(std::size_t state = 0, std::size_t signal = 0) const;
    const GpuTexture& demodulation(std::size_t signal) const; ///< what its signal is to be times
    /// The filter that ran in the last frame; none of a state that did not.
    const RanFilter* ran(std::size_t state = 0) const;
    const GpuTexture& display(std::size_t state = 0) const; ///< of the last frame
    /// An image that can be looked at, of a filter that ran; none if it did not make it.
    struct FilterImage {
        const GpuTexture* texture = nullptr;
        int channel = 0;
    };
    FilterImage filterImage(std::string_view aov, std::size_t state = 0,
                            std::size_t signal = 0) const;
    /// Returns the inputs and images of a filter's passes in the last frame, for passes that run
    /// again to be inspected. Histories of a frame stay in place until the next frame begins.
    /// std::logic_error if the state has not run.
    struct FilterCall {
        FrameContext context;
        FilterInput in;
        FilterImages own;
    };
    FilterCall filterCall(std::size_t state, std::size_t signal);
    /// Returns the inputs and images of the lighting of a signal in the last frame, for rays that
    /// are listed and traced again: that changes the raw signal. std::logic_error if no frame has
    /// been rendered.
    struct LightingCall {
        FrameContext context;
        const SceneGpu& scene;
        LightingPass::Inputs in;
        LightingPass::Outputs out;
    };
    LightingCall lightingCall(std::size_t signal);
    FrameStats readStats() const; ///< waits for the GPU
    GpuTimer& timer();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace afterglow
