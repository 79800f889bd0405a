// SPDX-License-Identifier: MIT
// The inputs of a program by name, and the ones that it refuses.

#include "renderer/base/error.h"
#include "shared/bindings.h"
#include "tests/gl/compiled_program.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/message_of.h"

#include <array>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("dispatch refuses names that are misspelt, missing or given twice") {
    testContext();
    const GlCheck check;
    ComputeProgram program = compile("scale.comp", kScale);
    GpuTexture r("r", PixelFormat::RGBA32F, kOdd), g("g", PixelFormat::RG32F, kOdd);
    const ScaleParams params{};
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch(kOdd, params, {{"radiance", r}, {"guide", g}}, {{"scaled", r}});
          }) == "scale.comp has no texture named guide; it has guides, radiance, scaled");
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch(kOdd, params, {{"radiance", r}}, {});
          }) == "scale.comp uses guides, radiance, scaled but was not given guides, scaled");
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch(kOdd, params, {{"radiance", r}, {"guides", g}, {"scaled", r}},
                               {{"scaled", r}});
          }) == "scale.comp was given scaled twice");
}

TEST_CASE("where bindings are not strict, a surplus name is let pass, and a missing one is no "
          "texture of before") {
    testContext();
    const GlCheck check;
    const Image<glm::vec4> input = randomImage(kOdd, 5);
    GpuTexture r("r", PixelFormat::RGBA32F, kOdd), g("g", PixelFormat::RG32F, kOdd);
    GpuTexture out("out", PixelFormat::RGBA32F, kOdd);
    r.write(input);
    g.write(Image<glm::vec2>(kOdd, {16, 32}));
    const ScaleParams params{glm::vec4(1), glm::vec4(0)};
    setStrictBindings(false);
    for (const Defines& defines : kFetchPaths) {
        ComputeProgram program = compile("scale.comp", kScale, defines);
        CHECK_NOTHROW(program.dispatch(
            kOdd, params, {{"radiance", r}, {"guides", g}, {"unused", r}}, {{"scaled", out}}));
        CHECK(out.read<glm::vec4>()({7, 5}) == input({7, 5}) + glm::vec4(16, 32, 32, 32));
        // A misspelt name is a surplus one and a missing one.
        CHECK_NOTHROW(
            program.dispatch(kOdd, params, {{"radiance", r}, {"guide", g}}, {{"scaled", out}}));
        CHECK(out.read<glm::vec4>()({7, 5}) == input({7, 5})); // of nothing, rg is zero
        out.clear();
        CHECK_NOTHROW(program.dispatch(kOdd, params, {{"radiance", r}, {"guides", g}}, {}));
        CHECK(out.read<glm::vec4>()({7, 5}) == glm::vec4(0)); // nothing was stored
    }
    setStrictBindings(true);
}

TEST_CASE("dispatch refuses a texture of another kind than the shader declares") {
    testContext();
    const GlCheck check;
    GpuTexture floats("floats", PixelFormat::RGBA32F, kOdd),
        uints("uints", PixelFormat::RG32UI, kOdd), guides("guides", PixelFormat::RG32F, kOdd),
        depth("depth", PixelFormat::Depth32F, kOdd);
    TexelBuffer texels("texels", 0);
    const auto give = [&](const Defines& defines, const Binding& radiance, const Binding& scaled) {
        return messageOf<std::logic_error>([&] {
            compile("scale.comp", kScale, defines)
                .dispatch(kOdd, ScaleParams{}, {radiance, {"guides", guides}}, {scaled});
        });
    };
    CHECK(give({}, {"radiance", uints}, {"scaled", floats}) ==
          "scale.comp declares radiance as sampler2D, but was given a texture of format RG32UI");
    CHECK(give({}, {"radiance", texels}, {"scaled", floats}) ==
          "scale.comp declares radiance as sampler2D, but was given a buffer of texels of "
          "format RGBA32UI");
    CHECK(give({}, {"radiance", floats}, {"scaled", uints}) ==
          "scale.comp declares scaled as image2D, but was given a texture of format RG32UI");
    CHECK(give(kFetchPaths[1], {"radiance", depth}, {"scaled", floats}) ==
          "scale.comp declares radiance as image2D, but was given a texture of format Depth32F");
    CHECK(give({}, {"radiance", GpuTexture()}, {"scaled", floats}) ==
          "scale.comp was given nothing as radiance: the texture was never made");
    CHECK(messageOf<std::logic_error>([&] {
              compile("scale.comp", kScale)
                  .dispatch(kOdd, ScaleParams{}, {{"guides", guides}},
                            {{"radiance", floats}, {"scaled", floats}});
          }) == "scale.comp samples radiance; it cannot be written");
}

