// SPDX-License-Identifier: MIT
#include "renderer/image/flip.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/image/ssim.h"

#include "tests/support/compare.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

// Every metric against metrics_oracle.py: scikit-image, FFmpeg, and formulas written a second time.

namespace {

/// A number in [0, 1) that seems random (the finalizer of MurmurHash3).
double hashed(int x, int y, int salt) {
    std::uint32_t h = std::uint32_t(x) * 0x9e3779b1u ^ std::uint32_t(y) * 0x85ebca77u ^
                      std::uint32_t(salt) * 0xc2b2ae3du;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return double(h ^ (h >> 16)) / 4294967296.0;
}

using Picture = std::function<glm::dvec3(int x, int y)>; ///< display values, clamped to [0, 1]

Image<glm::u8vec4> painted(glm::ivec2 size, const Picture& picture) {
    Image<glm::u8vec4> image(size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 color = glm::clamp(picture(x, y), 0.0, 1.0);
            const double alpha = hashed(x, y, 99); // no metric may look at it
            image({x, y}) = glm::u8vec4(glm::dvec4(color, alpha) * 255.0 + 0.5);
        }
    }
    return image;
}

glm::dvec3 noise(int x, int y, int salt) {
    return {hashed(x, y, salt), hashed(x, y, salt + 1), hashed(x, y, salt + 2)};
}

/// A smooth texture of waves, in every color.
glm::dvec3 waves(double x, double y) {
    return 0.5 + 0.5 * glm::dvec3(std::sin(0.9 * x + 0.2 * y), std::sin(0.7 * y - 0.1 * x),
                                  std::sin(0.05 * x * y));
}

/// Discs and stripes with hard edges, black, white and saturated.
glm::dvec3 shapes(int x, int y) {
    const double radius = glm::length(glm::dvec2(x - 30, y - 20));
    if (radius < 12.0)
        return {1.0, radius < 6.0 ? 1.0 : 0.0, 0.0};
    return (x / 3 + y / 7) % 2 ? glm::dvec3(1.0) : glm::dvec3(0.0, 0.0, y > 20 ? 1.0 : 0.0);
}

glm::dvec3 corner(int x, int y, int salt) {
    return glm::round(noise(x / 9, y / 9, salt));
}

struct Pair {
    std::string name;
    double pixelsPerDegree;
    Image<glm::u8vec4> image, reference;
    Mask mask;
};

Mask hashedMask(glm::ivec2 size) {
    Mask mask(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            mask({x, y}) = 2 * x < size.x + 1 && hashed(x, y, 7) < 0.7;
    mask((size - 1) / 2) = 255;
    return mask;
}

std::vector<Pair> pairs() {
    std::vector<Pair> result;
    const auto add = [&](const char* name, glm::ivec2 size, const Picture& image,
                         const Picture& reference, double density = Flip::kPixelsPerDegree) {
        result.push_back(
            {name, density, painted(size, image), painted(size, reference), hashedMask(size)});
    };
    const Picture gradient = [](int x, int y) { return glm::dvec3(x, y, 90 - x - y) / 90.0; };
    const Picture noisy = [](int x, int y) { return waves(x, y) + 0.5 * noise(x, y, 1) - 0.25; };
    const Picture blurred = [](int x, int y) {
        glm::dvec3 sum(0.0);
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i)
                sum += shapes(x + i, y + j) / 25.0;
        return sum;
    };
    const auto shifted = [](int x, int y) { return shapes(x + 1, y); };
    add(
        "noise", {61, 37}, [](int x, int y) { return noise(x, y, 1); },
        [](int x, int y) { return noise(x, y, 11); });
    add("noise_on_waves", {64, 48}, noisy, [](int x, int y) { return waves(x, y); });
    add(
        "gradient_off", {53, 41}, [&](int x, int y) { return 0.9 * gradient(x, y) + 0.04; },
        gradient);
    add(
        "gradient_faint", {53, 41},
        [&](int x, int y) { return gradient(x, y) + (noise(x, y, 3) - 0.5) / 100.0; }, gradient);
    add("blur", {61, 43}, blurred, shapes);
    add("edges", {61, 43}, shifted, shapes);
    add("edges_far_away", {47, 39}, shifted, shapes, 120.5);
    add("edges_near", {47, 39}, shifted, shapes, 23.0);
    add(
        "corners", {45, 36}, [](int x, int y) { return corner(x, y, 1); },
        [](int x, int y) { return corner(x, y, 4); });
    add("equal", {19, 13}, shapes, shapes);
    for (const glm::ivec2 size : {glm::ivec2(11, 11), {12, 10}, {7, 5}, {3, 40}, {1, 17}, {1, 1}}) {
        const std::string name = "small_" + std::to_string(size.x) + "x" + std::to_string(size.y);
        add(name.c_str(), size, noisy, [](int x, int y) { return waves(x, y); });
    }
    return result;
}

