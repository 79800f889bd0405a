// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/gpu_timer.h"
#include "renderer/gl/texture.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/message_of.h"

#include <array>
#include <bit>
#include <random>

#include <doctest/doctest.h>
#include <glm/gtc/type_precision.hpp>

using namespace afterglow;

namespace {

constexpr glm::ivec2 kOdd{61, 37};

template <class Pixel>
Image<Pixel> randomBits(glm::ivec2 size) {
    std::mt19937 random(5);
    Image<Pixel> image(size);
    for (std::byte& byte : std::as_writable_bytes(image.pixels()))
        byte = std::byte(random());
    return image;
}

template <class Pixel>
bool sameBits(const Image<Pixel>& a, const Image<Pixel>& b) {
    return a.size() == b.size() &&
           std::ranges::equal(std::as_bytes(a.pixels()), std::as_bytes(b.pixels()));
}

template <class Pixel>
void checkRoundTrip(PixelFormat format, const Image<Pixel>& image) {
    CAPTURE(info(format).name);
    const GlCheck check;
    GpuTexture texture("round trip", format, image.size());
    texture.write(image);
    CHECK(sameBits(texture.read<Pixel>(), image));
    texture.clear();
    CHECK(sameBits(texture.read<Pixel>(), Image<Pixel>(image.size(), Pixel(0))));
}

/// Numbers from 0 to 1 of which every one is exact in 16 bits.
template <class Pixel>
Image<Pixel> exactHalves(glm::ivec2 size) {
    std::mt19937 random(6);
    Image<Pixel> image(size);
    auto* numbers = reinterpret_cast<float*>(image.pixels().data());
    for (std::size_t i = 0; i < image.pixels().size_bytes() / sizeof(float); ++i)
        numbers[i] = float(random() % 1025) / 1024.0f;
    return image;
}

} // namespace

TEST_CASE("what is written to a texture of any format is read back, bit by bit") {
    testContext();
    checkRoundTrip(PixelFormat::R32F, exactHalves<float>(kOdd));
    checkRoundTrip(PixelFormat::RG32F, exactHalves<glm::vec2>(kOdd));
    checkRoundTrip(PixelFormat::RGBA32F, exactHalves<glm::vec4>(kOdd));
    checkRoundTrip(PixelFormat::RGBA16F, exactHalves<glm::vec4>(kOdd));
    checkRoundTrip(PixelFormat::R32UI, randomBits<std::uint32_t>(kOdd));
    checkRoundTrip(PixelFormat::RG32UI, randomBits<glm::uvec2>(kOdd));
    checkRoundTrip(PixelFormat::RGBA32UI, randomBits<glm::uvec4>(kOdd));
    checkRoundTrip(PixelFormat::RGBA8, randomBits<glm::u8vec4>(kOdd));
    checkRoundTrip(PixelFormat::SRGBA8, randomBits<glm::u8vec4>(kOdd));
    checkRoundTrip(PixelFormat::Depth32F, exactHalves<float>(kOdd));
}

TEST_CASE("a texture knows its bytes, and what it is made of") {
    testContext();
    const GpuTexture texture("a label", PixelFormat::RG32UI, kOdd);
    CHECK(texture.bytes() == 61u * 37u * 8u);
    CHECK(texture.size() == kOdd);
    CHECK(texture.format() == PixelFormat::RG32UI);
    std::array<char, 32> label{};
    glGetObjectLabel(GL_TEXTURE, texture.id(), GLsizei(label.size()), nullptr, label.data());
    CHECK(std::string(label.data()) == "a label");
}

