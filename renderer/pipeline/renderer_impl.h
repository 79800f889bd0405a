#pragma once

// What Renderer is made of. Seen by its own .cpp files alone.

#include "renderer/pipeline/renderer.h"

#include <stdexcept>

namespace afterglow {

struct Renderer::Impl {
    Impl(ShaderLibrary& shaders, const GlInfo& gl)
        : timer(gl.softwareRasterizer), visibility(shaders), surface(shaders), lighting(shaders),
          denoiser(shaders), composite(shaders), tonemap(shaders), reference(shaders) {}

    void requireScene() const {
        if (!sceneGpu || targets.size.x == 0)
            throw std::logic_error("Renderer: setScene() and resize() come before a frame");
    }
    void begin(const FrameInput& input, const Settings& settings);
    void setLights(const FrameInput& input);
    void findSurfaces(FrameContext& context);
    void placeSurfaces(FrameContext& context, double seconds);
    struct Traced { // what is lit, and by which random numbers
        const GpuTexture &visibility, &surface, &guides, &seeds;
    };
    void trace(const FrameContext& context, const Settings& settings, const Traced& traced,
               GpuTexture& raw);
    void traceExtraSamples(FrameContext& context, const Settings& settings);
    void startStates(std::span<const FilterRun> runs);
    const GpuTexture& present(FrameContext& context, FilterTargets& filter,
                              const GpuTexture& signal, const Settings& settings);

    GpuTimer timer;
    VisibilityPass visibility;
    SurfacePass surface;
    LightingPass lighting;
    Denoiser denoiser;
    CompositePass composite;
    TonemapPass tonemap;
    ReferencePass reference;

    Scene scene;
    SceneStats sceneStats;
    std::unique_ptr<SceneGpu> sceneGpu;
    std::optional<Pose> previousPose;
    FrameData frame;
    RenderTargets targets;
    PassListener* listener = nullptr;
    /// By state, of those that ran in the last frame.
    std::array<const GpuTexture*, kFilterStates> signals{};

    /// Surfaces somewhere else than where they are seen.
    struct PlacedSurfaces {
        explicit PlacedSurfaces(glm::ivec2 size)
            : surface("placed surface", PixelFormat::RGBA32UI, size),
              guides("placed guides", PixelFormat::RGBA32F, size),
              slope("placed slope", PixelFormat::RG32F, size),
              motion("placed motion", PixelFormat::RGBA32F, size),
              albedo("placed albedo", PixelFormat::RGBA32F, size),
              emission("placed emission", PixelFormat::RGBA32F, size) {}
        GpuTexture surface, guides, slope, motion, albedo, emission;
    };
    std::optional<PlacedSurfaces> placed; ///< kept from one reference to the next
    GpuTexture lost;                      ///< what rounding took from targets.sum

    struct Reference {
        Settings settings;
        const GpuTexture* surface = nullptr; ///< the surfaces that are lit
        const GpuTexture* guides = nullptr;
        int samples = 0;
    };
    std::optional<Reference> converging;
};

} // namespace afterglow
