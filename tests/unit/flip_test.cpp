// SPDX-License-Identifier: MIT
#include "renderer/image/flip.h"

#include "tests/support/compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using doctest::Approx;

namespace {

using Color = glm::u8vec4;
constexpr Color kBlack(0, 0, 0, 255), kWhite(255), kRed(255, 0, 0, 255), kGreen(0, 255, 0, 255),
    kBlue(0, 0, 255, 255);

/// HyAB of green and blue, the largest there is. L*, and a* and b* times L*/100, are (87.736,
/// -75.610, 72.981) and (32.298, 25.578, -34.836): 55.438 + sqrt(101.188^2 + 107.817^2).
constexpr double kLargest = 203.302;

/// What the color error is for a distance HyAB below, and above, the knee.
double belowKnee(double distance) {
    return 0.95 * std::pow(distance / kLargest, 0.7) / 0.4;
}
double aboveKnee(double distance) {
    return 0.95 + 0.05 * (std::pow(distance / kLargest, 0.7) - 0.4) / 0.6;
}

/// One color against another; nothing has edges.
double errorOf(Color image, Color reference) {
    const glm::ivec2 size(5, 4);
    return Flip(Image<Color>(size, reference)).compare(Image<Color>(size, image)).mean;
}

Image<Color> painted(glm::ivec2 size, const std::function<Color(int x, int y)>& paint) {
    Image<Color> image(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image({x, y}) = paint(x, y);
    return image;
}

/// Stripes and blocks without any symmetry.
Image<Color> pattern(glm::ivec2 size) {
    return painted(size, [](int x, int y) {
        return Color(37 * x + 11 * y, 20 * (x / 4) + y * y, (x * y * 7) % 256, 40 * x);
    });
}

Image<Color> turned(const Image<Color>& image) {
    return painted({image.size().y, image.size().x}, [&](int x, int y) { return image({y, x}); });
}

} // namespace

TEST_CASE("FLIP: equal images have no error, whatever their alpha") {
    const Image<Color> reference = pattern({31, 22});
    Image<Color> image = reference;
    for (Color& pixel : image.pixels())
        pixel.a = 0;
    const MeasuredImage error = Flip(reference).compare(image);
    CHECK(error.mean == 0.0);
    CHECK(std::ranges::all_of(error.map.pixels(), [](float e) { return e == 0.0f; }));
}

TEST_CASE("FLIP of two plain colors is the exponentiated distance of their Hunt-adjusted Lab") {
    const auto about = [](double value) { return Approx(value).epsilon(1e-5); }; // of five digits
    CHECK(errorOf(kGreen, kBlue) == about(1.0));
    CHECK(errorOf(kBlack, kWhite) == about(aboveKnee(100.0))); // L* alone, 0 and 100
    // Red is (53.237, 42.639, 35.775).
    CHECK(errorOf(kRed, kBlue) ==
          about(aboveKnee(53.237 - 32.298 + std::hypot(42.639 - 25.578, 35.775 + 34.836))));
    // sRGB 119 and 133 are 18.4 % and 23.5 % linear; L* is 116 Y^(1/3) - 16.
    const auto lightness = [](double encoded) {
        return 116.0 * std::cbrt(std::pow((encoded / 255.0 + 0.055) / 1.055, 2.4)) - 16.0;
    };
    CHECK(errorOf(Color(119, 119, 119, 255), Color(133, 133, 133, 255)) ==
          about(belowKnee(lightness(133.0) - lightness(119.0))));
}

TEST_CASE("FLIP: no two corners of the color cube are further apart than green and blue") {
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            const auto corner = [](int i) {
                return Color(i & 1 ? 255 : 0, i & 2 ? 255 : 0, i & 4 ? 255 : 0, 255);
            };
            const double error = errorOf(corner(a), corner(b));
            CHECK(error <= 1.0);
            CHECK((error == 0.0) == (a == b));
        }
    }
}

TEST_CASE("FLIP is symmetric, within [0, 1], and turns with the picture") {
    const Image<Color> a = pattern({33, 21});
    Image<Color> b = a;
    for (int y = 5; y < 15; ++y)
        for (int x = 8; x < 19; ++x)
            std::swap(b({x, y}).r, b({x, y}).g);
    const MeasuredImage error = Flip(a).compare(b), back = Flip(b).compare(a);
    CHECK(std::ranges::equal(error.map.pixels(), back.map.pixels()));
    CHECK(error.mean > 0.01);
    CHECK(std::ranges::all_of(error.map.pixels(), [](float e) { return e >= 0.0f && e <= 1.0f; }));

    const MeasuredImage sideways = Flip(turned(a)).compare(turned(b));
    Image<float> expected(sideways.map.size());
    for (int y = 0; y < expected.size().y; ++y)
        for (int x = 0; x < expected.size().x; ++x)
            expected({x, y}) = error.map({y, x});
    CHECK_CLOSE(sideways.map, expected, Tolerance{.max = 1e-6}); // columns first rounds otherwise
}

