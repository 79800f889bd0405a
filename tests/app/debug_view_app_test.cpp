// SPDX-License-Identifier: MIT
#include "app/workbench/color_maps.h"
#include "app/workbench/frame_images.h"
#include "renderer/image/color.h"
#include "renderer/passes/debug_view_pass.h"
#include "renderer/scene/procedural.h"
#include "shared/bindings.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

#include <bit>
#include <limits>

#include <set>
#include <string_view>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::gpu;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr glm::u8vec4 kMagenta{255, 0, 255, 255};

DebugViewParams showing(int map, float low, float high, int channel = 0) {
    DebugViewParams params{};
    params.map = map;
    params.channel = channel;
    params.pixelsPerTexel = 1;
    params.low = low;
    params.high = high;
    return params;
}

template <class Pixel>
Image<glm::u8vec4> shown(const Image<Pixel>& values, PixelFormat format, glm::ivec2 size,
                         const DebugViewParams& params) {
    testContext();
    GpuTimer timer(true);
    FrameContext frame{timer};
    GpuTexture source("values", format, values.size()),
        display("display", PixelFormat::RGBA8, size);
    source.write(values);
    DebugViewPass(testShaders()).run(frame, source, display, params);
    return display.read<glm::u8vec4>();
}

glm::dvec4 bytesOfColor(glm::vec3 color) {
    return glm::dvec4(glm::round(255.0f * color), 255.0);
}

Image<float> ramp(float low, float high, int count) {
    Image<float> values({count, 1});
    for (int i = 0; i < count; ++i)
        values({i, 0}) = low + (high - low) * float(i) / float(count - 1);
    return values;
}

} // namespace

TEST_CASE("false colors are those of the legend, on both scales") {
    const int count = 61;
    const auto scalar = shown(ramp(2.0f, 5.0f, count), PixelFormat::R32F, {count, 1},
                              showing(kMapScalar, 2.0f, 5.0f));
    const auto both = shown(ramp(-3.0f, 3.0f, count), PixelFormat::R32F, {count, 1},
                            showing(kMapSigned, -3.0f, 3.0f));
    Image<glm::dvec4> scalarLegend({count, 1}), signedLegend({count, 1});
    for (int i = 0; i < count; ++i) {
        const float t = float(i) / float(count - 1);
        scalarLegend({i, 0}) = bytesOfColor(scalarColor(t));
        signedLegend({i, 0}) = bytesOfColor(signedColor(2.0f * t - 1.0f));
    }
    CHECK_CLOSE(scalar, scalarLegend, Tolerance{.max = 1.0}); // rounding to bytes
    CHECK_CLOSE(both, signedLegend, Tolerance{.max = 1.0});
}

TEST_CASE("the scale of numbers grows lighter all the way, and the signed one is as light on both "
          "sides") {
    const auto lightness = [](glm::vec3 color) { return double(luminance(color)); };
    for (int i = 1; i <= 100; ++i) {
        const float t = float(i) / 100.0f;
        CHECK(lightness(scalarColor(t)) > lightness(scalarColor(t - 0.01f)));
        CHECK(lightness(signedColor(t)) > lightness(signedColor(t - 0.01f)));
        CHECK(lightness(signedColor(t)) ==
              doctest::Approx(lightness(signedColor(-t))).epsilon(0.12));
    }
}

TEST_CASE("a logarithmic scale gives equal steps to equal factors") {
    Image<float> decades({4, 1});
    for (int i = 0; i < 4; ++i)
        decades({i, 0}) = std::pow(10.0f, float(i - 3));
    const auto image =
        shown(decades, PixelFormat::R32F, {4, 1}, showing(kMapLogarithm, 1e-3f, 1.0f));
    for (int i = 0; i < 4; ++i)
        CHECK_CLOSE(image({i, 0}), bytesOfColor(scalarColor(float(i) / 3.0f)),
                    Tolerance{.max = 1.0});
}

TEST_CASE("radiance is divided by what is white, and encoded") {
    Image<glm::vec4> values({2, 1});
    values({0, 0}) = {0.5f, 1.0f, 4.0f, 0.0f};
    values({1, 0}) = {0.0f, 2.0f, 0.02f, 0.0f};
    const auto image =
        shown(values, PixelFormat::RGBA32F, {2, 1}, showing(kMapRadiance, 0.0f, 2.0f));
    for (int i = 0; i < 2; ++i) {
        const glm::vec3 c = glm::min(glm::vec3(values({i, 0})) / 2.0f, 1.0f);
        CHECK_CLOSE(image({i, 0}),
                    bytesOfColor({encodeSrgb(c.r), encodeSrgb(c.g), encodeSrgb(c.b)}),
                    Tolerance{.max = 1.0});
    }
}

