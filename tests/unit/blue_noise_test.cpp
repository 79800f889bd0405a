// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/image/pgm.h"
#include "tests/support/source_dir.h"
#include "tools/blue_noise/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

std::string shippedTile() {
    std::ifstream file(sourceDir() / "assets/noise/blue_noise_128.pgm", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool eachRankOnce(const Image<std::uint16_t>& tile) {
    std::vector<std::uint16_t> ranks(tile.pixels().begin(), tile.pixels().end());
    std::sort(ranks.begin(), ranks.end());
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        if (ranks[i] != i)
            return false;
    }
    return true;
}

/// The energy at a pixel, by the definition: the Gaussian of sigma 1.5 summed over all points of
/// rank below `end`, on the torus. Floating point, and no kernel that is cut off.
double energyAt(const Image<std::uint16_t>& tile, glm::ivec2 p, int end) {
    const int edge = tile.size().x;
    double sum = 0.0;
    for (int y = 0; y < edge; ++y) {
        for (int x = 0; x < edge; ++x) {
            if (tile({x, y}) >= end)
                continue;
            const int dx = std::min(std::abs(x - p.x), edge - std::abs(x - p.x));
            const int dy = std::min(std::abs(y - p.y), edge - std::abs(y - p.y));
            sum += std::exp(-(dx * dx + dy * dy) / (2.0 * 1.5 * 1.5));
        }
    }
    return sum;
}

struct Extremes {
    double mostOfSet = -1.0;    ///< the tightest cluster's energy
    double leastOfFree = 1e300; ///< the largest void's energy
};

Extremes extremesOf(const Image<std::uint16_t>& tile, int end) {
    Extremes e;
    for (int y = 0; y < tile.size().y; ++y) {
        for (int x = 0; x < tile.size().x; ++x) {
            const double energy = energyAt(tile, {x, y}, end);
            if (tile({x, y}) < end)
                e.mostOfSet = std::max(e.mostOfSet, energy);
            else
                e.leastOfFree = std::min(e.leastOfFree, energy);
        }
    }
    return e;
}

/// The mean power of a square image with its mean removed: over rings of the frequency's length,
/// and over eight sectors of its direction.
struct Spectrum {
    std::vector<double> rings;   ///< ring r: lengths in [r - 0.5, r + 0.5), cycles per tile
    std::vector<double> sectors; ///< of 22.5 degrees, frequencies up to the Nyquist length
    double mean = 0.0;           ///< over all frequencies but zero

    /// The strongest ring of those that are whole.
    int peak() const {
        const auto end = rings.begin() + std::ptrdiff_t(rings.size() / 2);
        return int(std::max_element(rings.begin(), end) - rings.begin());
    }

    /// The mean power below a quarter of the peak's frequency, relative to the mean of all.
    double lowShare(int peakRing) const {
        const int end = std::max(2, peakRing / 4);
        return std::accumulate(rings.begin() + 1, rings.begin() + end, 0.0) / (end - 1) / mean;
    }
};

Spectrum spectrumOf(const Image<double>& image) {
    const int n = image.size().x;
    using Complex = std::complex<double>;
    double average = 0.0;
    for (const double v : image.pixels())
        average += v / double(image.pixels().size());

    std::vector<Complex> turn;
    for (int i = 0; i < n; ++i)
        turn.push_back(std::polar(1.0, -2.0 * std::numbers::pi * i / n));
    Image<Complex> rows(image.size()), all(image.size());
    for (int y = 0; y < n; ++y) {
        for (int u = 0; u < n; ++u) {
            for (int x = 0; x < n; ++x)
                rows({u, y}) += (image({x, y}) - average) * turn[std::size_t(u * x % n)];
        }
    }
    for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) {
            for (int y = 0; y < n; ++y)
                all({u, v}) += rows({u, y}) * turn[std::size_t(v * y % n)];
        }
    }

    Spectrum s{std::vector<double>(std::size_t(n)), std::vector<double>(8), 0.0};
    std::vector<int> inRing(s.rings.size()), inSector(8);
    for (int v = -n / 2; v < n - n / 2; ++v) {
        for (int u = -n / 2; u < n - n / 2; ++u) {
            if (u == 0 && v == 0)
                continue;
            const double power = std::norm(all({(u + n) % n, (v + n) % n}));
            const double length = std::hypot(u, v);
            s.mean += power / (double(n) * n - 1.0);
            s.rings[std::size_t(length + 0.5)] += power;
            ++inRing[std::size_t(length + 0.5)];
            if (length < n / 2.0) {
                // A real image's spectrum is symmetric: directions in half a turn tell all.
                const double angle = std::atan2(v, u) + std::numbers::pi;
                const auto sector = std::size_t(angle / std::numbers::pi * 8.0) % 8;
                s.sectors[sector] += power;
                ++inSector[sector];
            }
        }
    }
    for (std::size_t i = 0; i < s.rings.size(); ++i)
        s.rings[i] /= std::max(inRing[i], 1);
    for (std::size_t i = 0; i < 8; ++i)
        s.sectors[i] /= inSector[i];
    return s;
}

