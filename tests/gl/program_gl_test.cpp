// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/framebuffer.h"
#include "shared/bindings.h"
#include "tests/gl/compiled_program.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/glsl_probe.h"
#include "tests/support/message_of.h"

#include <array>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("a program reads, writes and takes parameters at an odd size, by image and by sampler") {
    testContext();
    const GlCheck check;
    const Image<glm::vec4> input = randomImage(kOdd, 1);
    const ScaleParams params{{2, 3, 4, 5}, {0.5f, 0.25f, -1, 8}};
    Image<glm::vec4> expected(kOdd);
    Image<glm::vec2> guide(kOdd, {16, 32});
    for (std::size_t i = 0; i < input.pixels().size(); ++i)
        expected.pixels()[i] =
            input.pixels()[i] * params.factor + params.summand + glm::vec4(16, 32, 32, 32);

    GpuTexture radiance("radiance", PixelFormat::RGBA32F, kOdd);
    GpuTexture guides("guides", PixelFormat::RG32F, kOdd);
    GpuTexture scaled("scaled", PixelFormat::RGBA32F, kOdd);
    radiance.write(input);
    guides.write(guide);
    for (const Defines& defines : kFetchPaths) {
        ComputeProgram program = compile("scale.comp", kScale, defines);
        CHECK(program.groupSize() == glm::ivec3(8, 8, 1));
        scaled.clear();
        program.dispatch(kOdd, params, {{"radiance", radiance}, {"guides", guides}},
                         {{"scaled", scaled}});
        // Sums of few multiples of 1/1024: exact in 32 bits.
        CHECK_CLOSE(scaled.read<glm::vec4>(), expected, Tolerance{});
    }
}

TEST_CASE("every kind of fetch gives what was written, by image and by sampler") {
    testContext();
    const GlCheck check;
    const glm::ivec2 size{5, 3};
    std::mt19937 random(2);
    Image<glm::uvec4> bits(size);
    for (glm::uvec4& pixel : bits.pixels())
        pixel = {random(), random(), random(), random()};
    const Image<glm::vec4> numbers = randomImage(size, 3);
    Image<float> ones(size);
    Image<glm::vec2> twos(size);
    Image<std::uint32_t> oneBits(size);
    Image<glm::uvec2> twoBits(size);
    for (std::size_t i = 0; i < bits.pixels().size(); ++i) {
        ones.pixels()[i] = numbers.pixels()[i].x;
        twos.pixels()[i] = glm::vec2(numbers.pixels()[i]);
        oneBits.pixels()[i] = bits.pixels()[i].x;
        twoBits.pixels()[i] = glm::uvec2(bits.pixels()[i]);
    }

    GpuTexture f1("f1", PixelFormat::R32F, size), f2("f2", PixelFormat::RG32F, size),
        f4("f4", PixelFormat::RGBA32F, size), h4("h4", PixelFormat::RGBA16F, size),
        u1("u1", PixelFormat::R32UI, size), u2("u2", PixelFormat::RG32UI, size),
        u4("u4", PixelFormat::RGBA32UI, size), floats("floats", PixelFormat::RGBA32F, size),
        uints("uints", PixelFormat::RGBA32UI, size);
    f1.write(ones);
    f2.write(twos);
    f4.write(numbers);
    h4.write(numbers);
    u1.write(oneBits);
    u2.write(twoBits);
    u4.write(bits);
    TexelBuffer texels("texels", 0);
    texels.write(bits.pixels());

    const auto fetched = [&](const char* declaration, const char* name, const Binding& binding) {
        for (const Defines& defines : kFetchPaths) {
            CAPTURE(declaration);
            const bool isUint = std::string_view(declaration).starts_with("Uint");
            const bool isBuffer = binding.buffer != nullptr;
            ComputeProgram program =
                compile("fetch.comp",
                        std::string(declaration) + "(" + name + ");\n" +
                            (isUint ? "layout(rgba32ui) uniform writeonly uimage2D result;\n"
                                    : "uniform writeonly image2D result;\n") +
                            "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n" +
                            "if (p.x < 5 && p.y < 3) imageStore(result, p, " +
                            (isBuffer ? std::string("fetchBuffer(") + name + ", p.y * 5 + p.x)"
                                      : std::string("fetch(") + name + ", p)") +
                            " + " + (isUint ? "uint" : "float") + "(" +
                            (isBuffer ? "lengthOf(" : "sizeOf(") + name + ")" +
                            (isBuffer ? "" : ".x") + " - " + (isBuffer ? "15" : "5") + ")); }\n",
                        defines);
            GpuTexture& result = isUint ? uints : floats;
            result.clear();
            program.dispatch(size, {binding}, {{"result", result}});
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::ivec2 p{x, y};
                    const bool two = std::string_view(declaration).find('2') != std::string::npos;
                    const bool four = std::string_view(declaration).find('4') != std::string::npos;
                    if (isUint) {
                        glm::uvec4 want = bits(p);
                        if (!four)
                            want = two ? glm::uvec4(want.x, want.y, 0, 1)
                                       : glm::uvec4(want.x, 0, 0, 1);
                        CHECK(uints.read<glm::uvec4>()(p) == want);
                    } else {
                        glm::vec4 want = numbers(p);
                        if (!four)
                            want =
                                two ? glm::vec4(want.x, want.y, 0, 1) : glm::vec4(want.x, 0, 0, 1);
                        CHECK(floats.read<glm::vec4>()(p) == want);
                    }
                }
        }
    };
    fetched("FloatTexture", "f1", {"f1", f1});
    fetched("Float2Texture", "f2", {"f2", f2});
    fetched("Float4Texture", "f4", {"f4", f4});
    fetched("UintTexture", "u1", {"u1", u1});
    fetched("Uint2Texture", "u2", {"u2", u2});
    fetched("Uint4Texture", "u4", {"u4", u4});
    fetched("Uint4Buffer", "texels", {"texels", texels});
    // 16-bit images are loaded as such whatever the shader's layout says, at least by llvmpipe, the
    // one driver for which FETCH_BY_IMAGE is chosen.
    if (glInfo(testContext()).softwareRasterizer)
        fetched("Float4Texture", "h4", {"h4", h4});
}

