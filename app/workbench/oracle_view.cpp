#include "app/workbench/oracle_view.h"

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

// As in experiments, references draw other random numbers than the frame.
constexpr std::uint32_t kReferenceSeed = 0x9e3779b9u;

Image<float> channelOf(const Image<glm::vec4>& image, int channel) {
    Image<float> result(image.size());
    std::ranges::transform(image.pixels(), result.pixels().begin(),
                           [&](const glm::vec4& c) { return c[channel]; });
    return result;
}

/// The light that surfaces reflect: signal times albedo.
Image<glm::vec4> litBy(Image<glm::vec4> signal, const Image<glm::vec4>& albedo) {
    for (std::size_t i = 0; i < signal.pixels().size(); ++i)
        signal.pixels()[i] =
            glm::vec4(glm::vec3(signal.pixels()[i]) * glm::vec3(albedo.pixels()[i]), 0.0f);
    return signal;
}

/// a - b where the mask counts, else 0.
Image<float> difference(const Image<float>& a, const Image<float>& b, const Mask& counts) {
    Image<float> result(a.size());
    for (std::size_t i = 0; i < result.pixels().size(); ++i)
        if (counts.pixels()[i] != 0)
            result.pixels()[i] = a.pixels()[i] - b.pixels()[i];
    return result;
}

Mask both(const Mask& a, const Mask& b) {
    Mask result = a;
    for (std::size_t i = 0; i < result.pixels().size(); ++i)
        result.pixels()[i] &= b.pixels()[i];
    return result;
}

/// What a filter left of the frozen frame.
struct FrozenFilter {
    Image<glm::vec4> lit;
    Image<float> lambda;  ///< per stratum; has a meaning if the filter has
    Image<float> alpha;   ///< likewise
    Image<float> blended; ///< luminance of the history, if the blend is fed to the spatial filter
    Image<float> fedBack; ///< the same, if the blend is itself the history
    Mask hasHistory;
    std::optional<double> rmse; ///< once it has been asked for
};

FrozenFilter freeze(const Renderer& watched, std::size_t state, const Image<glm::vec4>& albedo,
                    const Mask& foreground) {
    const FilterTargets& own = watched.targets().filters[state];
    FrozenFilter frozen;
    frozen.lit = litBy(watched.filteredSignal(state).read<glm::vec4>(), albedo);
    frozen.lambda = own.lambda.read<float>();
    const auto control = own.control.read<glm::vec4>();
    frozen.alpha = channelOf(control, 1);
    frozen.blended = channelOf(own.accumulated.read<glm::vec4>(), 3);
    frozen.fedBack = channelOf(own.color.current().read<glm::vec4>(), 3);
    frozen.hasHistory = foreground;
    for (std::size_t i = 0; i < control.pixels().size(); ++i)
        if (control.pixels()[i].w != float(gpu::kHistoryKept))
            frozen.hasHistory.pixels()[i] = 0;
    return frozen;
}

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

/// What an image depends on beside the frozen frame.
struct Asked {
    bool accumulates = false, hasLambda = false, fedBack = false;
    float deltaFloor = 0.0f;

    static Asked of(const Settings& settings) {
        const DenoisePlan plan = makePlan(settings.filter, settings.denoiser);
        return {plan.accumulate, plan.useLambda, plan.feedbackIteration == 0,
                settings.denoiser.gradient.deltaFloor};
    }
    bool operator==(const Asked&) const = default;
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

    struct Cached {
        Asked asked;
        GpuTexture texture;
    };
    std::array<std::array<std::optional<Cached>, kFilterStates>, kOracleImages> cache;

    FrameInput inputNow() const {
        FrameInput input = moment->now;
        input.lights = moment->lights;
        input.seed ^= kReferenceSeed;
        return input;
    }
    FrameInput inputBefore() const {
        FrameInput input = inputNow();
        input.seconds = moment->secondsBefore;
        input.lights = moment->lightsBefore;
        return input;
    }
    int total() const { return changed ? 2 * samples : samples; }
    int traced() const { return atBefore ? samples + done : done; }

    bool hasChanged(const Scene& scene) const;
    void start(const FrameInput& world);
    void addFor(double milliseconds);
    void finishOne();
    void keepNow();
    Image<float> make(OracleImage image, const FrozenFilter& filter, const Asked& asked) const;
    Image<float> idealAlphaOf(const FrozenFilter& filter, const Asked& asked) const;
};

