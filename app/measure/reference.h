// SPDX-License-Identifier: MIT
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

/// Returns the seed of references: their random numbers differ from those of the frames.
constexpr std::uint32_t referenceSeed(std::uint32_t seed) {
    return seed ^ 0x9e3779b9u;
}

/// The portions in which the samples of a reference are traced. Drivers end programs that keep a
/// device busy for seconds; waiting after every sample would take longer than the samples. The
/// first portion is one sample, and the time of each portion sets the length of the next one.
class SamplePortions {
public:
    /// `most`: samples that a portion has at most, from 1 to 2^16.
    explicit SamplePortions(int most) : most_(most) {}

    /// Returns the samples that take about so long: at least 1, at most twice the last portion.
    int next(double milliseconds) const;
    void took(int samples, double milliseconds); ///< notes the last portion

private:
    int most_, last_ = 0;
    double each_ = 0.0; ///< milliseconds a sample, of late
};

/// References, each converged once: those of this run are kept in memory as far as there is room,
/// and all in the cache, if there is one.
class ReferenceStore {
public:
    explicit ReferenceStore(ReferenceMaker maker, std::optional<ReferenceCache> cache = {});
    /// Returns a store with the cache in the default folder, or without one, and with a warning, if
    /// that folder cannot be made.
    static ReferenceStore withDefaultCache(ReferenceMaker maker);

    /// A reference that is there already.
    std::optional<Reference> find(const std::string& key);
    /// Keeps a reference that was converged, unless OpenGL has failed in this context. Error,
    /// naming the file, if the cache cannot be written; with the default cache a warning, and no
    /// more writing.
    void add(const std::string& key, const Reference& reference, const ReferenceRequest& request);

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

/// A reference in the making, portion by portion; its bits do not depend on the portions. In the
/// end the renderer shows it, and holds guides, albedo and emission of what is seen; histories are
/// void. Nothing else may render in between.
class ReferenceTask {
public:
    /// The surfaces of `seen` in the light of `world`: see Renderer::beginReference(). The lights
    /// of both, the renderer and the store must outlive it. Without a store it is always converged.
    ReferenceTask(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                  const FrameSettings& settings, int samples, ReferenceStore* store = nullptr);

    /// Traces one portion, which takes about so long, of one sample at least. Returns the samples a
    /// pixel that are there since: at once all of a reference that the store has.
    int advance(double milliseconds);
    bool isDone() const { return done_ == request_.samples; }
    const Reference& result() const { return reference_; } ///< once it is done

private:
    void finish();

    Renderer& renderer_;
    ReferenceRequest request_;
    ReferenceStore* store_;
    std::string key_; ///< in the store
    SamplePortions portions_;
    int done_ = 0;              ///< samples
    std::uint32_t counted_ = 0; ///< rays, as the device counts
    Image<glm::vec4> half_;     ///< after the first half of the samples
    Reference reference_;
};

/// Returns a reference, made in one go. `advanced` is told of every portion of samples as it is
/// done.
Reference converge(Renderer& renderer, const FrameInput& seen, const FrameInput& world,
                   const FrameSettings& settings, int samples,
                   const std::function<void(int)>& advanced = {}, ReferenceStore* store = nullptr);

/// The milliseconds that a portion takes where nobody waits in between.
inline constexpr double kPortionMilliseconds = 50.0;

} // namespace afterglow
