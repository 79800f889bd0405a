// SPDX-License-Identifier: MIT
#include "renderer/pipeline/renderer_impl.h"

#include "renderer/gl/device_memory.h"
#include "renderer/pipeline/jitter.h"

#include "shared/counters.h"

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
                         .bvhRecords = gpuSide.bvh().records().size(),
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
    // Before the new ones are made: both may be too much.
    impl_->targets = {};
    impl_->requireMemoryFor(size, Impl::Needed::FrameAndFilter);
    impl_->targets = RenderTargets(size);
    impl_->states = {};
    impl_->converging.reset();
    resetHistory();
}

glm::ivec2 Renderer::size() const {
    return impl_->targets.size;
}

void Renderer::resetHistory() {
    impl_->frame.forget();
}

// Small pictures are nobody's concern: with four filters and two signals a pixel takes 2 kB.
void Renderer::Impl::requireMemoryFor(glm::ivec2 size, Needed what) const {
    constexpr double kSmallPixels = double(1 << 16);
    const double pixels = double(size.x) * double(size.y);
    if (pixels <= kSmallPixels)
        return;
    const ImageBytes perPixel = imageBytes(familyOf(Filter::Svgf).images);
    const double count = double(signals.size());
    double needed = what == Needed::Paths ? perPixel.paths : count * perPixel.filter;
    if (what == Needed::FrameAndFilter)
        needed += perPixel.frame + count * perPixel.signal;
    requireMemory(std::size_t(pixels * needed),
                  "images of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                      " pixels (" + std::to_string(std::lround(needed)) + " bytes a pixel)",
                  software);
}

RanFilter Renderer::Impl::ranFilterOf(const FilterSettings& settings) {
    RanFilter ran{settings, needsOf(settings), {}};
    if (&familyOf(settings.filter) == &familyOf(Filter::Svgf))
        ran.svgf = makePlan(settings);
    return ran;
}

SignalFilter& Renderer::Impl::programsOf(const FilterFamily& family) {
    std::unique_ptr<SignalFilter>& filter = programs[&family];
    if (!filter)
        filter = family.make(shaders);
    return *filter;
}

// Poses, lights and the frame block.
void Renderer::Impl::begin(const FrameInput& input, const FrameSettings& settings,
                           glm::vec2 jitter) {
    const Pose pose = poseAt(scene, input.seconds);
    sceneGpu->update(scene, pose, previousPose.value_or(pose));
    previousPose = pose;
    setLights(input);

    gpu::FrameUniforms& u = frame.uniforms;
    // Without occlusion rays there are no surroundings: the lights are all the light there is.
    u.ambient =
        seesSurroundings(Signal(settings.lighting.signal)) ? scene.ambient : glm::vec3(0.0f);
    u.extent = sceneGpu->extent();
    u.frame = input.frame;
    u.sampleIndex = input.frame;
    u.seed = input.seed;
    u.lightTriangleCount = sceneGpu->lightTriangleCount();
    u.aoRadius = settings.lighting.aoRadius * sceneGpu->extent();
    u.signalClamp = settings.lighting.signalClamp;
    u.regularization = settings.lighting.regularization;
    u.jitter = jitter;
    frame.begin(input.camera, targets.size);
    targets.counters.clear();
}

void Renderer::Impl::setLights(const FrameInput& input) {
    std::vector<glm::vec3> scales;
    for (const LightState& light : input.lights)
        scales.push_back(light.scale());
    sceneGpu->setLightScales(scales);
}

void Renderer::Impl::setSignals(const FrameSettings& settings) {
    const auto signal = Signal(settings.lighting.signal);
    signals = signalsOf(signal);
    division = pathsOf(signal);
    targets.setSignals(signals.size());
    if (division && targets.paths.empty())
        requireMemoryFor(targets.size, Needed::Paths);
    targets.setPaths(division.has_value(), division == PathPass::Division::Lobes);
}

void Renderer::Impl::startStates(std::span<const FilterRun> runs) {
    std::array<bool, kFilterStates> taken{};
    for (const FilterRun& run : runs) {
        if (run.state >= kFilterStates || std::exchange(taken[run.state], true))
            throw std::logic_error("Renderer: each filter needs a state of its own");
        startState(run.state, familyOf(run.settings.filter));
    }
}

