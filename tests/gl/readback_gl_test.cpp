// SPDX-License-Identifier: MIT
#include "renderer/gl/readback.h"
#include "tests/support/gl_fixture.h"

#include <array>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

constexpr glm::ivec2 kSize{61, 37};

template <class Pixel>
Image<Pixel> randomImage(glm::ivec2 size, unsigned seed) {
    Image<Pixel> image(size);
    std::mt19937 engine(seed);
    const auto bytes = std::as_writable_bytes(image.pixels());
    for (std::byte& byte : bytes)
        byte = std::byte(engine() >> 24);
    return image;
}

// Numbers that 16 bits hold, too.
template <class Pixel>
requires std::is_same_v<Pixel, float> || std::is_same_v<Pixel, glm::vec2> ||
    std::is_same_v<Pixel, glm::vec4>
        Image<Pixel> randomImage(glm::ivec2 size, unsigned seed) {
    Image<Pixel> image(size);
    std::mt19937 engine(seed);
    for (Pixel& pixel : image.pixels()) {
        float numbers[4];
        for (float& number : numbers)
            number = float(int(engine() % 2048) - 1024) / 64.0f;
        std::memcpy(&pixel, numbers, sizeof pixel);
    }
    return image;
}

template <class Pixel>
bool isSame(std::span<const Pixel> row, const Image<Pixel>& image, glm::ivec2 min,
            glm::ivec2 size) {
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (std::memcmp(&row[std::size_t(y * size.x + x)], &image(min + glm::ivec2(x, y)),
                            sizeof(Pixel)) != 0)
                return false;
    return true;
}

template <class Pixel>
void checkFormat(PixelFormat format) {
    CAPTURE(info(format).name);
    const auto before = randomImage<Pixel>(kSize, 1), after = randomImage<Pixel>(kSize, 2);
    GpuTexture texture("texture", format, kSize);
    texture.write(before);
    PixelReadback readback;
    const auto part = readback.add<Pixel>(texture, {5, 3}, {7, 30});
    const auto all = readback.add<Pixel>(texture, {0, 0}, kSize);
    texture.write(after);
    const auto later = readback.add<Pixel>(texture, {60, 36});
    readback.submit();
    texture.clear();
    readback.finish();
    CHECK(isSame(readback.pixels(part), before, {5, 3}, {7, 30}));
    CHECK(isSame(readback.pixels(all), before, {0, 0}, kSize));
    CHECK(isSame(readback.pixels(later), after, {60, 36}, {1, 1}));
    const Pixel corner = readback.pixel(part, {6, 29});
    CHECK(std::memcmp(&corner, &before({11, 32}), sizeof corner) == 0);
}

} // namespace

TEST_CASE("pixels that are read back are those of the moment in which they were asked for") {
    testContext();
    const GlCheck check;
    checkFormat<float>(PixelFormat::R32F);
    checkFormat<glm::vec2>(PixelFormat::RG32F);
    checkFormat<glm::vec4>(PixelFormat::RGBA32F);
    checkFormat<glm::vec4>(PixelFormat::RGBA16F);
    checkFormat<std::uint32_t>(PixelFormat::R32UI);
    checkFormat<glm::uvec2>(PixelFormat::RG32UI);
    checkFormat<glm::uvec4>(PixelFormat::RGBA32UI);
    checkFormat<glm::u8vec4>(PixelFormat::RGBA8);
}

