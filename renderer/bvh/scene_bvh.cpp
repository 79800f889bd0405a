// SPDX-License-Identifier: MIT
#include "renderer/bvh/scene_bvh.h"

#include "renderer/base/error.h"
#include "renderer/base/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>

namespace afterglow {

namespace {

/// Paths below a root, and from the root of everything to it. Together kBvhMaxDepth.
constexpr std::uint32_t kTreeDepth = 40, kJoinDepth = gpu::kBvhMaxDepth - kTreeDepth;

constexpr std::size_t kChunk = 16384; ///< triangles that a thread prepares at a time

glm::vec3 transformed(const glm::dmat4& matrix, glm::vec3 p) {
    return glm::vec3(matrix * glm::dvec4(p, 1.0));
}

/// A mesh at one place among the leaves of a tree.
struct Placed {
    const Mesh* mesh;
    std::uint32_t instance;
    glm::dmat4 matrix;
    std::size_t first; ///< leaf of its first triangle
};

/// Adds a tree over meshes, with their corners moved by a matrix and rounded once.
BvhRoot addTree(LargeArray<BvhRecord>& records, std::span<const Placed> meshes,
                std::size_t triangles) {
    LargeArray<BvhRecord> leaves(triangles);
    LargeArray<Aabb> boxes(triangles);
    for (const Placed& placed : meshes) {
        const auto& corners = placed.mesh->triangles;
        parallelFor((corners.size() + kChunk - 1) / kChunk, hardwareThreads(), [&](std::size_t c) {
            for (std::size_t i = c * kChunk; i < std::min((c + 1) * kChunk, corners.size()); ++i) {
                const auto corner = [&](int k) {
                    return transformed(placed.matrix, placed.mesh->positions[corners[i][k]]);
                };
                const gpu::BvhTriangle triangle{.v0 = corner(0),
                                                .instance = gpu::kBvhTriangle | placed.instance,
                                                .v1 = corner(1),
                                                .triangle = std::uint32_t(i),
                                                .v2 = corner(2),
                                                .next = 0};
                leaves[placed.first + i] = triangle;
                boxes[placed.first + i] = boundsOf(triangle);
            }
        });
    }
    return buildBvh(records, boxes, leaves, {.maxDepth = kTreeDepth});
}

bool isFinite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(float(m[column][row])))
                return false;
    return true;
}

std::uint32_t blocksOf(std::size_t records) {
    return std::uint32_t(records / gpu::kBvhWidth);
}

} // namespace

SceneBvh::SceneBvh(const Scene& scene) {
    if (scene.instances.size() > gpu::kBvhInstanceMask)
        throw Error("a scene holds at most " + std::to_string(gpu::kBvhInstanceMask) +
                    " instances, but there are " + std::to_string(scene.instances.size()));
    const Pose pose = poseAt(scene, 0.0);
    const std::vector<bool> moves = movingNodes(scene);

    std::vector<Placed> still;
    std::vector<std::uint32_t> movers;
    std::size_t triangles = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (mesh.triangles.empty())
            continue;
        if (moves[instance.node]) {
            movers.push_back(i);
            continue;
        }
        still.push_back({&mesh, i, glm::dmat4(pose.worldFromNode[instance.node]), triangles});
        triangles += mesh.triangles.size();
    }
    records_.assign(gpu::kBvhWidth, nullRecord());
    still_ = addTree(records_, still, triangles);
    records_[gpu::kBvhRoot] = still_.record;
    addMoving(scene, movers);
    refresh(pose);
}

