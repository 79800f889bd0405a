// SPDX-License-Identifier: MIT
#include "renderer/image/metrics.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using doctest::Approx;

namespace {

/// A picture in which every value differs: 7 x 5 pixels in (0, 1).
Image<glm::vec4> gradient() {
    Image<glm::vec4> image({7, 5});
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x)
            image({x, y}) = {0.1f + 0.1f * float(x), 0.2f + 0.1f * float(y), 0.5f, float(x * y)};
    }
    return image;
}

Image<glm::vec4> scaled(Image<glm::vec4> image, float factor) {
    for (glm::vec4& pixel : image.pixels())
        pixel *= factor;
    return image;
}

} // namespace

TEST_CASE("a constant error is its own RMSE") {
    Image<glm::vec4> image = gradient();
    for (glm::vec4& pixel : image.pixels())
        pixel += glm::vec4(0.25f, -0.25f, 0.25f, 9.0f);           // alpha does not count
    CHECK(rmse(image, gradient()) == Approx(0.25).epsilon(1e-6)); // fp32 pixels
    CHECK(rmse(gradient(), image) == Approx(0.25).epsilon(1e-6));
    CHECK(rmse(gradient(), gradient()) == 0.0);
}

TEST_CASE("RMSE averages squares over pixels and channels") {
    const Image<glm::vec4> reference({2, 3}, glm::vec4(1.0f));
    Image<glm::vec4> image = reference;
    image({1, 2}).g = 4.0f; // one of 18 values is wrong by 3
    CHECK(rmse(image, reference) == Approx(3.0 / std::sqrt(18.0)).epsilon(1e-12));

    // The same error, seen in luminance: one of 6 pixels, times the weight of green.
    CHECK(rmse(luminanceOf(image), luminanceOf(reference)) ==
          Approx(3.0 * 0.7152 / std::sqrt(6.0)).epsilon(1e-6));
}

TEST_CASE("relMSE of an image that is off by a factor has a closed form") {
    // x = (1 + d) r with constant r: d^2 r^2 / (r^2 + 0.01 r^2) = d^2 / 1.01, at every exposure.
    for (const float level : {1e-3f, 1.0f, 300.0f}) {
        const Image<float> reference({6, 4}, level), image({6, 4}, 1.5f * level);
        CHECK(relMse(image, reference) == Approx(0.25 / 1.01).epsilon(1e-6));
    }

    // Two levels, 1 and 3, half each: the mean square is 5, the floor 0.05.
    Image<float> reference({2, 1}), image({2, 1});
    reference({0, 0}) = 1.0f;
    reference({1, 0}) = 3.0f;
    image({0, 0}) = 1.5f;
    image({1, 0}) = 5.0f;
    CHECK(relMse(image, reference) == Approx((0.25 / 1.05 + 4.0 / 9.05) / 2.0).epsilon(1e-12));
}

TEST_CASE("relMSE does not depend on exposure; RMSE is proportional to it") {
    Image<glm::vec4> image = gradient();
    image({3, 3}).r += 0.2f;
    image({6, 0}).b -= 0.4f;
    const double relative = relMse(image, gradient()), absolute = rmse(image, gradient());
    CHECK(relative > 0.0);
    CHECK(relMse(scaled(image, 64.0f), scaled(gradient(), 64.0f)) ==
          Approx(relative).epsilon(1e-12)); // a power of two: exact
    CHECK(rmse(scaled(image, 64.0f), scaled(gradient(), 64.0f)) ==
          Approx(64.0 * absolute).epsilon(1e-12));
}

TEST_CASE("against a black reference relMSE is 0 or infinite") {
    const Image<float> black({3, 3}, 0.0f), gray({3, 3}, 0.1f);
    CHECK(relMse(black, black) == 0.0);
    CHECK(std::isinf(relMse(gray, black)));
}

TEST_CASE("a tenth of the peak is 20 dB, and a larger peak adds its own") {
    const Image<float> reference({8, 8}, 0.5f), image({8, 8}, 0.6f);
    CHECK(psnr(image, reference) == Approx(20.0).epsilon(1e-6));
    CHECK(psnr(image, reference, 10.0) == Approx(40.0).epsilon(1e-6));
    CHECK(std::isinf(psnr(reference, reference)));
}

TEST_CASE("what a mask leaves out changes nothing") {
    Image<glm::vec4> image = gradient();
    Mask mask(image.size(), 1);
    image({2, 2}) += glm::vec4(0.3f);
    image({4, 1}).r += 0.5f;
    mask({4, 1}) = 0;
    CHECK(countOf(mask) == 34);
    const double expected = std::sqrt(3.0 * 0.3 * 0.3 / (34.0 * 3.0));
    CHECK(rmse(image, gradient(), &mask) == Approx(expected).epsilon(1e-6));
    CHECK(psnr(image, gradient(), 1.0, &mask) ==
          Approx(-20.0 * std::log10(expected)).epsilon(1e-6));

    // In the floor of relMSE as well, and even if it is not a number.
    const double before = relMse(image, gradient(), &mask);
    Image<glm::vec4> reference = gradient();
    image({4, 1}) = glm::vec4(std::numeric_limits<float>::quiet_NaN());
    reference({4, 1}) = glm::vec4(1e6f);
    CHECK(relMse(image, reference, &mask) == before);
    CHECK(std::isnan(rmse(image, reference)));
}

