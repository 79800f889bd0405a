// SPDX-License-Identifier: MIT
#include "renderer/bvh/bvh_split.h"

#include "renderer/base/parallel.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace afterglow::bvh {

namespace {

constexpr int kMaxBins = 16;
constexpr std::uint32_t kChunk = 32768; ///< items that a thread bins at a time
/// Of so many items and fewer, bins are over their centers; of more, over their box, which is about
/// as large and known already.
constexpr std::uint32_t kMeasured = 64;

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

void measureCenters(std::span<const Item> items, Range& range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i)
        range.centers.include(items[i].doubledCenter(), items[i].doubledCenter());
}

void measure(std::span<const Item> items, Range& range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i)
        range.box.include(items[i].low, items[i].high);
    measureCenters(items, range);
}

/// Puts those on the left of a split first. Each is exchanged with the first on the right whether
/// it has to be or not: a branch on it would be foreseen every second time.
void partition(std::span<Item> items, const Range& range, const Binning& binning,
               const Split& split) {
    const float origin = binning.origin[split.axis], scale = binning.scale[split.axis];
    Item* left = &items[range.begin];
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
void splitFew(std::span<Item> all, const Range& range, Range& left, Range& right) {
    Item* const items = &all[range.begin];
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
    measure(all, left);
    measure(all, right);
}

Bins binned(std::span<const Item> all, const Range& range, const Binning& binning,
            unsigned threads) {
    const Item* items = all.data();
    Bins bins(binning.bins);
    if (threads == 1 || range.count() < 2 * kChunk) {
        bins.add(items + range.begin, items + range.end, binning);
        return bins;
    }
    std::vector<Bins> chunks((range.count() + kChunk - 1) / kChunk, Bins(binning.bins));
    parallelFor(chunks.size(), threads, [&](std::size_t i) {
        const std::uint32_t begin = range.begin + std::uint32_t(i) * kChunk;
        chunks[i].add(items + begin, items + std::min(begin + kChunk, range.end), binning);
    });
    for (const Bins& chunk : chunks)
        bins.add(chunk, binning.bins);
    return bins;
}

std::optional<Split> bestSplit(const Bins& bins, const Range& range, const Binning& binning) {
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
void halve(std::span<Item> items, const Range& range, Range& left, Range& right) {
    const Float4 extent = range.box.high - range.box.low;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (extent[i] > extent[axis])
            axis = i;
    const auto begin = items.begin();
    const std::uint32_t middle = range.begin + range.count() / 2;
    std::nth_element(begin + range.begin, begin + middle, begin + range.end,
                     [axis](const Item& a, const Item& b) {
                         return a.doubledCenter()[axis] < b.doubledCenter()[axis];
                     });
    left = {range.begin, middle, {}, {}};
    right = {middle, range.end, {}, {}};
    measure(items, left);
    measure(items, right);
}

} // namespace

Range allItems(std::span<const Item> items, unsigned threads) {
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

void split(std::span<Item> items, const Range& range, std::uint64_t mostPerChild, unsigned threads,
           Range& left, Range& right) {
    if (range.count() <= 3)
        return splitFew(items, range, left, right);
    const Binning binning(range);
    const std::optional<Split> best =
        bestSplit(binned(items, range, binning, threads), range, binning);
    if (!best || best->leftCount > mostPerChild || range.count() - best->leftCount > mostPerChild)
        return halve(items, range, left, right);

    left = {range.begin, range.begin + best->leftCount, best->left, {}};
    right = {left.end, range.end, best->right, {}};
    partition(items, range, binning, *best);
    for (Range* child : {&left, &right})
        if (child->count() > kMeasured)
            child->centers = {child->box.low + child->box.low, child->box.high + child->box.high};
        else
            measureCenters(items, *child);
}

} // namespace afterglow::bvh