TEST_CASE("pixels that a texture cannot hold are refused") {
    testContext();
    GpuTexture texture("slope", PixelFormat::RG32F, kOdd);
    CHECK(messageOf<std::logic_error>([&] { texture.write(Image<glm::vec4>(kOdd)); }) ==
          "texture slope is RG32F, which does not hold pixels of type vec4");
    CHECK(messageOf<std::logic_error>([&] { texture.read<glm::uvec2>(); }) ==
          "texture slope is RG32F, which does not hold pixels of type uvec2");
    CHECK(messageOf<std::logic_error>([&] {
              texture.write(Image<glm::vec2>({37, 61}));
          }) == "texture slope is 61 x 37 pixels, but was given 37 x 61");
    CHECK(messageOf<std::logic_error>([&] {
              GpuTexture("none", PixelFormat::R32F, {0, 4});
          }) == "texture none would be 0 x 4 pixels");
}

TEST_CASE(
    "a texture that is moved from holds nothing; one that is assigned to lets go of the old") {
    testContext();
    GpuTexture a("a", PixelFormat::R32F, kOdd), b("b", PixelFormat::R32F, kOdd);
    const GLuint idOfA = a.id(), idOfB = b.id();
    b = std::move(a);
    CHECK(a.id() == 0);
    CHECK(b.id() == idOfA);
    CHECK(glIsTexture(idOfA) == GL_TRUE);
    CHECK(glIsTexture(idOfB) == GL_FALSE);
    b = GpuTexture();
    CHECK(glIsTexture(idOfA) == GL_FALSE);
}

TEST_CASE("a buffer is zero at first, keeps what is written, and refuses too much") {
    testContext();
    const GlCheck check;
    GpuBuffer buffer("numbers", 5 * sizeof(std::uint32_t));
    CHECK(buffer.read<std::uint32_t>() == std::vector<std::uint32_t>(5, 0u));
    buffer.write(std::vector<std::uint32_t>{1, 2, 3});
    buffer.write(std::array<std::uint32_t, 1>{9}, 4 * sizeof(std::uint32_t));
    CHECK(buffer.read<std::uint32_t>() == std::vector<std::uint32_t>{1, 2, 3, 0, 9});
    CHECK(messageOf<std::logic_error>([&] { buffer.write(std::vector<std::uint32_t>(5), 4); }) ==
          "buffer numbers has 20 bytes, but 20 were given for offset 4");
    CHECK(GpuBuffer().empty());
    CHECK(GpuBuffer("nothing", 0).empty());
}

TEST_CASE("a buffer of texels grows with what is written") {
    testContext();
    const GlCheck check;
    TexelBuffer buffer("texels", 20);
    CHECK(buffer.bytes() == 32); // whole texels
    const std::vector<glm::uvec4> few{{1, 2, 3, 4}}, many(100, {5, 6, 7, 8});
    buffer.write(few);
    CHECK(buffer.bytes() == 32);
    CHECK(buffer.read<glm::uvec4>().front() == few.front());
    buffer.write(std::span(many));
    CHECK(buffer.read<glm::uvec4>() == many);
    GLint texels = 0;
    glGetTextureLevelParameteriv(buffer.texture(), 0, GL_TEXTURE_WIDTH, &texels);
    CHECK(texels == 100);
    CHECK(TexelBuffer("empty", 0).bytes() == 16);
}

