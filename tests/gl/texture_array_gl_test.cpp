// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/program.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/message_of.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

constexpr glm::ivec2 kOdd{61, 37};
constexpr int kLayers = 3;

ComputeProgram compile(std::string_view name, const std::string& body) {
    return ComputeProgram(name, testShaders().source().expandText(
                                    name, "#version 450 core\n"
                                          "layout(local_size_x = 8, local_size_y = 4) in;\n" +
                                              body));
}

template <class Pixel>
Image<Pixel> randomBits(glm::ivec2 size, int seed) {
    std::mt19937 random{unsigned(seed)};
    Image<Pixel> image(size);
    for (std::byte& byte : std::as_writable_bytes(image.pixels()))
        byte = std::byte(random());
    return image;
}

/// Multiples of 1/1024 from 0 to 1.
Image<glm::vec4> randomNumbers(glm::ivec2 size, int seed) {
    std::mt19937 random{unsigned(seed)};
    Image<glm::vec4> image(size);
    for (glm::vec4& pixel : image.pixels())
        for (int i = 0; i < 4; ++i)
            pixel[i] = float(random() % 1025) / 1024.0f;
    return image;
}

template <class Pixel>
bool sameBits(const Image<Pixel>& a, const Image<Pixel>& b) {
    return a.size() == b.size() &&
           std::ranges::equal(std::as_bytes(a.pixels()), std::as_bytes(b.pixels()));
}

/// The image of half the size, by averages of 2 x 2 pixels. Both sides are even.
Image<glm::vec4> halved(const Image<glm::vec4>& image) {
    Image<glm::vec4> half(image.size() / 2);
    for (int y = 0; y < half.size().y; ++y)
        for (int x = 0; x < half.size().x; ++x) {
            const glm::ivec2 p{2 * x, 2 * y};
            half({x, y}) = 0.25f * (image(p) + image(p + glm::ivec2(1, 0)) +
                                    image(p + glm::ivec2(0, 1)) + image(p + glm::ivec2(1, 1)));
        }
    return half;
}

/// The texel that stands at index i of a line of n texels which has no end.
int wrapped(TextureWrap wrap, int i, int n) {
    if (wrap == TextureWrap::Clamp)
        return glm::clamp(i, 0, n - 1);
    const int period = wrap == TextureWrap::Repeat ? n : 2 * n;
    const int inside = ((i % period) + period) % period;
    return inside < n ? inside : 2 * n - 1 - inside;
}

/// Returns the value of one level at uv by OpenGL 4.5, section 8.14.
glm::vec4 sampledLevel(const Image<glm::vec4>& level, const TextureSampling& how, glm::vec2 uv) {
    const glm::vec2 p = uv * glm::vec2(level.size());
    const auto texel = [&](int x, int y) {
        return level(
            {wrapped(how.wrapX, x, level.size().x), wrapped(how.wrapY, y, level.size().y)});
    };
    if (how.filter == TextureFilter::Nearest)
        return texel(int(std::floor(p.x)), int(std::floor(p.y)));
    const glm::vec2 corner = glm::floor(p - 0.5f), weight = p - 0.5f - corner;
    const int x = int(corner.x), y = int(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), weight.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), weight.x), weight.y);
}

glm::vec4 sampled(const std::vector<Image<glm::vec4>>& levels, const TextureSampling& how,
                  glm::vec2 uv, float lod) {
    const int last = int(levels.size()) - 1;
    const float inside = glm::clamp(lod, 0.0f, float(last));
    if (how.filter == TextureFilter::Nearest)
        return sampledLevel(levels[std::size_t(std::lround(inside))], how, uv);
    const int level = int(inside), next = std::min(level + 1, last);
    return glm::mix(sampledLevel(levels[std::size_t(level)], how, uv),
                    sampledLevel(levels[std::size_t(next)], how, uv), inside - float(level));
}

template <class Pixel>
void checkLayersAreApart(PixelFormat format) {
    CAPTURE(info(format).name);
    const GlCheck check;
    GpuTextureArray array("layers", format, kOdd, kLayers);
    array.clear();
    for (const int layer : {2, 0})
        array.write(layer, randomBits<Pixel>(kOdd, layer));
    CHECK(sameBits(array.read<Pixel>(0), randomBits<Pixel>(kOdd, 0)));
    CHECK(sameBits(array.read<Pixel>(1), Image<Pixel>(kOdd, Pixel(0))));
    CHECK(sameBits(array.read<Pixel>(2), randomBits<Pixel>(kOdd, 2)));
}

} // namespace

