// The part of Renderer that converges references.

#include "renderer/pipeline/renderer_impl.h"

namespace afterglow {

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
        self.trace(
            context, reference.settings,
            {t.visibility.current(), *reference.surface, *reference.guides, t.seeds.current()},
            t.raw.current());
        self.reference.add(context, t.raw.current(), {t.seeds.current(), t.sum, self.lost});
        ++reference.samples;
    }
}

const GpuTexture& Renderer::finishReference() {
    Impl& self = *impl_;
    if (!self.converging || self.converging->samples == 0)
        throw std::logic_error("Renderer: a reference needs samples");
    FrameContext context{self.timer};
    FilterTargets& shown = self.targets.filters[0];
    self.reference.mean(context, self.targets.sum, self.converging->samples, shown.filtered[0]);
    return self.present(context, shown, shown.filtered[0], self.converging->settings);
}

const GpuTexture& Renderer::showReference(const Image<glm::vec4>& converged,
                                          const Settings& settings) {
    impl_->requireScene();
    Impl& self = *impl_;
    FrameContext context{self.timer};
    FilterTargets& shown = self.targets.filters[0];
    shown.filtered[0].write(converged);
    return self.present(context, shown, shown.filtered[0], settings);
}

} // namespace afterglow
