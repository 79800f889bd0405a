// SPDX-License-Identifier: MIT
#include "tests/support/glsl_probe.h"

#include "tests/support/gl_fixture.h"

namespace afterglow {

std::vector<glm::vec4> probe(std::initializer_list<std::string_view> includes,
                             std::string_view expression, std::span<const glm::vec4> inputs) {
    std::string text = "#version 450 core\n#include \"lib/fetch.glsl\"\n";
    for (const std::string_view include : includes)
        text += "#include \"" + std::string(include) + "\"\n";
    text += R"(
layout(local_size_x = 64) in;
Uint4Buffer(probeInputs);
layout(rgba32ui) writeonly uniform uimageBuffer probeOutputs;
layout(std140, binding = 1) uniform Params {
    ivec4 probeCount;
};
vec4 probeValue(vec4 x, int i) {
    return )" +
            std::string(expression) +
            R"(;
}
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= probeCount.x)
        return;
    vec4 x = uintBitsToFloat(fetchBuffer(probeInputs, i));
    imageStore(probeOutputs, i, floatBitsToUint(probeValue(x, i)));
}
)";
    const ShaderLibrary& shaders = testShaders();
    ComputeProgram program("probe", shaders.source().expandText("probe", text, shaders.common()));

    TexelBuffer in("probe inputs", inputs.size_bytes());
    TexelBuffer out("probe outputs", inputs.size_bytes());
    in.write(inputs);
    program.dispatch({int(inputs.size()), 1}, glm::ivec4(int(inputs.size()), 0, 0, 0),
                     {{"probeInputs", in}}, {{"probeOutputs", out}});
    std::vector<glm::vec4> values = out.read<glm::vec4>();
    values.resize(inputs.size());
    return values;
}

} // namespace afterglow
