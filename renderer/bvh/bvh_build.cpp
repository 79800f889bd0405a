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
#include <condition_variable>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

namespace afterglow {

namespace {

constexpr int kMaxBins = 16;
constexpr std::uint32_t kParts = 64;          ///< so many at least, where items are many
constexpr std::uint32_t kSmallestPart = 2048; ///< items
constexpr std::uint32_t kChunk = 32768;       ///< items that a thread bins at a time
/// Of so many items and fewer, bins are over their centers; of more, over their box, which is about
/// as large and known already.
constexpr std::uint32_t kMeasured = 64;

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

/// What all parts of a tree share.
struct Build {
    std::span<const BvhRecord> leaves;
    BvhOptions options;
    LargeArray<Item> items;
    std::uint32_t partSize = 0; ///< ranges of so many items and fewer are parts
};

/// Builds a subtree into an array of records.
class Part {
public:
    /// With `cutting`, ranges of a part's size are left for others to build.
    Part(Build& build, LargeArray<BvhRecord>& records, unsigned threads, bool cutting)
        : build_(build), records_(records), threads_(threads), cutting_(cutting) {}

    struct Cut {
        Range range;
        std::uint32_t depth;
        std::size_t record; ///< that its root becomes
    };

    /// Returns a node over a range. Its recursion is as deep as the tree.
    BvhRecord node(const Range& range, std::uint32_t depth);

    std::vector<Cut> cuts;

private:
    std::uint32_t childrenOf(const Range& range, std::uint32_t depth, Range (&children)[4]);
    void split(const Range& range, std::uint32_t depth, Range& left, Range& right);
    void splitFew(const Range& range, Range& left, Range& right);
    Bins binned(const Range& range, const Binning& binning) const;
    std::optional<Split> bestSplit(const Range& range, const Binning& binning) const;
    void halve(const Range& range, Range& left, Range& right);
    void partition(const Range& range, const Binning& binning, const Split& split);
    void measure(Range& range) const;
    void measureCenters(Range& range) const;
    bool isLeaf(const Range& range) const;
    void putLeaf(const Range& range, std::size_t record, std::size_t& tail);

    const Item& item(std::uint32_t i) const { return build_.items[i]; }

