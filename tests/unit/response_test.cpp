// SPDX-License-Identifier: MIT
#include "app/measure/response.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using doctest::Approx;

namespace {

/// A lit floor whose light falls off to the right; `off` is what remains without it.
Image<glm::vec4> lit(glm::ivec2 size = {61, 37}) {
    Image<glm::vec4> image(size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            image({x, y}) = glm::vec4(0.1f + 2.0f / (1.0f + 0.05f * float(x * x + y)));
    }
    return image;
}

Image<glm::vec4> unlit() {
    return Image<glm::vec4>({61, 37}, glm::vec4(0.1f));
}

/// from + p (to - from)
Image<glm::vec4> blend(const Image<glm::vec4>& from, const Image<glm::vec4>& to, double p) {
    Image<glm::vec4> image(from.size());
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        image.pixels()[i] = glm::vec4(glm::dvec4(from.pixels()[i]) +
                                      p * glm::dvec4(to.pixels()[i] - from.pixels()[i]));
    return image;
}

/// The response of an exponential average with weight a: 1 - (1 - a)^(k + 1) after k frames.
std::vector<double> exponentialResponse(double a, int frames) {
    std::vector<double> p;
    for (int k = 0; k < frames; ++k)
        p.push_back(1.0 - std::pow(1.0 - a, k + 1));
    return p;
}

} // namespace

TEST_CASE(
    "the response of a blend of two references is its weight, dimming and brightening alike") {
    for (const bool dims : {true, false}) {
        const Image<glm::vec4> before = dims ? lit() : unlit(), after = dims ? unlit() : lit();
        const auto change = PictureChange::between(before, after);
        REQUIRE(change);
        for (const double p : {-0.25, 0.0, 0.3, 1.0, 1.5}) {
            CHECK(change->response(blend(before, after, p)) ==
                  Approx(p).epsilon(1e-6)); // fp32 pixels
            CHECK(change->noise(blend(before, after, p)) < 1e-6);
        }
        CHECK(change->response(before) == 0.0);
        CHECK(change->response(after) == 1.0);
    }
}

TEST_CASE("the mask holds what changes by more than 2 % of the greatest change") {
    Image<glm::vec4> before({4, 1}, glm::vec4(1.0f)), after = before;
    after({0, 0}) = glm::vec4(101.0f); // 100: the greatest
    after({1, 0}) = glm::vec4(3.0f);   // 2: exactly 2 %, not more
    after({2, 0}) = glm::vec4(-1.5f);  // 2.5, downwards
    const auto change = PictureChange::between(before, after);
    REQUIRE(change);
    CHECK(change->mask()({0, 0}) == 1);
    CHECK(change->mask()({1, 0}) == 0);
    CHECK(change->mask()({2, 0}) == 1);
    CHECK(change->mask()({3, 0}) == 0);

    // What is outside it does not count.
    Image<glm::vec4> frame = after;
    frame({3, 0}) = glm::vec4(1e6f);
    CHECK(change->response(frame) == Approx(1.0).epsilon(1e-12));
    CHECK(change->noise(frame) == Approx(0.0));
}

TEST_CASE("where nothing changes there is no response") {
    CHECK_FALSE(PictureChange::between(lit(), lit()));
    Image<glm::vec4> broken = lit();
    broken({5, 5}).g = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(PictureChange::between(lit(), broken));
    CHECK_THROWS_AS(PictureChange::between(lit(), lit({3, 3})), std::logic_error);
    CHECK_THROWS_AS(PictureChange::between(lit(), unlit())->response(lit({3, 3})),
                    std::logic_error);
}

