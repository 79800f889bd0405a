// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/temporal.h"
#include "tests/stage/stage_runner.h"
#include "tests/support/compare.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <glm/gtx/component_wise.hpp>

namespace afterglow::test {

/// Checks the images of the temporal pass. Returns the largest difference in color and moments
/// (first) and in control (second).
inline glm::dvec2 checkTemporalImages(const TemporalImages& images,
                                      const reference::TemporalResult& expected,
                                      Tolerance tolerance) {
    CHECK(expected.margin > 1e-4); // else a decision may fall either way
    CHECK_CLOSE(images.accumulated, expected.accumulated, tolerance);
    CHECK_CLOSE(images.moments, expected.moments, tolerance);
    CHECK_CLOSE(images.control, expected.control, tolerance);
    return {std::max(compare(images.accumulated, expected.accumulated, tolerance).largest,
                     compare(images.moments, expected.moments, tolerance).largest),
            compare(images.control, expected.control, tolerance).largest};
}

} // namespace afterglow::test
