// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/bvh.h"
#include "renderer/scene/scene.h"

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// All triangles of a scene, ready to be walked by shaders/lib/bvh_trace.glsl.
///
/// Everything is in world space, in one array of records. What never moves is one tree, made once.
/// Each instance that moves has a tree of its own, whose shape is that of its mesh and whose boxes
/// are fitted anew to its triangles where they are in this frame; a small tree joins them all with
/// that of the rest. A walk knows of none of this.
class SceneBvh {
public:
    /// Builds everything, at the pose of second 0. The scene is complete and is not needed
    /// afterwards. Throws Error if there are more triangles than links can count.
    explicit SceneBvh(const Scene& scene);

    /// Puts the moving instances where they are in this pose. The number of records stays. An
    /// instance whose matrix has no inverse is not hit by any ray.
    void refresh(const Pose& pose);

    /// The tree: blocks of gpu::kBvhWidth, of which the first has the root at gpu::kBvhRoot.
    std::span<const BvhRecord> records() const { return records_; }

    /// Consecutive records.
    struct Span {
        std::size_t first = 0, count = 0;
    };
    /// Returns the records that the last refresh() changed, in order.
    std::span<const Span> changed() const { return changed_; }

    const BvhRecord& root() const { return records_[gpu::kBvhRoot]; }
    std::size_t movingInstances() const { return moving_.size(); }

private:
    /// A tree in the space of a mesh that moves.
    struct MeshTree {
        BvhRoot root;
        LargeArray<BvhRecord> records;
    };
    struct Moving {
        std::uint32_t instance = 0;  ///< index into Scene::instances
        std::uint32_t node = 0;      ///< index into Scene::nodes
        std::size_t mesh = 0;        ///< index into meshTrees_
        std::uint32_t block = 0;     ///< where its records begin
        BvhRoot root;                ///< where it is; without bounds it cannot be hit
        glm::mat4 worldFromObject{}; ///< of the root
        bool placed = false;         ///< they are there
    };

    void addMoving(const Scene& scene, std::span<const std::uint32_t> instances);
    bool place(Moving& moving, const glm::mat4& worldFromObject);
    void join();

    LargeArray<BvhRecord> records_;
    BvhRoot still_; ///< of what never moves
    std::vector<MeshTree> meshTrees_;
    std::vector<Moving> moving_;
    std::uint32_t joinBlock_ = 0; ///< where the tree over all trees begins
    std::vector<Span> changed_;
};

} // namespace afterglow
