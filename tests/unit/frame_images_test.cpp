#include "app/workbench/frame_images.h"

#include <limits>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("a fitted range leaves out the outermost hundredth, and what is no number") {
    Image<glm::vec4> values({1000, 1});
    for (int i = 0; i < 1000; ++i)
        values({i, 0}) = glm::vec4(float(i) / 1000.0f, 0, 0, 0);
    values({0, 0}).x = std::numeric_limits<float>::quiet_NaN();
    values({999, 0}).x = std::numeric_limits<float>::infinity();
    values({998, 0}).x = 1e9f;
    const ImageDisplay fitted = fittedTo(values, {"depth", gpu::kMapScalar, 0.0f, 1.0f, "m"});
    CHECK(fitted.low == doctest::Approx(0.01).epsilon(0.2));
    CHECK(fitted.high == doctest::Approx(0.99).epsilon(0.01));
    const ImageDisplay both = fittedTo(values, {"gradient", gpu::kMapSigned, -9.0f, 9.0f, ""});
    CHECK(both.low == -both.high);
    const Image<glm::vec4> nothing({3, 3}, glm::vec4(std::numeric_limits<float>::quiet_NaN()));
    const ImageDisplay before{"depth", gpu::kMapScalar, 0.25f, 0.5f, "m"};
    CHECK(fittedTo(nothing, before) == before);
}