    Build& build_;
    LargeArray<BvhRecord>& records_;
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
    const std::size_t first = records_.size();
    std::size_t tail = first + gpu::kBvhWidth;
    const std::size_t blocks = 1 + (tails + gpu::kBvhWidth - 1) / gpu::kBvhWidth;
    records_.resize(first + blocks * gpu::kBvhWidth, nullRecord());
    for (std::uint32_t k = 0; k < count; ++k) {
        if (leaf[k])
            putLeaf(children[k], first + k, tail);
        else if (cutting_ && children[k].count() <= build_.partSize)
            cuts.push_back({children[k], depth + 1, first + k});
        else
            records_[first + k] = node(children[k], depth + 1);
    }
    return packNode(boxes, std::uint32_t(first / gpu::kBvhWidth));
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
    records_[record] = build_.leaves[item(range.begin).index()];
    for (std::uint32_t i = range.begin + 1; i < range.end; ++i) {
        gpu::BvhTriangle triangle = records_[record].triangle();
        triangle.next = std::uint32_t(tail);
        records_[record] = triangle;
        record = tail++;
        records_[record] = build_.leaves[item(i).index()];
    }
}

void Part::split(const Range& range, std::uint32_t depth, Range& left, Range& right) {
    // The children may have so many items that halving them still ends in time.
    const std::uint64_t mostPerChild = std::uint64_t(1) << (build_.options.maxDepth - depth - 1);
    if (range.count() <= 3)
        return splitFew(range, left, right);
    const Binning binning(range);
    const std::optional<Split> best = bestSplit(range, binning);
    if (!best || best->leftCount > mostPerChild || range.count() - best->leftCount > mostPerChild)
        return halve(range, left, right);

    left = {range.begin, range.begin + best->leftCount, best->left, {}};
    right = {left.end, range.end, best->right, {}};
    partition(range, binning, *best);
    for (Range* child : {&left, &right})
        if (child->count() > kMeasured)
            child->centers = {child->box.low + child->box.low, child->box.high + child->box.high};
        else
            measureCenters(*child);
}

/// Puts those on the left of a split first. Each is exchanged with the first on the right whether
/// it has to be or not: a branch on it would be foreseen every second time.
void Part::partition(const Range& range, const Binning& binning, const Split& split) {
    const float origin = binning.origin[split.axis], scale = binning.scale[split.axis];
    Item* left = &build_.items[range.begin];
    Item* const end = left + range.count();
    for (Item* i = left; i != end; ++i) {
        const float center = i->low[split.axis] + i->high[split.axis];
        const int bin = std::clamp(int((center - origin) * scale), 0, binning.bins - 1);
        const Item item = *i;
        *i = *left;
        *left = item;
        left += bin < split.bin ? 1 : 0;
    }
}

/// Splits two or three items: of three, the pair with the smallest box stays together.
void Part::splitFew(const Range& range, Range& left, Range& right) {
    Item* const items = &build_.items[range.begin];
    std::uint32_t pair = 1;
    if (range.count() == 3) {
        float least = kInfinity;
        for (std::uint32_t single = 0; single < 3; ++single) {
            Box box{items[single].low, items[single].high};
            const float alone = box.halfArea();
            box = {items[(single + 1) % 3].low, items[(single + 1) % 3].high};
            box.include(items[(single + 2) % 3].low, items[(single + 2) % 3].high);
            const float cost = alone + 2.0f * box.halfArea();
            if (cost < least) {
                least = cost;
                pair = single;
            }
        }
        std::swap(items[pair], items[2]);
        pair = 2;
    }
    left = {range.begin, range.begin + pair, {}, {}};
    right = {left.end, range.end, {}, {}};
    measure(left);
    measure(right);
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
    for (std::uint32_t i = range.begin; i < range.end; ++i)
        range.box.include(item(i).low, item(i).high);
    measureCenters(range);
}

void Part::measureCenters(Range& range) const {
    for (std::uint32_t i = range.begin; i < range.end; ++i)
        range.centers.include(item(i).doubledCenter(), item(i).doubledCenter());
}

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

Range allItems(const LargeArray<Item>& items, unsigned threads) {
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

/// Builds the parts that were cut off and puts them behind the records, in their order.
void buildParts(Build& build, std::span<const Part::Cut> cuts, LargeArray<BvhRecord>& records,
                unsigned threads) {
    std::mutex placing;
    std::condition_variable placed;
    std::size_t next = 0;
    bool failed = false;
    std::vector<LargeArray<BvhRecord>> spare; // memory that is new costs more than filling it
    const auto buildOne = [&](std::size_t i) {
        LargeArray<BvhRecord> own;
        {
            const std::lock_guard lock(placing);
            if (!spare.empty()) {
                own = std::move(spare.back());
                spare.pop_back();
            }
        }
        BvhRecord root = Part(build, own, 1, false).node(cuts[i].range, cuts[i].depth);

        std::unique_lock lock(placing);
        placed.wait(lock, [&] { return next == i || failed; }); // those before are being built
        if (failed)
            return;
        const auto blocks = std::uint32_t(records.size() / gpu::kBvhWidth);
        moveBlocks(root, blocks);
        records[cuts[i].record] = root;
        for (BvhRecord& record : own)
            moveBlocks(record, blocks);
        records.insert(records.end(), own.begin(), own.end());
        own.clear();
        spare.push_back(std::move(own));
        ++next;
        placed.notify_all();
    };
    parallelFor(cuts.size(), threads, [&](std::size_t i) {
        try {
            buildOne(i);
        } catch (...) {
            const std::lock_guard lock(placing);
            failed = true;
            placed.notify_all();
            throw;
        }
    });
}

} // namespace

BvhRoot buildBvh(LargeArray<BvhRecord>& records, std::span<const Aabb> boxes,
                 std::span<const BvhRecord> leaves, const BvhOptions& options) {
    assert(boxes.size() == leaves.size() && records.size() % gpu::kBvhWidth == 0);
    assert(options.maxLeafSize >= 1 && options.maxLeafSize <= kBvhMaxLeafSize);
    // A block holds more than one leaf on average; what is built is counted exactly below.
    if (boxes.size() > gpu::kBvhMaxBlocks)
        throw Error("a scene holds at most " + std::to_string(gpu::kBvhMaxBlocks) +
                    " triangles, but there are " + std::to_string(boxes.size()));
    const unsigned threads = options.threads == 0 ? hardwareThreads() : options.threads;
    const auto count = std::uint32_t(boxes.size());
    Build build{leaves, options, LargeArray<Item>(count), std::max(count / kParts, kSmallestPart)};
    parallelFor((count + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
        const auto begin = std::uint32_t(chunk) * kChunk;
        for (std::uint32_t i = begin; i < std::min(begin + kChunk, count); ++i)
            build.items[i] = Item(boxes[i], i);
    });

    const Range all = allItems(build.items, threads);
    // Roots of other trees have links that stay as they are; there are few of them.
    const bool cutting = count > build.partSize && leaves[0].isTriangle();
    records.reserve(records.size() + 2 * std::size_t(count));
    Part top(build, records, threads, cutting);
    BvhRoot root{top.node(all, 0), count > 0 ? all.box.aabb() : Aabb{}};
    buildParts(build, top.cuts, records, threads);
    if (records.size() / gpu::kBvhWidth > gpu::kBvhMaxBlocks)
        throw Error("the tree of the scene needs " +
                    std::to_string(records.size() / gpu::kBvhWidth) + " blocks; links count " +
                    std::to_string(gpu::kBvhMaxBlocks));
    return root;
}

} // namespace afterglow
