#include "app/workbench/oracle_view.h"

#include "app/experiment/meter.h"
#include "app/experiment/oracle.h"
#include "app/experiment/reference.h"
#include "renderer/image/color.h"
#include "renderer/pipeline/denoise_plan.h"
#include "shared/bindings.h"

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

/// What a filter left of the frozen frame, and what has been made of it.
struct FrozenFilter {
    FrameImages images;
    bool accumulates = false;
    float deltaFloor = 0.0f;
    std::optional<double> rmse;
    std::array<GpuTexture, kOracleImages> textures; ///< empty until they are asked for
};

/// The uniform block of another renderer's frame, put back when this ends: between two of its
/// frames nothing else may have been bound.
class KeptFrameBlock {
public:
    KeptFrameBlock() { glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, gpu::kFrameBlock, &buffer_); }
    KeptFrameBlock(const KeptFrameBlock&) = delete;
    KeptFrameBlock& operator=(const KeptFrameBlock&) = delete;
    ~KeptFrameBlock() { glBindBufferBase(GL_UNIFORM_BUFFER, gpu::kFrameBlock, GLuint(buffer_)); }

private:
    GLint buffer_ = 0;
};

} // namespace

struct OracleView::Impl {
    Impl(ShaderLibrary& library, const GlInfo& info) : shaders(library), gl(info) {}

    ShaderLibrary& shaders;
    GlInfo gl;

    std::optional<Moment> moment;
    Settings settings;
    int samples = 0;
    std::array<std::optional<FrozenFilter>, kFilterStates> filters;

    // While it converges.
    std::optional<Renderer> renderer;
    GLint frameBlock = 0; ///< of `renderer`
    bool converged = false;
    bool changed = false; ///< so the light of the frame before is another reference
    bool atBefore = false;
    int done = 0;                       ///< samples of the reference that is being traced
    double millisecondsPerSample = 0.0; ///< of late; 0: not known yet

    // Once it is there.
    Image<glm::vec4> lit;
    Image<float> now, before, variance;
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
    bool has(OracleImage image, const FrozenFilter& filter) const;
    Image<float> make(OracleImage image, const FrozenFilter& filter) const;
    Image<float> idealAlphaOf(const FrozenFilter& filter) const;
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
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, gpu::kFrameBlock, &frameBlock);
}

// Portions as large as the last ones say that there is time for.
void OracleView::Impl::addFor(double milliseconds) {
    glBindBufferBase(GL_UNIFORM_BUFFER, gpu::kFrameBlock, GLuint(frameBlock));
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
    const auto signal = renderer->filteredSignal().read<glm::vec4>();
    now = luminanceOf(signal);
    variance = channelOf(signal, 3);
    lit = litRadiance(*renderer);
    foreground = foregroundOf(*renderer);
    picture = renderer->targets().filters[0].composed.copy();
}

// The reference that was being traced has all its samples.
void OracleView::Impl::finishOne() {
    renderer->finishReference();
    if (atBefore) {
        before = luminanceOf(renderer->filteredSignal().read<glm::vec4>());
    } else {
        keepNow();
        if (changed) {
            atBefore = true;
            start(inputOf(*moment->before));
            return;
        }
        before = now;
    }
    converged = true;
    renderer.reset(); // its images are many
}

OracleView::OracleView(ShaderLibrary& shaders, const GlInfo& gl)
    : impl_(std::make_unique<Impl>(shaders, gl)) {}
OracleView::~OracleView() = default;

void OracleView::begin(const Renderer& watched, Moment moment, std::span<const FilterRun> runs,
                       int samples) {
    if (samples < 1 || runs.empty())
        throw std::logic_error("an oracle needs a sample, and a filter that has run");
    end();
    const KeptFrameBlock kept;
    Impl& self = *impl_;
    for (const FilterRun& run : runs) {
        const DenoiserSettings& denoiser = run.settings.denoiser;
        self.filters.at(run.state) = {.images = readFrame(watched, run.settings, true, run.state),
                                      .accumulates =
                                          makePlan(run.settings.filter, denoiser).accumulate,
                                      .deltaFloor = denoiser.gradient.deltaFloor,
                                      .rmse = {},
                                      .textures = {}};
    }
    self.moment = std::move(moment);
    self.settings = runs.front().settings;
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
    const KeptFrameBlock kept;
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

Image<float> OracleView::Impl::idealAlphaOf(const FrozenFilter& filter) const {
    return within(idealAlpha(filter.images.history, now, variance, filter.images.hasHistory),
                  foreground);
}

bool OracleView::Impl::has(OracleImage image, const FrozenFilter& filter) const {
    switch (image) {
    case OracleImage::Lambda:
    case OracleImage::LambdaError: return filter.images.lambda.size().x != 0 && moment->before;
    case OracleImage::Alpha:
    case OracleImage::AlphaError: return filter.accumulates;
    case OracleImage::Error:
    case OracleImage::Reference: break;
    }
    return true;
}

Image<float> OracleView::Impl::make(OracleImage image, const FrozenFilter& filter) const {
    const FrameImages& frozen = filter.images;
    const float floor = filter.deltaFloor;
    switch (image) {
    case OracleImage::Error:
        return difference(luminanceOf(frozen.lit), luminanceOf(lit), foreground);
    case OracleImage::Lambda: return idealLambda(now, before, foreground, floor);
    case OracleImage::LambdaError:
        return difference(frozen.lambda, idealLambda(now, before, foreground, floor),
                          litStrata(now, before, foreground, floor));
    case OracleImage::Alpha: return idealAlphaOf(filter);
    case OracleImage::AlphaError:
        return difference(frozen.alpha, idealAlphaOf(filter), both(frozen.hasHistory, foreground));
    case OracleImage::Reference: break;
    }
    throw std::logic_error("the reference is no image of numbers");
}

const GpuTexture* OracleView::image(OracleImage image, std::size_t state) {
    Impl& self = *impl_;
    if (!self.converged)
        return nullptr;
    if (image == OracleImage::Reference)
        return &self.picture;
    std::optional<FrozenFilter>& filter = self.filters.at(state);
    if (!filter || !self.has(image, *filter))
        return nullptr;
    GpuTexture& texture = filter->textures[std::size_t(image)];
    if (texture.size().x == 0) {
        const Image<float> values = self.make(image, *filter);
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