TEST_CASE("an exponential average has the response that its weight predicts") {
    // Run as pictures: history <- (1 - a) history + a new, from the old reference to the new one.
    const auto change = PictureChange::between(lit(), unlit());
    REQUIRE(change);
    const double a = 0.2;
    Image<glm::vec4> history = lit();
    std::vector<double> p;
    for (int frame = 0; frame < 60; ++frame) {
        history = blend(history, unlit(), a);
        p.push_back(change->response(history));
        CHECK(p.back() == Approx(1.0 - std::pow(1.0 - a, frame + 1)).epsilon(1e-5)); // fp32 history
    }
    // 0.8^(k + 1) < 0.5, 0.1, 0.01 from k + 1 = 4, 11, 21 on.
    const ResponseSummary s = summarize(p);
    CHECK(s.t50 == 3);
    CHECK(s.t90 == 10);
    CHECK(s.t99 == 20);
    CHECK(s.ghostFrames ==
          Approx((1.0 - a) / a).epsilon(1e-4)); // 4; the tail after 60 frames: 6e-6
}

TEST_CASE("the lag of every exponential average has its closed form") {
    for (const double a : {0.05, 0.1, 0.5, 0.9}) {
        CAPTURE(a);
        const std::vector<double> p = exponentialResponse(a, 2000);
        CHECK(ghostFrames(p) == Approx((1.0 - a) / a).epsilon(1e-9));
        for (const double level : {0.5, 0.9, 0.99}) {
            // The first k with (1 - a)^(k + 1) < 1 - level.
            const double k = std::floor(std::log(1.0 - level) / std::log(1.0 - a) + 1e-9);
            const auto frames = framesUntilAbove(p, level);
            REQUIRE(frames);
            // At a = 0.5 and 0.9 equality occurs, and rounding decides: one frame's difference.
            CHECK(*frames >= int(k) - 1);
            CHECK(*frames <= int(k));
        }
    }
    CHECK(framesUntilAbove(exponentialResponse(0.1, 100), 0.9) == 21); // 0.9^22 = 0.098
    CHECK(framesUntilAbove(exponentialResponse(1.0, 100), 0.99) == 0);
}

TEST_CASE("a response that falls back has not arrived, and one that never arrives says so") {
    const std::vector<double> p = {0.6, 0.95, 0.95, 0.85, 0.92, 0.97};
    CHECK(framesUntilAbove(p, 0.5) == 0);
    CHECK(framesUntilAbove(p, 0.9) == 4);
    CHECK(framesUntilAbove(p, 0.99) == std::nullopt);
    CHECK(framesUntilAbove(std::vector<double>{0.1, 0.9}, 0.9) == std::nullopt); // above, not at
    CHECK(framesUntilAbove({}, 0.5) == std::nullopt);
    const std::vector<double> lost = {1.0, 1.0, std::numeric_limits<double>::quiet_NaN()};
    CHECK(framesUntilAbove(lost, 0.5) == std::nullopt);
}

TEST_CASE("overshoot is how far the response passes 1, and does not pay for ghosting") {
    const std::vector<double> p = {0.0, 0.5, 1.25, 1.1, 1.0};
    const ResponseSummary s = summarize(p);
    CHECK(s.overshoot == Approx(0.25));
    CHECK(s.ghostFrames == Approx(1.5));
    CHECK(summarize(std::vector<double>{0.2, 0.7}).overshoot == Approx(-0.3));
    CHECK_THROWS_AS(summarize({}), std::logic_error);
}

TEST_CASE("noise and lag are told apart") {
    // A frame with a known lag and known noise. The projection takes one dimension of some 1000
    // away from the noise, and noise moves the response by sigma / sqrt(sum of squared changes).
    const auto change = PictureChange::between(lit(), unlit());
    REQUIRE(change);
    const double sigma = 0.05;
    std::mt19937 random(11);
    std::normal_distribution<double> normal(0.0, sigma);
    for (const double p : {0.0, 0.4, 1.0}) {
        Image<glm::vec4> frame = blend(lit(), unlit(), p);
        for (glm::vec4& value : frame.pixels())
            value += glm::vec4(normal(random), normal(random), normal(random), 0.0f);
        CHECK(std::abs(change->response(frame) - p) < 0.02);
        // The RMS of some 1000 samples strays by 2 %.
        CHECK(std::abs(change->noise(frame) / sigma - 1.0) < 0.08);
        // The plain error has both in it.
        const double plain = rmse(frame, unlit(), &change->mask());
        const double lag = (1.0 - p) * rmse(lit(), unlit(), &change->mask());
        CHECK(std::abs(plain / std::hypot(lag, change->noise(frame)) - 1.0) < 0.03);
    }
}

