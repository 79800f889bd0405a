// SPDX-License-Identifier: MIT
// Trees over boxes: what is built, and what is fitted again.

#include "renderer/bvh/bvh.h"
#include "tests/unit/random_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// A tree over boxes, each the leaf of a triangle that spans it.
struct BoxTree {
    explicit BoxTree(std::vector<Aabb> of, BvhOptions options = {}, std::size_t before = 0)
        : boxes(std::move(of)) {
        LargeArray<BvhRecord> leaves;
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            leaves.push_back(gpu::BvhTriangle{.v0 = boxes[i].min,
                                              .instance = gpu::kBvhTriangle,
                                              .v1 = boxes[i].max,
                                              .triangle = i,
                                              .v2 = boxes[i].max,
                                              .next = 0});
        records.resize(before, nullRecord());
        root = buildBvh(records, boxes, leaves, options);
    }
    std::uint32_t depth() const { return depthOf(root.record, records); }

    std::vector<Aabb> boxes;
    LargeArray<BvhRecord> records;
    BvhRoot root;
};

/// Returns whether every box is in exactly one leaf and inside every box above that leaf, and no
/// leaf holds more than may be.
bool isWhole(const BoxTree& of, std::uint32_t maxLeafSize = kBvhMaxLeafSize) {
    std::vector<int> seen(of.boxes.size(), 0);
    bool inside = true;
    const std::function<void(const gpu::BvhNode&, std::vector<Aabb>)> visit =
        [&](const gpu::BvhNode& node, const std::vector<Aabb>& above) {
            for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k) {
                if (childBox(node, k).empty())
                    continue;
                std::vector<Aabb> path = above;
                path.push_back(childBox(node, k));
                BvhRecord child = of.records.at(gpu::kBvhWidth * node.block + k);
                if (!child.isTriangle()) {
                    visit(child.node(), path);
                    continue;
                }
                for (std::uint32_t length = 1;; ++length) {
                    const std::uint32_t box = child.triangle().triangle;
                    ++seen.at(box);
                    for (const Aabb& outer : path)
                        inside = inside && outer.contains(of.boxes[box]);
                    inside = inside && length <= maxLeafSize;
                    if (child.triangle().next == 0)
                        break;
                    child = of.records.at(child.triangle().next);
                }
            }
        };
    visit(of.root.record.node(), {});
    return inside && std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; });
}

std::vector<Aabb> randomBoxes(Random& random, int count) {
    std::vector<Aabb> boxes(std::size_t(count), Aabb{});
    for (Aabb& box : boxes) {
        const glm::dvec3 center = random.inCube(10.0);
        box.include(glm::vec3(center));
        box.include(glm::vec3(center + random.inCube(0.3)));
    }
    return boxes;
}

} // namespace

TEST_CASE("every box is in one leaf of its tree, and inside all boxes above it") {
    Random random(11);
    for (const int count : {0, 1, 2, 3, 4, 5, 8, 33, 1000, 20000})
        for (const std::uint32_t leafSize : {1u, 4u})
            for (const std::size_t before : {0u, 28u}) {
                CAPTURE(count);
                const BoxTree tree(randomBoxes(random, count), {.maxLeafSize = leafSize}, before);
                CHECK(isWhole(tree, leafSize));
                CHECK(tree.records.size() % gpu::kBvhWidth == 0);
                if (count > 100)
                    CHECK(tree.depth() < 14); // not degenerate: log2(20000)
            }
}

TEST_CASE("a tree is the same for any number of threads") {
    Random random(12);
    const std::vector<Aabb> boxes = randomBoxes(random, 150000); // several chunks and many parts
    const BoxTree one(boxes, {.threads = 1});
    for (const unsigned threads : {2u, 3u, 8u}) {
        const BoxTree several(boxes, {.threads = threads});
        CHECK(several.root.record == one.root.record);
        CHECK(several.records == one.records);
    }
    CHECK(isWhole(one));
}

