// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/aabb.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

// Splits of the items of a tree by binned surface areas. Wald, "On fast Construction of SAH-based
// Bounding Volume Hierarchies", RT 2007: items fall into bins by their centers, and a range is
// split between two bins. Seen by bvh_build.cpp alone.

namespace afterglow::bvh {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

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

/// Returns the range of all items, with its boxes.
Range allItems(std::span<const Item> items, unsigned threads);

/// Splits a range of at least two items where a walk is cheapest, and puts those on the left first.
/// No child gets more than `mostPerChild`, which is at least half of them.
void split(std::span<Item> items, const Range& range, std::uint64_t mostPerChild, unsigned threads,
           Range& left, Range& right);

} // namespace afterglow::bvh
