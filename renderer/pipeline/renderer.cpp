#include "renderer/pipeline/renderer_impl.h"

#include "shared/counters.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afterglow {

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
    impl_->signals = {};
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

// One sample of the signal on these surfaces.
void Renderer::Impl::trace(const FrameContext& outer, const Settings& settings,
                           const Traced& traced, GpuTexture& raw) {
    FrameContext context = outer;
    const auto signalKind = Signal(settings.lighting.signal);
    lighting.run(context, *sceneGpu,
                 {traced.visibility, traced.surface, traced.guides, traced.seeds},
                 {raw, targets.counters},
                 {.shadows = signalKind != Signal::AmbientOcclusion,
                  .ambientOcclusion = signalKind != Signal::Shadows});
}

// What forward projection set beside the picture, shaded.
void Renderer::Impl::traceExtraSamples(FrameContext& outer, const Settings& settings) {
    FrameContext context{outer.timer, outer.listener, "extra "};
    ExtraSamples& x = targets.extra;
    surface.run(context, *sceneGpu, {x.visibility},
                {x.surface, x.guides, x.slope, x.motion, x.albedo, x.emission});
    trace(context, settings, {x.visibility, x.surface, x.guides, x.seeds}, x.raw);
}

// Filters that did not run in the last frame go on where the first one that did has come to.
void Renderer::Impl::startStates(std::span<const FilterRun> runs) {
    const auto ran = [&](std::size_t state) { return signals[state] != nullptr; };
    std::size_t donor = 0;
    while (donor < kFilterStates && !ran(donor))
        ++donor;
    std::array<bool, kFilterStates> taken{};
    for (const FilterRun& run : runs) {
        if (run.state >= kFilterStates || std::exchange(taken[run.state], true))
            throw std::logic_error("Renderer: each filter needs a state of its own");
        FilterTargets& own = targets.filters[run.state];
        if (own.empty())
            own = FilterTargets(targets.size);
        if (donor < kFilterStates && !ran(run.state)) {
            own.color.current().copyFrom(targets.filters[donor].color.current());
            own.moments.current().copyFrom(targets.filters[donor].moments.current());
        }
    }
}

const GpuTexture& Renderer::Impl::present(FrameContext& context, FilterTargets& filter,
                                          const GpuTexture& newest, const Settings& settings) {
    RenderTargets& t = targets;
    signals[std::size_t(&filter - t.filters.data())] = &newest;
    composite.run(context, {newest, t.albedo, t.emission, t.guides.current()}, {filter.composed});
    tonemap.run(context, filter.composed, filter.display,
                {std::exp2(settings.display.exposure), 0.0f, 0.0f, 0.0f});
    return filter.display;
}

const GpuTexture& Renderer::render(const FrameInput& input, const Settings& settings) {
    const FilterRun run{0, settings};
    render(input, {&run, 1});
    return impl_->targets.filters[0].display;
}

// The order of a frame.
void Renderer::render(const FrameInput& input, std::span<const FilterRun> runs) {
    impl_->requireScene();
    if (runs.empty())
        throw std::logic_error("Renderer: a frame needs a filter");
    Impl& self = *impl_;
    RenderTargets& t = self.targets;
    self.converging.reset();
    self.startStates(runs);
    // The frame before becomes the history. At the start and not at the end of a frame, so that
    // what was just rendered can be looked at as "current".
    t.swapHistories();
    self.timer.beginFrame();
    const Settings& settings = runs.front().settings;
    self.begin(input, settings);

    FrameContext context{self.timer, self.listener};
    const auto placement = SamplePlacement(settings.lighting.gradientSamples);
    const bool extra = placement == SamplePlacement::Extra;
    bool carries = false, usesLambda = false;
    std::vector<DenoisePlan> plans;
    for (const FilterRun& run : runs) {
        plans.push_back(makePlan(run.settings.filter, run.settings.denoiser));
        carries = carries || plans.back().carrySamples;
        usesLambda = usesLambda || plans.back().useLambda;
    }

    self.visibility.run(context, *self.sceneGpu,
                        {t.framebuffer, t.ids, t.visibility.current(), t.seeds.current()});
    if (carries) {
        if (extra && t.extra.empty())
            t.extra = ExtraSamples(t.strata);
        self.denoiser.carrySamples(context, *self.sceneGpu, t, placement);
    }
    self.surface.run(context, *self.sceneGpu, {t.visibility.current()},
                     {t.surface, t.guides.current(), t.slope, t.motion, t.albedo, t.emission});
    self.trace(context, settings,
               {t.visibility.current(), t.surface, t.guides.current(), t.seeds.current()},
               t.raw.current());
    if (extra && usesLambda)
        self.traceExtraSamples(context, settings);

    self.signals = {};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        FilterTargets& own = t.filters[runs[i].state];
        if (runs.size() > 1)
            context.prefix = std::string(1, char('A' + runs[i].state)) + " ";
        const GpuTexture& clean =
            self.denoiser.run(context, plans[i], t, own, runs[i].settings.denoiser, placement);
        self.present(context, own, clean, settings);
    }

    self.frame.end();
    self.timer.endFrame();
}

const RenderTargets& Renderer::targets() const {
    return impl_->targets;
}

const GpuTexture& Renderer::filteredSignal(std::size_t state) const {
    const GpuTexture* const signal = impl_->signals.at(state);
    if (!signal)
        throw std::logic_error("Renderer: no frame has been rendered");
    return *signal;
}

bool Renderer::hasRun(std::size_t state) const {
    return state < kFilterStates && impl_->signals[state] != nullptr;
}

std::size_t HistoryCheckpoint::bytes() const {
    std::size_t sum = visibility.bytes() + seeds.bytes() + guides.bytes() + raw.bytes();
    for (const auto& filter : filters)
        if (filter)
            sum += filter->color.bytes() + filter->moments.bytes();
    return sum;
}

HistoryCheckpoint Renderer::checkpoint() const {
    impl_->requireScene();
    const RenderTargets& t = impl_->targets;
    HistoryCheckpoint kept{.visibility = t.visibility.current().copy(),
                           .seeds = t.seeds.current().copy(),
                           .guides = t.guides.current().copy(),
                           .raw = t.raw.current().copy(),
                           .filters = {},
                           .matrices = impl_->frame.previous(),
                           .pose = impl_->previousPose};
    for (std::size_t i = 0; i < kFilterStates; ++i)
        if (impl_->signals[i])
            kept.filters[i] = {t.filters[i].color.current().copy(),
                               t.filters[i].moments.current().copy()};
    return kept;
}

void Renderer::restore(const HistoryCheckpoint& kept) {
    impl_->requireScene();
    RenderTargets& t = impl_->targets;
    impl_->converging.reset();
    t.visibility.current().copyFrom(kept.visibility);
    t.seeds.current().copyFrom(kept.seeds);
    t.guides.current().copyFrom(kept.guides);
    t.raw.current().copyFrom(kept.raw);
    impl_->signals = {};
    for (std::size_t i = 0; i < kFilterStates; ++i) {
        if (!kept.filters[i])
            continue;
        FilterTargets& own = t.filters[i];
        if (own.empty())
            own = FilterTargets(t.size);
        own.color.current().copyFrom(kept.filters[i]->color);
        own.moments.current().copyFrom(kept.filters[i]->moments);
        impl_->signals[i] = &own.color.current(); // until the next frame has filtered
    }
    impl_->frame.setPrevious(kept.matrices);
    impl_->previousPose = kept.pose;
}

void Renderer::setListener(PassListener* listener) {
    impl_->listener = listener;
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
