// SPDX-License-Identifier: MIT
// Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913, 1993.
//
// Departs from the paper in three places, none of which changes the idea:
//  - Energies are integers, so taking a point away undoes exactly what adding it did.
//  - Of equal energies the paper takes any; here a hash of the pixel decides. Scan order would
//    draw lines into the tile.
//  - The third phase, "insert into the tightest cluster of zeros", is the second phase continued:
//    on a torus the energies of ones and zeros add up to a constant, so the tightest cluster of
//    zeros is the largest void between the ones.

#include "tools/blue_noise/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace afterglow {
namespace {

// Ulichney's choice. Narrower, and points more than a few pixels apart do not feel each other: the
// first ranks of all become white noise. Wider, and the energy of a dense pattern no longer sees
// single pixels: the middle ranks lose their high frequencies.
constexpr double kSigma = 1.5;

// Energies are multiples of 2^-48. All of a tile's weights together stay below 15 * 2^48, far from
// overflow, and points up to 12 pixels apart still feel each other.
constexpr double kEnergyScale = 281474976710656.0;

// The share of ones in the pattern at the start. Ulichney: any number below one half will do.
constexpr int kStartDivisor = 10;

/// Maps 32 bits one to one: three rounds of multiply and shift.
std::uint32_t scramble(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

/// Points on a torus and the Gaussian energy that they spread around them.
class Pattern {
public:
    Pattern(int edge, std::uint32_t seed)
        : edge_(edge), bestVoid_(std::size_t(edge)), bestCluster_(std::size_t(edge)),
          isSet_(glm::ivec2(edge)), energy_(glm::ivec2(edge)), priority_(glm::ivec2(edge)) {
        for (int dy = -edge / 2; dy < edge - edge / 2; ++dy) {
            for (int dx = -edge / 2; dx < edge - edge / 2; ++dx) {
                const double weight = std::exp(-(dx * dx + dy * dy) / (2.0 * kSigma * kSigma));
                const auto energy = std::int64_t(std::llround(weight * kEnergyScale));
                if (energy > 0)
                    kernel_.push_back({{dx, dy}, energy});
            }
        }
        std::uint32_t index = 0;
        for (std::uint32_t& priority : priority_.pixels())
            priority = scramble(index++ ^ scramble(seed));
        for (int y = 0; y < edge; ++y)
            rescan(y);
    }

    bool isSet(glm::ivec2 p) const { return isSet_(p) != 0; }

    void toggle(glm::ivec2 p) {
        isSet_(p) ^= 1;
        const std::int64_t sign = isSet_(p) ? 1 : -1;
        int reach = 0;
        for (const Weight& w : kernel_) {
            energy_(wrapped(p + w.offset)) += sign * w.energy;
            reach = std::max(reach, std::abs(w.offset.y));
        }
        const int first = p.y - reach, rows = std::min(2 * reach + 1, edge_);
        for (int i = 0; i < rows; ++i)
            rescan(wrapped({0, first + i}).y);
    }

    /// Returns the set pixel with the most, and the free pixel with the least, energy around it.
    /// There must be one.
    glm::ivec2 tightestCluster() const { return best(bestCluster_, 1); }
    glm::ivec2 largestVoid() const { return best(bestVoid_, -1); }

    std::uint32_t priority(glm::ivec2 p) const { return priority_(p); }

private:
    struct Weight {
        glm::ivec2 offset;
        std::int64_t energy;
    };

    glm::ivec2 wrapped(glm::ivec2 p) const {
        return {(p.x % edge_ + edge_) % edge_, (p.y % edge_ + edge_) % edge_};
    }

    /// Returns whether a comes before b where more energy (sign 1) or less (sign -1) wins.
    bool beats(glm::ivec2 a, glm::ivec2 b, int sign) const {
        const std::int64_t difference = sign * (energy_(a) - energy_(b));
        return difference != 0 ? difference > 0 : priority_(a) > priority_(b);
    }

    void rescan(int y) {
        std::optional<glm::ivec2> cluster, hole;
        for (int x = 0; x < edge_; ++x) {
            const glm::ivec2 p(x, y);
            auto& winner = isSet(p) ? cluster : hole;
            if (!winner || beats(p, *winner, isSet(p) ? 1 : -1))
                winner = p;
        }
        bestCluster_[std::size_t(y)] = cluster;
        bestVoid_[std::size_t(y)] = hole;
    }

    glm::ivec2 best(const std::vector<std::optional<glm::ivec2>>& ofRows, int sign) const {
        std::optional<glm::ivec2> winner;
        for (const auto& p : ofRows) {
            if (p && (!winner || beats(*p, *winner, sign)))
                winner = p;
        }
        return winner.value();
    }

    int edge_;
    std::vector<Weight> kernel_;
    std::vector<std::optional<glm::ivec2>> bestVoid_, bestCluster_; ///< one per row
    Image<std::uint8_t> isSet_;
    Image<std::int64_t> energy_;
    Image<std::uint32_t> priority_;
};

/// Returns a random pattern of `count` points, evened out: the tightest cluster's point moves to
/// the largest void until it would come back to where it was. That happens: every other move lowers
/// the energy of the whole pattern or, at equal energy, raises the sum of its priorities.
Pattern startPattern(int edge, int count, std::uint32_t seed) {
    Pattern pattern(edge, seed);
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < edge; ++y) {
        for (int x = 0; x < edge; ++x)
            pixels.emplace_back(x, y);
    }
    std::sort(pixels.begin(), pixels.end(), [&](glm::ivec2 a, glm::ivec2 b) {
        return scramble(pattern.priority(a)) < scramble(pattern.priority(b));
    });
    for (int i = 0; i < count; ++i)
        pattern.toggle(pixels[std::size_t(i)]);

    while (true) {
        const glm::ivec2 from = pattern.tightestCluster();
        pattern.toggle(from);
        const glm::ivec2 to = pattern.largestVoid();
        pattern.toggle(to);
        if (to == from)
            return pattern;
    }
}

} // namespace

