// SPDX-License-Identifier: MIT
#include "app/workbench/color_maps.h"

#include "renderer/image/color.h"

#include <cmath>

namespace afterglow {
namespace {

// Ottosson 2020, "A perceptual color space for image processing": OKLab, as lightness, chroma and
// hue, to sRGB.
glm::vec3 fromPolar(float lightness, float chroma, float degrees) {
    const float a = chroma * std::cos(glm::radians(degrees));
    const float b = chroma * std::sin(glm::radians(degrees));
    const glm::vec3 root{lightness + 0.3963377774f * a + 0.2158037573f * b,
                         lightness - 0.1055613458f * a - 0.0638541728f * b,
                         lightness - 0.0894841775f * a - 1.2914855480f * b};
    const glm::vec3 lms = root * root * root;
    const glm::vec3 linear{glm::dot(lms, {4.0767416621f, -3.3077115913f, 0.2309699292f}),
                           glm::dot(lms, {-1.2684380046f, 2.6097574011f, -0.3413193965f}),
                           glm::dot(lms, {-0.0041960863f, -0.7034186147f, 1.7076147010f})};
    const glm::vec3 c = glm::clamp(linear, 0.0f, 1.0f);
    return {encodeSrgb(c.r), encodeSrgb(c.g), encodeSrgb(c.b)};
}

} // namespace

glm::vec3 scalarColor(float t) {
    const float chroma = 0.105f + 0.035f * std::cos(6.2831853f * t) + 0.03f * t * t * t * t;
    return fromPolar(0.20f + 0.72f * t, chroma, 300.0f - 195.0f * t);
}

glm::vec3 signedColor(float t) {
    const float a = std::abs(t);
    const float chroma = 0.13f * std::pow(a, 0.8f) * (1.0f - 0.25f * a * a);
    return fromPolar(0.22f + 0.62f * a, chroma, t < 0.0f ? 250.0f : 58.0f);
}

} // namespace afterglow
