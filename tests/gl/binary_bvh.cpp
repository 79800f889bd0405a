// SPDX-License-Identifier: MIT
// Binned surface area heuristic; Wald 2007, "On fast Construction of SAH-based Bounding Volume
// Hierarchies".

#include "tests/gl/binary_bvh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace afterglow::test {

namespace {

constexpr int kBins = 16;              // an axis; Wald 2007, section 4
constexpr float kTraversalCost = 1.0f; // of a node, in tests of what is in a leaf

/// Boxes in nodes are larger than what is in them by this part of the largest coordinate. A ray
/// along an axis that touches a side of a box from within would else be taken to leave it at once.
constexpr float kMargin = 2.0f * std::numeric_limits<float>::epsilon();

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A box with rows of four, so that the compiler grows it by two vector instructions.
struct alignas(16) WideBox {
    float min[4] = {kInfinity, kInfinity, kInfinity, kInfinity};
    float max[4] = {-kInfinity, -kInfinity, -kInfinity, -kInfinity};

    void include(const WideBox& other) {
        for (int i = 0; i < 4; ++i)
            min[i] = other.min[i] < min[i] ? other.min[i] : min[i];
        for (int i = 0; i < 4; ++i)
            max[i] = other.max[i] > max[i] ? other.max[i] : max[i];
    }
    /// Half of the surface; 0 if empty.
    float halfArea() const {
        const float x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
        return x >= 0.0f ? x * y + y * z + z * x : 0.0f;
    }
};

struct Item {
    WideBox box;
    std::uint32_t index;

    float doubledCenter(int axis) const { return box.min[axis] + box.max[axis]; }
};

struct Range {
    std::uint32_t begin, end;
    std::uint32_t count() const { return end - begin; }
};

struct Split {
    float cost = kInfinity; // in tests, without the traversal of the node
    int axis = 0;
    int bin = 0; // the first on the right
    std::uint32_t leftCount = 0;
};

/// Which bin of an axis a center falls into. Everything that is not a number falls into the first.
struct Binning {
    float origin = 0.0f, scale = 0.0f;

    int operator()(float center) const {
        const float position = (center - origin) * scale;
        return position > 0.0f ? (position < float(kBins - 1) ? int(position) : kBins - 1) : 0;
    }
};

class Builder {
public:
    Builder(std::span<const Aabb> boxes, std::uint32_t maxLeafSize) : maxLeafSize_(maxLeafSize) {
        items_.resize(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            Item& item = items_[i];
            for (int axis = 0; axis < 3; ++axis) {
                item.box.min[axis] = boxes[i].min[axis];
                item.box.max[axis] = boxes[i].max[axis];
            }
            item.box.min[3] = item.box.max[3] = 0.0f;
            item.index = std::uint32_t(i);
        }
        bvh_.nodes.reserve(boxes.size() / 2 + 1);
    }

    BinaryBvh build() {
        const Range all{0, std::uint32_t(items_.size())};
        const WideBox bounds = boundsOf(all);
        for (int axis = 0; axis < 3; ++axis)
            margin_ = std::max({margin_, kMargin * std::abs(bounds.min[axis]),
                                kMargin * std::abs(bounds.max[axis])});
        if (all.count() > 0)
            bvh_.bounds = {{bounds.min[0], bounds.min[1], bounds.min[2]},
                           {bounds.max[0], bounds.max[1], bounds.max[2]}};
        const std::uint32_t root = subtree(all, bounds, 0);
        if (isLeaf(root)) { // the root is a node even so: beside the leaf stands an empty one
            bvh_.nodes.emplace_back();
            setChildren(0, bounds, root, pointBox(), leafLink(0, 0));
        }
        bvh_.order.reserve(items_.size());
        for (const Item& item : items_)
            bvh_.order.push_back(item.index);
        return std::move(bvh_);
    }

private:
    WideBox boundsOf(Range range) const {
        WideBox bounds;
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            bounds.include(items_[i].box);
        return range.count() > 0 ? bounds : pointBox();
    }

    /// What stands for "no box": slabs would take an inverted box for an infinite one.
    static WideBox pointBox() {
        WideBox box;
        std::fill(box.min, box.min + 4, 0.0f);
        std::fill(box.max, box.max + 4, 0.0f);
        return box;
    }

    /// The link to a subtree over a range. Its recursion is as deep as the tree.
    std::uint32_t subtree(Range range, const WideBox& bounds, std::uint32_t depth) {
        const std::uint32_t count = range.count();
        if (count <= 1)
            return leafLink(range.begin, count);

        // The children may have so many items that halving them still ends in time.
        assert(depth < kBinaryMaxDepth);
        const std::uint64_t mostPerChild = std::uint64_t(1) << (kBinaryMaxDepth - depth - 1);

        std::array<Binning, 3> binnings;
        const Split split = bestSplit(range, binnings);
        const float area = bounds.halfArea();
        const bool useful = split.cost < kInfinity && split.leftCount <= mostPerChild &&
                            count - split.leftCount <= mostPerChild;
        if (count <= maxLeafSize_ &&
            (!useful || float(count) * area <= kTraversalCost * area + split.cost))
            return leafLink(range.begin, count);

        const std::uint32_t middle =
            useful ? partition(range, split, binnings[std::size_t(split.axis)]) : halve(range);
        const Range left{range.begin, middle}, right{middle, range.end};
        const WideBox leftBounds = boundsOf(left), rightBounds = boundsOf(right);

        const std::size_t node = bvh_.nodes.size();
        bvh_.nodes.emplace_back();
        const std::uint32_t leftLink = subtree(left, leftBounds, depth + 1);
        const std::uint32_t rightLink = subtree(right, rightBounds, depth + 1);
        setChildren(node, leftBounds, leftLink, rightBounds, rightLink);
        return std::uint32_t(node);
    }