TEST_CASE("an image given to be written can be read in place, and a buffer of texels too") {
    testContext();
    const GlCheck check;
    ComputeProgram program = compile("twice.comp", R"(
layout(rgba32f) uniform image2D values;
layout(rgba32ui) uniform uimageBuffer texels;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(values))))
        return;
    imageStore(values, p, 2.0 * imageLoad(values, p));
    if (p.y == 0)
        imageStore(texels, p.x, imageLoad(texels, p.x) + 1u);
}
)");
    const Image<glm::vec4> input = randomImage(kOdd, 4);
    GpuTexture values("values", PixelFormat::RGBA32F, kOdd);
    values.write(input);
    TexelBuffer texels("texels", 0);
    texels.write(std::vector<glm::uvec4>(61, {1, 2, 3, 4}));
    for (int i = 0; i < 3; ++i)
        program.dispatch(kOdd, {}, {{"values", values}, {"texels", texels}});
    Image<glm::vec4> expected = input;
    for (glm::vec4& pixel : expected.pixels())
        pixel *= 8.0f;
    CHECK_CLOSE(values.read<glm::vec4>(), expected, Tolerance{});
    CHECK(texels.read<glm::uvec4>() == std::vector<glm::uvec4>(61, {4, 5, 6, 7}));
}

TEST_CASE("a buffer of floats is read through samplers and images, and written in place") {
    testContext();
    const GlCheck check;
    ComputeProgram program = compile("add.comp", R"(
uniform samplerBuffer ones;
layout(rgba32f) readonly uniform imageBuffer fours;
layout(r32f) uniform imageBuffer sums;
void main() {
    int i = int(gl_GlobalInvocationID.y) * 8 + int(gl_GlobalInvocationID.x);
    if (i >= imageSize(sums))
        return;
    float sum = imageLoad(sums, i).x + texelFetch(ones, i).x + imageLoad(fours, i / 4)[i % 4];
    imageStore(sums, i, vec4(sum));
}
)");
    TexelBuffer ones("ones", 0, PixelFormat::R32F), fours("fours", 0, PixelFormat::RGBA32F),
        sums("sums", 0, PixelFormat::R32F);
    std::vector<float> first(44), second(44), third(44), expected(44);
    for (int i = 0; i < 44; ++i) {
        first[i] = 0.25f * float(i) - 3.0f;
        second[i] = float(100 * i);
        third[i] = -0.5f * float(i);
        expected[i] = first[i] + second[i] + third[i];
    }
    ones.write(first);
    fours.write(second);
    sums.write(third);
    program.dispatch(glm::ivec2(8, 6), {{"ones", ones}, {"fours", fours}}, {{"sums", sums}});
    CHECK(sums.read<float>() == expected); // multiples of 1/4: exact
    CHECK(ones.read<float>() == first);

    TexelBuffer bits("bits", 44 * 4, PixelFormat::R32UI);
    GpuTexture picture("picture", PixelFormat::R32F, kOdd);
    const auto give = [&](const Binding& read, const Binding& written) {
        return messageOf<std::logic_error>([&] {
            program.dispatch(glm::ivec2(8, 6), {read, {"fours", fours}}, {written});
        });
    };
    CHECK(give({"ones", bits}, {"sums", sums}) == "add.comp declares ones as samplerBuffer, but "
                                                  "was given a buffer of texels of format R32UI");
    CHECK(give({"ones", ones}, {"sums", bits}) ==
          "add.comp declares sums as imageBuffer, but was given a buffer of texels of format "
          "R32UI");
    CHECK(give({"ones", picture}, {"sums", sums}) ==
          "add.comp declares ones as samplerBuffer, but was given a texture of format R32F");
    GpuTexture out("out", PixelFormat::RGBA32F, kOdd), guides("guides", PixelFormat::RG32F, kOdd);
    CHECK(messageOf<std::logic_error>([&] {
              compile("scale.comp", kScale)
                  .dispatch(kOdd, ScaleParams{}, {{"radiance", fours}, {"guides", guides}},
                            {{"scaled", out}});
          }) == "scale.comp declares radiance as sampler2D, but was given a buffer of texels of "
                "format RGBA32F");
}