TEST_CASE("FLIP grows with contrast") {
    const glm::ivec2 size(40, 30);
    const Flip flip{Image<Color>(size, Color(100, 100, 100, 255))};
    double before = 0.0;
    for (const int contrast : {1, 2, 5, 15, 40, 90}) {
        const double error =
            flip.compare(painted(size,
                                 [&](int x, int y) {
                                     const int gray = 100 + ((x / 4 + y / 4) % 2 ? contrast : 0);
                                     return Color(gray, gray, gray, 255);
                                 }))
                .mean;
        CHECK(error > before);
        before = error;
    }
}

TEST_CASE("FLIP: from afar, or on a finer display, a fine pattern fades") {
    // A checkerboard of pixels against the gray that emits as much light: sRGB 188.
    const glm::ivec2 size(60, 60);
    const Image<Color> board =
        painted(size, [](int x, int y) { return (x + y) % 2 ? kWhite : kBlack; });
    const Image<Color> gray(size, Color(188, 188, 188, 255));
    const auto errorInTheMiddle = [&](double pixelsPerDegree) {
        Mask middle(size, 0);
        middle({30, 30}) = middle({31, 30}) = 1; // a white and a black one, far from the border
        return Flip(gray, pixelsPerDegree).compare(board, &middle).mean;
    };
    CHECK(errorInTheMiddle(10.0) > 0.9);
    CHECK(errorInTheMiddle(40.0) < errorInTheMiddle(20.0));
    CHECK(errorInTheMiddle(80.0) < errorInTheMiddle(40.0));
    CHECK(errorInTheMiddle(200.0) < 0.02); // 188 is not quite half the light
    CHECK(Flip::kPixelsPerDegree == Approx(67.0206).epsilon(1e-6));
}

TEST_CASE("FLIP: a lone difference stays within the reach of the filters") {
    // At 67 pixels per degree the color filters reach 10 pixels, those of the features 9.
    const glm::ivec2 size(61, 47), dot(30, 20);
    const Image<Color> reference(size, Color(90, 90, 90, 255));
    Image<Color> image = reference;
    image(dot) = kWhite;
    const Image<float> error = Flip(reference).compare(image).map;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 away = glm::abs(glm::ivec2(x, y) - dot);
            if (std::max(away.x, away.y) > 10)
                CHECK(error({x, y}) < 1e-6f); // rounding, raised to the power of 0.7
            CHECK(error({x, y}) <= error(dot));
        }
    }
}

TEST_CASE("FLIP: one reference serves many images, and a mask chooses what counts in the mean") {
    const Image<Color> reference = pattern({25, 14});
    Image<Color> image = reference;
    image({3, 3}) = kWhite;
    const Flip flip(reference);
    const MeasuredImage error = flip.compare(image);
    CHECK(flip.compare(reference).mean == 0.0);
    CHECK(flip.compare(image).mean == error.mean);

    Mask mask(image.size(), 0);
    mask({3, 3}) = mask({4, 3}) = 1;
    CHECK(flip.compare(image, &mask).mean ==
          Approx((double(error.map({3, 3})) + double(error.map({4, 3}))) / 2.0).epsilon(1e-12));
    mask = Mask(image.size(), 0);
    mask({24, 13}) = 1;
    CHECK(flip.compare(image, &mask).mean < 1e-6);
}

TEST_CASE("FLIP: a single pixel is a plain color, and what cannot be compared is our mistake") {
    const Image<Color> one({1, 1}, kWhite), two({1, 2}, kWhite), none;
    CHECK(Flip(Image<Color>({1, 1}, kBlack)).compare(one).mean ==
          Approx(errorOf(kWhite, kBlack)).epsilon(1e-7));
    CHECK_THROWS_AS(Flip{none}, std::logic_error);
    CHECK_THROWS_AS(Flip(Image<Color>({0, 3})), std::logic_error);
    CHECK_THROWS_AS(Flip(one).compare(two), std::logic_error);
    CHECK_THROWS_AS(Flip(one, 0.5), std::logic_error);
    CHECK_THROWS_AS(Flip(one, std::nan("")), std::logic_error);
    const Mask nothing({1, 1}, 0), other({2, 1}, 1);
    CHECK_THROWS_AS(Flip(one).compare(one, &nothing), std::logic_error);
    CHECK_THROWS_AS(Flip(one).compare(one, &other), std::logic_error);
}
