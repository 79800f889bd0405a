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

TEST_CASE("flicker is the mean over pixels of the deviation over time") {
    // Pixel 0 alternates by 0.25 about 1000, pixel 1 stands still.
    std::vector<Image<float>> frames;
    for (int i = 0; i < 16; ++i) {
        Image<float> frame({2, 1}, 7.0f);
        frame({0, 0}) = i % 2 ? 1000.25f : 999.75f; // exact in fp32
        frames.push_back(frame);
    }
    CHECK(flicker(frames) == Approx(0.125).epsilon(1e-12));
    Mask mask({2, 1}, 1);
    mask({1, 0}) = 0;
    CHECK(flicker(frames, &mask) == Approx(0.25).epsilon(1e-12));
    frames.resize(1);
    CHECK(flicker(frames) == 0.0);
}

TEST_CASE("comparing what cannot be compared is our mistake") {
    const Image<float> a({4, 4}), b({4, 5});
    const Mask none({4, 4}, 0), other({3, 3}, 1);
    CHECK_THROWS_AS(rmse(a, b), std::logic_error);
    CHECK_THROWS_AS(relMse(a, a, &other), std::logic_error);
    CHECK_THROWS_AS(psnr(a, a, 1.0, &none), std::logic_error);
    CHECK_THROWS_AS(flicker({}), std::logic_error);
    CHECK_THROWS_AS(flicker({a, b}), std::logic_error);
}