TEST_CASE("what is no number is magenta, and only where the shown channel has it") {
    Image<glm::vec4> values({3, 1}, glm::vec4(0.5f));
    values({0, 0}).y = kNan;
    values({1, 0}).y = -std::numeric_limits<float>::infinity();
    values({2, 0}).x = kNan;
    const auto image =
        shown(values, PixelFormat::RGBA32F, {3, 1}, showing(kMapScalar, 0.0f, 1.0f, 1));
    CHECK(image({0, 0}) == kMagenta);
    CHECK(image({1, 0}) == kMagenta);
    CHECK(image({2, 0}) != kMagenta);
}

TEST_CASE("a texel of strata covers its nine pixels, at the partial edges too") {
    const glm::ivec2 size{8, 4};
    Image<glm::uvec4> strata({3, 2});
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            strata({x, y}) = glm::uvec4(0u, std::uint32_t(1 + x + 3 * y), 0u, 0u);
    DebugViewParams params = showing(kMapNumber, 0.0f, 9.0f, 1);
    params.pixelsPerTexel = int(kStratumSize);
    const auto image = shown(strata, PixelFormat::RGBA32UI, size, params);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            CHECK(image({x, y}) == image({x / 3 * 3, y / 3 * 3}));
            if (x >= 3)
                CHECK(image({x, y}) != image({x - 3, y}));
        }
}

TEST_CASE("integer images are shown as whole numbers or as the floats whose bits they hold") {
    Image<glm::uvec4> bits({1, 1}, glm::uvec4(std::bit_cast<std::uint32_t>(0.75f), 0u, 0u, 0u));
    DebugViewParams params = showing(kMapScalar, 0.0f, 1.0f);
    params.isFloatBits = 1;
    const auto image = shown(bits, PixelFormat::RGBA32UI, {1, 1}, params);
    CHECK_CLOSE(image({0, 0}), bytesOfColor(scalarColor(0.75f)), Tolerance{.max = 1.0});
    params.isFloatBits = 0;
    Image<std::uint32_t> numbers({1, 1}, 3u);
    params.high = 4.0f;
    CHECK_CLOSE(shown(numbers, PixelFormat::R32UI, {1, 1}, params)({0, 0}),
                bytesOfColor(scalarColor(0.75f)), Tolerance{.max = 1.0});
}

TEST_CASE("a format without a view is refused by name") {
    testContext();
    GpuTimer timer(true);
    FrameContext frame{timer};
    GpuTexture source("encoded", PixelFormat::RGBA8, {1, 1}),
        display("d", PixelFormat::RGBA8, {1, 1});
    CHECK_THROWS_WITH_AS(DebugViewPass(testShaders()).run(frame, source, display, {}),
                         "DebugViewPass: encoded is RGBA8, of which there is no view",
                         std::logic_error);
}

TEST_CASE("every image of the frame is shown from the texture that its file is written from") {
    const glm::ivec2 size{31, 17};
    Renderer renderer(testShaders(), glInfo(testContext()));
    renderer.setScene(makeProceduralScene("cornell"));
    renderer.resize(size);
    const Camera camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    GpuTimer timer(true);
    FrameContext frame{timer};
    DebugViewPass pass(testShaders());
    GpuTexture direct("direct", PixelFormat::RGBA8, size),
        fromFile("file", PixelFormat::RGBA8, size);
    const auto displays = imageDisplays(1.0f);
    std::set<std::string_view> shown;
    for (const Filter filter : {Filter::Asvgf, Filter::Counted}) { // together they make all images
        const Settings settings = defaultSettings(filter);
        for (std::uint32_t i = 0; i < 2; ++i)
            renderer.render({.camera = camera, .seconds = 0.0, .frame = i, .seed = 0, .lights = {}},
                            settings);
        for (std::size_t i = 0; i < aovs().size(); ++i) {
            const AovInfo& aov = aovs()[i];
            CAPTURE(aov.name);
            if (!isMadeBy(aov, settings))
                continue;
            shown.insert(aov.name);
            const AovSource source = sourceOf(renderer, aov);
            DebugViewParams params = debugViewParams(displays[i], source, size);
            pass.run(frame, source.texture, direct, params);
            const Image<glm::vec4> values = readAov(renderer, aov);
            GpuTexture copy("values", PixelFormat::RGBA32F, values.size());
            copy.write(values);
            params.channel = 0;
            params.isFloatBits = 0;
            pass.run(frame, copy, fromFile, params);
            CHECK_CLOSE(direct.read<glm::u8vec4>(), fromFile.read<glm::u8vec4>(), Tolerance{});
        }
    }
    CHECK(shown.size() == aovs().size());
}
