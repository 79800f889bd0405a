// SPDX-License-Identifier: MIT
#include "tests/support/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("a comparison is as strict as its tolerance") {
    CHECK(compare(1.0, 1.0, Tolerance{}).close);
    CHECK_FALSE(compare(1.0, std::nextafter(1.0, 2.0), Tolerance{}).close);
    CHECK(compare(1.5, 1.0, Tolerance{.max = 0.5}).close);
    CHECK_FALSE(compare(1.5, 1.0, Tolerance{.max = 0.49}).close);
    CHECK(compare(-110.0, -100.0, Tolerance{.relative = 0.1}).close);
    CHECK_FALSE(compare(-110.0, -100.0, Tolerance{.relative = 0.09}).close);
    CHECK(compare(110.0, 100.0, Tolerance{.max = 5.0, .relative = 0.05}).close);
    CHECK(compare(glm::vec3(1, 2, 3), glm::dvec3(1, 2, 3.25), Tolerance{.max = 0.25}).close);
    CHECK(compare(glm::vec3(1, 2, 3), glm::dvec3(1, 2, 3.25), Tolerance{}).largest == 0.25);
}

TEST_CASE("NaN is close to nothing, and infinity to itself alone") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const Tolerance wide{.max = 1e9, .relative = 1.0};
    CHECK_FALSE(compare(nan, 0.0, wide).close);
    CHECK_FALSE(compare(0.0, nan, wide).close);
    CHECK_FALSE(compare(nan, nan, wide).close);
    CHECK(compare(infinity, infinity, wide).close);
    CHECK_FALSE(compare(infinity, -infinity, Tolerance{.max = 1.0}).close);
    CHECK_FALSE(compare(1.0, infinity, Tolerance{.max = 1.0}).close);
    CHECK_FALSE(compare(infinity, 1.0, wide).close);
}

TEST_CASE("pictures of other sizes, or ranges of other lengths, are not close") {
    const Tolerance wide{.max = 1e9};
    CHECK_FALSE(compare(Image<float>({6, 4}), Image<float>({4, 6}), wide).close);
    CHECK_FALSE(compare(std::vector<float>(3), std::vector<float>(4), wide).close);
    CHECK_FALSE(compare(Image<glm::vec2>({2, 2}), Image<glm::vec4>({2, 2}), wide).close);
}

TEST_CASE("a report counts what differs and shows the ten worst pixels, worst first") {
    const Image<glm::dvec2> expected({7, 5}, {1, 2});
    Image<glm::vec2> actual({7, 5}, {1, 2});
    for (int i = 0; i < 12; ++i)
        actual({i % 7, i / 7}).y = 2.0f + float(i);
    actual({6, 4}).x = 101.0f;
    const Comparison comparison = compare(actual, expected, Tolerance{.max = 1.5});
    CHECK_FALSE(comparison.close);
    CHECK(comparison.largest == 100.0);
    CHECK(comparison.report.starts_with("largest difference 100; 11 of 35 differ by more than 1.5\n"
                                        "    (6, 4) is (101, 2), expected (1, 2), off by 100\n"
                                        "    (4, 1) is (1, 13), expected (1, 2), off by 11\n"));
    CHECK(std::ranges::count(comparison.report, '\n') == 10);
    CHECK(comparison.report.find("(2, 0)") == std::string::npos); // the eleventh
}