TEST_CASE("no path is longer than the stack of a walk, whatever the boxes") {
    SUBCASE("a hundred thousand identical boxes") {
        const BoxTree tree(std::vector<Aabb>(100000, Aabb{{1, 2, 3}, {4, 5, 6}}));
        CHECK(isWhole(tree));
        CHECK(tree.depth() <= 17); // halved each time
    }
    SUBCASE("boxes at powers of two, of which each split sheds only a few") {
        std::vector<Aabb> boxes;
        for (int copy = 0; copy < 40; ++copy)
            for (int exponent = -120; exponent < 40; ++exponent) {
                const float x = std::ldexp(1.0f, exponent);
                boxes.push_back({{x, 0, 0}, {x * 1.01f, x, x}});
            }
        const BoxTree shallow(boxes, {.maxLeafSize = 1, .maxDepth = 14});
        CHECK(isWhole(shallow, 1));
        CHECK(shallow.depth() <= 14); // 2^14 leaves are room for 6,400
        const BoxTree free(boxes, {.maxLeafSize = 1});
        CHECK(isWhole(free, 1));
        CHECK(free.depth() <= 40);
        CHECK(free.depth() > 14); // the case is as bad as it means to be
    }
    SUBCASE("boxes whose areas overflow") {
        std::vector<Aabb> boxes;
        for (int i = 0; i < 1000; ++i)
            boxes.push_back({{-8e36f, float(i), 0}, {8e36f, float(i) + 1e30f, 8e36f}});
        const BoxTree tree(boxes);
        CHECK(isWhole(tree));
        CHECK(tree.depth() <= 40);
    }
}

TEST_CASE("a node holds its children's boxes with little room to spare, whatever their size") {
    Random random(13);
    for (const double scale : {1e-30, 1e-6, 1.0, 1e6, 1e30})
        for (int i = 0; i < 200; ++i) {
            std::array<Aabb, gpu::kBvhWidth> boxes;
            const int children = random.below(5);
            Aabb all;
            for (int k = 0; k < children; ++k) {
                boxes[std::size_t(k)].include(glm::vec3(random.inCube(scale)));
                boxes[std::size_t(k)].include(glm::vec3(random.inCube(scale)));
                all.include(boxes[std::size_t(k)]);
            }
            const gpu::BvhNode node = packNode(boxes, 5);
            CHECK(node.block == 5);
            for (std::uint32_t k = 0; k < gpu::kBvhWidth; ++k) {
                const Aabb packed = childBox(node, k);
                REQUIRE(packed.empty() == boxes[k].empty());
                if (packed.empty())
                    continue;
                CHECK(packed.contains(boxes[k]));
                if (scale < 1e-18) // finer than the finest grid
                    continue;
                // A step is at most 2 / 255 of the extent.
                const glm::vec3 slack = 0.0085f * (all.max - all.min) + float(2e-6 * scale);
                CHECK(glm::all(glm::lessThanEqual(boxes[k].min - packed.min, slack)));
                CHECK(glm::all(glm::lessThanEqual(packed.max - boxes[k].max, slack)));
            }
        }
}

TEST_CASE("a tree that is fitted again is one over what its triangles have become") {
    Random random(14);
    BoxTree tree(randomBoxes(random, 3000));
    const LargeArray<BvhRecord> before = tree.records;
    refitBvh(tree.root, tree.records);
    CHECK(tree.records == before); // nothing has moved
    for (BvhRecord& record : tree.records) {
        if (!record.isTriangle() || record == nullRecord())
            continue;
        gpu::BvhTriangle triangle = record.triangle();
        const glm::vec3 move(random.inCube(3.0));
        triangle.v0 += move;
        triangle.v1 += move;
        triangle.v2 += move;
        tree.boxes[triangle.triangle] = boundsOf(triangle);
        record = triangle;
    }
    CHECK_FALSE(isWhole(tree));
    refitBvh(tree.root, tree.records);
    CHECK(isWhole(tree));
    for (const Aabb& box : tree.boxes)
        CHECK(tree.root.bounds.contains(box));
}