// Filters that did not run in the last frame go on where the first one that did has come to.
void Renderer::Impl::startState(std::size_t state, const FilterFamily& family) {
    FilterTargets& own = targets.filters[state];
    if (own.empty()) {
        requireMemoryFor(targets.size, Needed::Filter);
        own = FilterTargets(targets.size);
    }
    const auto isOfFamily = [&](std::size_t other) {
        return states[other].ran && &familyOf(states[other].ran->settings.filter) == &family;
    };
    if (!own.own.empty() && own.own[0].declared().data() != family.images.data())
        own.own.clear();
    const std::size_t there = own.own.size();
    while (own.own.size() < signals.size())
        own.own.emplace_back(family.images, targets.size);
    const bool goesOn = isOfFamily(state);
    if (!goesOn && own.resolved.current().size().x != 0)
        own.resolved.clear();
    std::size_t donor = 0;
    while (donor < kFilterStates && !isOfFamily(donor))
        ++donor;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        if (goesOn && i < there)
            continue;
        const bool given =
            donor < kFilterStates && donor != state && i < targets.filters[donor].own.size();
        if (!given) {
            if (states[state].ran || i < there)
                own.own[i].clearHistories(); // of another filter, or of long ago
            continue;
        }
        const auto from = targets.filters[donor].own[i].kept();
        const auto to = own.own[i].kept();
        for (std::size_t image = 0; image < to.size(); ++image)
            to[image]->copyFrom(*from[image]);
    }
}

void Renderer::Impl::carrySamples(FrameContext& context, bool beside) {
    RenderTargets& t = targets;
    if (beside && t.sampleSurfaces.empty()) {
        t.sampleSurfaces = Surfaces(t.strata, "sample ");
        t.sampleSeeds = GpuTexture("sample seeds", PixelFormat::R32UI, t.strata);
    }
    forwardProject.run(
        context, *sceneGpu, {t.previousVisibility, t.seeds.previous(), t.surfaces.visibility},
        {beside ? t.sampleSurfaces.visibility : t.surfaces.visibility,
         beside ? t.sampleSeeds : t.seeds.current(), t.owners, t.claims, t.samples, t.counters});
}

void Renderer::Impl::trace(const FrameContext& outer, const Surfaces& surfaces,
                           const GpuTexture& seeds, GpuTexture& (*raw)(SignalTargets&)) {
    if (division) {
        std::vector<GpuTexture*> results;
        for (SignalTargets& signal : targets.signals)
            results.push_back(&raw(signal));
        FrameContext context = outer;
        paths.run(context, *sceneGpu, {surfaces, seeds},
                  {results, targets.rays, targets.paths, targets.counters}, *division);
        return;
    }
    for (std::size_t i = 0; i < signals.size(); ++i) {
        FrameContext context = outer.forSignal(signals.size() > 1 ? signals[i].name : "");
        lighting.run(context, *sceneGpu, {surfaces, seeds},
                     {raw(targets.signals[i]), targets.rays, targets.counters}, signals[i].rays);
    }
}

void Renderer::Impl::divide(FrameContext& context) {
    if (!division)
        return;
    std::vector<GpuTexture*> divisors;
    for (SignalTargets& signal : targets.signals)
        divisors.push_back(&signal.divisor);
    paths.divide(context, *sceneGpu, targets.surfaces, divisors, *division);
}

// Shades the gradient samples that forward projection has set beside the picture.
void Renderer::Impl::traceSamplesBeside(const FrameContext& outer) {
    FrameContext context = outer;
    context.prefix = "extra ";
    for (SignalTargets& signal : targets.signals)
        if (signal.sampleRaw.size().x == 0)
            signal.sampleRaw = GpuTexture("sample raw", PixelFormat::RGBA32F, targets.strata);
    surface.run(context, *sceneGpu, targets.sampleSurfaces);
    trace(context, targets.sampleSurfaces, targets.sampleSeeds,
          [](SignalTargets& signal) -> GpuTexture& { return signal.sampleRaw; });
}

// From each signal to the filtered one.
void Renderer::Impl::filter(const FrameContext& context, const FilterRun& run) {
    SignalFilter& programsOfFilter = programsOf(familyOf(run.settings.filter));
    State& state = states[run.state];
    for (std::size_t i = 0; i < signals.size(); ++i) {
        FrameContext own = context.forSignal(signals.size() > 1 ? signals[i].name : "");
        state.results[i] = &programsOfFilter.run(own, filterInput(i), run.settings,
                                                 FilterImages(targets.filters[run.state].own[i]));
    }
}

FilterInput Renderer::Impl::filterInput(std::size_t signal) const {
    const RenderTargets& t = targets;
    return {.surfaces = t.surfaces,
            .previousVisibility = t.previousVisibility,
            .previousGuides = t.previousGuides,
            .motion = motionOf(signal),
            .samples = t.samples,
            .strataGuides = t.strataGuides,
            .strataSlope = t.strataSlope,
            .signal = t.signals.at(signal),
            .newest = t.signals.at(signal).raw.current(),
            .samplesBeside = samplesBeside};
}

const GpuTexture& Renderer::render(const FrameInput& input, const Settings& settings) {
    const FilterRun run{0, settings};
    render(input, settings, {&run, 1});
    return display();
}

