// SPDX-License-Identifier: MIT
#include "renderer/pipeline/jitter.h"

namespace afterglow {
namespace {

double radicalInverse(std::uint32_t index, std::uint32_t base) {
    double value = 0.0, digit = 1.0;
    for (; index > 0; index /= base) {
        digit /= base;
        value += digit * double(index % base);
    }
    return value;
}

} // namespace

glm::vec2 jitterAt(std::uint32_t frame) {
    const std::uint32_t index = 1 + frame % kJitterCycle;
    return {float(radicalInverse(index, 2) - 0.5), float(radicalInverse(index, 3) - 0.5)};
}

glm::vec2 jitterOf(const DisplaySettings& display, std::uint32_t frame) {
    return AntiAliasing(display.antiAliasing) == AntiAliasing::Taa ? jitterAt(frame)
                                                                   : glm::vec2(0.0f);
}

} // namespace afterglow