TEST_CASE("a layer of an array holds what was written to it, and no other layer does") {
    testContext();
    checkLayersAreApart<glm::u8vec4>(PixelFormat::RGBA8);
    checkLayersAreApart<glm::u8vec4>(PixelFormat::SRGBA8);
    checkLayersAreApart<std::uint32_t>(PixelFormat::R32UI);
    checkLayersAreApart<glm::uvec4>(PixelFormat::RGBA32UI);
}

TEST_CASE("an array knows its levels, and its bytes over all of them") {
    testContext();
    const GlCheck check;
    CHECK(mipLevels({1, 1}) == 1);
    CHECK(mipLevels({2, 1}) == 2);
    CHECK(mipLevels({61, 37}) == 6);
    CHECK(mipLevels({5, 64}) == 7);
    const GpuTextureArray array("array", PixelFormat::RGBA8, kOdd, kLayers, mipLevels(kOdd));
    CHECK(array.levels() == 6);
    CHECK(array.layers() == kLayers);
    std::size_t pixels = 0;
    for (int level = 0; level < 6; ++level) {
        glm::ivec3 found{0};
        glGetTextureLevelParameteriv(array.id(), level, GL_TEXTURE_WIDTH, &found.x);
        glGetTextureLevelParameteriv(array.id(), level, GL_TEXTURE_HEIGHT, &found.y);
        glGetTextureLevelParameteriv(array.id(), level, GL_TEXTURE_DEPTH, &found.z);
        CHECK(found == glm::ivec3(array.sizeOf(level), kLayers));
        pixels += std::size_t(found.x * found.y * found.z);
    }
    CHECK(array.bytes() == 4 * pixels);
    CHECK(GpuTextureArray("one", PixelFormat::RGBA32F, kOdd, 2).bytes() == 61u * 37u * 2u * 16u);
}

TEST_CASE("each level is the average of the one before, layer by layer, and sRGB averages light") {
    testContext();
    const GlCheck check;
    const glm::ivec2 size{16, 4};
    GpuTextureArray array("mips", PixelFormat::RGBA32F, size, kLayers, 3);
    array.clear();
    for (int layer = 0; layer < kLayers; ++layer)
        array.write(layer, randomNumbers(size, layer));
    array.makeMips();
    for (int layer = 0; layer < kLayers; ++layer) {
        CAPTURE(layer);
        const Image<glm::vec4> half = halved(randomNumbers(size, layer));
        // Rounding of sums of four numbers.
        CHECK_CLOSE(array.read<glm::vec4>(layer, 1), half, Tolerance{.max = 1e-6});
        CHECK_CLOSE(array.read<glm::vec4>(layer, 2), halved(half), Tolerance{.max = 1e-6});
    }

    Image<glm::u8vec4> checker({8, 8});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            checker({x, y}) = (x + y) % 2 ? glm::u8vec4(255) : glm::u8vec4(0);
    for (const auto& [format, gray] :
         {std::pair{PixelFormat::RGBA8, 128}, std::pair{PixelFormat::SRGBA8, 188}}) {
        CAPTURE(info(format).name);
        GpuTextureArray colors("colors", format, {8, 8}, 1, 2);
        colors.write(0, checker);
        colors.makeMips();
        const Image<glm::u8vec4> averages = colors.read<glm::u8vec4>(0, 1);
        for (const glm::u8vec4& pixel : averages.pixels()) {
            CHECK(std::abs(int(pixel.r) - gray) <= 1); // half of the light is 187.5 in sRGB
            CHECK(std::abs(int(pixel.a) - 128) <= 1);  // the fourth number is linear in both
        }
    }
}

