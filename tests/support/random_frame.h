// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "renderer/image/image.h"

namespace afterglow {

/// Plausible inputs for every stage of the filter, made from a seed. docs/pipeline.md says what
/// each image holds.
///
/// Up to six instances, each a plane with a normal, a slope and a motion of its own, overlap before
/// a background with holes; their edges are edges of depth. Some pixels moved off the screen or
/// came from behind the camera; some previous ones show the right instance at a wrong depth or with
/// a wrong normal, so that every reason to lose history occurs.
///
/// Two things make an exact comparison possible. Motion is a multiple of 1/32 pixel, so positions
/// and bilinear weights are exact in 32 bits; and no validity test comes near its threshold as long
/// as 1 <= depthTolerance <= 4 and 0.3 <= normalTolerance <= 0.95.
///
/// The samples show every change of light: none at all, one factor for all channels, another color,
/// from and to black, and steps just below and just above what counts as a change.
///
/// Background holds garbage in `signal`, `accumulated`, `moments`, `gradient` and the previous
/// frame, and a normal, so that a filter which looks there is found out.
struct RandomFrame {
    RandomFrame(glm::ivec2 pixels, std::uint32_t seed);

    glm::ivec2 size;   ///< pixels
    glm::ivec2 strata; ///< ceil(size / 3)

    Image<glm::uvec4> visibility, previousVisibility;
    Image<glm::vec4> guides, previousGuides;
    Image<glm::vec2> slope;
    Image<glm::vec4> motion;
    Image<glm::vec4> raw, previousRaw;

    Image<glm::vec4> previousColor;
    Image<glm::vec4> previousMoments; ///< N is one of 0, 1, 2, 3, 4, 10
    Image<float> lambda;              ///< strata; 0 and 1 occur
    Image<glm::vec4> change;          ///< strata; E, v, scale, weight; scale is 1 without lambda
    std::uint32_t changed = 100;      ///< strata whose light has changed

    Image<glm::vec4> accumulated;
    Image<glm::vec4> moments; ///< N is one of 0, 1, 2, 3, 4, 10; the variance of some is below 0
    Image<glm::vec4> signal;  ///< rgb and variance: the input of an a-trous iteration

    Image<glm::uvec4> samples; ///< strata; some are empty
    Image<glm::vec4> gradient; ///< strata; delta, Delta, mean, variance
    Image<glm::vec4> strataGuides;
    Image<glm::vec2> strataSlope;
    Image<glm::vec4> before, now, products; ///< strata; light pairs, as after some iterations

private:
    void addChangeOfLight(std::uint32_t seed);
};

} // namespace afterglow