struct Sequences {
    std::string name;
    std::vector<Image<glm::vec4>> image, reference;
    Mask mask;
};

/// Linear light over six decades, which moves, and an image of it with noise.
Sequences sequences(const char* name, glm::ivec2 size, int frames) {
    Sequences result{.name = name, .image = {}, .reference = {}, .mask = hashedMask(size)};
    for (int i = 0; i < frames; ++i) {
        Image<glm::vec4> image(size), reference(size);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const double power = std::pow(10.0, 6.0 * hashed(x, y, 50) - 3.0);
                const glm::dvec3 light = power * (0.1 + waves(x + 0.3 * i, y));
                reference({x, y}) = glm::vec4(light, 1.0);
                image({x, y}) = glm::vec4(light * (0.5 + noise(x, y, 60 + 3 * i)), hashed(x, y, i));
            }
        }
        result.image.push_back(image);
        result.reference.push_back(reference);
    }
    return result;
}

Image<glm::u8vec4> pictureOf(const Mask& mask) {
    Image<glm::u8vec4> image(mask.size());
    for (std::size_t i = 0; i < mask.pixels().size(); ++i)
        image.pixels()[i] = glm::u8vec4(mask.pixels()[i], 0, 0, 255);
    return image;
}

class Oracle {
public:
    Oracle(const std::vector<Pair>& pairs, const std::vector<Sequences>& moving) {
        std::ostringstream pairList, movingList;
        pairList.precision(17);
        for (const Pair& pair : pairs) {
            writePng(folder_ / (pair.name + ".image.png"), pair.image);
            writePng(folder_ / (pair.name + ".reference.png"), pair.reference);
            writePng(folder_ / (pair.name + ".mask.png"), pictureOf(pair.mask));
            pairList << pair.name << ' ' << pair.pixelsPerDegree << '\n';
        }
        for (const Sequences& one : moving) {
            writePng(folder_ / (one.name + ".mask.png"), pictureOf(one.mask));
            movingList << one.name << ' ' << one.image.size() << '\n';
            for (std::size_t i = 0; i < one.image.size(); ++i) {
                const std::string frame = "." + std::to_string(i) + ".pfm";
                writePfm(folder_ / (one.name + ".image" + frame), one.image[i], 3);
                writePfm(folder_ / (one.name + ".reference" + frame), one.reference[i], 3);
            }
        }
        folder_.write("pairs.txt", pairList.str());
        folder_.write("sequences.txt", movingList.str());
        run();
    }

    double operator()(const std::string& name) const {
        const auto found = answers_.find(name);
        REQUIRE_MESSAGE(found != answers_.end(), "no answer to " << name);
        return found->second;
    }

    Image<double> map(const std::string& name, glm::ivec2 size) const {
        Image<double> result(size);
        std::ifstream file(folder_ / (name + ".f64"), std::ios::binary);
        const auto bytes = std::streamsize(result.pixels().size_bytes());
        file.read(reinterpret_cast<char*>(result.pixels().data()), bytes);
        REQUIRE(file.gcount() == bytes);
        return result;
    }

private:
    void run() {
        // Debian's python, whatever else is in the PATH, and nothing of the user's.
        const std::string log = (folder_ / "log.txt").string();
        const int status = std::system(("/usr/bin/python3 -I -B '" +
                                        (sourceDir() / "tests/oracle/metrics_oracle.py").string() +
                                        "' '" + folder_.path().string() + "' >'" + log + "' 2>&1")
                                           .c_str());
        std::ostringstream said;
        said << std::ifstream(log).rdbuf();
        REQUIRE_MESSAGE(status == 0, said.str());
        std::ifstream file(folder_ / "answers.txt");
        for (std::string name, value; file >> name >> value;)
            answers_[name] = std::stod(value); // which reads "inf" as well
    }

