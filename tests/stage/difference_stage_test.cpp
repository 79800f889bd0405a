// SPDX-License-Identifier: MIT
#include "renderer/passes/difference_pass.h"

#include <doctest/doctest.h>

#include <bit>
#include <random>

#include "renderer/passes/debug_view_pass.h"
#include "tests/stage/mutants.h"
#include "tests/stage/upload.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

template <class Pixel>
Image<Pixel> noise(glm::ivec2 size, std::uint32_t seed) {
    std::mt19937 engine(seed);
    Image<glm::vec4> values(size);
    for (glm::vec4& pixel : values.pixels())
        for (int i = 0; i < 4; ++i)
            pixel[i] = float(engine() >> 8) * 0x1p-22f - 1.0f;
    Image<Pixel> image(size);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        image.pixels()[i] = Pixel(values.pixels()[i]);
    return image;
}
template <>
Image<float> noise(glm::ivec2 size, std::uint32_t seed) {
    const auto values = noise<glm::vec2>(size, seed);
    Image<float> image(size);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        image.pixels()[i] = values.pixels()[i].x;
    return image;
}

glm::vec4 padded(float x) {
    return {x, 0.0f, 0.0f, 0.0f};
}
glm::vec4 padded(glm::vec2 x) {
    return {x, 0.0f, 0.0f};
}
glm::vec4 padded(glm::vec4 x) {
    return x;
}

template <class Pixel>
Image<glm::vec4> difference(ShaderLibrary& shaders, const Image<Pixel>& a, const Image<Pixel>& b,
                            Difference kind = Difference::Signed) {
    const GpuTexture minuend = upload("a", a), subtrahend = upload("b", b);
    GpuTexture result =
        upload("difference", Image<glm::vec4>(a.size(), glm::vec4(-1234.5f))); // garbage
    GpuTimer timer(true);
    FrameContext context{timer};
    DifferencePass(shaders).run(context, minuend, subtrahend, result, kind);
    return result.read<glm::vec4>();
}

template <class Pixel>
void checkKind(glm::ivec2 size) {
    CAPTURE(size.x);
    const auto a = noise<Pixel>(size, 7), b = noise<Pixel>(size, 8);
    const auto signedOne = difference(testShaders(), a, b);
    const auto absolute = difference(testShaders(), a, b, Difference::Absolute);
    const auto reverse = difference(testShaders(), b, a);
    const auto self = difference(testShaders(), a, a);
    int wrong = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        // A subtraction is rounded the same way everywhere.
        const glm::vec4 expected = padded(a.pixels()[i]) - padded(b.pixels()[i]);
        wrong += signedOne.pixels()[i] != expected;
        wrong += absolute.pixels()[i] != glm::abs(expected);
        wrong += reverse.pixels()[i] != -expected;
        wrong += self.pixels()[i] != glm::vec4(0.0f);
    }
    CHECK(wrong == 0);
}

} // namespace

TEST_CASE("the difference of two images is that of their numbers, to the bit, and of itself 0") {
    const GlCheck noGlMessages;
    for (const glm::ivec2 size : {glm::ivec2(61, 37), {1, 1}, {8, 8}, {130, 3}}) {
        checkKind<float>(size);
        checkKind<glm::vec2>(size);
        checkKind<glm::vec4>(size);
    }
}

TEST_CASE("a difference is shown warm where there is more and cold where there is less") {
    const GlCheck noGlMessages;
    const glm::ivec2 size{61, 37};
    const auto a = noise<glm::vec4>(size, 7), b = noise<glm::vec4>(size, 8);
    const GpuTexture more = upload("difference", difference(testShaders(), a, b));
    GpuTexture display("display", PixelFormat::RGBA8, size);
    GpuTimer timer(true);
    FrameContext context{timer};
    for (int channel = 0; channel < 4; ++channel) {
        CAPTURE(channel);
        DebugViewPass(testShaders())
            .run(context, more, display, {gpu::kMapSigned, channel, 1, 0, 0.0f, 4.0f, 0.0f, 0.0f});
        const auto shown = display.read<glm::u8vec4>();
        int warm = 0, cold = 0, wrong = 0;
        for (std::size_t i = 0; i < shown.pixels().size(); ++i) {
            const glm::u8vec4 color = shown.pixels()[i];
            const float x = a.pixels()[i][channel] - b.pixels()[i][channel];
            if (std::abs(x) < 0.1f) // as good as none
                continue;
            wrong += x > 0.0f ? color.r <= color.b : color.b <= color.r;
            ++(x > 0.0f ? warm : cold);
        }
        CHECK(wrong == 0);
        CHECK(warm > 500);
        CHECK(cold > 500);
    }
}

TEST_CASE("images that are not alike have no difference") {
    const GlCheck noGlMessages;
    GpuTimer timer(true);
    FrameContext context{timer};
    DifferencePass pass(testShaders());
    const auto make = [](PixelFormat format, glm::ivec2 size) {
        return GpuTexture(info(format).name, format, size);
    };
    const GpuTexture colors = make(PixelFormat::RGBA32F, {8, 8});
    const GpuTexture pairs = make(PixelFormat::RG32F, {8, 8});
    const GpuTexture small = make(PixelFormat::RGBA32F, {8, 7});
    const GpuTexture numbers = make(PixelFormat::R32UI, {8, 8});
    GpuTexture result = make(PixelFormat::RGBA32F, {8, 8});
    GpuTexture smallResult = make(PixelFormat::RGBA32F, {7, 8});
    GpuTexture narrowResult = make(PixelFormat::R32F, {8, 8});
    CHECK_NOTHROW(pass.run(context, colors, colors, result));
    CHECK_THROWS_WITH_AS(pass.run(context, colors, pairs, result),
                         "DifferencePass: RG32F does not go with RGBA32F", std::logic_error);
    CHECK_THROWS_AS(pass.run(context, colors, small, result), std::logic_error);
    CHECK_THROWS_AS(pass.run(context, colors, colors, smallResult), std::logic_error);
    CHECK_THROWS_AS(pass.run(context, colors, colors, narrowResult), std::logic_error);
    CHECK_THROWS_WITH_AS(pass.run(context, numbers, numbers, result),
                         "DifferencePass: R32UI is R32UI, of which there is no difference",
                         std::logic_error);
}

TEST_CASE("mistakes in the difference show") {
    const GlCheck noGlMessages;
    const auto a = noise<glm::vec4>({61, 37}, 7), b = noise<glm::vec4>({61, 37}, 8);
    Image<glm::vec4> expected(a.size()), absolute(a.size());
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        expected.pixels()[i] = a.pixels()[i] - b.pixels()[i];
        absolute.pixels()[i] = glm::abs(expected.pixels()[i]);
    }
    const std::string file = "post/difference.comp";
    checkMutants(
        [&](ShaderLibrary& shaders) {
            Verdict verdict;
            verdict.add(difference(shaders, a, b), expected);
            verdict.add(difference(shaders, a, b, Difference::Absolute), absolute);
            return verdict;
        },
        {{"one pixel is taken from all", file, "fetch(subtrahend, p)",
          "fetch(subtrahend, ivec2(0))"},
         {"it is a sum", file, "fetch(minuend, p) - ", "fetch(minuend, p) + "},
         {"the sign is always lost", file, "params.isAbsolute != 0", "true"},
         {"the sign is never lost", file, "params.isAbsolute != 0", "params.isAbsolute == 2"},
         {"the last column is left out", file, "greaterThanEqual(p, ",
          "greaterThanEqual(p + 1, "}});
}
