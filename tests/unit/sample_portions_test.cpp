// SPDX-License-Identifier: MIT
#include "app/measure/reference.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

constexpr int kMost = 1 << 16;

/// The portions of so many samples on a device that takes so long for each, and for every portion.
std::vector<int> portionsOf(int samples, double millisecondsEach, double overhead, int most) {
    SamplePortions portions(most);
    std::vector<int> made;
    while (samples > 0) {
        const int portion = std::min(portions.next(kPortionMilliseconds), samples);
        portions.took(portion, portion * millisecondsEach + overhead);
        made.push_back(portion);
        samples -= portion;
    }
    return made;
}

} // namespace

TEST_CASE("portions of a reference begin with one sample and take no longer than is wanted") {
    for (const double each : {0.001, 0.09, 1.0, 7.0, 24.9, 49.0, 51.0, 400.0, 3000.0})
        for (const double overhead : {0.0, 0.2, 5.0}) {
            CAPTURE(each);
            CAPTURE(overhead);
            const std::vector<int> made = portionsOf(5000, each, overhead, kMost);
            CHECK(made.front() == 1);
            for (std::size_t i = 0; i < made.size(); ++i) {
                // A single sample is as long as it is.
                CHECK(
                    (made[i] == 1 || made[i] * each + overhead <= kPortionMilliseconds + overhead));
                CHECK((i == 0 || made[i] <= 2 * made[i - 1]));
            }
        }
}

TEST_CASE("portions of a fast device grow to what is wanted, and follow it when it slows down") {
    const std::vector<int> made = portionsOf(100000, 0.01, 0.0, kMost);
    CHECK(made[13] >= 4999); // rounded down
    CHECK(made[13] <= 5000);
    CHECK(made.size() < 40);
    for (const int portion : portionsOf(100000, 0.01, 0.0, 300))
        CHECK(portion <= 300);
    CHECK(portionsOf(10000, 0.0, 0.0, kMost).size() == 14); // too fast for the clock

    SamplePortions portions(kMost);
    for (int i = 0; i < 20; ++i)
        portions.took(portions.next(kPortionMilliseconds),
                      0.01 * portions.next(kPortionMilliseconds));
    CHECK(portions.next(kPortionMilliseconds) >= 4999);
    portions.took(5000, 500.0);
    CHECK(portions.next(kPortionMilliseconds) == 500);
    portions.took(500, 1e6);
    CHECK(portions.next(kPortionMilliseconds) == 1);
}
