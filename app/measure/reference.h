#pragma once

#include "app/measure/reference_cache.h"
#include "renderer/image/metrics.h"
#include "renderer/pipeline/renderer.h"

#include <functional>
#include <list>

namespace afterglow {

/// The pixels of the last frame or reference that show a surface.
Mask foregroundOf(const Renderer& renderer);

/// The light that surfaces reflect towards the viewer: the filtered signals times albedo, linear;
/// alpha is 0. Without emission, which no filter touches: a light that is seen directly is so much
/// brighter than all it shines on that its going out would be all there is to measure.
Image<glm::vec4> litRadiance(const Renderer& renderer, std::size_t state = 0);

/// References draw other random numbers than the frames of the seed that are compared with them.
constexpr std::uint32_t referenceSeed(std::uint32_t seed) {
    return seed ^ 0x9e3779b9u;
}

/// The portions in which the samples of a reference are traced. Drivers end programs that keep a
/// device busy for seconds; waiting after every sample would take longer than the samples. The
/// first portion is one sample, and the time of each portion sets the length of the next one.
class SamplePortions {
public:
    static constexpr double kMilliseconds = 50.0; ///< that a portion is to take

    /// `most`: samples that a portion has at most, from 1 to 2^16.
    explicit SamplePortions(int most) : most_(most) {}

    int next() const { return next_; } ///< at least 1; at most twice the one before
    void took(int samples, double milliseconds);

private:
    int next_ = 1, most_;
};

/// Averages so many samples a pixel, at least 1, of the surfaces of `seen` in the light of `world`:
/// see Renderer::beginReference(). Afterwards the renderer shows it; its histories are void.
/// `advanced` is told of every portion of samples as it is done.
Reference converge(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                   const Settings& settings, int samples,
                   const std::function<void(int)>& advanced = {});

/// References, each converged once: those of this run are kept in memory as far as there is room,
/// and all in the cache, if there is one.
class ReferenceStore {
public:
    explicit ReferenceStore(ReferenceMaker maker, std::optional<ReferenceCache> cache = {});
    /// With the cache in the default folder. Where there can be none, a warning says so, and that
    /// is all.
    static ReferenceStore withDefaultCache(ReferenceMaker maker);

    /// The surfaces of `seen` in the light of `world`; see Renderer::beginReference(). `samples` a
    /// pixel, at least 1. Afterwards the renderer shows it, and holds guides, albedo and emission
    /// of `seen`; histories are void. `advanced` is told of every portion of samples as it is done,
    /// and at once of all that need not be done.
    ///
    /// Error, naming the file, if the cache cannot be written; with the default cache a warning,
    /// and no more writing.
    Reference get(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                  const Settings& settings, int samples,
                  const std::function<void(int)>& advanced = {});

    struct Counts {
        int converged = 0, fromMemory = 0, fromCache = 0;
    };
    const Counts& counts() const { return counts_; }
    const ReferenceMaker& maker() const { return maker_; }
    const std::optional<ReferenceCache>& cache() const { return cache_; }

private:
    struct Kept {
        std::string key;
        Reference reference;
    };
    std::optional<Reference> recall(const std::string& key);
    void keep(const std::string& key, const Reference& reference);
    void writeCache(const std::string& key, const Reference& reference,
                    const ReferenceRequest& request);

    ReferenceMaker maker_;
    std::optional<ReferenceCache> cache_;
    bool cacheIsRequired_ = true;
    std::list<Kept> kept_; ///< the one used last is first
    std::size_t keptBytes_ = 0;
    Counts counts_;
};

} // namespace afterglow
