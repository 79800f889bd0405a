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
    void trace(const Settings& settings);
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

    struct Reference {
        Settings settings;
        std::uint32_t firstIndex = 0;
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

    std::vector<glm::vec3> scales;
    for (const LightState& light : input.lights)
        scales.push_back(light.scale());
    sceneGpu->setLightScales(scales);

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

// Surfaces and one sample of the signal from what the visibility buffer and the seeds hold.
void Renderer::Impl::trace(const Settings& settings) {
    FrameContext context{timer};
    RenderTargets& t = targets;
    const auto signalKind = Signal(settings.lighting.signal);
    lighting.run(context, *sceneGpu,
                 {t.visibility.current(), t.surface, t.guides.current(), t.seeds.current()},
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
    self.trace(settings);
    const GpuTexture& clean = self.denoiser.run(context, plan, t, settings.denoiser);
    const GpuTexture& display = self.present(context, clean, settings);

    self.frame.end();
    self.timer.endFrame();
    return display;
}

void Renderer::beginReference(const FrameInput& input, const Settings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    RenderTargets& t = self.targets;
    self.begin(input, settings);
    self.frame.forget();
    self.previousPose.reset();
    FrameContext context{self.timer};
    self.visibility.run(context, *self.sceneGpu,
                        {t.framebuffer, t.ids, t.visibility.current(), t.seeds.current()});
    self.surface.run(context, *self.sceneGpu, {t.visibility.current()},
                     {t.surface, t.guides.current(), t.slope, t.motion, t.albedo, t.emission});
    t.sum.clear();
    self.converging = Impl::Reference{settings, 0, 0};
}

void Renderer::addReferenceSamples(int count) {
    Impl& self = *impl_;
    if (!self.converging)
        throw std::logic_error("Renderer: beginReference() comes before its samples");
    RenderTargets& t = self.targets;
    FrameContext context{self.timer};
    for (int i = 0; i < count; ++i) {
        self.frame.uniforms.sampleIndex =
            self.converging->firstIndex + std::uint32_t(self.converging->samples);
        self.frame.upload();
        self.visibility.resolve(context, *self.sceneGpu,
                                {t.framebuffer, t.ids, t.visibility.current(), t.seeds.current()});
        self.trace(self.converging->settings);
        self.reference.add(context, t.raw.current(), t.sum);
        ++self.converging->samples;
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
