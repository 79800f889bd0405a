#include "app/scenario/frame_change.h"

#include <algorithm>

namespace afterglow {

bool lightsDiffer(const Scene& scene, std::span<const LightState> a,
                  std::span<const LightState> b) {
    const auto scaleIn = [](std::span<const LightState> lights, std::size_t slot) {
        return slot < lights.size() ? lights[slot].scale() : glm::vec3(1.0f);
    };
    for (std::size_t slot = 0; slot < scene.lights.size(); ++slot)
        if (scaleIn(a, slot) != scaleIn(b, slot))
            return true;
    return false;
}

bool geometryDiffers(const Scene& scene, const Pose& a, const Pose& b) {
    return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
        return a.worldFromNode[instance.node] != b.worldFromNode[instance.node];
    });
}

bool lightOrGeometryDiffers(const Scene& scene, const FrameInput& a, const FrameInput& b) {
    return lightsDiffer(scene, a.lights, b.lights) ||
           (a.seconds != b.seconds &&
            geometryDiffers(scene, poseAt(scene, a.seconds), poseAt(scene, b.seconds)));
}

} // namespace afterglow