TEST_CASE("dispatch refuses parameters that are not of the size of the block") {
    testContext();
    const GlCheck check;
    GpuTexture r("r", PixelFormat::RGBA32F, kOdd), g("g", PixelFormat::RG32F, kOdd);
    GpuTexture out("out", PixelFormat::RGBA32F, kOdd);
    ComputeProgram scale = compile("scale.comp", kScale);
    CHECK(
        messageOf<std::logic_error>([&] {
            scale.dispatch(kOdd, glm::mat4(1), {{"radiance", r}, {"guides", g}}, {{"scaled", out}});
        }) == "scale.comp: its Params block is 32 bytes, but 64 were given");
    CHECK(messageOf<std::logic_error>([&] {
              scale.dispatch(kOdd, {{"radiance", r}, {"guides", g}}, {{"scaled", out}});
          }) == "scale.comp: its Params block is 32 bytes, but 0 were given");
    ComputeProgram plain = compile("plain.comp", "void main() {}\n");
    CHECK(messageOf<std::logic_error>([&] { plain.dispatch(kOdd, glm::vec4(1), {}, {}); }) ==
          "plain.comp has no Params block, but 16 bytes were given");
    CHECK_NOTHROW(plain.dispatch(kOdd, {}, {}));
}

TEST_CASE("a uniform block is read under its name, another one in the next dispatch") {
    testContext();
    const GlCheck check;
    GpuBuffer first("first", 16), second("second", 16);
    first.write(std::array{glm::vec4(1, 2, 3, 4)});
    second.write(std::array{glm::vec4(5, 6, 7, 8)});
    ComputeProgram program = compile("frame.comp", R"(
layout(std140, binding = 0) uniform Frame { vec4 ofFrame; };
layout(std140, binding = 1) uniform Params { vec4 ofPass; };
uniform writeonly image2D result;
void main() { imageStore(result, ivec2(gl_GlobalInvocationID.xy), ofFrame + ofPass); }
)");
    GpuTexture result("result", PixelFormat::RGBA32F, {8, 8});
    const auto run = [&](const GpuBuffer& block, float add) {
        program.dispatch({8, 8}, glm::vec4(add), {{"Frame", block}}, {{"result", result}});
        return result.read<glm::vec4>();
    };
    CHECK_CLOSE(run(first, 10), Image<glm::vec4>({8, 8}, {11, 12, 13, 14}), Tolerance{});
    CHECK_CLOSE(run(second, 10), Image<glm::vec4>({8, 8}, {15, 16, 17, 18}), Tolerance{});
    CHECK_CLOSE(run(first, 20), Image<glm::vec4>({8, 8}, {21, 22, 23, 24}), Tolerance{});

    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch({8, 8}, glm::vec4(1), {}, {{"result", result}});
          }) == "frame.comp uses Frame, result but was not given Frame");
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch({8, 8}, glm::vec4(1), {{"Frame", result}}, {{"result", result}});
          }) == "frame.comp declares Frame as a uniform block, but was given a texture of format "
                "RGBA32F");
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch({8, 8}, glm::vec4(1), {{"Frame", first}}, {{"result", first}});
          }) == "frame.comp declares result as image2D, but was given a buffer with a block");
}

TEST_CASE("a storage block is written under its name") {
    testContext();
    const GlCheck check;
    GpuBuffer numbers("numbers", 16);
    const GpuTexture texture("texture", PixelFormat::RGBA32F, {8, 8});
    ComputeProgram program = compile("store.comp", R"(
layout(std430) buffer Numbers { vec4 numbers; };
void main() { if (gl_GlobalInvocationID.xy == uvec2(0)) numbers += vec4(1, 2, 3, 4); }
)");
    for (const float times : {1.0f, 2.0f}) {
        program.dispatch({8, 8}, {}, {{"Numbers", numbers}});
        CHECK(numbers.read<glm::vec4>()[0] == times * glm::vec4(1, 2, 3, 4));
    }
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch({8, 8}, {}, {});
          }) == "store.comp uses Numbers but was not given Numbers");
    CHECK(messageOf<std::logic_error>([&] {
              program.dispatch({8, 8}, {}, {{"Numbers", texture}});
          }) == "store.comp declares Numbers as a storage block, but was given a texture of format "
                "RGBA32F");
}

TEST_CASE("a shader that does not compile is an error at its own line") {
    testContext();
    const GlCheck check; // what the compiler says is not a misuse of OpenGL
    const std::string error =
        messageOf<Error>([] { compile("bad.comp", "void main() { dott(vec3(1), vec3(1)); }\n"); });
    CHECK(error.starts_with("bad.comp:4: "));
    CHECK(error.find("dott") != std::string::npos);
    if (glInfo(testContext()).softwareRasterizer)
        CHECK(error == "bad.comp:4: no function with name 'dott'");
    CHECK(messageOf<Error>([] {
              compile("loop.comp", "void f();\nvoid main() { f(); }\n");
          }).starts_with("loop.comp: "));
}