TEST_CASE("samplers find layer, level and texel as OpenGL says, however they wrap and filter") {
    testContext();
    const GlCheck check;
    const glm::ivec2 size{8, 4};
    GpuTextureArray array("sampled", PixelFormat::RGBA32F, size, kLayers, 3);
    std::vector<std::vector<Image<glm::vec4>>> layers;
    for (int layer = 0; layer < kLayers; ++layer) {
        array.write(layer, randomNumbers(size, layer));
        layers.push_back({randomNumbers(size, layer)});
    }
    array.makeMips();
    for (int layer = 0; layer < kLayers; ++layer)
        for (int level = 1; level < 3; ++level)
            layers[std::size_t(layer)].push_back(array.read<glm::vec4>(layer, level));

    // From two pictures to the left to two to the right, at eighths between texels: never on an
    // edge, and at weights that 8 bits hold.
    ComputeProgram program = compile("sample.comp", R"(
layout(std140, binding = 1) uniform Params { vec4 layerAndLod; };
uniform sampler2DArray pictures;
uniform writeonly image2D result;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    vec2 uv = (0.25 * vec2(p) + 0.125) / vec2(8.0, 4.0) - 2.0;
    imageStore(result, p, textureLod(pictures, vec3(uv, layerAndLod.x), layerAndLod.y));
}
)");
    const glm::ivec2 positions{5 * 8 * 4, 5 * 4 * 4};
    GpuTexture result("result", PixelFormat::RGBA32F, positions);
    using enum TextureWrap;
    for (const TextureSampling& how : {TextureSampling{},
                                       {TextureFilter::Nearest, Repeat, MirroredRepeat},
                                       {TextureFilter::Trilinear, Clamp, Clamp},
                                       {TextureFilter::Trilinear, Repeat, Clamp},
                                       {TextureFilter::Trilinear, MirroredRepeat, Repeat}})
        for (const auto& [layer, lod] :
             {std::pair{0, 0.0f}, {2, 0.25f}, {1, 1.0f}, {1, 1.75f}, {0, 7.0f}}) {
            CAPTURE(int(how.filter));
            CAPTURE(int(how.wrapX));
            CAPTURE(int(how.wrapY));
            CAPTURE(layer);
            CAPTURE(lod);
            array.setSampling(how);
            program.dispatch(positions, glm::vec4(layer, lod, 0, 0), {{"pictures", array}},
                             {{"result", result}});
            Image<glm::vec4> expected(positions);
            for (int y = 0; y < positions.y; ++y)
                for (int x = 0; x < positions.x; ++x)
                    expected({x, y}) =
                        sampled(layers[std::size_t(layer)], how,
                                (0.25f * glm::vec2(x, y) + 0.125f) / glm::vec2(size) - 2.0f, lod);
            // llvmpipe is exact; the tolerance is for GPUs, which weigh with 8 bits.
            CHECK_CLOSE(result.read<glm::vec4>(), expected, Tolerance{.max = 4e-3});
        }
}

TEST_CASE("samplers decode what an sRGB array holds, and an image has all layers of its array") {
    testContext();
    const GlCheck check;
    GpuTextureArray colors("colors", PixelFormat::SRGBA8, {8, 4}, 2),
        bits("bits", PixelFormat::R32UI, {8, 4}, 2), out("out", PixelFormat::RGBA32F, {8, 4}, 2),
        sums("sums", PixelFormat::R32UI, {8, 4}, 2);
    for (int layer = 0; layer < 2; ++layer) {
        colors.write(layer, Image<glm::u8vec4>({8, 4}, glm::u8vec4(188 * layer)));
        bits.write(layer, randomBits<std::uint32_t>({8, 4}, layer));
        sums.write(layer, Image<std::uint32_t>({8, 4}, std::uint32_t(layer)));
    }
    ComputeProgram program = compile("layers.comp", R"(
uniform sampler2DArray colors;
uniform usampler2DArray bits;
layout(r32ui) readonly uniform uimage2DArray sameBits;
uniform writeonly image2DArray result;
layout(r32ui) uniform uimage2DArray sums;
void main() {
    ivec3 p = ivec3(gl_GlobalInvocationID);
    imageStore(result, p, texelFetch(colors, p, 0));
    uint sum = texelFetch(bits, p, 0).x + imageLoad(sameBits, p).x + imageLoad(sums, p).x;
    imageStore(sums, p, uvec4(sum));
}
)");
    program.dispatch(glm::ivec3(8, 4, 2), {{"colors", colors}, {"bits", bits}, {"sameBits", bits}},
                     {{"result", out}, {"sums", sums}});
    for (int layer = 0; layer < 2; ++layer) {
        CAPTURE(layer);
        const double encoded = 188.0 * layer / 255.0;
        const auto light = float(layer ? std::pow((encoded + 0.055) / 1.055, 2.4) : 0.0);
        // Drivers may be off by half a step of 8 bits: llvmpipe is, by 7e-4.
        CHECK_CLOSE(out.read<glm::vec4>(layer),
                    Image<glm::vec4>({8, 4}, {light, light, light, float(encoded)}),
                    Tolerance{.max = 2e-3});
        Image<std::uint32_t> expected = randomBits<std::uint32_t>({8, 4}, layer);
        for (std::uint32_t& number : expected.pixels())
            number = 2 * number + std::uint32_t(layer);
        CHECK(sameBits(sums.read<std::uint32_t>(layer), expected));
    }
}

