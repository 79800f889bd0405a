// SPDX-License-Identifier: MIT
#include "renderer/passes/probe_pass.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "tests/stage/mutants.h"
#include "tests/stage/stage_runner.h"
#include "tests/stage/upload.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// Sums of 16 values, then of 64 sums, in 32 bits. llvmpipe: 3e-7.
constexpr Tolerance kTolerance{.max = 1e-9, .relative = 2e-6};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kFar = std::numeric_limits<int>::max();

struct Rectangle {
    glm::ivec2 min, size;
};

struct Picture {
    Image<glm::vec4> filtered, raw, albedo, guides, control;

    explicit Picture(glm::ivec2 size, glm::vec4 value = glm::vec4(0.0f))
        : filtered(size, value), raw(size, value), albedo(size, value),
          guides(size, glm::vec4(0.0f, 0.0f, 1.0f, 3.0f)), control(size, value) {}
};

/// Noise on surfaces; where there is no surface, images hold what is not a number.
Picture randomPicture(glm::ivec2 size, std::uint32_t seed) {
    const RandomFrame frame(size, seed);
    Picture picture(size, glm::vec4(kNan));
    std::mt19937 engine(seed);
    const auto uniform = [&] { return float(engine() >> 8) * 0x1p-24f; };
    picture.guides = frame.guides;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 p{x, y};
            if (frame.guides(p).w == 0.0f)
                continue;
            picture.filtered(p) = frame.signal(p);
            picture.raw(p) = frame.raw(p);
            for (int i = 0; i < 4; ++i)
                picture.albedo(p)[i] = uniform();
            picture.control(p) = {0.3f * uniform(), uniform(), 1.0f + 40.0f * uniform(),
                                  float(engine() % 6)};
        }
    return picture;
}

/// `second`: another signal of the same surfaces.
ProbeReading probe(ProbePass& pass, const Picture& picture, const Rectangle& rectangle,
                   const Picture* second = nullptr) {
    struct Textures {
        explicit Textures(const Picture& p)
            : filtered(upload("filtered", p.filtered)), raw(upload("raw", p.raw)),
              albedo(upload("albedo", p.albedo)), guides(upload("guides", p.guides)),
              control(upload("control", p.control)) {}
        GpuTexture filtered, raw, albedo, guides, control;
    };
    const Textures t(picture);
    ProbePass::Inputs in{t.filtered, t.raw, t.albedo, t.guides, t.control};
    std::optional<Textures> other;
    if (second) {
        other.emplace(*second);
        in.other.emplace(ProbePass::OtherSignal{other->filtered, other->raw, other->albedo});
    }
    GpuTimer timer(true);
    FrameContext context{timer};
    pass.run(context, in, rectangle.min, rectangle.size);
    return pass.read();
}

ProbeReading probe(ShaderLibrary& shaders, const Picture& picture, const Rectangle& rectangle) {
    ProbePass pass(shaders);
    return probe(pass, picture, rectangle);
}

double luminanceOf(glm::dvec3 c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// By the definitions, in double precision, the variance in two passes.
ProbeReading reference(const Picture& picture, const Rectangle& rectangle) {
    const glm::ivec2 size = picture.raw.size();
    std::vector<double> luminances, lits;
    ProbeReading r;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 p{x, y};
            const glm::dvec2 from = glm::dvec2(p) - glm::dvec2(rectangle.min);
            const bool inside = from.x >= 0.0 && from.y >= 0.0 &&
                                from.x < double(rectangle.size.x) &&
                                from.y < double(rectangle.size.y);
            if (!inside || picture.guides(p).w == 0.0f)
                continue;
            const glm::dvec3 albedo(picture.albedo(p));
            ++r.pixels;
            r.lit += luminanceOf(albedo * glm::dvec3(picture.filtered(p)));
            r.variance += picture.filtered(p).a;
            r.lambda += picture.control(p).x;
            r.alpha += picture.control(p).y;
            r.history += picture.control(p).z;
            luminances.push_back(picture.raw(p).a);
            lits.push_back(luminanceOf(albedo * glm::dvec3(picture.raw(p))));
        }
    if (r.pixels == 0)
        return r;
    const double n = double(r.pixels);
    for (double* mean : {&r.lit, &r.variance, &r.lambda, &r.alpha, &r.history})
        *mean /= n;
    const auto meanAndVariance = [n](const std::vector<double>& values) {
        double mean = 0.0, variance = 0.0;
        for (const double value : values)
            mean += value / n;
        for (const double value : values)
            variance += (value - mean) * (value - mean) / n;
        return glm::dvec2(mean, variance);
    };
    r.rawVariance = meanAndVariance(luminances).y;
    r.rawLit = meanAndVariance(lits).x;
    r.rawLitVariance = meanAndVariance(lits).y;
    return r;
}

