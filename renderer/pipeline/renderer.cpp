#include "renderer/pipeline/renderer.h"

#include "shared/counters.h"

#include <algorithm>
#include <cmath>
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
    void trace(const Settings& settings, const GpuTexture& tracedSurface,
               const GpuTexture& tracedGuides);
    const GpuTexture& present(FrameContext& context, const GpuTexture& signal,
                              const Settings& settings);

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
    const GpuTexture* signal = nullptr; ///< of the last frame

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

Renderer::Renderer(ShaderLibrary& shaders, const GlInfo& gl)
    : impl_(std::make_unique<Impl>(shaders, gl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::setScene(Scene scene) {
    auto gpuScene = std::make_unique<SceneGpu>(scene);
    impl_->sceneGpu = std::move(gpuScene);
    impl_->scene = std::move(scene);
    const SceneGpu& gpuSide = *impl_->sceneGpu;
    impl_->sceneStats = {.triangles = gpuSide.triangleCount(),
                         .instances = impl_->scene.instances.size(),
                         .lights = impl_->scene.lights.size(),
                         .lightTriangles = gpuSide.lightTriangleCount(),
                         .bvhNodes = gpuSide.bvh().nodes().size(),
                         .bvhBuildMilliseconds = gpuSide.bvhBuildMilliseconds()};
    impl_->previousPose.reset();
    impl_->converging.reset();
    resetHistory();
}

const Scene& Renderer::scene() const {
    return impl_->scene;
}
const SceneStats& Renderer::sceneStats() const {
    return impl_->sceneStats;
}

void Renderer::resize(glm::ivec2 size) {
    if (size == impl_->targets.size)
        return;
    impl_->targets = RenderTargets(size);
    impl_->signal = nullptr;
    impl_->converging.reset();
    impl_->placed.reset();
    impl_->lost = {};
    resetHistory();
}

glm::ivec2 Renderer::size() const {
    return impl_->targets.size;
}

void Renderer::resetHistory() {
    impl_->frame.forget();
}

// Poses, lights and the frame block.
void Renderer::Impl::begin(const FrameInput& input, const Settings& settings) {
    const Pose pose = poseAt(scene, input.seconds);
    sceneGpu->update(scene, pose, previousPose.value_or(pose));
    previousPose = pose;
    setLights(input);

    gpu::FrameUniforms& u = frame.uniforms;
    // Without occlusion rays there are no surroundings: the lights are all the light there is.
    u.ambient =
        Signal(settings.lighting.signal) == Signal::Shadows ? glm::vec3(0.0f) : scene.ambient;
    u.extent = sceneGpu->extent();
    u.frame = input.frame;
    u.sampleIndex = input.frame;
    u.seed = input.seed;
    u.lightTriangleCount = sceneGpu->lightTriangleCount();
    u.aoRadius = settings.lighting.aoRadius * sceneGpu->extent();
    u.signalClamp = settings.lighting.signalClamp;
    u.bvh = sceneGpu->bvh().params();
    frame.begin(input.camera, targets.size);
    targets.counters.clear();
}

void Renderer::Impl::setLights(const FrameInput& input) {
    std::vector<glm::vec3> scales;
    for (const LightState& light : input.lights)
        scales.push_back(light.scale());
    sceneGpu->setLightScales(scales);
}

// The visibility samples of the pixels' centers, for a reference, and their surfaces.
void Renderer::Impl::findSurfaces(FrameContext& context) {
    RenderTargets& t = targets;
    visibility.run(context, *sceneGpu,
                   {t.framebuffer, t.ids, t.visibility.current(), t.seeds.current()});
    surface.run(context, *sceneGpu, {t.visibility.current()},
                {t.surface, t.guides.current(), t.slope, t.motion, t.albedo, t.emission});
}

// Moves the scene to another time, and the visibility samples with it.
void Renderer::Impl::placeSurfaces(FrameContext& context, double seconds) {
    const Pose pose = poseAt(scene, seconds);
    sceneGpu->update(scene, pose, pose);
    frame.uniforms.bvh = sceneGpu->bvh().params();
    frame.upload();
    if (!placed)
        placed.emplace(targets.size);
    surface.run(context, *sceneGpu, {targets.visibility.current()},
                {placed->surface, placed->guides, placed->slope, placed->motion, placed->albedo,
                 placed->emission});
}

// One sample of the signal on these surfaces, from what the visibility buffer and the seeds hold.
void Renderer::Impl::trace(const Settings& settings, const GpuTexture& tracedSurface,
                           const GpuTexture& tracedGuides) {
    FrameContext context{timer};
    RenderTargets& t = targets;
    const auto signalKind = Signal(settings.lighting.signal);
    lighting.run(context, *sceneGpu,
                 {t.visibility.current(), tracedSurface, tracedGuides, t.seeds.current()},
                 {t.raw.current(), t.counters},
                 {.shadows = signalKind != Signal::AmbientOcclusion,
                  .ambientOcclusion = signalKind != Signal::Shadows});
}

const GpuTexture& Renderer::Impl::present(FrameContext& context, const GpuTexture& newest,
                                          const Settings& settings) {
    RenderTargets& t = targets;
    signal = &newest;
    composite.run(context, {newest, t.albedo, t.emission, t.guides.current()}, {t.composed});
    tonemap.run(context, t.composed, t.display,
                {std::exp2(settings.display.exposure), 0.0f, 0.0f, 0.0f});
    return t.display;
}

// The order of a frame.
const GpuTexture& Renderer::render(const FrameInput& input, const Settings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    RenderTargets& t = self.targets;
    self.converging.reset();
    // The frame before becomes the history. At the start and not at the end of a frame, so that
    // what was just rendered can be looked at as "current".
    t.swapHistories();
    self.timer.beginFrame();
    self.begin(input, settings);

    FrameContext context{self.timer};
    const DenoisePlan plan = makePlan(settings.filter, settings.denoiser);
    self.visibility.run(context, *self.sceneGpu,
                        {t.framebuffer, t.ids, t.visibility.current(), t.seeds.current()});
    if (plan.carrySamples)
        self.denoiser.carrySamples(context, *self.sceneGpu, t);
    self.surface.run(context, *self.sceneGpu, {t.visibility.current()},
                     {t.surface, t.guides.current(), t.slope, t.motion, t.albedo, t.emission});
    self.trace(settings, t.surface, t.guides.current());
    const GpuTexture& clean = self.denoiser.run(context, plan, t, settings.denoiser);
    const GpuTexture& display = self.present(context, clean, settings);

    self.frame.end();
    self.timer.endFrame();
    return display;
}

void Renderer::beginReference(const FrameInput& input, const Settings& settings) {
    beginReference(input, input, settings);
}

void Renderer::beginReference(const FrameInput& seen, const FrameInput& world,
                              const Settings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    RenderTargets& t = self.targets;
    FrameInput first = seen;
    first.frame = 0; // the number of a reference's first sample takes the place of the frame's
    self.begin(first, settings);
    self.frame.forget();
    self.previousPose.reset();
    FrameContext context{self.timer};
    self.findSurfaces(context);
    self.setLights(world);
    self.converging = Impl::Reference{settings, &t.surface, &t.guides.current()};
    if (world.seconds != seen.seconds) {
        self.placeSurfaces(context, world.seconds);
        self.converging->surface = &self.placed->surface;
        self.converging->guides = &self.placed->guides;
    }
    if (self.lost.size() != t.size)
        self.lost = GpuTexture("sum, lost", PixelFormat::RGBA32F, t.size);
    self.lost.clear();
    t.sum.clear();
}

void Renderer::addReferenceSamples(int count) {
    Impl& self = *impl_;
    if (!self.converging)
        throw std::logic_error("Renderer: beginReference() comes before its samples");
    RenderTargets& t = self.targets;
    FrameContext context{self.timer};
    Impl::Reference& reference = *self.converging;
    for (int i = 0; i < count; ++i) {
        self.trace(reference.settings, *reference.surface, *reference.guides);
        self.reference.add(context, t.raw.current(), {t.seeds.current(), t.sum, self.lost});
        ++reference.samples;
    }
}

const GpuTexture& Renderer::finishReference() {
    Impl& self = *impl_;
    if (!self.converging || self.converging->samples == 0)
        throw std::logic_error("Renderer: a reference needs samples");
    FrameContext context{self.timer};
    self.reference.mean(context, self.targets.sum, self.converging->samples,
                        self.targets.filtered[0]);
    return self.present(context, self.targets.filtered[0], self.converging->settings);
}

const GpuTexture& Renderer::showReference(const Image<glm::vec4>& converged,
                                          const Settings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    FrameContext context{self.timer};
    self.targets.filtered[0].write(converged);
    return self.present(context, self.targets.filtered[0], settings);
}

const RenderTargets& Renderer::targets() const {
    return impl_->targets;
}

const GpuTexture& Renderer::filteredSignal() const {
    if (!impl_->signal)
        throw std::logic_error("Renderer: no frame has been rendered");
    return *impl_->signal;
}

FrameStats Renderer::readStats() const {
    const auto counters = impl_->targets.counters.read<std::uint32_t>();
    return {.rays = counters({int(gpu::kCounterRays), 0}),
            .gradientSamples = counters({int(gpu::kCounterGradientSamples), 0}),
            .invalidValues = counters({int(gpu::kCounterInvalid), 0})};
}

GpuTimer& Renderer::timer() {
    return impl_->timer;
}

} // namespace afterglow
