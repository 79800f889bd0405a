// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/stage/spoilt_shaders.h"

// Errors planted in the stages that know the scene.

namespace afterglow::test {

/// Measures the largest difference that a stage's test finds in the shaders, as a multiple of the
/// bound, or the number of pixels or strata that are wrong, whichever is more.
using SceneMeasure = std::function<double(ShaderLibrary&)>;

/// An error that somebody might make.
struct SceneMutant {
    std::string what;
    std::string file;
    std::string from; ///< stands in the file, once unless said otherwise
    std::string to;
    int times = 1;
};

/// Each mutant must show, and the shaders as they are must not.
inline void checkMutants(const SceneMeasure& measure, const std::vector<SceneMutant>& mutants) {
    SpoiltShaders shaders;
    {
        ShaderLibrary unchanged = shaders.library();
        REQUIRE(measure(unchanged) <= 1.0);
    }
    for (const SceneMutant& mutant : mutants) {
        CAPTURE(mutant.what);
        const int found = shaders.spoil(mutant.file, mutant.from, mutant.to);
        CHECK_MESSAGE(found == mutant.times, mutant.file, " has ", found, " times: ", mutant.from);
        ShaderLibrary library = shaders.library();
        const double failure = measure(library);
        MESSAGE(mutant.what, ": ", failure);
        CHECK(failure >= 3.0);
        shaders.mend(mutant.file);
    }
}

} // namespace afterglow::test
