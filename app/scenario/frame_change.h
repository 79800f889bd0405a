#pragma once

#include "renderer/pipeline/renderer.h"

namespace afterglow {

// The changes between two frames of a scene.

/// Returns whether a light shines differently. A light that a list misses is on at nominal power.
bool lightsDiffer(const Scene& scene, std::span<const LightState> a, std::span<const LightState> b);

/// Returns whether an instance is in another place: what is lit, or casts a shadow.
bool geometryDiffers(const Scene& scene, const Pose& a, const Pose& b);

/// Returns whether surfaces may reflect other light in the one frame than in the other.
bool lightOrGeometryDiffers(const Scene& scene, const FrameInput& a, const FrameInput& b);

} // namespace afterglow