TEST_CASE("a buffer of texels has its format, and takes only values that are whole texels") {
    testContext();
    const GlCheck check;
    for (const auto& [format, internal] : {std::pair{PixelFormat::RGBA32UI, GL_RGBA32UI},
                                           {PixelFormat::RGBA32F, GL_RGBA32F},
                                           {PixelFormat::RG32F, GL_RG32F},
                                           {PixelFormat::R32F, GL_R32F},
                                           {PixelFormat::R32UI, GL_R32UI}}) {
        CAPTURE(info(format).name);
        TexelBuffer buffer("weights", 0, format);
        CHECK(buffer.format() == format);
        CHECK(buffer.bytes() == std::size_t(info(format).bytes));
        const std::vector<float> numbers{1, 2, 3, 4, 5, 6, 7, 8};
        buffer.write(numbers); // grows, and keeps its format
        CHECK(buffer.read<float>() == numbers);
        CHECK(buffer.format() == format);
        GLint found = 0, texels = 0;
        glGetTextureLevelParameteriv(buffer.texture(), 0, GL_TEXTURE_INTERNAL_FORMAT, &found);
        glGetTextureLevelParameteriv(buffer.texture(), 0, GL_TEXTURE_WIDTH, &texels);
        CHECK(found == GLint(internal));
        CHECK(texels == 32 / info(format).bytes);
    }
    TexelBuffer fours("fours", 64, PixelFormat::RGBA32F), ones("ones", 64, PixelFormat::R32F);
    CHECK(messageOf<std::logic_error>([&] { fours.write(std::vector<float>(5)); }) ==
          "buffer fours has texels of 16 bytes, but was given 5 values of 4");
    CHECK(messageOf<std::logic_error>([&] { // whole texels, but records of which none is
              fours.write(std::vector<std::array<float, 6>>(2));
          }) == "buffer fours has texels of 16 bytes, but was given 2 values of 24");
    CHECK_NOTHROW(ones.write(std::vector<float>(5)));
    CHECK_NOTHROW(ones.write(std::vector<std::array<float, 6>>(1)));
    for (const PixelFormat format :
         {PixelFormat::Depth32F, PixelFormat::SRGBA8, PixelFormat::RGBA8, PixelFormat::RGBA16F})
        CHECK(messageOf<std::logic_error>([&] { TexelBuffer("none", 16, format); }) ==
              "buffer none cannot have texels of format " + std::string(info(format).name));
}

TEST_CASE("more texels than the driver addresses are an error that says how many") {
    testContext();
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    CHECK_THROWS_WITH_AS(TexelBuffer("huge", (std::size_t(most) + 1) * 16),
                         ("buffer huge needs " + std::to_string(std::size_t(most) + 1) +
                          " texels; this driver addresses " + std::to_string(most))
                             .c_str(),
                         Error);
}

TEST_CASE("a framebuffer clears its attachments, each in its own type") {
    testContext();
    const GlCheck check;
    const GpuTexture ids("ids", PixelFormat::RG32UI, kOdd),
        light("light", PixelFormat::RGBA32F, kOdd);
    const GpuTexture depth("depth", PixelFormat::Depth32F, kOdd);
    const Framebuffer framebuffer("visibility", {&ids, &light}, &depth);
    framebuffer.bind();
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    CHECK(viewport == std::array<GLint, 4>{0, 0, kOdd.x, kOdd.y});
    framebuffer.clearColor(0, glm::uvec4(7, 0xffffffffu, 0, 0));
    framebuffer.clearColor(1, glm::vec4(0.5f, 2.0f, -1.0f, 1.0f));
    framebuffer.clearDepth(0.25f);
    CHECK(sameBits(ids.read<glm::uvec2>(), Image<glm::uvec2>(kOdd, {7, 0xffffffffu})));
    CHECK_CLOSE(light.read<glm::vec4>(), Image<glm::vec4>(kOdd, {0.5f, 2.0f, -1.0f, 1.0f}),
                Tolerance{});
    CHECK_CLOSE(depth.read<float>(), Image<float>(kOdd, 0.25f), Tolerance{});
}

TEST_CASE("attachments that do not go together are named by the driver's status") {
    testContext();
    const GpuTexture color("color", PixelFormat::RGBA8, kOdd),
        small("small", PixelFormat::RGBA8, {4, 4});
    CHECK_THROWS_WITH_AS(Framebuffer("wrong", {&color}, &color),
                         "framebuffer wrong is not complete: GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT",
                         Error);
    CHECK_THROWS_WITH_AS(
        Framebuffer("none", {}),
        "framebuffer none is not complete: GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT", Error);
    CHECK(messageOf<std::logic_error>([&] {
              Framebuffer("sizes", {&color, &small});
          }) == "framebuffer sizes: small is not of the size of the others");
}
