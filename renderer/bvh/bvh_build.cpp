// SPDX-License-Identifier: MIT
// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007: items fall into
// bins by their centers, and a range is split between two bins. Departs from it in that a node has
// up to four children: the child with the largest surface is split again, as in Wald, Benthin and
// Boulos, "Getting Rid of Packets", RT 2008.
//
// A range of many items is cut into parts that threads build on their own. The cut depends on the
// items alone, so the tree is the same for any number of threads.

#include "renderer/base/error.h"
#include "renderer/base/parallel.h"
#include "renderer/bvh/bvh.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

namespace afterglow {

namespace {

constexpr int kMaxBins = 16;
constexpr std::uint32_t kParts = 64;          ///< so many at least, where items are many
constexpr std::uint32_t kSmallestPart = 2048; ///< items
constexpr std::uint32_t kChunk = 32768;       ///< items that a thread bins at a time

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

/// A box whose fourth component is not used.
struct Box {
    Float4 low{kInfinity, kInfinity, kInfinity, kInfinity};
    Float4 high{-kInfinity, -kInfinity, -kInfinity, -kInfinity};

    void include(Float4 from, Float4 to) {
        low = from < low ? from : low;
        high = to > high ? to : high;
    }
    void include(const Box& other) { include(other.low, other.high); }
    /// Half of the surface; 0 if empty.
    float halfArea() const {
        const Float4 e = high - low;
        return e[0] >= 0.0f ? e[0] * e[1] + e[1] * e[2] + e[2] * e[0] : 0.0f;
    }
    Aabb aabb() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
};

/// A leaf's box. The fourth component of `low` holds its index, as the bits of a number that is
/// normal: with denormal ones sums take many times as long.
struct Item {
    static constexpr std::uint32_t kLeastNormal = 0x00800000u;

    Item() = default;
    Item(const Aabb& box, std::uint32_t index)
        : low{box.min.x, box.min.y, box.min.z, std::bit_cast<float>(index + kLeastNormal)},
          high{box.max.x, box.max.y, box.max.z, 0.0f} {}

    std::uint32_t index() const {
        const float bits = low[3];
        return std::bit_cast<std::uint32_t>(bits) - kLeastNormal;
    }
    Float4 doubledCenter() const { return low + high; }

    Float4 low, high;
};

struct Range {
    std::uint32_t begin = 0, end = 0;
    Box box;     ///< of its items
    Box centers; ///< of their doubled centers

    std::uint32_t count() const { return end - begin; }
};

struct Split {
    float cost = kInfinity; ///< records fetched times half areas
    int axis = 0;
    int bin = 0; ///< the first on the right
    std::uint32_t leftCount = 0;
    Box left, right;
};

/// The bin of a center along each axis. What is not a number falls into the first.
struct Binning {
    explicit Binning(const Range& range) : origin(range.centers.low) {
        bins = int(std::min<std::uint32_t>(kMaxBins, 4 + range.count() / 8));
        const Float4 extent = range.centers.high - range.centers.low;
        for (int axis = 0; axis < 3; ++axis) {
            // Just under bins / extent, so that the last center is in the last bin.
            const float s = float(bins) * 0.99999f / extent[axis];
            scale[axis] = s < kInfinity ? s : 0.0f;
        }
    }
    Int4 operator()(Float4 center) const {
        const Int4 bin = __builtin_convertvector((center - origin) * scale, Int4);
        const Int4 last = Int4{} + (bins - 1);
        const Int4 notNegative = bin > 0 ? bin : Int4{};
        return notNegative < last ? notNegative : last;
    }

    Float4 origin, scale{};
    int bins;
};

struct Bins {
    struct Bin {
        Box box;
        std::uint32_t count = 0;
    };
    Bin bins[3][kMaxBins];