std::array<double, 9> numbersOf(const ProbeReading& r) {
    return {double(r.pixels), r.lit,   r.rawLit,  r.rawVariance,   r.variance,
            r.lambda,         r.alpha, r.history, r.rawLitVariance};
}

bool isNothing(const ProbeReading& r) {
    return std::ranges::all_of(numbersOf(r), [](double x) { return x == 0.0; });
}

std::vector<Rectangle> rectanglesOf(glm::ivec2 size) {
    return {{{0, 0}, size},
            {{-7, -3}, {30, 17}},
            {{size.x / 2, size.y / 3}, {1, 1}},
            {size - 1, {5, 5}},
            {{3, 0}, {2, kFar}},
            {{-kFar, -kFar}, {kFar, kFar}}, // ends just before the picture
            {{-4, -4}, {kFar, kFar}}};
}

} // namespace

TEST_CASE("a probe reads means and variances of its rectangle, at every size and place") {
    const GlCheck noGlMessages;
    double largest = 0.0;
    std::uint64_t pixels = 0;
    ProbePass pass(testShaders());
    for (const glm::ivec2 size : {glm::ivec2(61, 37), {1, 1}, {8, 8}, {130, 3}, {170, 101}})
        for (const std::uint32_t seed : {7u, 8u}) {
            const Picture picture = randomPicture(size, seed);
            for (const Rectangle& rectangle : rectanglesOf(size)) {
                CAPTURE(size.x);
                CAPTURE(size.y);
                CAPTURE(seed);
                CAPTURE(rectangle.min.x);
                CAPTURE(rectangle.size.x);
                const ProbeReading reading = probe(pass, picture, rectangle);
                const ProbeReading expected = reference(picture, rectangle);
                CHECK(reading.pixels == expected.pixels);
                CHECK_CLOSE(numbersOf(reading), numbersOf(expected), kTolerance);
                for (std::size_t i = 0; i < numbersOf(expected).size(); ++i)
                    if (const double x = numbersOf(expected)[i]; x != 0.0)
                        largest = std::max(largest, std::abs(numbersOf(reading)[i] / x - 1.0));
                pixels += expected.pixels;
            }
        }
    MESSAGE("largest relative difference: ", largest);
    CHECK(pixels > 10000);
}

TEST_CASE("a probe that sees no surface reads nothing") {
    const GlCheck noGlMessages;
    ProbePass pass(testShaders());
    CHECK(isNothing(pass.read()));
    Picture picture = randomPicture({61, 37}, 7);
    for (const Rectangle& rectangle : {Rectangle{{61, 0}, {5, 5}},
                                       {{-5, 2}, {5, 5}},
                                       {{3, 37}, {5, 5}},
                                       {{5, 5}, {0, 3}},
                                       {{5, 5}, {3, -1}},
                                       {{kFar, kFar}, {kFar, kFar}}}) {
        CAPTURE(rectangle.min.x);
        CAPTURE(rectangle.size.y);
        REQUIRE(!isNothing(probe(pass, picture, {{0, 0}, {61, 37}})));
        CHECK(isNothing(probe(pass, picture, rectangle)));
    }
    for (glm::vec4& guide : picture.guides.pixels())
        guide.w = 0.0f;
    CHECK(isNothing(probe(pass, picture, {{0, 0}, {61, 37}})));
}