TEST_CASE("luminance has the weights of Rec. 709") {
    Image<glm::vec4> image({4, 1});
    image({0, 0}) = {1, 0, 0, 5};
    image({1, 0}) = {0, 1, 0, 5};
    image({2, 0}) = {0, 0, 1, 5};
    image({3, 0}) = {2, 2, 2, 5};
    const Image<float> l = luminanceOf(image);
    CHECK(l({0, 0}) == 0.2126f);
    CHECK(l({1, 0}) == 0.7152f);
    CHECK(l({2, 0}) == 0.0722f);
    CHECK(l({3, 0}) == Approx(2.0).epsilon(1e-6));
}

TEST_CASE("PSNR of display pixels has a peak of 255") {
    using Color = glm::u8vec4;
    const Image<Color> reference({4, 3}, Color(200, 100, 50, 7));
    Image<Color> image({4, 3}, Color(149, 151, 101, 99)); // off by 51, a fifth of the peak
    CHECK(psnr(image, reference) == Approx(20.0 * std::log10(5.0)).epsilon(1e-12));
    image({0, 0}) = Color(255);
    Mask mask(image.size(), 1);
    mask({0, 0}) = 0;
    CHECK(psnr(image, reference, &mask) == Approx(20.0 * std::log10(5.0)).epsilon(1e-12));
    CHECK(std::isinf(psnr(reference, reference)));
}

TEST_CASE("the mean of a map counts what its mask does") {
    Image<float> map({3, 1});
    map({0, 0}) = 0.5f;
    map({1, 0}) = 1.0f;
    map({2, 0}) = 4.5f;
    CHECK(meanOf(map) == 2.0);
    Mask mask(map.size(), 255);
    mask({2, 0}) = 0;
    CHECK(meanOf(map, &mask) == 0.75);
}

TEST_CASE("a constant error does not move; one that comes and goes does") {
    const Image<glm::vec4> before = gradient(), now = scaled(gradient(), 2.0f);
    Image<glm::vec4> imageBefore = before, imageNow = now;
    for (std::size_t i = 0; i < before.pixels().size(); ++i) {
        imageBefore.pixels()[i] += glm::vec4(0.5f, -0.25f, 0.125f, 3.0f);
        imageNow.pixels()[i] += glm::vec4(0.5f, -0.25f, 0.125f, -8.0f); // alpha does not count
    }
    CHECK(temporalError(imageNow, imageBefore, now, before) < 1e-6); // fp32 pixels
    CHECK(temporalError(now, before, now, before) == 0.0);

    // The reference changes and the image does not: the error is all of the change.
    CHECK(temporalError(before, before, now, before) == Approx(rmse(now, before)).epsilon(1e-12));
    // Of 105 values one gains 0.3 too much, and one 0.4.
    imageNow = now;
    imageNow({1, 2}).g += 0.3f;
    imageBefore = before;
    imageBefore({6, 4}).r -= 0.4f;
    CHECK(temporalError(imageNow, imageBefore, now, before) ==
          Approx(0.5 / std::sqrt(105.0)).epsilon(1e-6));
    Mask mask(now.size(), 1);
    mask({6, 4}) = 0;
    CHECK(temporalError(imageNow, imageBefore, now, before, &mask) ==
          Approx(0.3 / std::sqrt(102.0)).epsilon(1e-6));
}

TEST_CASE("flicker is the mean over pixels and channels of the deviation over time") {
    // In pixel 0, red alternates by 0.25 about 1000 and green by 0.5 about 2; all else stands
    // still.
    Flicker flicker;
    for (int i = 0; i < 16; ++i) {
        Image<glm::vec4> frame({2, 1}, glm::vec4(7.0f, 7.0f, 7.0f, float(i)));
        frame({0, 0}).r = i % 2 ? 1000.25f : 999.75f; // exact in fp32
        frame({0, 0}).g = i % 2 ? 1.5f : 2.5f;
        flicker.add(frame);
        if (i == 0)
            CHECK(flicker.mean() == 0.0);
    }
    CHECK(flicker.frames() == 16);
    CHECK(flicker.mean() == Approx(0.75 / 6.0).epsilon(1e-12));
    Mask mask({2, 1}, 1);
    mask({1, 0}) = 0;
    CHECK(flicker.mean(&mask) == Approx(0.75 / 3.0).epsilon(1e-12));
}

TEST_CASE("comparing what cannot be compared is our mistake") {
    const Image<float> a({4, 4}), b({4, 5});
    const Mask none({4, 4}, 0), other({3, 3}, 1);
    CHECK_THROWS_AS(rmse(a, b), std::logic_error);
    CHECK_THROWS_AS(relMse(a, a, &other), std::logic_error);
    CHECK_THROWS_AS(psnr(a, a, 1.0, &none), std::logic_error);
    CHECK_THROWS_AS(meanOf(a, &none), std::logic_error);
    CHECK_THROWS_AS(meanOf(a, &other), std::logic_error);

    const Image<glm::vec4> c({4, 4}), d({5, 4});
    CHECK_THROWS_AS(temporalError(c, c, c, d), std::logic_error);
    CHECK_THROWS_AS(temporalError(c, d, c, c), std::logic_error);
    CHECK_THROWS_AS(temporalError(c, c, c, c, &none), std::logic_error);
    Flicker flickering;
    CHECK_THROWS_AS(flickering.mean(), std::logic_error);
    flickering.add(c);
    CHECK_THROWS_AS(flickering.add(d), std::logic_error);
    CHECK_THROWS_AS(flickering.mean(&other), std::logic_error);
}