    TemporaryFolder folder_;
    std::map<std::string, double> answers_;
};

/// How well one metric agrees with the oracle, over all that it is checked with.
class Agreement {
public:
    explicit Agreement(double tolerance) : tolerance_(tolerance) {}

    void check(double actual, double expected, const std::string& what) {
        const double difference = actual == expected ? 0.0 : std::abs(actual - expected);
        largest_ = std::max(largest_, difference);
        CHECK_MESSAGE(difference <= tolerance_,
                      what << ": " << actual << ", the oracle has " << expected);
    }
    void check(const Image<float>& actual, const Image<double>& expected, const std::string& what) {
        const Comparison comparison = compare(actual, expected, Tolerance{.max = tolerance_});
        largest_ = std::max(largest_, comparison.largest);
        CHECK_MESSAGE(comparison.close, what << ": " << comparison.report);
    }
    double largest() const { return largest_; }

private:
    double tolerance_;
    double largest_ = 0.0;
};

} // namespace

TEST_CASE("every metric agrees with an implementation that is not ours, or written a second time") {
    const std::vector<Pair> stills = pairs();
    const std::vector<Sequences> moving = {sequences("long", {23, 19}, 8),
                                           sequences("short", {31, 11}, 2)};
    const Oracle oracle(stills, moving);

    // All is in double precision on both sides, but our maps are stored as 32-bit floats.
    constexpr double kDouble = 1e-9, kFloatMap = 1e-7;
    Agreement psnrs(kDouble), ssims(kFloatMap), flips(kFloatMap), ssimMaps(kFloatMap),
        flipMaps(kFloatMap);
    Agreement ffmpeg(1e-6); // it prints six digits
    for (const auto& [name, pixelsPerDegree, image, reference, mask] : stills) {
        psnrs.check(psnr(image, reference), oracle(name + ".psnr"), name);
        psnrs.check(std::pow(10.0, -psnr(image, reference) / 10.0), oracle(name + ".mse"), name);
        psnrs.check(std::pow(10.0, -psnr(image, reference, &mask) / 10.0),
                    oracle(name + ".mse.masked"), name);
        ffmpeg.check(psnr(image, reference), oracle(name + ".psnr.ffmpeg"), name);

        const MeasuredImage similarity = ssim(image, reference);
        ssims.check(similarity.mean, oracle(name + ".ssim"), name);
        ssims.check(ssim(image, reference, &mask).mean, oracle(name + ".ssim.masked"), name);
        ssimMaps.check(similarity.map, oracle.map(name + ".ssim", image.size()), name);

        const Flip flip(reference, pixelsPerDegree);
        const MeasuredImage error = flip.compare(image);
        flips.check(error.mean, oracle(name + ".flip"), name);
        flips.check(flip.compare(image, &mask).mean, oracle(name + ".flip.masked"), name);
        flipMaps.check(error.map, oracle.map(name + ".flip", image.size()), name);
    }

    // Relative: the light is between 1e-4 and 1e3.
    Agreement ofLight(kDouble);
    for (const auto& [name, image, reference, mask] : moving) {
        Flicker flicker;
        for (const Image<glm::vec4>& frame : image)
            flicker.add(frame);
        const std::size_t last = image.size() - 1;
        const std::map<std::string, const Mask*> masks = {{"", nullptr}, {".masked", &mask}};
        for (const auto& [suffix, pixels] : masks) {
            const auto check = [&, suffix = suffix, name = name](double value, const char* metric) {
                const double expected = oracle(name + "." + metric + suffix);
                ofLight.check(value / expected, 1.0, name + " " + metric);
            };
            check(relMse(image[last], reference[last], pixels), "relmse");
            check(flicker.mean(pixels), "flicker");
            check(temporalError(image[last], image[last - 1], reference[last], reference[last - 1],
                                pixels),
                  "temporal");
        }
    }
    MESSAGE("largest differences: PSNR and MSE ", psnrs.largest(), " (FFmpeg ", ffmpeg.largest(),
            "), SSIM ", ssims.largest(), " (map ", ssimMaps.largest(), "), FLIP ", flips.largest(),
            " (map ", flipMaps.largest(), "), relMSE, flicker and temporal error ",
            ofLight.largest());
}
