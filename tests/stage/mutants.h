// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "tests/stage/spoilt_shaders.h"
#include "tests/support/compare.h"

namespace afterglow::test {

constexpr Tolerance kMutantTolerance{.max = 3e-5,
                                     .relative = 3e-5}; // the widest of the stage tests
constexpr double kClearMargin = 1e-2; // more than three hundred times the tolerance

/// The largest difference of anything compared; infinite where it is not a number.
struct Verdict {
    bool close = true;
    double largest = 0.0;

    template <class Actual, class Expected>
    void add(const Actual& actual, const Expected& expected) {
        const Comparison comparison = compare(actual, expected, kMutantTolerance);
        close = close && comparison.close;
        largest = std::max(largest, comparison.largest);
    }
};

/// Runs a stage with these shaders and compares it with its reference.
using Measure = std::function<Verdict(ShaderLibrary&)>;

/// An error that somebody might make.
struct Mutant {
    std::string what;
    std::string file;
    std::string from; ///< stands in the file once
    std::string to;
    double margin = kClearMargin; ///< the least difference that must show
};

/// Each mutant must show, and the shaders as they are must not.
inline void checkMutants(const Measure& measure, const std::vector<Mutant>& mutants) {
    SpoiltShaders shaders;
    {
        ShaderLibrary unchanged = shaders.library();
        REQUIRE(measure(unchanged).close);
    }
    for (const Mutant& mutant : mutants) {
        CAPTURE(mutant.what);
        const int found = shaders.spoil(mutant.file, mutant.from, mutant.to);
        CHECK_MESSAGE(found == 1, mutant.file, " has ", found, " times: ", mutant.from);
        ShaderLibrary library = shaders.library();
        const Verdict verdict = measure(library);
        MESSAGE(mutant.what, ": ", verdict.largest);
        CHECK(!verdict.close);
        CHECK(verdict.largest > mutant.margin);
        shaders.mend(mutant.file);
    }
}

} // namespace afterglow::test
