// SPDX-License-Identifier: MIT
#include "renderer/image/ssim.h"

#include "tests/support/compare.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using doctest::Approx;

namespace {

using Color = glm::u8vec4;

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

Image<Color> brighter(Image<Color> image, int by) {
    for (Color& pixel : image.pixels())
        pixel = Color(glm::min(glm::ivec4(pixel) + by, 255));
    return image;
}

} // namespace

TEST_CASE("SSIM of equal images is 1, whatever their alpha") {
    const Image<Color> reference = pattern({31, 22});
    Image<Color> image = reference;
    for (Color& pixel : image.pixels())
        pixel.a = 0;
    const MeasuredImage similarity = ssim(image, reference);
    CHECK(similarity.mean == 1.0);
    CHECK(std::ranges::all_of(similarity.map.pixels(), [](float s) { return s == 1.0f; }));
}

TEST_CASE("SSIM of two plain colors compares their means alone") {
    const Image<Color> image({14, 12}, Color(51, 102, 255, 0));
    const Image<Color> reference({14, 12}, Color(153, 102, 0, 9));
    const double red = (2.0 * 0.2 * 0.6 + 1e-4) / (0.2 * 0.2 + 0.6 * 0.6 + 1e-4);
    const double green = 1.0, blue = 1e-4 / (1.0 + 1e-4);
    const MeasuredImage similarity = ssim(image, reference);
    CHECK(similarity.mean == Approx((red + green + blue) / 3.0).epsilon(1e-7)); // a map of floats
    CHECK(similarity.map({0, 0}) == Approx(similarity.mean).epsilon(1e-7)); // at the border as well
}

TEST_CASE("SSIM is symmetric, and turns with the picture") {
    const Image<Color> a = pattern({33, 21}), b = brighter(a, 60);
    const MeasuredImage similarity = ssim(a, b), back = ssim(b, a);
    CHECK(std::ranges::equal(similarity.map.pixels(), back.map.pixels()));
    CHECK(similarity.mean < 0.95);

    const auto turned = [](const Image<Color>& image) {
        return painted({image.size().y, image.size().x}, [&](int x, int y) {
            return image({y, x});
        });
    };
    const MeasuredImage sideways = ssim(turned(a), turned(b));
    Image<float> expected(sideways.map.size());
    for (int y = 0; y < expected.size().y; ++y)
        for (int x = 0; x < expected.size().x; ++x)
            expected({x, y}) = similarity.map({y, x});
    CHECK_CLOSE(sideways.map, expected, Tolerance{.max = 1e-6}); // columns first rounds otherwise
}

TEST_CASE("SSIM of a negative is negative, and it falls as contrast is lost") {
    const glm::ivec2 size(26, 23);
    const auto board = [&](int contrast) {
        return painted(size, [&](int x, int y) {
            const int gray = (x + y) % 2 ? 127 + contrast : 127 - contrast;
            return Color(gray, gray, gray, 255);
        });
    };
    const Image<Color> reference = board(100);
    // Windows of 61 pixels of one color and 60 of the other have nearly equal means. What is left
    // is 2 s t / (s^2 + t^2) of the deviations.
    CHECK(ssim(board(-100), reference).mean == Approx(-1.0).epsilon(0.02));
    CHECK(ssim(board(50), reference).mean == Approx(0.8).epsilon(0.01));
    CHECK(ssim(board(25), reference).mean == Approx(8.0 / 17.0).epsilon(0.01));
}

TEST_CASE("SSIM does not count where the window reaches over the border") {
    const glm::ivec2 size(17, 15);
    const Image<Color> reference = pattern(size);
    Image<Color> image = reference;
    image({2, 7}) = Color(0, 0, 0, 255);
    const MeasuredImage similarity = ssim(image, reference);
    CHECK(similarity.map({2, 7}) < 1.0f);
    double sum = 0.0;
    for (int y = 5; y < 10; ++y)
        for (int x = 5; x < 12; ++x)
            sum += double(similarity.map({x, y}));
    CHECK(similarity.mean == Approx(sum / 35.0).epsilon(1e-12));

    // A window of 11 pixels: the mean sees it in columns 5, 6 and 7, and no further.
    for (int y = 0; y < size.y; ++y)
        CHECK(similarity.map({8, y}) == 1.0f);
    CHECK(similarity.map({7, 7}) < 1.0f);
}

TEST_CASE(
    "SSIM: a mask leaves pixels out of the mean; near the border they count if no other does") {
    const Image<Color> reference = pattern({20, 16}), image = brighter(reference, 70);
    const Image<float> map = ssim(image, reference).map;
    Mask mask(image.size(), 0);
    mask({0, 0}) = 1;
    CHECK(ssim(image, reference, &mask).mean == Approx(double(map({0, 0}))).epsilon(1e-12));
    mask({6, 8}) = mask({12, 9}) = 1;
    CHECK(ssim(image, reference, &mask).mean ==
          Approx((double(map({6, 8})) + double(map({12, 9}))) / 2.0).epsilon(1e-12));
}

TEST_CASE("SSIM has a value between -1 and 1 for images of every small size") {
    for (int height = 1; height <= 12; ++height) {
        for (int width = 1; width <= 12; ++width) {
            const Image<Color> reference = pattern({width, height}), image = brighter(reference, 9);
            const double similarity = ssim(image, reference).mean;
            CHECK(similarity > -1.0);
            CHECK(similarity < 1.0);
            CHECK(ssim(reference, reference).mean == 1.0);
        }
    }
    // Of one pixel, the mean is all there is.
    const double value = 51.0 / 255.0, other = 60.0 / 255.0;
    CHECK(ssim(Image<Color>({1, 1}, Color(51)), Image<Color>({1, 1}, Color(60))).mean ==
          Approx((2.0 * value * other + 1e-4) / (value * value + other * other + 1e-4))
              .epsilon(1e-7));
}

TEST_CASE("SSIM of what cannot be compared is our mistake") {
    const Image<Color> a({12, 12}), b({12, 13}), none, line({0, 5});
    const Mask nothing({12, 12}, 0), other({3, 3}, 1);
    CHECK_THROWS_AS(ssim(a, b), std::logic_error);
    CHECK_THROWS_AS(ssim(a, a, &nothing), std::logic_error);
    CHECK_THROWS_AS(ssim(a, a, &other), std::logic_error);
    CHECK_THROWS_AS(ssim(none, none), std::logic_error);
    CHECK_THROWS_AS(ssim(line, line), std::logic_error);
}