TEST_CASE("an array refuses what it cannot hold or be, and programs refuse one for a texture") {
    testContext();
    const GlCheck check;
    GpuTextureArray array("colors", PixelFormat::RGBA8, kOdd, kLayers, 2);
    const auto made = [](glm::ivec2 size, int layers, int levels) {
        return messageOf<std::logic_error>(
            [&] { GpuTextureArray("none", PixelFormat::R32F, size, layers, levels); });
    };
    CHECK(made({4, 4}, 0, 1) == "texture none would be 0 layers of 4 x 4 pixels");
    CHECK(made({0, 4}, 1, 1) == "texture none would be 1 layers of 0 x 4 pixels");
    CHECK(made({4, 4}, 1, 4) == "texture none of 4 x 4 pixels cannot have 4 levels");
    CHECK(made({4, 4}, 1, 0) == "texture none of 4 x 4 pixels cannot have 0 levels");
    CHECK(made({4, 4}, 1, 3) == "");
    CHECK(messageOf<std::logic_error>([&] { array.write(0, Image<float>(kOdd)); }) ==
          "texture colors is RGBA8, which does not hold pixels of type float");
    CHECK(messageOf<std::logic_error>([&] {
              array.write(0, Image<glm::u8vec4>({37, 61}));
          }) == "texture colors is 61 x 37 pixels, but was given 37 x 61");
    CHECK(messageOf<std::logic_error>([&] { array.write(3, Image<glm::u8vec4>(kOdd)); }) ==
          "texture colors has 3 layers, but was asked for layer 3");
    CHECK(messageOf<std::logic_error>([&] { array.read<glm::u8vec4>(-1); }) ==
          "texture colors has 3 layers, but was asked for layer -1");
    CHECK(messageOf<std::logic_error>([&] { array.read<glm::u8vec4>(0, 2); }) ==
          "texture colors has 2 levels, but was asked for level 2");
    GpuTextureArray bits("bits", PixelFormat::R32UI, kOdd, 1, 2);
    CHECK(messageOf<std::logic_error>([&] { bits.makeMips(); }) ==
          "texture bits is R32UI, of which there are no averages");
    CHECK(messageOf<std::logic_error>([&] {
              bits.setSampling({.filter = TextureFilter::Trilinear});
          }) == "texture bits is R32UI, of which there are no averages");

    GLint most = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    std::string error;
    try {
        GpuTextureArray("many", PixelFormat::R32F, {1, 1}, most + 1);
    } catch (const Error& thrown) {
        error = thrown.what();
    }
    CHECK(error.starts_with("texture many needs " + std::to_string(most + 1) +
                            " layers of 1 x 1 pixels; this driver has textures of " +
                            std::to_string(most) + " layers and "));

    ComputeProgram program = compile("copy.comp", R"(
uniform sampler2D picture;
uniform sampler2DArray pictures;
uniform writeonly image2DArray result;
void main() {
    ivec3 p = ivec3(gl_GlobalInvocationID);
    imageStore(result, p, texelFetch(picture, p.xy, 0) + texelFetch(pictures, p, 0));
}
)");
    GpuTexture picture("picture", PixelFormat::RGBA8, kOdd);
    GpuTextureArray encoded("encoded", PixelFormat::SRGBA8, kOdd, 1);
    const auto given = [&](const Binding& one, const Binding& many, const Binding& written) {
        return messageOf<std::logic_error>([&] { program.dispatch(kOdd, {one, many}, {written}); });
    };
    const Binding one("picture", picture), many("pictures", array), written("result", array);
    CHECK(given({"picture", array}, many, written) ==
          "copy.comp declares picture as sampler2D, but was given an array of textures of format "
          "RGBA8");
    CHECK(given(one, {"pictures", picture}, written) ==
          "copy.comp declares pictures as sampler2DArray, but was given a texture of format RGBA8");
    CHECK(given(one, {"pictures", bits}, written) ==
          "copy.comp declares pictures as sampler2DArray, but was given an array of textures of "
          "format R32UI");
    CHECK(given(one, many, {"result", encoded}) ==
          "copy.comp declares result as image2DArray, but was given an array of textures of format "
          "SRGBA8");
    CHECK(given(one, many, {"result", picture}) ==
          "copy.comp declares result as image2DArray, but was given a texture of format RGBA8");
    CHECK(given(one, {"pictures", GpuTextureArray()}, written) ==
          "copy.comp was given nothing as pictures: the texture was never made");
}