Image<std::uint16_t> makeBlueNoise(int edge, std::uint32_t seed) {
    if (edge < 2 || edge > 256)
        throw std::logic_error("a blue-noise tile has an edge of 2 to 256 pixels, not " +
                               std::to_string(edge));
    const int pixels = edge * edge;
    const int start = std::max(1, pixels / kStartDivisor);
    const Pattern initial = startPattern(edge, start, seed);
    Image<std::uint16_t> ranks(glm::ivec2{edge});

    Pattern pattern = initial;
    for (int rank = start - 1; rank >= 0; --rank) {
        const glm::ivec2 p = pattern.tightestCluster();
        pattern.toggle(p);
        ranks(p) = std::uint16_t(rank);
    }
    pattern = initial;
    for (int rank = start; rank < pixels; ++rank) {
        const glm::ivec2 p = pattern.largestVoid();
        pattern.toggle(p);
        ranks(p) = std::uint16_t(rank);
    }
    return ranks;
}

Image<std::uint16_t> spreadRanks(const Image<std::uint16_t>& ranks) {
    const std::size_t count = ranks.pixels().size();
    if (count == 0 || 65536 % count != 0)
        throw std::logic_error("the ranks of " + std::to_string(count) +
                               " pixels do not spread evenly over 16 bits");
    Image<std::uint16_t> values(ranks.size());
    std::transform(
        ranks.pixels().begin(), ranks.pixels().end(), values.pixels().begin(),
        [&](std::uint16_t rank) { return std::uint16_t(std::size_t(rank) * (65536 / count)); });
    return values;
}

std::string writePgm16(const Image<std::uint16_t>& image) {
    std::string bytes = "P5\n" + std::to_string(image.size().x) + " " +
                        std::to_string(image.size().y) + "\n65535\n";
    for (const std::uint16_t value : image.pixels()) {
        bytes.push_back(char(value >> 8));
        bytes.push_back(char(value & 0xff));
    }
    return bytes;
}

} // namespace afterglow
