// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace afterglow {

/// Returns the luminance of linear Rec. 709 radiance.
template <class Vec3>
auto luminance(const Vec3& c) {
    using T = typename Vec3::value_type;
    return T(0.2126) * c.r + T(0.7152) * c.g + T(0.0722) * c.b;
}

/// Applies the sRGB transfer function: linear [0, 1] to encoded [0, 1]. IEC 61966-2-1.
inline float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// Applies its inverse: encoded [0, 1] to linear [0, 1].
inline double decodeSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace afterglow
