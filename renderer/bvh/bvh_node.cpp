// SPDX-License-Identifier: MIT
// Nodes as walks see them: boxes in steps of a grid, and what is measured and mended on a tree.

#include "renderer/bvh/bvh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace afterglow {

namespace {

/// Steps of a grid along one axis.
constexpr int kSteps = 255;
/// Exponents of a step: below, a step times the inverse of a direction could be a denormal number;
/// above, 255 steps could overflow.
constexpr int kLeastExponent = -60, kMostExponent = 119;

double powerOfTwo(int exponent) {
    return std::bit_cast<double>(std::uint64_t(exponent + 1023) << 52);
}

/// The exponent of the smallest step, a power of two, of which 255 reach over an extent.
int exponentOf(double extent) {
    // Of the largest power of two that is not above.
    const int exponent = int(std::bit_cast<std::uint64_t>(extent / kSteps) >> 52) - 1023;
    const int least = std::clamp(exponent, kLeastExponent, kMostExponent);
    return least < kMostExponent && kSteps * powerOfTwo(least) < extent ? least + 1 : least;
}

/// Boxes in nodes are larger than what they hold by this part of their largest coordinate. A ray
/// along an axis that touches a side of a box from within would else be taken to leave it at once:
/// a walk finds the place of a plane within 3 epsilon.
constexpr float kMargin = 6.0f * std::numeric_limits<float>::epsilon();

float area(const Aabb& box) {
    const glm::vec3 e = box.max - box.min;
    return box.empty() ? 0.0f : e.x * e.y + e.y * e.z + e.z * e.x;
}

template <class Record>
Record& childOf(const gpu::BvhNode& node, std::uint32_t k, std::span<Record> records) {
    return records[node.block * gpu::kBvhWidth + k];
}

std::uint32_t depthBelow(const gpu::BvhNode& node, std::span<const BvhRecord> records) {
    std::uint32_t deepest = 0;
    for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k)
        if (!childBox(node, k).empty() && !childOf(node, k, records).isTriangle())
            deepest = std::max(deepest, depthBelow(childOf(node, k, records).node(), records));
    return deepest + 1;
}

double costBelow(const gpu::BvhNode& node, std::span<const BvhRecord> records) {
    double cost = 0.0;
    for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k) {
        const Aabb box = childBox(node, k);
        if (box.empty())
            continue;
        const BvhRecord* record = &childOf(node, k, records);
        cost += double(area(box));
        if (!record->isTriangle())
            cost += costBelow(record->node(), records);
        else
            for (; record->triangle().next != 0; record = &records[record->triangle().next])
                cost += double(area(box));
    }
    return cost;
}

Aabb refitNode(BvhRecord& record, std::span<BvhRecord> records) {
    const gpu::BvhNode node = record.node();
    std::array<Aabb, gpu::kBvhWidth> boxes;
    Aabb all;
    for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k) {
        if (childBox(node, k).empty())
            continue;
        BvhRecord* child = &childOf(node, k, records);
        if (!child->isTriangle()) {
            boxes[k] = refitNode(*child, records);
        } else {
            boxes[k] = boundsOf(child->triangle());
            while (child->triangle().next != 0) {
                child = &records[child->triangle().next];
                boxes[k].include(boundsOf(child->triangle()));
            }
        }
        all.include(boxes[k]);
    }
    record = packNode(boxes, node.block);
    return all;
}

} // namespace

BvhRecord nullRecord() {
    return gpu::BvhTriangle{.v0 = {},
                            .instance = gpu::kBvhTriangle | gpu::kBvhInstanceMask,
                            .v1 = {},
                            .triangle = 0,
                            .v2 = {},
                            .next = 0};
}

Aabb boundsOf(const gpu::BvhTriangle& triangle) {
    Aabb box;
    box.include(triangle.v0);
    box.include(triangle.v1);
    box.include(triangle.v2);
    return box;
}

gpu::BvhNode packNode(const std::array<Aabb, gpu::kBvhWidth>& children, std::uint32_t block) {
    Aabb all;
    for (const Aabb& child : children)
        all.include(child);
    gpu::BvhNode node{};
    node.block = block;
    if (all.empty())
        all = {glm::vec3(0.0f), glm::vec3(0.0f)};
    const glm::vec3 largest = glm::max(glm::abs(all.min), glm::abs(all.max));
    const float margin = kMargin * std::max({largest.x, largest.y, largest.z});
    std::uint32_t* const low[3] = {&node.lowX, &node.lowY, &node.lowZ};
    std::uint32_t* const high[3] = {&node.highX, &node.highY, &node.highZ};
    for (int axis = 0; axis < 3; ++axis) {
        const float origin = all.min[axis] - margin;
        const int exponent = exponentOf(double(all.max[axis]) + margin - origin);
        const double inverse = powerOfTwo(-exponent);
        node.origin[axis] = origin;
        node.exponents |= std::uint32_t(exponent + 127) << (8 * axis);
        for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k) {
            int below = kSteps, above = 0;
            if (!children[k].empty()) { // both are at least 0, where a cast rounds down
                const double from = (double(children[k].min[axis]) - margin - origin) * inverse;
                const double to = (double(children[k].max[axis]) + margin - origin) * inverse;
                below = std::clamp(int(std::min(from, double(kSteps))), 0, kSteps);
                above = int(std::clamp(to, 0.0, double(kSteps)));
                above += above < kSteps && double(above) < to ? 1 : 0;
            }
            *low[axis] |= std::uint32_t(below) << (8 * k);
            *high[axis] |= std::uint32_t(above) << (8 * k);
        }
    }
    return node;
}

Aabb childBox(const gpu::BvhNode& node, std::uint32_t child) {
    const std::uint32_t low[3] = {node.lowX, node.lowY, node.lowZ};
    const std::uint32_t high[3] = {node.highX, node.highY, node.highZ};
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
        const int exponent = int((node.exponents >> (8 * axis)) & 255u) - 127;
        const float step = std::ldexp(1.0f, exponent);
        const std::uint32_t from = (low[axis] >> (8 * child)) & 255u;
        const std::uint32_t to = (high[axis] >> (8 * child)) & 255u;
        if (from > to)
            return {};
        box.min[axis] = node.origin[axis] + float(from) * step;
        box.max[axis] = node.origin[axis] + float(to) * step;
    }
    return box;
}

void refitBvh(BvhRoot& root, std::span<BvhRecord> records) {
    root.bounds = refitNode(root.record, records);
}

std::uint32_t depthOf(const BvhRecord& root, std::span<const BvhRecord> records) {
    return depthBelow(root.node(), records);
}

double sahCost(const BvhRecord& root, std::span<const BvhRecord> records) {
    Aabb all;
    for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k)
        all.include(childBox(root.node(), k));
    const double whole = double(area(all));
    return whole > 0.0 ? 1.0 + costBelow(root.node(), records) / whole : 1.0;
}

} // namespace afterglow