TEST_CASE("a dispatch of three dimensions runs every thread once, at sizes that no group divides") {
    testContext();
    const GlCheck check;
    const std::string text = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(std140, binding = 1) uniform Params { ivec4 size; };
layout(r32ui) uniform uimageBuffer visits;
void main() {
    ivec3 p = ivec3(gl_GlobalInvocationID);
    if (all(lessThan(p, size.xyz)))
        imageAtomicAdd(visits, (p.z * size.y + p.y) * size.x + p.x, uint(1 + p.z));
}
)";
    ComputeProgram program("visits.comp", testShaders().source().expandText("visits.comp", text));
    CHECK(program.groupSize() == glm::ivec3(8, 4, 2));
    const auto visitsOf = [&](auto threads, glm::ivec3 size) {
        const std::size_t count = std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
        TexelBuffer visits("visits", count * 4, PixelFormat::R32UI);
        program.dispatch(threads, glm::ivec4(size, 0), {}, {{"visits", visits}});
        return visits.read<std::uint32_t>();
    };
    const glm::ivec3 size{13, 7, 5};
    std::vector<std::uint32_t> expected;
    for (std::uint32_t z = 0; z < 5; ++z)
        expected.insert(expected.end(), 13 * 7, 1 + z);
    CHECK(visitsOf(size, size) == expected);
    // Two dimensions are one layer of groups, which is two threads deep here.
    std::fill(expected.begin() + 2 * 13 * 7, expected.end(), 0u);
    CHECK(visitsOf(glm::ivec2(size), size) == expected);
}

TEST_CASE("the top of clip space is row 0, and depth runs from 0 to 1") {
    testContext();
    const GlCheck check;
    const ShaderSource& source = testShaders().source();
    RasterProgram program("half.vert + half.frag",
                          source.expandText("half.vert", R"(#version 450 core
layout(std140, binding = 1) uniform Params { vec4 lowest; };
uniform float depth;
void main() { // a triangle over all of the picture above y = lowest
    vec2 corner = vec2(gl_VertexID == 1 ? 5.0 : -1.0, gl_VertexID == 2 ? 5.0 + lowest.y : lowest.y);
    gl_Position = vec4(corner, depth, 1.0);
}
)"),
                          source.expandText("half.frag", R"(#version 450 core
layout(location = 0) out uvec2 id;
uniform uint mark;
void main() { id = uvec2(mark, uint(gl_FragCoord.y)); }
)"));
    const glm::ivec2 size{6, 10};
    const GpuTexture ids("ids", PixelFormat::RG32UI, size),
        depth("depth", PixelFormat::Depth32F, size);
    const Framebuffer framebuffer("half", {&ids}, &depth);
    framebuffer.bind();
    framebuffer.clearColor(0, glm::uvec4(0));
    framebuffer.clearDepth(1.0f);
    const auto vertices = GlObject<VertexArrayKind>::create("none");
    glBindVertexArray(vertices.id());
    glEnable(GL_DEPTH_TEST);
    program.use(glm::vec4(0.0f));
    program.set("depth", 0.25f);
    program.set("mark", std::uint32_t(7));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_DEPTH_TEST);
    CHECK(messageOf<std::logic_error>([&] { program.set("dept", 1.0f); }) ==
          "half.vert + half.frag has no uniform named dept");

    const auto drawn = ids.read<glm::uvec2>();
    const auto depths = depth.read<float>();
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const bool covered = y < size.y / 2; // the upper half of clip space
            CHECK(drawn({x, y}) == (covered ? glm::uvec2(7, y) : glm::uvec2(0)));
            CHECK(depths({x, y}) == (covered ? 0.25f : 1.0f));
        }
}

TEST_CASE("a probe maps an expression over its inputs") {
    const GlCheck check;
    std::vector<glm::vec4> inputs, expected;
    for (int i = 0; i < 1000; ++i) {
        inputs.emplace_back(i, 0.5f * float(i), -i, 1);
        expected.emplace_back(2 * i, i, -2 * i, 2 + i);
    }
    CHECK_CLOSE(probe({}, "2.0 * x + vec4(0, 0, 0, i)", inputs), expected, Tolerance{});
    CHECK(messageOf<Error>([&] { probe({}, "nothing(x)", inputs); }).find("nothing") !=
          std::string::npos);
}
