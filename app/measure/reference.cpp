#include "app/measure/reference.h"

#include "renderer/base/error.h"
#include "renderer/base/log.h"
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

/// Adds samples to the renderer's reference, counts their rays and tells of them.
class Sampling {
public:
    Sampling(Renderer& renderer, const std::function<void(int)>& advanced)
        : renderer_(renderer), advanced_(advanced) {
        // The device counts in 32 bits over the whole image, and a pixel has at most two rays.
        const auto pixels = std::uint64_t(renderer.size().x) * std::uint64_t(renderer.size().y);
        portions_ = SamplePortions(
            int(std::clamp<std::uint64_t>((~0u) / (2 * pixels), 1, std::uint64_t(1) << 16)));
    }

    void addUpTo(int target) {
        while (done_ < target) {
            const auto start = Clock::now();
            const int portion = std::min(portions_.next(), target - done_);
            renderer_.addReferenceSamples(portion);
            done_ += portion;
            const auto now = std::uint32_t(renderer_.readStats().rays); // waits for the device
            portions_.took(portion, millisecondsSince(start));
            rays_ += std::uint32_t(now - counted_);
            counted_ = now;
            if (advanced_)
                advanced_(portion);
        }
    }
    std::uint64_t rays() const { return rays_; }

private:
    Renderer& renderer_;
    const std::function<void(int)>& advanced_;
    SamplePortions portions_{1};
    int done_ = 0;
    std::uint32_t counted_ = 0;
    std::uint64_t rays_ = 0;
};

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

void SamplePortions::took(int samples, double milliseconds) {
    const double fitting = milliseconds > 0.0 ? samples * kMilliseconds / milliseconds : most_;
    next_ = int(std::clamp(fitting, 1.0, double(std::min(2 * next_, most_))));
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

Reference converge(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                   const Settings& settings, int samples,
                   const std::function<void(int)>& advanced) {
    if (samples < 1)
        throw std::logic_error("a reference needs at least one sample");
    Reference reference;
    reference.samples = samples;
    const auto start = Clock::now();
    renderer.beginReference(seen, world, settings);
    Sampling sampling(renderer, advanced);
    Image<glm::vec4> half;
    if (samples > 1) {
        sampling.addUpTo(samples / 2);
        renderer.finishReference();
        half = litRadiance(renderer);
    }
    sampling.addUpTo(samples);
    renderer.finishReference();
    glFinish();
    reference.milliseconds = millisecondsSince(start);
    reference.rays = sampling.rays();
    for (std::size_t signal = 0; signal < renderer.signals().size(); ++signal)
        reference.signals.push_back(renderer.filteredSignal(0, signal).read<glm::vec4>());
    const Mask foreground = foregroundOf(renderer);
    if (samples > 1 && countOf(foreground) > 0)
        reference.residual = residualOf(rmse(half, litRadiance(renderer), &foreground), samples);
    return reference;
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

Reference ReferenceStore::get(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                              const Settings& settings, int samples,
                              const std::function<void(int)>& advanced) {
    const ReferenceRequest request{renderer.scene(), renderer.size(), seen, world,
                                   settings,         samples};
    const std::string key = referenceKey(request, maker_);
    if (std::optional<Reference> known = recall(key)) {
        renderer.beginReference(seen, settings);
        renderer.showReference(known->signals, settings);
        if (advanced)
            advanced(samples);
        return *std::move(known);
    }
    Reference reference = converge(renderer, seen, world, settings, samples, advanced);
    ++counts_.converged;
    writeCache(key, reference, request);
    keep(key, reference);
    return reference;
}

std::optional<Reference> ReferenceStore::recall(const std::string& key) {
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

} // namespace afterglow