    void setChildren(std::size_t node, const WideBox& a, std::uint32_t aLink, const WideBox& b,
                     std::uint32_t bLink) {
        const auto rows = [this](const WideBox& box, int axis) {
            return glm::vec2(box.min[axis] - margin_, box.max[axis] + margin_);
        };
        bvh_.nodes[node] = {.child0xy = glm::vec4(rows(a, 0), rows(a, 1)),
                            .child1xy = glm::vec4(rows(b, 0), rows(b, 1)),
                            .childrenZ = glm::vec4(rows(a, 2), rows(b, 2)),
                            .link0 = aLink,
                            .link1 = bLink,
                            .pad0 = 0,
                            .pad1 = 0};
    }

    Split bestSplit(Range range, std::array<Binning, 3>& binnings) {
        float low[3] = {kInfinity, kInfinity, kInfinity};
        float high[3] = {-kInfinity, -kInfinity, -kInfinity};
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], items_[i].doubledCenter(axis));
                high[axis] = std::max(high[axis], items_[i].doubledCenter(axis));
            }
        for (int axis = 0; axis < 3; ++axis) {
            // Just under kBins / extent, so that the last center is in the last bin.
            const float scale = float(kBins) * 0.99999f / (high[axis] - low[axis]);
            binnings[std::size_t(axis)] = {low[axis], scale < kInfinity ? scale : 0.0f};
        }

        for (auto& bins : bins_)
            bins.fill({});
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Bin& bin =
                    bins_[axis][std::size_t(binnings[axis](items_[i].doubledCenter(int(axis))))];
                bin.box.include(items_[i].box);
                ++bin.count;
            }

        Split best;
        for (int axis = 0; axis < 3; ++axis)
            if (binnings[std::size_t(axis)].scale > 0.0f)
                best = cheaper(best, bestOfAxis(axis, range.count()));
        return best;
    }

    Split bestOfAxis(int axis, std::uint32_t total) const {
        const auto& bins = bins_[std::size_t(axis)];
        std::array<float, kBins> rightCost{};
        WideBox box;
        std::uint32_t count = 0;
        for (int i = kBins - 1; i > 0; --i) {
            box.include(bins[std::size_t(i)].box);
            count += bins[std::size_t(i)].count;
            rightCost[std::size_t(i)] = box.halfArea() * float(count);
        }
        Split best;
        box = {};
        count = 0;
        for (int i = 1; i < kBins; ++i) {
            box.include(bins[std::size_t(i - 1)].box);
            count += bins[std::size_t(i - 1)].count;
            if (count > 0 && count < total)
                best = cheaper(best, {box.halfArea() * float(count) + rightCost[std::size_t(i)],
                                      axis, i, count});
        }
        return best;
    }

    static Split cheaper(const Split& a, const Split& b) { return b.cost < a.cost ? b : a; }

    std::uint32_t partition(Range range, const Split& split, const Binning& binning) {
        const auto middle = std::partition(
            items_.begin() + range.begin, items_.begin() + range.end,
            [&](const Item& item) { return binning(item.doubledCenter(split.axis)) < split.bin; });
        return std::uint32_t(middle - items_.begin());
    }

    /// Splits by number along the longest axis, for what the heuristic cannot tell apart.
    std::uint32_t halve(Range range) {
        const WideBox bounds = boundsOf(range);
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (bounds.max[i] - bounds.min[i] > bounds.max[axis] - bounds.min[axis])
                axis = i;
        const std::uint32_t middle = range.begin + range.count() / 2;
        std::nth_element(items_.begin() + range.begin, items_.begin() + middle,
                         items_.begin() + range.end, [axis](const Item& a, const Item& b) {
                             return a.doubledCenter(axis) < b.doubledCenter(axis);
                         });
        return middle;
    }

    struct Bin {
        WideBox box;
        std::uint32_t count = 0;
    };

    std::uint32_t maxLeafSize_;
    float margin_ = 0.0f; // by which the boxes in the nodes are larger, on each side
    std::vector<Item> items_;
    std::array<std::array<Bin, kBins>, 3> bins_; // scratch of bestSplit()
    BinaryBvh bvh_;
};

} // namespace

BinaryBvh buildBinaryBvh(std::span<const Aabb> boxes) {
    return Builder(boxes, 4).build();
}

} // namespace afterglow::test