    explicit Bins(int count) {
        for (auto& axis : bins)
            std::fill_n(axis, count, Bin{});
    }
    void add(const Item* item, const Item* end, const Binning& binning) {
        for (; item != end; ++item) {
            const Int4 bin = binning(item->doubledCenter());
            for (int axis = 0; axis < 3; ++axis) {
                bins[axis][bin[axis]].box.include(item->low, item->high);
                ++bins[axis][bin[axis]].count;
            }
        }
    }
    void add(const Bins& other, int count) {
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < count; ++i) {
                bins[axis][i].box.include(other.bins[axis][i].box);
                bins[axis][i].count += other.bins[axis][i].count;
            }
    }
};

/// Moves a record's links by so many blocks.
void moveBlocks(BvhRecord& record, std::uint32_t blocks) {
    if (record.isTriangle()) {
        gpu::BvhTriangle triangle = record.triangle();
        triangle.next += triangle.next != 0 ? blocks * gpu::kBvhWidth : 0u;
        record = triangle;
    } else {
        gpu::BvhNode node = record.node();
        node.block += blocks;
        record = node;
    }
}

/// What all parts of a tree share.
struct Build {
    std::span<const BvhRecord> leaves;
    BvhOptions options;
    std::vector<Item> items;
    std::uint32_t partSize = 0; ///< ranges of so many items and fewer are parts
};

/// A subtree, whose records begin with a block.
class Part {
public:
    /// With `cutting` ranges of a part's size are left for others to build.
    Part(Build& build, std::uint32_t firstBlock, unsigned threads, bool cutting)
        : build_(build), firstBlock_(firstBlock), threads_(threads), cutting_(cutting) {}

    struct Cut {
        Range range;
        std::uint32_t depth;
        std::size_t record; ///< that its root becomes
    };

    /// Returns a node over a range. Its recursion is as deep as the tree.
    BvhRecord node(const Range& range, std::uint32_t depth);

    std::vector<BvhRecord> records;
    std::vector<Cut> cuts;

private:
    std::uint32_t childrenOf(const Range& range, std::uint32_t depth, Range (&children)[4]);
    void split(const Range& range, std::uint32_t depth, Range& left, Range& right);
    Bins binned(const Range& range, const Binning& binning) const;
    std::optional<Split> bestSplit(const Range& range, const Binning& binning) const;
    void halve(const Range& range, Range& left, Range& right);
    void measure(Range& range) const;
    bool isLeaf(const Range& range) const;
    void putLeaf(const Range& range, std::size_t record, std::size_t& tail);

    const Item& item(std::uint32_t i) const { return build_.items[i]; }