template <class Value>
Image<double> mapped(const Image<std::uint16_t>& tile, Value value) {
    Image<double> image(tile.size());
    std::transform(tile.pixels().begin(), tile.pixels().end(), image.pixels().begin(), value);
    return image;
}

Image<std::uint16_t> whiteNoise(int edge) {
    Image<std::uint16_t> tile(glm::ivec2{edge});
    std::iota(tile.pixels().begin(), tile.pixels().end(), std::uint16_t(0));
    std::mt19937 random(7);
    for (std::size_t i = tile.pixels().size() - 1; i > 0; --i)
        std::swap(tile.pixels()[i], tile.pixels()[random() % (i + 1)]);
    return tile;
}

std::string refusal(std::string_view bytes) {
    try {
        readPgm16(bytes, "tile.pgm");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST_CASE("a blue-noise tile has each rank once, at any edge") {
    for (const int edge : {2, 3, 8, 17, 32, 64}) {
        CAPTURE(edge);
        CHECK(eachRankOnce(makeBlueNoise(edge, 5)));
    }
    CHECK_THROWS_AS(makeBlueNoise(1, 5), std::logic_error);
    CHECK_THROWS_AS(makeBlueNoise(257, 5), std::logic_error);
}

TEST_CASE("a tile depends on its seed and on nothing else") {
    const Image<std::uint16_t> a = makeBlueNoise(32, 1), b = makeBlueNoise(32, 1),
                               c = makeBlueNoise(32, 2);
    CHECK(std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin()));
    CHECK_FALSE(std::equal(a.pixels().begin(), a.pixels().end(), c.pixels().begin()));
}

TEST_CASE("every rank lies where the void-and-cluster method puts it") {
    // The three phases as laws of the finished tile, with energies summed from their definition.
    // Energies are rounded to 2^-48 and cut off beyond 13 pixels (a term of 6e-17): 1e-12 covers
    // the sum of both over all points.
    constexpr double kTolerance = 1e-12;
    for (const int edge : {16, 19}) {
        const Image<std::uint16_t> tile = makeBlueNoise(edge, 3);
        std::vector<glm::ivec2> at(tile.pixels().size());
        for (int y = 0; y < edge; ++y) {
            for (int x = 0; x < edge; ++x)
                at[tile({x, y})] = {x, y};
        }
        const int pixels = edge * edge, start = pixels / 10;
        int wrong = 0;
        for (int rank = 0; rank < pixels; ++rank) {
            if (rank < start) { // taken away as the tightest cluster of the ranks up to itself
                const double own = energyAt(tile, at[std::size_t(rank)], rank + 1);
                wrong += own < extremesOf(tile, rank + 1).mostOfSet - kTolerance;
            } else { // put into the largest void that the ranks below it leave
                const double own = energyAt(tile, at[std::size_t(rank)], rank);
                wrong += own > extremesOf(tile, rank).leastOfFree + kTolerance;
            }
        }
        CHECK(wrong == 0);

        // The start pattern is settled: its tightest cluster, the highest rank in it, would be put
        // back.
        const glm::ivec2 tightest = at[std::size_t(start - 1)];
        CHECK(energyAt(tile, tightest, start - 1) <=
              extremesOf(tile, start - 1).leastOfFree + kTolerance);
    }
}

TEST_CASE("a tile has almost no energy at low frequencies; white noise has its share") {
    const auto rank = [](std::uint16_t r) { return double(r); };
    const Spectrum blue = spectrumOf(mapped(makeBlueNoise(64, 1), rank));
    const Spectrum white = spectrumOf(mapped(whiteNoise(64), rank));
    const double blueLow = blue.lowShare(blue.peak()), whiteLow = white.lowShare(blue.peak());
    MESSAGE("peak at ring " << blue.peak()
                            << " of 32; low-frequency power relative to the mean: blue " << blueLow
                            << ", white " << whiteLow);
    CHECK(blue.peak() > 16);
    CHECK(blueLow < 0.02);
    CHECK(whiteLow > 0.5);
}

TEST_CASE("a tile prefers no direction") {
    // Ranks of equal count: a sector of 64 x 64 pixels holds some 400 frequencies, whose mean of
    // exponentially distributed powers strays by 5 percent; three times that is 15.
    const Spectrum s =
        spectrumOf(mapped(makeBlueNoise(64, 1), [](std::uint16_t r) { return double(r); }));
    const double mean = std::accumulate(s.sectors.begin(), s.sectors.end(), 0.0) / 8.0;
    for (const double sector : s.sectors)
        CHECK(sector / mean == doctest::Approx(1.0).epsilon(0.15));
}

TEST_CASE("the shipped tile is blue, and so are its lowest sixteenth, quarter and half") {
    const Image<std::uint16_t> tile = readPgm16(shippedTile(), "blue_noise_128.pgm");
    REQUIRE(tile.size() == glm::ivec2(128));
    const Image<std::uint16_t> white = spreadRanks(whiteNoise(128));
    const Spectrum whole = spectrumOf(mapped(tile, [](std::uint16_t v) { return double(v); }));
    CHECK(whole.lowShare(whole.peak()) < 0.01);
    for (const int parts : {16, 4, 2}) {
        CAPTURE(parts);
        const auto below = [&](std::uint16_t v) { return v < 65536 / parts ? 1.0 : 0.0; };
        const Spectrum s = spectrumOf(mapped(tile, below));
        const double low = s.lowShare(s.peak());
        const double whiteLow = spectrumOf(mapped(white, below)).lowShare(s.peak());
        MESSAGE("lowest 1/" << parts << ": peak at ring " << s.peak() << " of 64, low " << low
                            << ", white noise " << whiteLow);
        // Points as far apart as they can be peak near the square root of their number, as far as
        // the rings go.
        CHECK(s.peak() > 0.8 * std::min(128.0 / std::sqrt(double(parts)), 64.0));
        CHECK(low < 0.1);
        CHECK(whiteLow > 0.5);
    }
}

TEST_CASE("the shipped tile is what the generator makes") {
    CHECK(shippedTile() == writePgm16(spreadRanks(makeBlueNoise(128, 1))));
}

TEST_CASE("spread ranks are evenly spaced over 16 bits") {
    Image<std::uint16_t> ranks({2, 2});
    std::iota(ranks.pixels().begin(), ranks.pixels().end(), std::uint16_t(0));
    const Image<std::uint16_t> values = spreadRanks(ranks);
    CHECK(values({0, 0}) == 0);
    CHECK(values({1, 0}) == 16384);
    CHECK(values({1, 1}) == 49152);
    CHECK_THROWS_AS(spreadRanks(makeBlueNoise(3, 1)), std::logic_error);
}

TEST_CASE("a 16-bit PGM comes back as it was written") {
    Image<std::uint16_t> image({5, 3});
    std::uint16_t value = 0;
    for (std::uint16_t& pixel : image.pixels())
        pixel = value += 4369;
    const Image<std::uint16_t> back = readPgm16(writePgm16(image), "tile.pgm");
    CHECK(back.size() == image.size());
    CHECK(std::equal(back.pixels().begin(), back.pixels().end(), image.pixels().begin()));
}

TEST_CASE("a PGM header may have comments, and its bytes are most significant first") {
    const Image<std::uint16_t> image =
        readPgm16("P5 # made by hand\n1\t# width\n 1\n65535\n\x12\x34", "tile.pgm");
    CHECK(image({0, 0}) == 0x1234);
}

TEST_CASE("a malformed PGM names its fault") {
    CHECK(refusal("") == "tile.pgm: not a binary PGM: it does not begin with P5");
    CHECK(refusal("P2\n1 1\n65535\n7\n") ==
          "tile.pgm: not a binary PGM: it does not begin with P5");
    CHECK(refusal("P5\n") == "tile.pgm: the header has no width");
    CHECK(refusal("P5\n4 x") == "tile.pgm: the header has no height");
    CHECK(refusal("P5\n0 4\n65535\n") == "tile.pgm: the width is not between 1 and 16384");
    CHECK(refusal("P5\n4 99999999999999999999\n65535\n") ==
          "tile.pgm: the height is not between 1 and 16384");
    CHECK(refusal("P5\n1 1\n255\n\x7f") ==
          "tile.pgm: the greatest value is not between 256 and 65535");
    CHECK(refusal("P5\n1 1\n65535") == "tile.pgm: the header does not end in white space");
    CHECK(refusal("P5\n2 2\n65535\n1234567") ==
          "tile.pgm: has 7 bytes of pixels; 2 x 2 pixels need 8");
    CHECK(refusal("P5\n2 2\n65535\n123456789") ==
          "tile.pgm: has 9 bytes of pixels; 2 x 2 pixels need 8");
}
