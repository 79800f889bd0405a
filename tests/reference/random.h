// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "renderer/image/image.h"

// Seeds and the numbers that follow from them: docs/pipeline.md, "Seeds and random numbers".

namespace afterglow::reference {

inline std::uint32_t mixBits(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}
inline std::uint32_t hash2(std::uint32_t a, std::uint32_t b) {
    return mixBits(a ^ mixBits(b + 0x9e3779b9u));
}
inline std::uint32_t hash3(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return hash2(a, hash2(b, c));
}

struct Seed {
    glm::uvec2 tile;     ///< in [0, 128)
    std::uint32_t frame; ///< modulo 2^18
};
inline Seed unpackSeed(std::uint32_t bits) {
    return {{bits % 128u, bits / 128u % 128u}, bits / (128u * 128u)};
}
inline std::uint32_t packSeed(glm::ivec2 pixel, std::uint32_t frame) {
    return std::uint32_t(pixel.x) % 128u | (std::uint32_t(pixel.y) % 128u) << 7 |
           (frame % (1u << 18)) << 14;
}

/// The digits of i in a base, mirrored at the point: one division of whole numbers.
inline double radicalInverse(std::uint32_t i, std::uint32_t base) {
    std::uint64_t mirrored = 0, denominator = 1;
    for (; i > 0; i /= base) {
        mirrored = mirrored * base + i % base;
        denominator *= base;
    }
    return double(mirrored) / double(denominator);
}

/// A portable graymap of two bytes a pixel, most significant byte first, as stored.
inline Image<std::uint16_t> readTile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string magic;
    int width = 0, height = 0, most = 0;
    file >> magic >> width >> height >> most;
    file.get();
    if (!file || magic != "P5" || width != 128 || height != 128 || most != 65535)
        throw std::runtime_error("no tile of 128 x 128 in " + path.string());
    Image<std::uint16_t> tile({width, height});
    for (std::uint16_t& pixel : tile.pixels()) {
        const int high = file.get();
        pixel = std::uint16_t(high * 256 + file.get());
    }
    if (!file)
        throw std::runtime_error("the tile ends early: " + path.string());
    return tile;
}

/// The numbers of one run.
class Random {
public:
    Random(Image<std::uint16_t> tile, std::uint32_t runSeed)
        : tile_(std::move(tile)), runSeed_(runSeed) {}

    /// Before the whole part is taken off; in [0, 3).
    double sum(const Seed& seed, std::uint32_t dimension) const {
        constexpr std::uint32_t kBases[] = {2, 3, 5, 7, 11, 13, 2, 3, 5};
        const std::uint32_t shift = hash2(runSeed_, dimension);
        const glm::ivec2 place((seed.tile.x + shift) % 128u, (seed.tile.y + (shift >> 7)) % 128u);
        return double(tile_(place)) / 65536.0 + 1.0 / 32768.0 +
               radicalInverse(seed.frame, kBases[dimension]) +
               double(mixBits(shift) >> 8) / 16777216.0;
    }
    double number(const Seed& seed, std::uint32_t dimension) const {
        const double value = sum(seed, dimension);
        return std::min(value - std::floor(value), 1.0 - 1.0 / 16777216.0);
    }
    /// How far the number is from the place where it jumps from 1 to 0.
    double distanceToWrap(const Seed& seed, std::uint32_t dimension) const {
        const double value = sum(seed, dimension);
        return std::abs(value - std::round(value));
    }

private:
    Image<std::uint16_t> tile_;
    std::uint32_t runSeed_;
};

} // namespace afterglow::reference