TEST_CASE("a batch of any size is read back whole, and so is the next one in its place") {
    testContext();
    const GlCheck check;
    PixelReadback readback;
    for (const int count : {1, 700, 3, 2000}) {
        std::vector<Image<glm::uvec4>> images;
        for (unsigned i = 0; i < 5; ++i)
            images.push_back(randomImage<glm::uvec4>({9, 5}, unsigned(count) + i));
        GpuTexture texture("texture", PixelFormat::RGBA32UI, {9, 5});
        std::vector<PixelReadback::Region<glm::uvec4>> regions;
        for (int i = 0; i < count; ++i) {
            if (i % 400 == 0)
                texture.write(images[std::size_t(i / 400)]);
            regions.push_back(readback.add<glm::uvec4>(texture, {i % 8, i % 3}, {2, 3}));
        }
        readback.finish();
        int same = 0;
        for (int i = 0; i < count; ++i)
            same += isSame(readback.pixels(regions[std::size_t(i)]), images[std::size_t(i / 400)],
                           {i % 8, i % 3}, {2, 3});
        CHECK(same == count);
        readback.clear();
        CHECK(readback.empty());
    }
    // One that nobody has waited for.
    GpuTexture texture("texture", PixelFormat::R32F, {1, 1});
    texture.clear();
    readback.add<float>(texture, {0, 0});
    readback.submit();
    readback.clear();
    const auto image = randomImage<float>({1, 1}, 3);
    texture.write(image);
    const auto region = readback.add<float>(texture, {0, 0});
    readback.finish();
    CHECK(readback.pixel(region) == image({0, 0}));
}

TEST_CASE("numbers that are none are read back as they are") {
    testContext();
    const GlCheck check;
    using Limits = std::numeric_limits<float>;
    Image<glm::vec4> image({1, 1});
    image({0, 0}) = {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), 3e38f};
    GpuTexture texture("texture", PixelFormat::RGBA32F, {1, 1});
    texture.write(image);
    PixelReadback readback;
    const auto region = readback.add<glm::vec4>(texture, {0, 0});
    readback.finish();
    const glm::vec4 read = readback.pixel(region);
    CHECK(std::isnan(read.x));
    CHECK(read.y == Limits::infinity());
    CHECK(read.z == -Limits::infinity());
    CHECK(read.w == 3e38f);
}

TEST_CASE("the value of a buffer is read back as it was when it was asked for") {
    testContext();
    const GlCheck check;
    struct Pair {
        glm::vec4 a;
        glm::ivec2 b, c;
    };
    GpuBuffer buffer("buffer", sizeof(Pair));
    const Pair before{{1, 2, 3, 4}, {5, 6}, {7, 8}}, after{};
    buffer.write(std::array{before});
    PixelReadback readback;
    const auto region = readback.add<Pair>(buffer);
    buffer.write(std::array{after});
    readback.finish();
    CHECK(std::memcmp(&readback.pixels(region)[0], &before, sizeof(Pair)) == 0);
    CHECK_THROWS_AS(readback.add<Pair>(buffer), std::logic_error);
    readback.clear();
    CHECK_THROWS_AS(readback.add<glm::mat4>(buffer), std::logic_error);
}

TEST_CASE("what cannot be read back is refused, and so is reading too early") {
    testContext();
    const GlCheck check;
    const GpuTexture floats("floats", PixelFormat::RGBA32F, kSize);
    const GpuTexture depth("depth", PixelFormat::Depth32F, kSize);
    PixelReadback readback;
    readback.finish(); // of nothing
    CHECK_THROWS_AS(readback.add<glm::vec2>(floats, {0, 0}), std::logic_error);
    CHECK_THROWS_AS(readback.add<glm::uvec4>(floats, {0, 0}), std::logic_error);
    CHECK_THROWS_AS(readback.add<float>(depth, {0, 0}), std::logic_error);
    for (const glm::ivec2 min : {glm::ivec2(-1, 0), {0, -1}, {60, 0}, {0, 36}})
        CHECK_THROWS_WITH_AS(readback.add<glm::vec4>(floats, min, {2, 2}),
                             "reading back texture floats: the rectangle is not inside it",
                             std::logic_error);
    CHECK_THROWS_AS(readback.add<glm::vec4>(floats, {0, 0}, {0, 1}), std::logic_error);
    CHECK(readback.empty());
    const auto region = readback.add<glm::vec4>(floats, {0, 0});
    CHECK_THROWS_AS(readback.pixel(region), std::logic_error);
    readback.submit();
    CHECK_THROWS_AS(readback.pixel(region), std::logic_error);
    CHECK_THROWS_AS(readback.add<glm::vec4>(floats, {0, 0}), std::logic_error);
    readback.finish();
    readback.pixel(region);
    readback.clear();
    CHECK_THROWS_AS(readback.pixel(region), std::logic_error);
}
