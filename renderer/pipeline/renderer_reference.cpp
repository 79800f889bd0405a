// SPDX-License-Identifier: MIT
// The part of Renderer that converges references.

#include "renderer/pipeline/jitter.h"
#include "renderer/pipeline/renderer_impl.h"

#include <cmath>

namespace afterglow {

// Moves the scene to another time, and the visibility samples with it.
void Renderer::Impl::placeSurfaces(FrameContext& context, double seconds) {
    const Pose pose = poseAt(scene, seconds);
    sceneGpu->update(scene, pose, pose);
    frame.upload();
    if (targets.placed.empty())
        targets.placed = Surfaces(targets.size, "placed ");
    targets.placed.visibility.copyFrom(targets.surfaces.visibility);
    surface.run(context, *sceneGpu, targets.placed);
}

void Renderer::beginReference(const FrameInput& input, const FrameSettings& settings) {
    beginReference(input, input, settings);
}

void Renderer::beginReference(const FrameInput& seen, const FrameInput& world,
                              const FrameSettings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    RenderTargets& t = self.targets;
    FrameInput first = seen;
    first.frame = 0; // the number of a reference's first sample takes the place of the frame's
    self.setSignals(settings);
    self.states = {};
    // The places in the pixels at which the frame looked, so that it can be compared.
    self.begin(first, settings, jitterOf(settings.display, seen.frame));
    self.frame.forget();
    self.previousPose.reset();
    FrameContext context = self.context();
    // The visibility samples of the pixels' centers, and their surfaces.
    self.visibility.run(context, *self.sceneGpu,
                        {t.framebuffer, t.ids, t.surfaces.visibility, t.seeds.current()});
    self.surface.run(context, *self.sceneGpu, t.surfaces);
    self.divide(context);
    self.setLights(world);
    self.converging = Impl::Reference{settings, &t.surfaces};
    if (world.seconds != seen.seconds) {
        self.placeSurfaces(context, world.seconds);
        self.converging->surfaces = &t.placed;
    }
    for (SignalTargets& signal : t.signals)
        signal.makeSums();
}

// The seeds are those of the sample: without its number, paths would take each surface for a
// gradient sample, seen by the camera of the last frame. Kaplanyan and Dachsbacher 2013, section 5:
// the bias of regularization vanishes as samples are added, slowly enough for the variance to
// vanish as well.
void Renderer::Impl::beginReferenceSample() {
    if (!division)
        return;
    frame.uniforms.sampleIndex = std::uint32_t(converging->samples);
    frame.uniforms.regularization = converging->settings.lighting.regularization *
                                    std::pow(float(converging->samples + 1), -1.0f / 6.0f);
    frame.upload();
}

void Renderer::addReferenceSamples(int count) {
    Impl& self = *impl_;
    if (!self.converging)
        throw std::logic_error("Renderer: beginReference() comes before its samples");
    RenderTargets& t = self.targets;
    FrameContext context = self.context();
    for (int i = 0; i < count; ++i) {
        self.beginReferenceSample();
        self.trace(context, *self.converging->surfaces, t.seeds.current(),
                   [](SignalTargets& signal) -> GpuTexture& { return signal.raw.current(); });
        for (SignalTargets& signal : t.signals)
            self.reference.add(context, signal.raw.current(), {signal.sum, signal.lost},
                               &signal == &t.signals.back() ? &t.seeds.current() : nullptr);
        ++self.converging->samples;
    }
}

const GpuTexture& Renderer::finishReference() {
    Impl& self = *impl_;
    if (!self.converging || self.converging->samples == 0)
        throw std::logic_error("Renderer: a reference needs samples");
    FrameContext context = self.context();
    for (std::size_t i = 0; i < self.signals.size(); ++i) {
        SignalTargets& signal = self.targets.signals[i];
        self.reference.mean(context, signal.sum, self.converging->samples, signal.converged);
        self.states[0].results[i] = &signal.converged;
    }
    self.states[0].ran = Impl::ranFilterOf({Filter::None, {}});
    return self.presentReference(context, self.converging->settings.display);
}

const GpuTexture& Renderer::showReference(std::span<const Image<glm::vec4>> converged,
                                          const FrameSettings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    if (converged.size() != self.signals.size())
        throw std::logic_error("Renderer: a reference has as many signals as the frame");
    FrameContext context = self.context();
    for (std::size_t i = 0; i < self.signals.size(); ++i) {
        SignalTargets& signal = self.targets.signals[i];
        if (signal.converged.size().x == 0)
            signal.makeSums();
        signal.converged.write(converged[i]);
        self.states[0].results[i] = &signal.converged;
    }
    return self.presentReference(context, settings.display);
}

} // namespace afterglow
