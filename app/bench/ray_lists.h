// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/renderer.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace afterglow {

/// The kinds of rays of a path tracer. A frame traces the first two.
enum class RayKind {
    Shadow,           ///< from what is seen to a random point of the lights
    AmbientOcclusion, ///< into the hemisphere, as far as the radius of ambient occlusion
    Closest,          ///< from the camera through the centers of pixels
    Bounce,           ///< cosine-weighted from what is seen, without an end
    BounceShadow      ///< from where those have hit to a random point of the lights
};
inline constexpr std::array kRayKinds{RayKind::Shadow, RayKind::AmbientOcclusion, RayKind::Closest,
                                      RayKind::Bounce, RayKind::BounceShadow};

std::string_view nameOf(RayKind kind); ///< "shadow", "ao", "closest", "bounce", "bounce_shadow"
/// Returns whether the question is if a ray hits anything, and not what it hits first.
bool isAnyHit(RayKind kind);

/// A ray as the list has it: shared/ray_list.h.
struct ListedRay {
    glm::vec3 origin;
    float tMax;
    glm::vec3 direction;
    std::uint32_t pixel; ///< x | y << 16
};
static_assert(sizeof(ListedRay) == gpu::kTexelsPerRay * sizeof(glm::uvec4));

/// Lists of the rays of the last frame of a renderer, on the device. Shadow and ambient occlusion
/// rays are listed and traced by the programs of the frame; the raw signal is not what it was
/// afterwards.
class RayLists {
public:
    /// A frame has been rendered, and no other one is while this is used.
    RayLists(Renderer& renderer, ShaderLibrary& shaders);

    /// Makes the list of a kind, in the place of the one before.
    void list(RayKind kind);
    /// Traces the rays of the kind that was listed last, by one dispatch.
    void trace();

    /// The rays that are listed, in the order of the list.
    std::vector<ListedRay> read() const;
    /// Traces, and returns for each of these rays whether it hits something.
    std::vector<std::uint8_t> traceForHits();

private:
    const RayList& current() const;
    void listOwn(const char* define, RayList& to);
    void traceOwn(const RayList& rays, TexelBuffer& hits, bool anyHit);

    ShaderLibrary& shaders_;
    Renderer::LightingCall call_;
    LightingPass lighting_;
    glm::ivec2 size_;
    RayKind kind_ = RayKind::Shadow;
    RayList rays_, bounces_; ///< of kinds that no frame traces
    TexelBuffer hits_, bounceHits_;
};

} // namespace afterglow
