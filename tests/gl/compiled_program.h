// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/program.h"
#include "tests/support/gl_fixture.h"

#include <array>
#include <random>
#include <string>
#include <string_view>

namespace afterglow::test {

inline constexpr glm::ivec2 kOdd{61, 37};

inline ComputeProgram compile(std::string_view name, const std::string& body,
                              const Defines& defines = {}) {
    const std::string text = "#version 450 core\n"
                             "#include \"lib/fetch.glsl\"\n"
                             "layout(local_size_x = 8, local_size_y = 8) in;\n" +
                             body;
    return ComputeProgram(name, testShaders().source().expandText(name, text, defines));
}

/// Scales a picture and adds to it.
inline const std::string kScale = R"(
layout(std140, binding = 1) uniform Params { vec4 factor; vec4 summand; };
Float4Texture(radiance);
Float2Texture(guides);
uniform writeonly image2D scaled;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, sizeOf(radiance))))
        return;
    imageStore(scaled, p, fetch(radiance, p) * factor + summand + fetch(guides, p).xyyy);
}
)";
struct ScaleParams {
    glm::vec4 factor, summand;
};

inline Image<glm::vec4> randomImage(glm::ivec2 size, unsigned seed) {
    std::mt19937 random(seed);
    Image<glm::vec4> image(size);
    for (glm::vec4& pixel : image.pixels())
        for (int i = 0; i < 4; ++i)
            pixel[i] = float(random() % 1025) / 1024.0f;
    return image;
}

/// The two ways of fetch() in shaders/lib/fetch.glsl.
inline const std::array<Defines, 2> kFetchPaths{Defines{}, Defines{{"FETCH_BY_IMAGE", "1"}}};

} // namespace afterglow::test
