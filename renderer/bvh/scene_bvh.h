// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/bvh.h"
#include "renderer/scene/scene.h"

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// All triangles of a scene, ready to be walked by bvh_trace.h and shaders/lib/bvh_trace.glsl.
///
/// What never moves is one tree in world space. Each mesh that moves has a tree in its own space,
/// and a small top-level tree over the moving instances is made anew each frame.
class SceneBvh {
public:
    /// Builds everything, at the pose of second 0. The scene is complete and is not needed
    /// afterwards.
    explicit SceneBvh(const Scene& scene);

    /// Puts the moving instances where they are in this pose. Changes instanceTexels() and
    /// params(), and nothing else. An instance whose matrix has no inverse is not hit by any ray.
    void refresh(const Pose& pose);

    /// Trees of triangles, one after the other; the static one is first, with its root at 0.
    std::span<const gpu::BvhNode> nodes() const { return nodes_; }

    /// What the leaves of nodes() hold. Never empty: a scene without triangles has one of no size.
    std::span<const gpu::BvhTriangle> triangles() const { return triangles_; }

    /// Entries of four texels: first one gpu::BvhInstance for each moving instance, then the
    /// gpu::BvhNodes of the top-level tree, whose inner links are entries and whose leaves hold one
    /// instance each. Never empty. Always of the same size.
    std::span<const glm::uvec4> instanceTexels() const { return instanceTexels_; }

    const gpu::BvhParams& params() const { return params_; }

    /// Whether any instance moves. If not, refresh() changes nothing.
    bool moves() const { return !moving_.empty(); }

    /// A moving instance as the CPU sees it.
    struct Moving {
        std::uint32_t instance = 0; ///< index into Scene::instances
        std::uint32_t node = 0;     ///< index into Scene::nodes
        std::uint32_t root = 0;     ///< index into nodes()
        Aabb bounds;                ///< of its mesh, in the mesh's own space
        glm::dmat4 objectFromWorld{1.0};
    };
    std::span<const Moving> moving() const { return moving_; }

    /// The top-level tree: its leaves are ranges of topOrder(), which indexes moving().
    const Bvh& top() const { return top_; }

private:
    std::uint32_t addTree(std::span<const gpu::BvhTriangle> triangles, Aabb* bounds);
    void packInstances();

    std::vector<gpu::BvhNode> nodes_;
    std::vector<gpu::BvhTriangle> triangles_;
    std::vector<Moving> moving_;
    Bvh top_;
    std::vector<glm::uvec4> instanceTexels_;
    gpu::BvhParams params_{};
};

} // namespace afterglow