TEST_CASE("a probe of a picture of one value reads that value, without variance") {
    const GlCheck noGlMessages;
    for (const glm::ivec2 size : {glm::ivec2(61, 37), {1, 1}}) {
        Picture picture(size);
        std::ranges::fill(picture.filtered.pixels(), glm::vec4(0.3f, 0.5f, 0.7f, 0.11f));
        std::ranges::fill(picture.raw.pixels(), glm::vec4(0.9f, 0.2f, 0.4f, 0.37f));
        std::ranges::fill(picture.albedo.pixels(), glm::vec4(0.5f, 0.25f, 1.0f, 9.0f));
        std::ranges::fill(picture.control.pixels(), glm::vec4(0.2f, 0.3f, 17.0f, 4.0f));
        const ProbeReading reading = probe(testShaders(), picture, {{0, 0}, size});
        CHECK(reading.pixels == std::uint64_t(size.x * size.y));
        const ProbeReading one{.pixels = reading.pixels,
                               .lit = 0.2126 * 0.15 + 0.7152 * 0.125 + 0.0722 * 0.7,
                               .rawLit = 0.2126 * 0.45 + 0.7152 * 0.05 + 0.0722 * 0.4,
                               .variance = 0.11,
                               .lambda = 0.2,
                               .alpha = 0.3,
                               .history = 17.0};
        CHECK_CLOSE(numbersOf(reading), numbersOf(one), kTolerance);
        CHECK(reading.rawVariance == 0.0);
        CHECK(reading.rawLitVariance == 0.0);
        CHECK(reading.history == 17.0); // whole numbers: every sum is exact
    }
}

TEST_CASE("the variance of a large value that hardly varies is exact where sums of squares fail") {
    const GlCheck noGlMessages;
    Picture picture({170, 101}, glm::vec4(0.5f));
    std::mt19937 engine(7);
    for (glm::vec4& pixel : picture.raw.pixels())
        pixel.a = 60.0f + float(engine() % 64) * 0x1p-14f;
    picture.raw({100, 50}).a = 60.125f; // one bright pixel among them
    const Rectangle all{{0, 0}, picture.raw.size()};
    const double expected = reference(picture, all).rawVariance;

    float sum = 0.0f, squares = 0.0f;
    for (const glm::vec4& pixel : picture.raw.pixels()) {
        sum += pixel.a;
        squares += pixel.a * pixel.a;
    }
    const float n = 170.0f * 101.0f;
    CHECK(std::abs((squares - sum * sum / n) / n - expected) > 10.0 * expected);

    const double measured = probe(testShaders(), picture, all).rawVariance;
    MESSAGE("relative error: ", std::abs(measured / expected - 1.0));
    CHECK(measured == doctest::Approx(expected).epsilon(2e-6));
}

TEST_CASE("what two halves hold comes to what the whole holds") {
    const GlCheck noGlMessages;
    const glm::ivec2 size{61, 37};
    const Picture picture = randomPicture(size, 9);
    const auto whole = probe(testShaders(), picture, {{0, 0}, size});
    for (const int cut : {1, 8, 29, 32, 60}) {
        CAPTURE(cut);
        const auto left = probe(testShaders(), picture, {{0, 0}, {cut, size.y}});
        const auto right = probe(testShaders(), picture, {{cut, 0}, size});
        CHECK(left.pixels + right.pixels == whole.pixels);
        const double share = double(left.pixels) / double(whole.pixels);
        const auto mean = [share](double a, double b) { return share * a + (1.0 - share) * b; };
        CHECK_CLOSE(mean(left.lit, right.lit), whole.lit, kTolerance);
        CHECK_CLOSE(mean(left.rawLit, right.rawLit), whole.rawLit, kTolerance);
        CHECK_CLOSE(mean(left.variance, right.variance), whole.variance, kTolerance);
        CHECK_CLOSE(mean(left.lambda, right.lambda), whole.lambda, kTolerance);
        CHECK_CLOSE(mean(left.alpha, right.alpha), whole.alpha, kTolerance);
        CHECK_CLOSE(mean(left.history, right.history), whole.history, kTolerance);
        // The variance within the halves, and that between them.
        const double apart = left.rawLit - right.rawLit;
        CHECK_CLOSE(mean(left.rawLitVariance, right.rawLitVariance) +
                        share * (1.0 - share) * apart * apart,
                    whole.rawLitVariance, kTolerance);
    }
}