    Build& build_;
    std::uint32_t firstBlock_;
    unsigned threads_;
    bool cutting_;
};

BvhRecord Part::node(const Range& range, std::uint32_t depth) {
    assert(depth < build_.options.maxDepth);
    Range children[gpu::kBvhWidth];
    const std::uint32_t count = range.count() > 0 ? childrenOf(range, depth, children) : 0;

    std::array<Aabb, gpu::kBvhWidth> boxes;
    std::size_t tails = 0;
    bool leaf[gpu::kBvhWidth] = {};
    for (std::uint32_t k = 0; k < count; ++k) {
        boxes[k] = children[k].box.aabb();
        leaf[k] = isLeaf(children[k]);
        tails += leaf[k] ? children[k].count() - 1 : 0;
    }
    const std::size_t first = records.size();
    std::size_t tail = first + gpu::kBvhWidth;
    const std::size_t blocks = 1 + (tails + gpu::kBvhWidth - 1) / gpu::kBvhWidth;
    records.resize(first + blocks * gpu::kBvhWidth, nullRecord());
    for (std::uint32_t k = 0; k < count; ++k) {
        if (leaf[k])
            putLeaf(children[k], first + k, tail);
        else if (cutting_ && children[k].count() <= build_.partSize)
            cuts.push_back({children[k], depth + 1, first + k});
        else
            records[first + k] = node(children[k], depth + 1);
    }
    return packNode(boxes, firstBlock_ + std::uint32_t(first / gpu::kBvhWidth));
}

/// Splits a range into up to four children, and so each leaf for which there is room: boxes of a
/// node are tested all at once, so a child more costs nothing.
std::uint32_t Part::childrenOf(const Range& range, std::uint32_t depth, Range (&children)[4]) {
    children[0] = range;
    std::uint32_t count = 1;
    while (count < gpu::kBvhWidth) {
        std::uint32_t largest = count;
        float most = -1.0f;
        for (std::uint32_t k = 0; k < count; ++k)
            if (children[k].count() > 1 && children[k].box.halfArea() > most) {
                largest = k;
                most = children[k].box.halfArea();
            }
        if (largest == count)
            break;
        Range left, right;
        split(children[largest], depth, left, right);
        children[largest] = left;
        children[count++] = right;
    }
    return count;
}

/// Whether a walk fetches fewer records if it tests the triangles of a range one after the other
/// than with a node over them. It is at most as large as a node has children.
bool Part::isLeaf(const Range& range) const {
    if (range.count() <= 1)
        return true;
    if (range.count() > build_.options.maxLeafSize)
        return false;
    const float whole = range.box.halfArea();
    float parts = 0.0f;
    for (std::uint32_t i = range.begin; i < range.end; ++i)
        parts += Box{item(i).low, item(i).high}.halfArea();
    return !(whole + parts < float(range.count()) * whole);
}

void Part::putLeaf(const Range& range, std::size_t record, std::size_t& tail) {
    records[record] = build_.leaves[item(range.begin).index()];
    for (std::uint32_t i = range.begin + 1; i < range.end; ++i) {
        gpu::BvhTriangle triangle = records[record].triangle();
        triangle.next = firstBlock_ * gpu::kBvhWidth + std::uint32_t(tail);
        records[record] = triangle;
        record = tail++;
        records[record] = build_.leaves[item(i).index()];
    }
}

void Part::split(const Range& range, std::uint32_t depth, Range& left, Range& right) {
    // The children may have so many items that halving them still ends in time.
    const std::uint64_t mostPerChild = std::uint64_t(1) << (build_.options.maxDepth - depth - 1);
    const Binning binning(range);
    const std::optional<Split> best = bestSplit(range, binning);
    if (!best || best->leftCount > mostPerChild || range.count() - best->leftCount > mostPerChild)
        return halve(range, left, right);

    left = {range.begin, range.begin + best->leftCount, best->left, {}};
    right = {left.end, range.end, best->right, {}};
    Item* i = &build_.items[range.begin];
    Item* j = i + range.count();
    for (;;) {
        while (i < j && binning(i->doubledCenter())[best->axis] < best->bin) {
            left.centers.include(i->doubledCenter(), i->doubledCenter());
            ++i;
        }
        while (i < j && !(binning(j[-1].doubledCenter())[best->axis] < best->bin)) {
            --j;
            right.centers.include(j->doubledCenter(), j->doubledCenter());
        }
        if (i >= j)
            break;
        std::swap(*i, j[-1]);
    }
}

Bins Part::binned(const Range& range, const Binning& binning) const {
    const Item* items = build_.items.data();
    Bins bins(binning.bins);
    if (threads_ == 1 || range.count() < 2 * kChunk) {
        bins.add(items + range.begin, items + range.end, binning);
        return bins;
    }
    std::vector<Bins> chunks((range.count() + kChunk - 1) / kChunk, Bins(binning.bins));
    parallelFor(chunks.size(), threads_, [&](std::size_t i) {
        const std::uint32_t begin = range.begin + std::uint32_t(i) * kChunk;
        chunks[i].add(items + begin, items + std::min(begin + kChunk, range.end), binning);
    });
    for (const Bins& chunk : chunks)
        bins.add(chunk, binning.bins);
    return bins;
}

std::optional<Split> Part::bestSplit(const Range& range, const Binning& binning) const {
    const Bins bins = binned(range, binning);
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(binning.scale[axis] > 0.0f))
            continue;
        const auto& bin = bins.bins[axis];
        std::array<Box, kMaxBins> right;
        float rightCost[kMaxBins] = {};
        Box box;
        std::uint32_t count = 0;
        for (int i = binning.bins - 1; i > 0; --i) {
            box.include(bin[i].box);
            count += bin[i].count;
            right[std::size_t(i)] = box;
            rightCost[i] = box.halfArea() * float(count);
        }
        box = {};
        count = 0;
        for (int i = 1; i < binning.bins; ++i) {
            box.include(bin[i - 1].box);
            count += bin[i - 1].count;
            const float cost = box.halfArea() * float(count) + rightCost[i];
            if (count > 0 && count < range.count() && cost < best.cost)
                best = {cost, axis, i, count, box, right[std::size_t(i)]};
        }
    }
    return best.cost < kInfinity ? std::optional(best) : std::nullopt;
}

/// Splits by number along the longest axis, for what the heuristic cannot tell apart.
void Part::halve(const Range& range, Range& left, Range& right) {
    const Float4 extent = range.box.high - range.box.low;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (extent[i] > extent[axis])
            axis = i;
    const auto begin = build_.items.begin();
    const std::uint32_t middle = range.begin + range.count() / 2;
    std::nth_element(begin + range.begin, begin + middle, begin + range.end,
                     [axis](const Item& a, const Item& b) {
                         return a.doubledCenter()[axis] < b.doubledCenter()[axis];
                     });
    left = {range.begin, middle, {}, {}};
    right = {middle, range.end, {}, {}};
    measure(left);
    measure(right);
}

