// SPDX-License-Identifier: MIT
#include "app/measure/oracle.h"

#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using doctest::Approx;

namespace {

constexpr glm::ivec2 kSize{7, 5}; // strata at the right and bottom are partial
constexpr float kFloor = 1e-4f;

Image<float> noise(unsigned seed, float least, float most) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(least, most);
    Image<float> image(kSize);
    for (float& value : image.pixels())
        value = uniform(random);
    return image;
}

Image<float> scaled(Image<float> image, float factor) {
    for (float& value : image.pixels())
        value *= factor;
    return image;
}

const Mask kAll(kSize, 1);

} // namespace

TEST_CASE("the ideal lambda is the share of the light that changed, in every stratum") {
    const Image<float> before = noise(1, 0.2f, 3.0f);
    for (const float left : {0.0f, 0.25f, 1.0f, 4.0f}) {
        const Image<float> lambda = idealLambda(scaled(before, left), before, kAll, kFloor).lambda;
        CHECK(lambda.size() == glm::ivec2(3, 2));
        const float share = left < 1.0f ? 1.0f - left : 1.0f - 1.0f / left;
        for (const float value : lambda.pixels())
            CHECK(value == Approx(share).epsilon(1e-6));
    }
    const Image<float> still = idealLambda(before, before, kAll, kFloor).lambda;
    for (const float value : still.pixels())
        CHECK(value == 0.0f);
}

TEST_CASE("the ideal lambda is 0 where there is no light to speak of, and sees no background") {
    const Image<float> dark(kSize, 0.5f * kFloor), darker(kSize, 0.0f);
    const StrataTruth none = idealLambda(darker, dark, kAll, kFloor);
    for (const float value : none.lambda.pixels())
        CHECK(value == 0.0f);
    CHECK(countOf(none.lit) == 0);

    Image<float> before = noise(2, 1.0f, 2.0f), now = before;
    Mask foreground = kAll;
    now({1, 1}) = 100.0f;
    foreground({1, 1}) = 0;
    CHECK(idealLambda(now, before, foreground, kFloor).lambda({0, 0}) == 0.0f);
    CHECK(countOf(idealLambda(now, before, foreground, kFloor).lit) == 6);
    for (glm::ivec2 p{6, 0}; p.y < 3; ++p.y)
        foreground(p) = 0; // all of the stratum at the right
    CHECK(idealLambda(now, before, foreground, kFloor).lit({2, 0}) == 0);
}

TEST_CASE("changes that cancel out within a stratum are no change of its light") {
    Image<float> before(kSize, 1.0f), now = before;
    now({0, 0}) = 1.5f;
    now({1, 0}) = 0.5f;
    const Image<float> lambda = idealLambda(now, before, kAll, kFloor).lambda;
    CHECK(lambda({0, 0}) == Approx(0.0f));
    now({1, 0}) = 1.0f;
    // 0.5 of 9.5
    CHECK(idealLambda(now, before, kAll, kFloor).lambda({0, 0}) == Approx(0.5 / 9.5).epsilon(1e-6));
}

TEST_CASE("the ideal alpha has the least expected error of all weights") {
    // E |(1 - a) h + a x - t|^2 = (1 - a)^2 e^2 + a^2 s^2, with e = h - t and s^2 = Var x.
    const Image<float> history = noise(3, 0.0f, 2.0f), truth = noise(4, 0.0f, 2.0f);
    const Image<float> variance = noise(5, 0.0f, 1.0f);
    const Image<float> alpha = idealAlpha(history, truth, variance, kAll);
    for (std::size_t i = 0; i < alpha.pixels().size(); ++i) {
        const double e = double(history.pixels()[i]) - double(truth.pixels()[i]);
        const auto risk = [&](double a) {
            return (1.0 - a) * (1.0 - a) * e * e + a * a * variance.pixels()[i];
        };
        const double best = alpha.pixels()[i];
        CHECK(best >= 0.0);
        CHECK(best <= 1.0);
        for (double a = 0.0; a <= 1.0; a += 0.01)
            CHECK(risk(best) <= risk(a) + 1e-9);
    }
}

TEST_CASE("the ideal alpha is 0 for a perfect history and 1 for a perfect sample or none before") {
    const Image<float> truth(kSize, 1.0f), wrong(kSize, 1.5f), still(kSize, 0.0f);
    const Image<float> noisy(kSize, 0.25f);
    const auto first = [](const Image<float>& image) { return image.pixels()[0]; };
    const Image<float> perfect = idealAlpha(truth, truth, noisy, kAll);
    const Image<float> sample = idealAlpha(wrong, truth, still, kAll);
    const Image<float> even = idealAlpha(wrong, truth, noisy, kAll);
    const Image<float> none = idealAlpha(wrong, truth, noisy, Mask(kSize, 0));
    const Image<float> nothing = idealAlpha(truth, truth, still, kAll);
    CHECK(first(perfect) == 0.0f);
    CHECK(first(sample) == 1.0f);
    CHECK(first(even) == Approx(0.5f));
    CHECK(first(none) == 1.0f);
    CHECK(first(nothing) == 0.0f);
    // Rounding is no error.
    const Image<float> rounded = idealAlpha(Image<float>(kSize, 1.00001f), truth, still, kAll);
    CHECK(first(rounded) == 0.0f);
}

TEST_CASE("agreement is told by its mean, its bias and its RMSE, over what counts") {
    Image<float> weight({4, 1}), ideal({4, 1});
    Mask counts({4, 1}, 1);
    counts({3, 0}) = 0;
    weight({0, 0}) = 0.5f, weight({1, 0}) = 1.0f, weight({3, 0}) = 1e9f;
    ideal({0, 0}) = 0.25f, ideal({1, 0}) = 0.5f;
    const Agreement agreement = compareWeights(weight, ideal, counts);
    CHECK(agreement.mean == Approx(0.5));
    CHECK(agreement.idealMean == Approx(0.25));
    CHECK(agreement.bias == Approx(0.25));
    CHECK(agreement.rmse == Approx(std::sqrt((0.0625 + 0.25) / 3.0)));
    CHECK_THROWS_AS(compareWeights(weight, Image<float>({3, 1}), counts), std::logic_error);
}

TEST_CASE(
    "a detector is judged by what it finds, what it takes for a change, and its false alarms") {
    Image<float> lambda({5, 1}), ideal({5, 1});
    const float found[] = {0.5f, 0.2f, 0.0f, 0.3f, 0.05f};
    const float changed[] = {0.6f, 0.0f, 0.4f, 0.3f, 0.0f};
    for (int x = 0; x < 5; ++x) {
        lambda({x, 0}) = found[x];
        ideal({x, 0}) = changed[x];
    }
    const Detection detection = detect(lambda, ideal, Mask({5, 1}, 1));
    CHECK(*detection.precision == Approx(2.0 / 3.0)); // 0, 1 and 3 are taken; 1 is not one
    CHECK(*detection.recall == Approx(2.0 / 3.0));    // 0, 2 and 3 are; 2 is missed
    CHECK(*detection.falseMean == Approx(0.125));     // 1 and 4
    const Image<float> still({5, 1});
    CHECK_FALSE(detect(still, still, Mask({5, 1}, 1)).precision);
    CHECK_FALSE(detect(still, still, Mask({5, 1}, 1)).recall);
    CHECK(*detect(still, still, Mask({5, 1}, 1)).falseMean == 0.0);
}
