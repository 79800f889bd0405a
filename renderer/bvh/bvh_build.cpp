// SPDX-License-Identifier: MIT
// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007 (bvh_split.cpp).
// Departs from it in that a node has up to four children: the child with the largest surface is
// split again, as in Wald, Benthin and Boulos, "Getting Rid of Packets", RT 2008.
//
// A range of many items is cut into parts that threads build on their own. The cut depends on the
// items alone, so the tree is the same for any number of threads.

#include "renderer/base/error.h"
#include "renderer/base/parallel.h"
#include "renderer/bvh/bvh.h"
#include "renderer/bvh/bvh_split.h"

#include <algorithm>
#include <cassert>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <string>

namespace afterglow {

namespace {

using bvh::allItems, bvh::Box, bvh::Item, bvh::Range, bvh::split;

constexpr std::uint32_t kParts = 64;          ///< so many at least, where items are many
constexpr std::uint32_t kSmallestPart = 2048; ///< items
constexpr std::uint32_t kChunk = 32768;       ///< items that a thread takes at a time

/// State that all parts of a tree share.
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
        float area = -1.0f;
        for (std::uint32_t k = 0; k < count; ++k)
            if (children[k].count() > 1 && children[k].box.halfArea() > area) {
                largest = k;
                area = children[k].box.halfArea();
            }
        if (largest == count)
            break;
        Range left, right;
        // They may have so many items that halving them still ends in time.
        const std::uint64_t most = std::uint64_t(1) << (build_.options.maxDepth - depth - 1);
        split(build_.items, children[largest], most, threads_, left, right);
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
