#include "app/workbench/oracle_view.h"

#include "app/measure/meter.h"
#include "app/measure/truth.h"

#include <chrono>
#include <stdexcept>

namespace afterglow {
namespace {

/// a - b where the mask counts, else 0.
Image<float> difference(const Image<float>& a, const Image<float>& b, const Mask& counts) {
    Image<float> result(a.size());
    for (std::size_t i = 0; i < result.pixels().size(); ++i)
        if (counts.pixels()[i] != 0)
            result.pixels()[i] = a.pixels()[i] - b.pixels()[i];
    return result;
}

GpuTexture textureOf(const Image<float>& values) {
    GpuTexture texture("oracle", PixelFormat::R32F, values.size());
    texture.write(values);
    return texture;
}

/// The result of one filter for the frozen frame, and the images made from it.
struct FrozenFilter {
    FrameImages images;
    float deltaFloor = 0.0f;
    std::optional<double> rmse{};
    /// By signal; empty until they are asked for.
    std::array<std::array<GpuTexture, kOracleImages>, kMaxSignals> textures{};
};

} // namespace

struct OracleView::Impl {
    Impl(ShaderLibrary& library, const GlInfo& info) : shaders(library), gl(info) {}

    ShaderLibrary& shaders;
    GlInfo gl;

    std::optional<Moment> moment;
    int samples = 0;
    std::array<std::optional<FrozenFilter>, kFilterStates> filters;
    // While it converges.
    std::optional<Renderer> renderer;
    std::optional<GroundTruth> making;
    // Once it is there.
    std::optional<Truth> truth;
    GpuTexture reference;

    bool has(OracleImage image, const ControlImages& control) const;
    Image<float> make(OracleImage image, const FrozenFilter& filter, std::size_t signal) const;
};

OracleView::OracleView(ShaderLibrary& shaders, const GlInfo& gl)
    : impl_(std::make_unique<Impl>(shaders, gl)) {}
OracleView::~OracleView() = default;

void OracleView::begin(const Renderer& watched, Moment moment, const FrameSettings& settings,
                       int samples) {
    end();
    Impl& self = *impl_;
    bool any = false;
    for (std::size_t state = 0; state < kFilterStates; ++state)
        if (const RanFilter* const ran = watched.ran(state)) {
            any = true;
            self.filters[state].emplace(readFrame(watched, true, state),
                                        ran->settings.denoiser.gradient.deltaFloor);
        }
    if (samples < 1 || !any)
        throw std::logic_error("an oracle needs a sample, and a filter that has run");
    self.moment = std::move(moment);
    self.samples = samples;
    self.renderer.emplace(self.shaders, self.gl);
    self.renderer->setScene(watched.scene());
    self.renderer->resize(watched.size());
    const auto inputOf = [&](const SceneFrame& frame) { return frame.input(self.moment->seed); };
    GroundTruth::Request request{
        .now = inputOf(self.moment->now), .before = {}, .settings = settings, .samples = samples};
    if (self.moment->before)
        request.before = inputOf(*self.moment->before);
    // No store: a camera that is flown by hand hardly returns to the same bits, and shaders may be
    // edited while the window is open.
    self.making.emplace(*self.renderer, request);
}

bool OracleView::advance(double milliseconds) {
    using Clock = std::chrono::steady_clock;
    Impl& self = *impl_;
    if (!self.making)
        return false;
    const auto end = Clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
    double left = milliseconds;
    do {
        self.making->advance(left);
        left = std::chrono::duration<double, std::milli>(end - Clock::now()).count();
    } while (!self.making->isDone() && left > 0.5 * milliseconds);
    if (!self.making->isDone())
        return false;
    self.truth = self.making->take();
    self.reference = GpuTexture("reference", PixelFormat::RGBA32F, self.truth->lit.size());
    self.reference.write(self.truth->lit);
    self.making.reset();
    self.renderer.reset(); // its images are many
    return true;
}

void OracleView::end() {
    impl_ = std::make_unique<Impl>(impl_->shaders, impl_->gl);
}

bool OracleView::isActive() const {
    return impl_->moment.has_value();
}
bool OracleView::isDone() const {
    return impl_->truth.has_value();
}
int OracleView::samples() const {
    return impl_->samples;
}
double OracleView::progress() const {
    return isDone() ? 1.0 : isActive() ? impl_->making->progress() : 0.0;
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
    const ControlImages& control = filter.images.control.at(signal);
    const auto alpha = [&] {
        return truth->idealAlpha(signal, control.history, control.hasHistory);
    };
    switch (image) {
    case OracleImage::Error:
        return difference(luminanceOf(filter.images.lit), luminanceOf(truth->lit),
                          truth->foreground);
    case OracleImage::Lambda: return truth->idealLambda(signal, filter.deltaFloor).lambda;
    case OracleImage::LambdaError: {
        const StrataTruth ideal = truth->idealLambda(signal, filter.deltaFloor);
        return difference(control.lambda, ideal.lambda, ideal.lit);
    }
    case OracleImage::Alpha: return alpha();
    case OracleImage::AlphaError:
        return difference(control.alpha, alpha(), both(control.hasHistory, truth->foreground));
    case OracleImage::Reference: break;
    }
    throw std::logic_error("the reference is no image of numbers");
}

const GpuTexture* OracleView::image(OracleImage image, std::size_t state, std::size_t signal) {
    Impl& self = *impl_;
    if (!self.truth)
        return nullptr;
    if (image == OracleImage::Reference)
        return &self.reference;
    std::optional<FrozenFilter>& filter = self.filters.at(state);
    if (!filter || signal >= self.truth->signals.size() ||
        !self.has(image, filter->images.control.at(signal)))
        return nullptr;
    GpuTexture& texture = filter->textures[signal][std::size_t(image)];
    if (texture.size().x == 0)
        texture = textureOf(self.make(image, *filter, signal));
    return &texture;
}

std::optional<double> OracleView::rmse(std::size_t state) {
    Impl& self = *impl_;
    std::optional<FrozenFilter>& filter = self.filters.at(state);
    if (!self.truth || !filter || countOf(self.truth->foreground) == 0)
        return {};
    if (!filter->rmse)
        filter->rmse =
            afterglow::rmse(filter->images.lit, self.truth->lit, &self.truth->foreground);
    return filter->rmse;
}

} // namespace afterglow
