// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/pixel_facts.h"
#include "renderer/pipeline/renderer.h"

#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// One line of the inspector.
struct InspectedValue {
    std::string name;              ///< "alpha"
    std::string value;             ///< "0.2", "0.61 0.58 0.55", four digits each
    std::string note;              ///< meaning and unit, for a tooltip
    std::vector<double> numbers{}; ///< those in `value`, exactly; empty where it is words alone
};

struct InspectedGroup {
    std::string
        title; ///< "surface", "raw signal", "gradient sample", "history", "history taps", "filter"
    std::vector<InspectedValue> values;
};

/// The values of one pixel and of its stratum in the last frame of one filter. Images that the
/// filter does not make are left out.
struct Inspection {
    glm::ivec2 pixel{0}, stratum{0};
    std::size_t state = 0, signal = 0;
    std::vector<InspectedGroup> groups;
    std::vector<std::string> story; ///< sentences: where the sample came from, why there is none
};

/// Makes the lines and the story of one signal in the filter with that state.
Inspection inspectionOf(const PixelFacts& facts, const Scene& scene, std::size_t state,
                        std::size_t signal = 0);

/// Explains the numbers of a pixel in sentences.
std::vector<std::string> storyOf(const PixelFacts& facts);

/// Returns a gpu::kHistory... code in words: "another instance was seen there".
std::string_view historyReason(int code);
/// Returns a gpu::kFate... code in words: "lost the race".
std::string_view sampleFate(std::uint32_t code);
/// Returns four significant digits, as the inspector writes numbers.
std::string fourDigits(double value);
/// Returns "(12, 7)".
std::string placeText(glm::ivec2 p);

} // namespace afterglow