void SceneBvh::addMoving(const Scene& scene, std::span<const std::uint32_t> instances) {
    std::map<std::uint32_t, std::size_t> trees; // by mesh
    for (const std::uint32_t i : instances) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        const auto [found, isNew] = trees.emplace(mesh, meshTrees_.size());
        if (isNew) {
            const Placed local{&scene.meshes[mesh], 0, glm::dmat4(1.0), 0};
            MeshTree& tree = meshTrees_.emplace_back();
            tree.root = addTree(tree.records, {&local, 1}, local.mesh->triangles.size());
        }
        moving_.push_back({.instance = i,
                           .node = scene.instances[i].node,
                           .mesh = found->second,
                           .block = blocksOf(records_.size()),
                           .root = {}});
        records_.resize(records_.size() + meshTrees_[found->second].records.size(), nullRecord());
    }
    joinBlock_ = blocksOf(records_.size());
    // Each node of a tree over n trees has two children at least.
    if (!moving_.empty())
        records_.resize(records_.size() + gpu::kBvhWidth * moving_.size(), nullRecord());
    if (blocksOf(records_.size()) > gpu::kBvhMaxBlocks)
        throw Error("the trees of the scene need " + std::to_string(blocksOf(records_.size())) +
                    " blocks; links count " + std::to_string(gpu::kBvhMaxBlocks));
}

/// Returns whether anything has changed.
bool SceneBvh::place(Moving& moving, const glm::mat4& worldFromObject) {
    if (moving.placed && moving.worldFromObject == worldFromObject)
        return false;
    moving.placed = true;
    moving.worldFromObject = worldFromObject;
    moving.root = {};
    const glm::dmat4 matrix(worldFromObject);
    if (!isFinite(matrix) || !isFinite(glm::inverse(matrix)))
        return true;

    const MeshTree& tree = meshTrees_[moving.mesh];
    const auto put = [&](const BvhRecord& from, BvhRecord& to) {
        if (from.isTriangle()) {
            gpu::BvhTriangle triangle = from.triangle();
            if (triangle.instance == nullRecord().triangle().instance)
                return; // it is one already
            triangle.v0 = transformed(matrix, triangle.v0);
            triangle.v1 = transformed(matrix, triangle.v1);
            triangle.v2 = transformed(matrix, triangle.v2);
            triangle.instance = gpu::kBvhTriangle | moving.instance;
            triangle.next += triangle.next != 0 ? moving.block * gpu::kBvhWidth : 0;
            to = triangle;
        } else {
            gpu::BvhNode node = from.node();
            node.block += moving.block;
            to = node;
        }
    };
    for (std::size_t i = 0; i < tree.records.size(); ++i)
        put(tree.records[i], records_[moving.block * gpu::kBvhWidth + i]);
    put(tree.root.record, moving.root.record);
    refitBvh(moving.root, records_);
    return true;
}

void SceneBvh::refresh(const Pose& pose) {
    changed_.clear();
    for (Moving& moving : moving_) {
        assert(moving.node < pose.worldFromNode.size());
        if (place(moving, pose.worldFromNode[moving.node]))
            changed_.push_back(
                {moving.block * gpu::kBvhWidth, meshTrees_[moving.mesh].records.size()});
    }
    if (changed_.empty())
        return;
    join();
    changed_.insert(changed_.begin(), {0, gpu::kBvhWidth});
    changed_.push_back(
        {joinBlock_ * gpu::kBvhWidth, records_.size() - joinBlock_ * gpu::kBvhWidth});
}

void SceneBvh::join() {
    std::vector<Aabb> boxes;
    LargeArray<BvhRecord> roots;
    const auto add = [&](const BvhRoot& root) {
        if (root.bounds.empty())
            return;
        boxes.push_back(root.bounds);
        roots.push_back(root.record);
    };
    add(still_);
    for (const Moving& moving : moving_)
        add(moving.root);
    const std::size_t size = records_.size();
    records_.resize(joinBlock_ * gpu::kBvhWidth);
    records_[gpu::kBvhRoot] =
        buildBvh(records_, boxes, roots, {.maxLeafSize = 1, .maxDepth = kJoinDepth}).record;
    assert(records_.size() <= size);
    records_.resize(size, nullRecord());
}

} // namespace afterglow