void Part::measure(Range& range) const {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        range.box.include(item(i).low, item(i).high);
        range.centers.include(item(i).doubledCenter(), item(i).doubledCenter());
    }
}

Range allItems(const std::vector<Item>& items, unsigned threads) {
    std::vector<Range> chunks((items.size() + kChunk - 1) / kChunk);
    parallelFor(chunks.size(), threads, [&](std::size_t i) {
        const std::size_t end = std::min((i + 1) * kChunk, items.size());
        for (std::size_t k = i * kChunk; k < end; ++k) {
            chunks[i].box.include(items[k].low, items[k].high);
            chunks[i].centers.include(items[k].doubledCenter(), items[k].doubledCenter());
        }
    });
    Range all{0, std::uint32_t(items.size()), {}, {}};
    for (const Range& chunk : chunks) {
        all.box.include(chunk.box);
        all.centers.include(chunk.centers);
    }
    return all;
}

} // namespace

Bvh buildBvh(std::span<const Aabb> boxes, std::span<const BvhRecord> leaves,
             const BvhOptions& options) {
    assert(boxes.size() == leaves.size());
    assert(options.maxLeafSize >= 1 && options.maxLeafSize <= kBvhMaxLeafSize);
    // A block holds more than one leaf on average; what is built below is counted exactly.
    if (boxes.size() > gpu::kBvhMaxBlocks)
        throw Error("a scene holds at most " + std::to_string(gpu::kBvhMaxBlocks) +
                    " triangles, but there are " + std::to_string(boxes.size()));
    const unsigned threads = options.threads == 0 ? hardwareThreads() : options.threads;
    const auto count = std::uint32_t(boxes.size());
    Build build{leaves, options, std::vector<Item>(count), std::max(count / kParts, kSmallestPart)};
    parallelFor((count + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
        const auto begin = std::uint32_t(chunk) * kChunk;
        for (std::uint32_t i = begin; i < std::min(begin + kChunk, count); ++i)
            build.items[i] = Item(boxes[i], i);
    });

    const Range all = allItems(build.items, threads);
    // Roots of other trees have links that stay as they are; there are few of them.
    const bool cuts = count > build.partSize && leaves[0].isTriangle();
    Part top(build, options.firstBlock, threads, cuts);
    Bvh bvh;
    bvh.root = top.node(all, 0);
    bvh.bounds = count > 0 ? all.box.aabb() : Aabb{};

    std::vector<Part> parts(top.cuts.size(), Part(build, 0, 1, false));
    std::vector<BvhRecord> roots(parts.size());
    parallelFor(parts.size(), threads, [&](std::size_t i) {
        parts[i].records.reserve(2 * top.cuts[i].range.count());
        roots[i] = parts[i].node(top.cuts[i].range, top.cuts[i].depth);
    });
    std::vector<std::size_t> begins(parts.size());
    std::size_t size = top.records.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        begins[i] = size;
        size += parts[i].records.size();
    }
    if (options.firstBlock + size / gpu::kBvhWidth > gpu::kBvhMaxBlocks)
        throw Error("the tree of the scene needs " + std::to_string(size / gpu::kBvhWidth) +
                    " blocks; links count " + std::to_string(gpu::kBvhMaxBlocks));
    bvh.records.resize(size);
    std::copy(top.records.begin(), top.records.end(), bvh.records.begin());
    parallelFor(parts.size(), threads, [&](std::size_t i) {
        const std::uint32_t blocks = options.firstBlock + std::uint32_t(begins[i] / gpu::kBvhWidth);
        for (std::size_t k = 0; k < parts[i].records.size(); ++k) {
            moveBlocks(parts[i].records[k], blocks);
            bvh.records[begins[i] + k] = parts[i].records[k];
        }
        parts[i].records = {};
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        moveBlocks(roots[i], options.firstBlock + std::uint32_t(begins[i] / gpu::kBvhWidth));
        bvh.records[top.cuts[i].record] = roots[i];
    }
    return bvh;
}

} // namespace afterglow
