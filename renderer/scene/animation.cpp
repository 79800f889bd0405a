// SPDX-License-Identifier: MIT
// The scene at a moment, from the moment alone. glTF 2.0, sections 3.11 and C.3, C.4.

#include "renderer/scene/scene.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace afterglow {

namespace {

glm::quat quatFrom(glm::vec4 xyzw) {
    return glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
}

// Returns the value of a track at a time. Files store the times of keys as 32-bit floats, and one
// that stands for a frame may lie a little above frame / rate. So keys are met in float; a value
// between two is weighed in double.
glm::vec4 valueAt(const Track& track, double seconds) {
    const float moment = float(seconds);
    const auto next = std::upper_bound(track.times.begin(), track.times.end(), moment,
                                       [](float value, double key) { return value < float(key); });
    if (next == track.times.begin()) {
        return track.values.front();
    }
    const std::size_t i = std::size_t(next - track.times.begin()) - 1;
    // At a key, and between two that are equal, the value is the key's to the last bit, which a
    // weighted sum is not: what stands still must not be taken for something that moves.
    if (next == track.times.end() || track.interpolation == Track::Interpolation::Step ||
        moment == float(track.times[i]) || track.values[i] == track.values[i + 1]) {
        return track.values[i];
    }
    const double span = track.times[i + 1] - track.times[i];
    const float t = float((seconds - track.times[i]) / span);
    if (track.path != Track::Path::Rotation) {
        return glm::mix(track.values[i], track.values[i + 1], t);
    }
    // glm::slerp takes the shorter way round, as glTF demands.
    const glm::quat q = glm::slerp(quatFrom(track.values[i]), quatFrom(track.values[i + 1]), t);
    return {q.x, q.y, q.z, q.w};
}

} // namespace

Pose poseAt(const Scene& scene, double seconds) {
    struct Local {
        glm::vec3 translation;
        glm::quat rotation;
        glm::vec3 scale;
    };
    std::vector<Local> locals;
    locals.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        locals.push_back({node.translation, node.rotation, node.scale});
    }
    for (const Track& track : scene.tracks) {
        const glm::vec4 value = valueAt(track, seconds);
        Local& local = locals[track.node];
        switch (track.path) {
        case Track::Path::Translation: local.translation = glm::vec3(value); break;
        case Track::Path::Rotation: local.rotation = glm::normalize(quatFrom(value)); break;
        case Track::Path::Scale: local.scale = glm::vec3(value); break;
        }
    }
    Pose pose;
    pose.worldFromNode.reserve(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const glm::mat4 parentFromNode =
            node.matrix ? *node.matrix
                        : glm::translate(glm::mat4(1.0f), locals[i].translation) *
                              glm::mat4_cast(locals[i].rotation) *
                              glm::scale(glm::mat4(1.0f), locals[i].scale);
        pose.worldFromNode.push_back(
            node.parent < 0 ? parentFromNode
                            : pose.worldFromNode[std::size_t(node.parent)] * parentFromNode);
    }
    return pose;
}

double duration(const Scene& scene) {
    double longest = 0.0;
    for (const Track& track : scene.tracks) {
        longest = std::max(longest, track.times.back());
    }
    return longest;
}

std::vector<bool> movingNodes(const Scene& scene) {
    std::vector<bool> moving(scene.nodes.size(), false);
    for (const Track& track : scene.tracks) {
        moving[track.node] = true;
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const int parent = scene.nodes[i].parent;
        moving[i] = moving[i] || (parent >= 0 && moving[std::size_t(parent)]);
    }
    return moving;
}

} // namespace afterglow
