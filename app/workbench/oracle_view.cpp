#include "app/workbench/oracle_view.h"

#include "app/measure/meter.h"
#include "app/measure/oracle.h"
#include "app/measure/reference.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace afterglow {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// a - b where the mask counts, else 0.
Image<float> difference(const Image<float>& a, const Image<float>& b, const Mask& counts) {
    Image<float> result(a.size());
    for (std::size_t i = 0; i < result.pixels().size(); ++i)
        if (counts.pixels()[i] != 0)
            result.pixels()[i] = a.pixels()[i] - b.pixels()[i];
    return result;
}

/// The result of one filter for the frozen frame, and the images made from it.
struct FrozenFilter {
    FrameImages images;
    float deltaFloor = 0.0f;
    std::optional<double> rmse;
    /// By signal; empty until they are asked for.
    std::array<std::array<GpuTexture, kOracleImages>, kMaxSignals> textures;
};

/// The references of one signal: of the frozen frame and of the frame before.
struct FrozenSignal {
    Image<float> now, before, variance;
};

} // namespace

struct OracleView::Impl {
    Impl(ShaderLibrary& library, const GlInfo& info) : shaders(library), gl(info) {}

    ShaderLibrary& shaders;
    GlInfo gl;

    std::optional<Moment> moment;
    FrameSettings settings;
    int samples = 0;
    std::array<std::optional<FrozenFilter>, kFilterStates> filters;

    // While it converges.
    std::optional<Renderer> renderer;
    bool converged = false;
    bool changed = false; ///< so the light of the frame before is another reference
    bool atBefore = false;
    int done = 0;                       ///< samples of the reference that is being traced
    double millisecondsPerSample = 0.0; ///< of late; 0: not known yet

    // Once it is there.
    Image<glm::vec4> lit;
    std::vector<FrozenSignal> signals;
    Mask foreground;
    GpuTexture picture;

    FrameInput inputOf(const FrameMoment& of) const {
        return {.camera = moment->now.camera,
                .seconds = of.seconds,
                .frame = 0,
                .seed = referenceSeed(moment->seed),
                .lights = of.lights};
    }
    int total() const { return changed ? 2 * samples : samples; }
    int traced() const { return atBefore ? samples + done : done; }

    bool hasChanged(const Scene& scene) const;
    void start(const FrameInput& world);
    void addFor(double milliseconds);
    void finishOne();
    void keepNow();
    bool has(OracleImage image, const ControlImages& control) const;
    Image<float> make(OracleImage image, const FrozenFilter& filter, std::size_t signal) const;
    Image<float> idealAlphaOf(const FrozenFilter& filter, std::size_t signal) const;
};

// Whether light or geometry of the frame before differ.
bool OracleView::Impl::hasChanged(const Scene& scene) const {
    if (!moment->before)
        return false;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const auto scaleIn = [&](const std::vector<LightState>& lights) {
            return i < lights.size() ? lights[i].scale() : glm::vec3(1.0f);
        };
        if (scaleIn(moment->now.lights) != scaleIn(moment->before->lights))
            return true;
    }
    if (moment->now.seconds == moment->before->seconds)
        return false;
    const Pose a = poseAt(scene, moment->now.seconds), b = poseAt(scene, moment->before->seconds);
    return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
        return a.worldFromNode[instance.node] != b.worldFromNode[instance.node];
    });
}

void OracleView::Impl::start(const FrameInput& world) {
    done = 0;
    renderer->beginReference(inputOf(moment->now), world, settings);
}

// Portions as large as the last ones say that there is time for.
void OracleView::Impl::addFor(double milliseconds) {
    const auto begin = Clock::now();
    double left = milliseconds;
    do {
        const double fit = millisecondsPerSample > 0.0 ? left / millisecondsPerSample : 1.0;
        const int portion = int(std::clamp(fit, 1.0, double(samples - done)));
        const auto start = Clock::now();
        renderer->addReferenceSamples(portion);
        glFinish();
        done += portion;
        millisecondsPerSample = millisecondsSince(start) / portion;
        left = milliseconds - millisecondsSince(begin);
    } while (done < samples && left > millisecondsPerSample);
}

void OracleView::Impl::keepNow() {
    signals.clear();
    for (std::size_t i = 0; i < renderer->signals().size(); ++i) {
        const auto signal = renderer->filteredSignal(0, i).read<glm::vec4>();
        signals.push_back({luminanceOf(signal), {}, channelOf(signal, 3)});
    }
    lit = litRadiance(*renderer);
    foreground = foregroundOf(*renderer);
    picture = renderer->targets().filters[0].composed.copy();
}

// The reference that was being traced has all its samples.
void OracleView::Impl::finishOne() {
    renderer->finishReference();
    if (!atBefore) {
        keepNow();
        if (changed) {
            atBefore = true;
            start(inputOf(*moment->before));
            return;
        }
    }
    for (std::size_t i = 0; i < signals.size(); ++i)
        signals[i].before = atBefore ? luminanceOf(renderer->filteredSignal(0, i).read<glm::vec4>())
                                     : signals[i].now;
    converged = true;
    renderer.reset(); // its images are many
}

