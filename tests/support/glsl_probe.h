// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// Returns the value of a GLSL expression of type vec4 for every input, as the shader compiler sees
/// it:
///
///     probe({"lib/encoding.glsl"}, "vec4(octDecode(octEncode(x.xyz)), 0)", directions)
///
/// In the expression, `x` is the input (vec4) and `i` its index (int). A value that is not a float
/// travels as its bits: uintBitsToFloat() here, std::bit_cast there. Runs in testContext(). Throws
/// Error, with the driver's message, when it does not compile.
std::vector<glm::vec4> probe(std::initializer_list<std::string_view> includes,
                             std::string_view expression, std::span<const glm::vec4> inputs);

} // namespace afterglow
