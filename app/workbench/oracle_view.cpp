// SPDX-License-Identifier: MIT
#include "app/workbench/oracle_view.h"

#include <chrono>
#include <stdexcept>

namespace afterglow {

void OracleView::begin(const Renderer& watched, Frozen frame, const FrameSettings& settings,
                       int samples) {
    end();
    bool any = false;
    for (std::size_t state = 0; state < kFilterStates; ++state)
        if (const RanFilter* const ran = watched.ran(state)) {
            any = true;
            filters_[state].emplace(readFrame(watched, true, state),
                                    ran->settings.denoiser.gradient.deltaFloor);
        }
    if (samples < 1 || !any)
        throw std::logic_error("an oracle needs a sample, and a filter that has run");
    frame_ = std::move(frame);
    samples_ = samples;
    renderer_.emplace(shaders_, gl_);
    renderer_->setScene(watched.scene());
    renderer_->resize(watched.size());
    GroundTruth::Request request{.now = frame_.now.input(frame_.seed),
                                 .before = {},
                                 .settings = settings,
                                 .samples = samples};
    if (frame_.before)
        request.before = frame_.before->input(frame_.seed);
    // No store: a camera that is flown by hand hardly returns to the same bits, and shaders may be
    // edited while the window is open.
    making_.emplace(*renderer_, request);
}

bool OracleView::advance(double milliseconds) {
    using Clock = std::chrono::steady_clock;
    if (!making_)
        return false;
    const auto start = Clock::now();
    double left = milliseconds;
    do {
        making_->advance(left);
        left =
            milliseconds - std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    } while (!making_->isDone() && left > 0.5 * milliseconds);
    if (!making_->isDone())
        return false;
    truth_ = making_->take();
    making_.reset();
    renderer_.reset(); // its images are many
    return true;
}

void OracleView::end() {
    samples_ = 0;
    filters_ = {};
    making_.reset();
    renderer_.reset();
    truth_.reset();
}

const GpuTexture* OracleView::image(std::size_t image, std::size_t state, std::size_t signal) {
    std::optional<Filter>& filter = filters_.at(state);
    if (!truth_ || !filter || signal >= truth_->signals.size())
        return nullptr;
    const auto [found, isNew] = filter->textures.try_emplace({signal, image});
    GpuTexture& texture = found->second;
    if (isNew) {
        const Image<glm::vec4> values = truthImages()[image].make(
            {*truth_, frame_.before.has_value(), filter->images, filter->deltaFloor}, signal);
        if (values.size().x > 0) {
            texture = GpuTexture("oracle", PixelFormat::RGBA32F, values.size());
            texture.write(values);
        }
    }
    return texture.size().x > 0 ? &texture : nullptr;
}

std::optional<double> OracleView::rmse(std::size_t state) {
    std::optional<Filter>& filter = filters_.at(state);
    if (!truth_ || !filter || countOf(truth_->foreground) == 0)
        return {};
    if (!filter->rmse)
        filter->rmse = afterglow::rmse(filter->images.lit, truth_->lit, &truth_->foreground);
    return filter->rmse;
}

} // namespace afterglow
