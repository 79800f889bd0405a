// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/pipeline/renderer.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The converged signals of one moment, and how far it can be trusted. docs/pipeline.md,
/// "References".
struct Reference {
    /// By signal; rgb: demodulated signal; a: variance of one sample's luminance
    std::vector<Image<glm::vec4>> signals;
    /// The RMSE that the sum of signals times albedo still has against the limit, over red, green
    /// and blue of the foreground: from the difference between the mean of the first half of the
    /// samples and the mean of all. 0 for a single sample, which has no halves.
    double residual = 0.0;
    std::uint64_t rays = 0;    ///< of converging it
    double milliseconds = 0.0; ///< likewise
    int samples = 0;           ///< a pixel
    bool cached = false;       ///< it was there already
};

/// The inputs of a reference. The scene and the lights of both frames must outlive it.
struct ReferenceRequest {
    const Scene& scene;
    glm::ivec2 size;
    FrameInput seen;  ///< whose surfaces; see Renderer::beginReference()
    FrameInput world; ///< in whose light
    FrameSettings settings;
    int samples; ///< a pixel, at least 1
};

/// What makes references: two that differ may make other bits from the same request.
struct ReferenceMaker {
    ReferenceMaker(const ShaderLibrary& shaders, const GlInfo& gl);
    ReferenceMaker(std::string shaderHash, std::string glVendor, std::string glRenderer,
                   std::string glVersion);

    std::string shaders; ///< a hash of the shaders that take part
    std::string vendor, renderer, version;
};

/// A name, 32 hexadecimal digits, for all that a reference depends on, and for nothing else: what
/// is seen in the same light at another time or under another name has the same key.
std::string referenceKey(const ReferenceRequest& request, const ReferenceMaker& maker);

/// The same for a person.
nlohmann::ordered_json describe(const ReferenceRequest& request, const ReferenceMaker& maker);

/// References in a folder: KEY.exr with the picture (R, G, B, A in 32-bit float), KEY-1.exr with
/// that of a second signal, and KEY.json with what it is. That is written last: without it there is
/// no entry. Several processes may use one folder.
class ReferenceCache {
public:
    /// Creates the folder where it is missing. Error names it if that fails, or if it cannot be
    /// written to.
    explicit ReferenceCache(std::filesystem::path folder);

    const std::filesystem::path& folder() const { return folder_; }

    /// An entry that is damaged counts as missing; a warning says what is wrong with it.
    std::optional<Reference> find(const std::string& key) const;
    /// Error, naming the file, if it cannot be written.
    void store(const std::string& key, const Reference& reference,
               const nlohmann::ordered_json& description) const;

private:
    std::filesystem::path folder_;
};

/// $XDG_CACHE_HOME/afterglow/references, or ~/.cache/afterglow/references where that is not set to
/// an absolute path. Error if there is no HOME either.
std::filesystem::path defaultCacheFolder();

} // namespace afterglow
