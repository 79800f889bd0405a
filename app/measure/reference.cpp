// SPDX-License-Identifier: MIT
#include "app/measure/reference.h"

#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/gl/errors.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The samples of one portion that the device can count the rays of: in 32 bits over the whole
/// image, where a pixel has at most two.
int mostSamples(glm::ivec2 size) {
    const auto pixels = std::uint64_t(size.x) * std::uint64_t(size.y);
    return int(std::clamp<std::uint64_t>((~0u) / (2 * pixels), 1, std::uint64_t(1) << 16));
}

/// The error of the mean of n samples, from how far the mean of the first m = n / 2 is from it.
/// mean(n) - mean(m) = (1 - m/n) (mean of the rest - mean(m)), whose variance is s^2 (1/m - 1/n);
/// that of mean(n) is s^2 / n.
double residualOf(double distance, int samples) {
    const double n = samples, m = samples / 2;
    return distance / std::sqrt(n / m - 1.0);
}

/// More than the moments that one experiment looks back at.
constexpr std::size_t kKeptBytes = std::size_t(256) << 20;

std::size_t bytesOf(const Reference& reference) {
    std::size_t sum = 0;
    for (const Image<glm::vec4>& signal : reference.signals)
        sum += signal.pixels().size_bytes();
    return sum;
}

} // namespace

int SamplePortions::next(double milliseconds) const {
    if (last_ == 0)
        return 1;
    const double fitting = each_ > 0.0 ? milliseconds / each_ : most_;
    return int(std::clamp(fitting, 1.0, double(std::min(2 * last_, most_))));
}

void SamplePortions::took(int samples, double milliseconds) {
    last_ = samples;
    each_ = milliseconds / samples;
}

Mask foregroundOf(const Renderer& renderer) {
    const auto guides = renderer.targets().surfaces.guides.read<glm::vec4>();
    Mask mask(guides.size());
    for (std::size_t i = 0; i < guides.pixels().size(); ++i)
        mask.pixels()[i] = guides.pixels()[i].w > 0.0f;
    return mask;
}

Image<glm::vec4> litRadiance(const Renderer& renderer, std::size_t state) {
    Image<glm::vec4> lit;
    for (std::size_t signal = 0; signal < renderer.signals().size(); ++signal) {
        auto part = renderer.filteredSignal(state, signal).read<glm::vec4>();
        const auto albedo = renderer.demodulation(signal).read<glm::vec4>();
        for (std::size_t i = 0; i < part.pixels().size(); ++i) {
            glm::vec4& pixel = part.pixels()[i];
            pixel = glm::vec4(glm::vec3(pixel) * glm::vec3(albedo.pixels()[i]), 0.0f);
            if (signal > 0)
                pixel += lit.pixels()[i];
        }
        lit = std::move(part);
    }
    return lit;
}

ReferenceStore::ReferenceStore(ReferenceMaker maker, std::optional<ReferenceCache> cache)
    : maker_(std::move(maker)), cache_(std::move(cache)) {}

ReferenceStore ReferenceStore::withDefaultCache(ReferenceMaker maker) {
    ReferenceStore store(std::move(maker));
    store.cacheIsRequired_ = false;
    try {
        store.cache_.emplace(defaultCacheFolder());
    } catch (const Error& error) {
        log(LogLevel::Warning, std::string("references will not be kept: ") + error.what());
    }
    return store;
}

std::optional<Reference> ReferenceStore::find(const std::string& key) {
    const auto kept = std::ranges::find(kept_, key, &Kept::key);
    if (kept != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, kept);
        ++counts_.fromMemory;
        Reference reference = kept_.front().reference;
        reference.cached = true;
        return reference;
    }
    std::optional<Reference> found = cache_ ? cache_->find(key) : std::nullopt;
    if (found) {
        ++counts_.fromCache;
        keep(key, *found);
    }
    return found;
}

void ReferenceStore::add(const std::string& key, const Reference& reference,
                         const ReferenceRequest& request) {
    ++counts_.converged;
    if (hasContextFailed())
        return;
    writeCache(key, reference, request);
    keep(key, reference);
}

void ReferenceStore::keep(const std::string& key, const Reference& reference) {
    kept_.push_front({key, reference});
    keptBytes_ += bytesOf(reference);
    while (keptBytes_ > kKeptBytes && kept_.size() > 1) {
        keptBytes_ -= bytesOf(kept_.back().reference);
        kept_.pop_back();
    }
}

void ReferenceStore::writeCache(const std::string& key, const Reference& reference,
                                const ReferenceRequest& request) {
    if (!cache_)
        return;
    try {
        cache_->store(key, reference, describe(request, maker_));
    } catch (const Error& error) {
        if (cacheIsRequired_)
            throw;
        log(LogLevel::Warning, std::string("references are no longer kept: ") + error.what());
        cache_.reset();
    }
}

ReferenceTask::ReferenceTask(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                             const FrameSettings& settings, int samples, ReferenceStore* store)
    : renderer_(renderer), request_{renderer.scene(), renderer.size(), seen, world,
                                    settings,         samples},
      store_(store), portions_(mostSamples(renderer.size())) {
    if (samples < 1)
        throw std::logic_error("a reference needs at least one sample");
    if (store) {
        key_ = referenceKey(request_, store->maker());
        if (std::optional<Reference> known = store->find(key_)) {
            reference_ = *std::move(known);
            renderer.beginReference(seen, settings);
            renderer.showReference(reference_.signals, settings);
            return;
        }
    }
    reference_.samples = samples;
    const auto start = Clock::now();
    renderer.beginReference(seen, world, settings);
    reference_.milliseconds = millisecondsSince(start);
}

int ReferenceTask::advance(double milliseconds) {
    const int samples = request_.samples, half = samples / 2;
    if (reference_.cached)
        return samples - std::exchange(done_, samples);
    const int target = done_ < half ? half : samples;
    const int portion = std::min(portions_.next(milliseconds), target - done_);
    if (portion == 0)
        return 0;
    const auto start = Clock::now();
    renderer_.addReferenceSamples(portion);
    const auto rays = std::uint32_t(renderer_.readStats().rays); // waits for the device
    portions_.took(portion, millisecondsSince(start));
    reference_.rays += std::uint32_t(rays - std::exchange(counted_, rays));
    done_ += portion;
    if (done_ == target) {
        renderer_.finishReference();
        glFinish();
    }
    reference_.milliseconds += millisecondsSince(start);
    if (isDone())
        finish();
    else if (done_ == half)
        half_ = litRadiance(renderer_);
    return portion;
}

void ReferenceTask::finish() {
    for (std::size_t signal = 0; signal < renderer_.signals().size(); ++signal)
        reference_.signals.push_back(renderer_.filteredSignal(0, signal).read<glm::vec4>());
    const Mask foreground = foregroundOf(renderer_);
    if (half_.size().x > 0 && countOf(foreground) > 0)
        reference_.residual =
            residualOf(rmse(half_, litRadiance(renderer_), &foreground), request_.samples);
    if (store_)
        store_->add(key_, reference_, request_);
}

Reference converge(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                   const FrameSettings& settings, int samples,
                   const std::function<void(int)>& advanced, ReferenceStore* store) {
    ReferenceTask task(renderer, seen, world, settings, samples, store);
    while (!task.isDone()) {
        const int portion = task.advance(kPortionMilliseconds);
        if (advanced)
            advanced(portion);
    }
    return task.result();
}

} // namespace afterglow
