// SPDX-License-Identifier: MIT
#include "renderer/bvh/scene_bvh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace afterglow {

namespace {

constexpr std::size_t kTexelsPerEntry = 4;

static_assert(sizeof(gpu::BvhNode) == kTexelsPerEntry * sizeof(glm::uvec4));
static_assert(sizeof(gpu::BvhInstance) == kTexelsPerEntry * sizeof(glm::uvec4));
static_assert(sizeof(gpu::BvhTriangle) == 3 * sizeof(glm::uvec4));

Aabb boundsOf(const gpu::BvhTriangle& triangle) {
    Aabb box;
    box.include(triangle.v0);
    box.include(triangle.v1);
    box.include(triangle.v2);
    return box;
}

/// Appends a mesh's triangles, with their corners moved by a matrix and rounded once.
void appendTriangles(std::vector<gpu::BvhTriangle>& to, const Mesh& mesh, std::uint32_t instance,
                     const glm::dmat4& matrix) {
    const auto corner = [&](std::uint32_t vertex) {
        return glm::vec3(matrix * glm::dvec4(mesh.positions[vertex], 1.0));
    };
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 v = mesh.triangles[i];
        to.push_back({.v0 = corner(v.x),
                      .instance = instance,
                      .v1 = corner(v.y),
                      .triangle = i,
                      .v2 = corner(v.z),
                      .pad = 0});
    }
}

/// The world box of a box in object space: of its corners, and a little more, since rays are
/// carried into object space with rounding and the box is rounded too.
Aabb worldBox(const Aabb& box, const glm::dmat4& worldFromObject) {
    Aabb world;
    for (int i = 0; i < 8; ++i)
        world.include(
            glm::vec3(worldFromObject * glm::dvec4((i & 1) != 0 ? box.max.x : box.min.x,
                                                   (i & 2) != 0 ? box.max.y : box.min.y,
                                                   (i & 4) != 0 ? box.max.z : box.min.z, 1.0)));
    constexpr float kRounding = 8.0f * std::numeric_limits<float>::epsilon();
    const glm::vec3 largest = glm::max(glm::abs(world.min), glm::abs(world.max));
    const glm::vec3 margin(kRounding * std::max({largest.x, largest.y, largest.z}));
    return {world.min - margin, world.max + margin};
}

bool isFinite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(float(m[column][row])))
                return false;
    return true;
}

gpu::BvhInstance record(const SceneBvh::Moving& moving) {
    const glm::mat4 rows(glm::transpose(moving.objectFromWorld));
    return {.objectFromWorldX = rows[0],
            .objectFromWorldY = rows[1],
            .objectFromWorldZ = rows[2],
            .instance = moving.instance,
            .root = moving.root,
            .pad0 = 0,
            .pad1 = 0};
}

} // namespace

SceneBvh::SceneBvh(const Scene& scene) {
    const Pose pose = poseAt(scene, 0.0);
    const std::vector<bool> moves = movingNodes(scene);

    std::vector<gpu::BvhTriangle> world;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!moves[instance.node])
            appendTriangles(world, scene.meshes[instance.mesh], i,
                            glm::dmat4(pose.worldFromNode[instance.node]));
    }
    addTree(world, nullptr);

    struct MeshTree {
        std::uint32_t root;
        Aabb bounds;
    };
    std::map<std::uint32_t, MeshTree> trees; // by mesh
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!moves[instance.node])
            continue;
        auto found = trees.find(instance.mesh);
        if (found == trees.end()) {
            std::vector<gpu::BvhTriangle> local;
            appendTriangles(local, scene.meshes[instance.mesh], gpu::kBvhNone, glm::dmat4(1.0));
            MeshTree tree{};
            tree.root = addTree(local, &tree.bounds);
            found = trees.emplace(instance.mesh, tree).first;
        }
        if (!found->second.bounds.empty())
            moving_.push_back({.instance = i,
                               .node = instance.node,
                               .root = found->second.root,
                               .bounds = found->second.bounds});
    }
    if (triangles_.empty())
        triangles_.push_back(
            {.v0 = {}, .instance = gpu::kBvhNone, .v1 = {}, .triangle = 0, .v2 = {}, .pad = 0});
    refresh(pose);
}

std::uint32_t SceneBvh::addTree(std::span<const gpu::BvhTriangle> triangles, Aabb* bounds) {
    std::vector<Aabb> boxes;
    boxes.reserve(triangles.size());
    for (const gpu::BvhTriangle& triangle : triangles)
        boxes.push_back(boundsOf(triangle));
    const Bvh tree = buildBvh(boxes);

    const auto root = std::uint32_t(nodes_.size());
    const auto first = std::uint32_t(triangles_.size());
    const auto moved = [&](std::uint32_t link) {
        return isLeaf(link) ? leafLink(first + leafFirst(link), leafCount(link)) : root + link;
    };
    for (gpu::BvhNode node : tree.nodes) {
        node.link0 = moved(node.link0);
        node.link1 = moved(node.link1);
        nodes_.push_back(node);
    }
    for (const std::uint32_t i : tree.order)
        triangles_.push_back(triangles[i]);
    if (bounds != nullptr)
        *bounds = tree.bounds;
    return root;
}

void SceneBvh::refresh(const Pose& pose) {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> present; // indices into moving_, one for each box
    for (std::uint32_t i = 0; i < moving_.size(); ++i) {
        assert(moving_[i].node < pose.worldFromNode.size());
        const glm::dmat4 worldFromObject(pose.worldFromNode[moving_[i].node]);
        const glm::dmat4 objectFromWorld = glm::inverse(worldFromObject);
        if (!isFinite(worldFromObject) || !isFinite(objectFromWorld))
            continue;
        moving_[i].objectFromWorld = objectFromWorld;
        boxes.push_back(worldBox(moving_[i].bounds, worldFromObject));
        present.push_back(i);
    }
    top_ = buildBvh(boxes, 1);
    for (std::uint32_t& i : top_.order)
        i = present[i];
    params_ = {.movingInstances = std::uint32_t(present.size()),
               .topRoot = std::uint32_t(moving_.size()),
               .pad0 = 0,
               .pad1 = 0};
    packInstances();
}

void SceneBvh::packInstances() {
    // A top-level tree with one instance a leaf has one node less than instances, but at least one.
    const std::size_t entries = moving_.size() + std::max<std::size_t>(moving_.size(), 2) - 1;
    assert(top_.nodes.size() <= entries - moving_.size());
    instanceTexels_.assign(entries * kTexelsPerEntry, glm::uvec4(0));
    const auto put = [&](std::size_t entry, const auto& value) {
        std::memcpy(&instanceTexels_[entry * kTexelsPerEntry], &value, sizeof(value));
    };
    for (std::size_t i = 0; i < moving_.size(); ++i)
        put(i, record(moving_[i]));

    const auto packed = [&](std::uint32_t link) {
        if (!isLeaf(link))
            return params_.topRoot + link;
        // The empty leaf beside a lone instance becomes that instance: a walk need not know of it.
        return leafLink(top_.order.empty() ? 0 : top_.order[leafFirst(link)], 1);
    };
    for (std::size_t i = 0; i < top_.nodes.size(); ++i) {
        gpu::BvhNode node = top_.nodes[i];
        node.link0 = packed(node.link0);
        node.link1 = packed(node.link1);
        put(params_.topRoot + i, node);
    }
}

} // namespace afterglow