TEST_CASE("noise has settled once it stays within a tenth of its settled value") {
    const std::vector<double> noise = {9.0, 2.0, 1.05, 1.5, 1.09, 0.95, 1.0};
    CHECK(framesUntilSettled(noise, 1.0) == 4);
    CHECK(framesUntilSettled(noise, 1.0, 0.6) == 2);
    CHECK(framesUntilSettled(noise, 5.0) == std::nullopt);
    // A light that goes out leaves less noise than the settled picture has; that is not settled
    // yet.
    CHECK(framesUntilSettled(std::vector<double>{0.1, 0.5, 1.0, 1.0}, 1.0) == 2);
    // Without light there is no noise, and it has settled.
    CHECK(framesUntilSettled(std::vector<double>{1.0, 0.0, 0.0}, 0.0) == 1);

    CHECK(settledValue(noise, 2) == Approx(0.975));
    CHECK(settledValue(noise, 100) == Approx(16.59 / 7.0));
    CHECK_THROWS_AS(settledValue({}, 4), std::logic_error);
}

TEST_CASE("a change of color is a change, whatever its luminance") {
    const Image<glm::vec4> red({5, 4}, {1.0f, 0.2f, 0.0f, 1.0f});
    const Image<glm::vec4> blue({5, 4}, {0.0f, 0.3f, 2.0f, 1.0f});
    const auto change = PictureChange::between(red, blue);
    REQUIRE(change);
    CHECK(change->response(blend(red, blue, 0.25)) == Approx(0.25).epsilon(1e-6));
    CHECK(change->ghostEnergy(blend(red, blue, 0.25)) == Approx(0.75).epsilon(1e-6));
}

TEST_CASE("ghost energy is the share of the old picture, and counts no error the other way") {
    const auto change = PictureChange::between(lit(), unlit());
    REQUIRE(change);
    for (const double p : {0.0, 0.3, 1.0})
        CHECK(change->ghostEnergy(blend(lit(), unlit(), p)) == Approx(1.0 - p).epsilon(1e-5));
    CHECK(change->ghostEnergy(blend(lit(), unlit(), 1.4)) == Approx(0.0)); // darker than dark
}

TEST_CASE("pixels that do not count are in no mask") {
    Mask counts({61, 37}, 1);
    counts({0, 0}) = 0; // where the change is greatest
    const auto change = PictureChange::between(lit(), unlit(), &counts);
    REQUIRE(change);
    CHECK(change->mask()({0, 0}) == 0);
    CHECK(change->mask()({1, 0}) == 1);
}

TEST_CASE("between its own settled values a biased response has the lag of an unbiased one") {
    const std::vector<double> p = exponentialResponse(0.2, 60);
    std::vector<double> biased;
    for (const double value : p)
        biased.push_back(0.1 + 0.85 * value); // never comes to 0.96
    CHECK(summarize(biased).t99 == std::nullopt);
    const auto own = betweenOwnValues(biased, 0.1, 0.95);
    REQUIRE(own);
    CHECK(summarize(*own).t50 == 3);
    CHECK(summarize(*own).t90 == 10);
    CHECK(summarize(*own).t99 == 20);
    CHECK(summarize(*own).ghostFrames == Approx(4.0).epsilon(1e-4));
    CHECK_FALSE(betweenOwnValues(biased, 0.5, 0.54));
    CHECK_FALSE(betweenOwnValues(biased, 0.5, std::numeric_limits<double>::quiet_NaN()));
}