TEST_CASE("a probe of the same picture reads the same bits, whatever it has read before") {
    const GlCheck noGlMessages;
    const glm::ivec2 size{170, 101};
    const Picture picture = randomPicture(size, 7), other = randomPicture(size, 8);
    const Rectangle rectangle{{11, 5}, {120, 90}};
    ProbePass pass(testShaders());
    const auto bits = [](const ProbeReading& r) {
        return std::bit_cast<std::array<std::uint64_t, 9>>(numbersOf(r));
    };
    const auto first = bits(probe(pass, picture, rectangle));
    for (int i = 0; i < 5; ++i) {
        CHECK(bits(probe(pass, other, {{0, 0}, size})) != first);
        CHECK(bits(probe(pass, picture, rectangle)) == first);
    }
}

TEST_CASE("a probe refuses images of different sizes") {
    ProbePass pass(testShaders());
    Picture picture({8, 8});
    picture.control = Image<glm::vec4>({8, 7});
    CHECK_THROWS_WITH_AS(probe(pass, picture, {{0, 0}, {8, 8}}),
                         "ProbePass: control is not of the size of filtered", std::logic_error);
}

TEST_CASE("of two signals a probe reads the picture, and the filter of one") {
    const GlCheck noGlMessages;
    Picture picture = randomPicture({61, 37}, 3);
    const Picture second = randomPicture({61, 37}, 4);
    for (std::size_t i = 0; i < picture.guides.pixels().size(); ++i) // the surfaces of both
        if (second.guides.pixels()[i].w == 0.0f)
            picture.guides.pixels()[i].w = 0.0f;
    const Rectangle rectangle{{7, 3}, {40, 30}};
    ProbePass pass(testShaders());
    const ProbeReading both = probe(pass, picture, rectangle, &second);
    const ProbeReading one = reference(picture, rectangle);
    Picture rest = second;
    rest.guides = picture.guides;
    const ProbeReading other = reference(rest, rectangle);
    CHECK(both.pixels == one.pixels);
    CHECK(both.lit == doctest::Approx(one.lit + other.lit).epsilon(1e-6));
    CHECK(both.rawLit == doctest::Approx(one.rawLit + other.rawLit).epsilon(1e-6));
    CHECK(both.lambda == doctest::Approx(one.lambda).epsilon(1e-6));
    CHECK(both.alpha == doctest::Approx(one.alpha).epsilon(1e-6));
    CHECK(both.variance == doctest::Approx(one.variance).epsilon(1e-6));
    CHECK(both.rawVariance == doctest::Approx(one.rawVariance).epsilon(1e-5));
    CHECK(both.rawLitVariance > 0.0);
    CHECK(other.lit > 0.1 * one.lit);
}

TEST_CASE("mistakes in the probe show") {
    const GlCheck noGlMessages;
    const glm::ivec2 size{170, 101};
    const Picture picture = randomPicture(size, 7);
    const std::string file = "post/probe.comp";
    checkMutants(
        [&](ShaderLibrary& shaders) {
            Verdict verdict;
            for (const Rectangle& rectangle : {Rectangle{{0, 0}, size}, {{11, 5}, {70, 40}}})
                verdict.add(numbersOf(probe(shaders, picture, rectangle)),
                            numbersOf(reference(picture, rectangle)));
            return verdict;
        },
        {{"background counts", file, "fetch(guides, inside).w == 0.0",
          "fetch(guides, inside).w == -1.0"},
         {"pixels beyond the rectangle count", file, "p != inside || ", ""},
         {"the rectangle begins at the corner", file, "params.first + block", "block"},
         {"the picture is shown without its albedo", file,
          "luminance(signal.rgb * surface + otherLit)", "luminance(signal.rgb)"},
         {"so is the raw one", file, "luminance(noisy.rgb * surface + otherNoise)",
          "luminance(noisy.rgb)"},
         {"the variance is the signal's red", file, "signal.a", "signal.r"},
         {"lambda is alpha", file, "driven.x", "driven.y"},
         {"alpha is lambda", file, "driven.yz", "driven.xz"},
         {"deviations between threads are forgotten", file,
          " + apart * apart * (a.count * b.count / count)", ""},
         {"deviations within threads are forgotten", file, "m.squares += before * (y - m.offset);",
          ""},
         {"the mean of a thread is its first pixel", file, "m.offset += before / m.count;", ""},
         {"anchors are not compared", file, "(b.anchor - a.anchor) + ", ""},
         {"half of the threads are lost", file, "left = kThreads", "left = kThreads / 2u"}});
}