// The order of a frame.
void Renderer::render(const FrameInput& input, const FrameSettings& settings,
                      std::span<const FilterRun> runs) {
    impl_->requireScene();
    if (runs.empty())
        throw std::logic_error("Renderer: a frame needs a filter");
    Impl& self = *impl_;
    RenderTargets& t = self.targets;
    self.converging.reset();
    self.setSignals(settings);
    self.startStates(runs);
    // The frame before becomes the history. At the start and not at the end of a frame, so that
    // what was just rendered can be looked at as "current".
    t.swapHistories();
    self.timer.beginFrame();
    self.begin(input, settings, jitterOf(settings.display, input.frame));

    FrameContext context = self.context();
    context.listener = self.listener;
    const bool beside = self.samplesBeside =
        SamplePlacement(settings.lighting.gradientSamples) == SamplePlacement::Extra;
    self.states = {};
    FilterNeeds needs;
    for (const FilterRun& run : runs) {
        const RanFilter& ran = self.states[run.state].ran.emplace(Impl::ranFilterOf(run.settings));
        needs.samples = needs.samples || ran.needs.samples;
        needs.lambda = needs.lambda || ran.needs.lambda;
    }

    self.visibility.run(context, *self.sceneGpu,
                        {t.framebuffer, t.ids, t.surfaces.visibility, t.seeds.current()});
    if (needs.samples)
        self.carrySamples(context, beside);
    self.surface.run(context, *self.sceneGpu, t.surfaces);
    self.divide(context);
    if (needs.lambda)
        self.strata.run(context, {t.surfaces.guides, t.surfaces.slope},
                        {t.strataGuides, t.strataSlope});
    self.trace(context, t.surfaces, t.seeds.current(),
               [](SignalTargets& signal) -> GpuTexture& { return signal.raw.current(); });
    if (GpuTexture& reflected = t.signals.back().motion; reflected.size().x > 0)
        self.paths.reflect(context, *self.sceneGpu, t.surfaces, t.paths, reflected);
    if (beside && needs.lambda)
        self.traceSamplesBeside(context);

    for (const FilterRun& run : runs) {
        if (runs.size() > 1)
            context.prefix = std::string(1, char('A' + run.state)) + " ";
        self.filter(context, run);
        self.compose(context, run.state);
        if (&run == &runs.front()) // one exposure for all, so that what differs is the filter
            self.expose(context, run.state, settings.display);
        self.present(context, run.state, settings.display);
    }

    self.frame.end();
    self.timer.endFrame();
}

const RenderTargets& Renderer::targets() const {
    return impl_->targets;
}

std::span<const SignalInfo> Renderer::signals() const {
    return impl_->signals;
}

const GpuTexture& Renderer::filteredSignal(std::size_t state, std::size_t signal) const {
    const GpuTexture* const result = impl_->states.at(state).results.at(signal);
    if (!result)
        throw std::logic_error("Renderer: no frame has been rendered");
    return *result;
}

const GpuTexture& Renderer::demodulation(std::size_t signal) const {
    return impl_->demodulation(signal);
}

const RanFilter* Renderer::ran(std::size_t state) const {
    if (state >= kFilterStates || !impl_->states[state].ran)
        return nullptr;
    return &*impl_->states[state].ran;
}

const GpuTexture& Renderer::display(std::size_t state) const {
    return impl_->targets.filters.at(state).display;
}

Renderer::FilterImage Renderer::filterImage(std::string_view aov, std::size_t state,
                                            std::size_t signal) const {
    const RanFilter* const filter = ran(state);
    if (!filter)
        return {};
    for (const FilterAov& row : familyOf(filter->settings.filter).aovs) {
        if (row.info.name != aov || !row.isMade(filter->settings))
            continue;
        const std::size_t image = row.image(filter->settings);
        return {image == kFilterResult ? impl_->states[state].results.at(signal)
                                       : impl_->targets.filters[state].own.at(signal).find(image),
                row.channel};
    }
    return {};
}

Renderer::FilterCall Renderer::filterCall(std::size_t state, std::size_t signal) {
    if (!ran(state))
        throw std::logic_error("Renderer: no filter of this state ran in the last frame");
    return {impl_->context(), impl_->filterInput(signal),
            FilterImages(impl_->targets.filters[state].own.at(signal))};
}

Renderer::LightingCall Renderer::lightingCall(std::size_t signal) {
    static_cast<void>(filteredSignal()); // there is a frame
    RenderTargets& t = impl_->targets;
    return {impl_->context(),
            *impl_->sceneGpu,
            {t.surfaces, t.seeds.current()},
            {t.signals.at(signal).raw.current(), t.rays, t.counters}};
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