// Whether light or geometry of the frame before differ.
bool OracleView::Impl::hasChanged(const Scene& scene) const {
    if (!moment->hasBefore)
        return false;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const auto scaleIn = [&](const std::vector<LightState>& lights) {
            return i < lights.size() ? lights[i].scale() : glm::vec3(1.0f);
        };
        if (scaleIn(moment->lights) != scaleIn(moment->lightsBefore))
            return true;
    }
    if (moment->now.seconds == moment->secondsBefore)
        return false;
    const Pose a = poseAt(scene, moment->now.seconds), b = poseAt(scene, moment->secondsBefore);
    return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
        return a.worldFromNode[instance.node] != b.worldFromNode[instance.node];
    });
}

void OracleView::Impl::start(const FrameInput& world) {
    done = 0;
    renderer->beginReference(inputNow(), world, settings);
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
            start(inputBefore());
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

void OracleView::begin(const Renderer& watched, Moment moment, const Settings& settings,
                       int samples) {
    if (samples < 1)
        throw std::logic_error("an oracle needs at least one sample");
    end();
    const RenderTargets& t = watched.targets();
    const KeptFrameBlock kept;
    Impl& self = *impl_;
    self.moment = std::move(moment);
    self.settings = settings;
    self.samples = samples;
    const auto albedo = t.albedo.read<glm::vec4>();
    const Mask foreground = foregroundOf(watched);
    bool any = false;
    for (std::size_t state = 0; state < kFilterStates; ++state)
        if (watched.hasRun(state)) {
            self.filters[state] = freeze(watched, state, albedo, foreground);
            any = true;
        }
    if (!any)
        throw std::logic_error("an oracle needs a frame");
    self.changed = self.hasChanged(watched.scene());
    self.renderer.emplace(self.shaders, self.gl);
    self.renderer->setScene(watched.scene());
    self.renderer->resize(t.size);
    self.start(self.inputNow());
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
double OracleView::progress() const {
    if (!isActive())
        return 0.0;
    return isDone() ? 1.0 : double(impl_->traced()) / impl_->total();
}

Image<float> OracleView::Impl::idealAlphaOf(const FrozenFilter& filter, const Asked& asked) const {
    Image<float> ideal = idealAlpha(asked.fedBack ? filter.fedBack : filter.blended, now, variance,
                                    filter.hasHistory);
    for (std::size_t i = 0; i < ideal.pixels().size(); ++i)
        if (foreground.pixels()[i] == 0)
            ideal.pixels()[i] = 0.0f;
    return ideal;
}

Image<float> OracleView::Impl::make(OracleImage image, const FrozenFilter& filter,
                                    const Asked& asked) const {
    switch (image) {
    case OracleImage::Error:
        return difference(luminanceOf(filter.lit), luminanceOf(lit), foreground);
    case OracleImage::Lambda: return idealLambda(now, before, foreground, asked.deltaFloor);
    case OracleImage::LambdaError:
        return difference(filter.lambda, idealLambda(now, before, foreground, asked.deltaFloor),
                          litStrata(now, before, foreground, asked.deltaFloor));
    case OracleImage::Alpha: return idealAlphaOf(filter, asked);
    case OracleImage::AlphaError:
        return difference(filter.alpha, idealAlphaOf(filter, asked),
                          both(filter.hasHistory, foreground));
    case OracleImage::Reference: break;
    }
    throw std::logic_error("the reference is no image of numbers");
}

const GpuTexture* OracleView::image(OracleImage image, std::size_t state,
                                    const Settings& settings) {
    Impl& self = *impl_;
    if (!self.converged)
        return nullptr;
    if (image == OracleImage::Reference)
        return &self.picture;
    const std::optional<FrozenFilter>& filter = self.filters.at(state);
    const Asked asked = Asked::of(settings);
    const bool isLambda = image == OracleImage::Lambda || image == OracleImage::LambdaError;
    const bool isAlpha = image == OracleImage::Alpha || image == OracleImage::AlphaError;
    if (!filter || (isLambda && !(asked.hasLambda && self.moment->hasBefore)) ||
        (isAlpha && !asked.accumulates))
        return nullptr;
    auto& cached = self.cache[std::size_t(image)][state];
    if (!cached || cached->asked != asked) {
        const Image<float> values = self.make(image, *filter, asked);
        cached = {asked, GpuTexture("oracle", PixelFormat::R32F, values.size())};
        cached->texture.write(values);
    }
    return &cached->texture;
}

std::optional<double> OracleView::rmse(std::size_t state, const Settings&) {
    Impl& self = *impl_;
    std::optional<FrozenFilter>& filter = self.filters.at(state);
    if (!self.converged || !filter || countOf(self.foreground) == 0)
        return {};
    if (!filter->rmse)
        filter->rmse = afterglow::rmse(filter->lit, self.lit, &self.foreground);
    return filter->rmse;
}

} // namespace afterglow