OracleView::OracleView(ShaderLibrary& shaders, const GlInfo& gl)
    : impl_(std::make_unique<Impl>(shaders, gl)) {}
OracleView::~OracleView() = default;

void OracleView::begin(const Renderer& watched, Moment moment, const FrameSettings& settings,
                       int samples) {
    end();
    Impl& self = *impl_;
    bool any = false;
    for (std::size_t state = 0; state < kFilterStates; ++state) {
        const RanFilter* const ran = watched.ran(state);
        if (!ran)
            continue;
        any = true;
        self.filters[state] = {.images = readFrame(watched, true, state),
                               .deltaFloor = ran->settings.denoiser.gradient.deltaFloor,
                               .rmse = {},
                               .textures = {}};
    }
    if (samples < 1 || !any)
        throw std::logic_error("an oracle needs a sample, and a filter that has run");
    self.moment = std::move(moment);
    self.settings = settings;
    self.samples = samples;
    self.changed = self.hasChanged(watched.scene());
    self.renderer.emplace(self.shaders, self.gl);
    self.renderer->setScene(watched.scene());
    self.renderer->resize(watched.size());
    self.start(self.inputOf(self.moment->now));
}

bool OracleView::advance(double milliseconds) {
    Impl& self = *impl_;
    if (!self.moment || self.converged)
        return false;
    const auto start = Clock::now();
    do {
        self.addFor(milliseconds - millisecondsSince(start));
        if (self.done == self.samples)
            self.finishOne();
    } while (!self.converged &&
             millisecondsSince(start) + self.millisecondsPerSample < milliseconds);
    return self.converged;
}

void OracleView::end() {
    impl_ = std::make_unique<Impl>(impl_->shaders, impl_->gl);
}

bool OracleView::isActive() const {
    return impl_->moment.has_value();
}
bool OracleView::isDone() const {
    return impl_->converged;
}
int OracleView::samples() const {
    return impl_->samples;
}
double OracleView::progress() const {
    if (!isActive())
        return 0.0;
    return isDone() ? 1.0 : double(impl_->traced()) / impl_->total();
}

Image<float> OracleView::Impl::idealAlphaOf(const FrozenFilter& filter, std::size_t signal) const {
    const ControlImages& control = filter.images.control.at(signal);
    const FrozenSignal& truth = signals.at(signal);
    return within(idealAlpha(control.history, truth.now, truth.variance, control.hasHistory),
                  foreground);
}

bool OracleView::Impl::has(OracleImage image, const ControlImages& control) const {
    switch (image) {
    case OracleImage::Lambda:
    case OracleImage::LambdaError: return control.lambda.size().x != 0 && moment->before;
    case OracleImage::Alpha:
    case OracleImage::AlphaError: return control.alpha.size().x != 0;
    case OracleImage::Error:
    case OracleImage::Reference: break;
    }
    return true;
}

Image<float> OracleView::Impl::make(OracleImage image, const FrozenFilter& filter,
                                    std::size_t signal) const {
    const FrameImages& frozen = filter.images;
    const ControlImages& control = frozen.control.at(signal);
    const auto& [now, before, variance] = signals.at(signal);
    const float floor = filter.deltaFloor;
    switch (image) {
    case OracleImage::Error:
        return difference(luminanceOf(frozen.lit), luminanceOf(lit), foreground);
    case OracleImage::Lambda: return idealLambda(now, before, foreground, floor);
    case OracleImage::LambdaError:
        return difference(control.lambda, idealLambda(now, before, foreground, floor),
                          litStrata(now, before, foreground, floor));
    case OracleImage::Alpha: return idealAlphaOf(filter, signal);
    case OracleImage::AlphaError:
        return difference(control.alpha, idealAlphaOf(filter, signal),
                          both(control.hasHistory, foreground));
    case OracleImage::Reference: break;
    }
    throw std::logic_error("the reference is no image of numbers");
}

const GpuTexture* OracleView::image(OracleImage image, std::size_t state, std::size_t signal) {
    Impl& self = *impl_;
    if (!self.converged)
        return nullptr;
    if (image == OracleImage::Reference)
        return &self.picture;
    std::optional<FrozenFilter>& filter = self.filters.at(state);
    if (!filter || signal >= self.signals.size() ||
        !self.has(image, filter->images.control.at(signal)))
        return nullptr;
    GpuTexture& texture = filter->textures[signal][std::size_t(image)];
    if (texture.size().x == 0) {
        const Image<float> values = self.make(image, *filter, signal);
        texture = GpuTexture("oracle", PixelFormat::R32F, values.size());
        texture.write(values);
    }
    return &texture;
}

std::optional<double> OracleView::rmse(std::size_t state) {
    Impl& self = *impl_;
    std::optional<FrozenFilter>& filter = self.filters.at(state);
    if (!self.converged || !filter || countOf(self.foreground) == 0)
        return {};
    if (!filter->rmse)
        filter->rmse = afterglow::rmse(filter->images.lit, self.lit, &self.foreground);
    return filter->rmse;
}

} // namespace afterglow
