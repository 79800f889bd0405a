// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <random>

#include "renderer/resources/frame_data.h"
#include "tests/reference/random.h"
#include "tests/stage/scene_frames.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/glsl_probe.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

const char* kShader = R"(#version 450 core
#include "lib/frame.glsl"
#include "lib/random.glsl"
layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
UintTexture(wanted);
writeonly uniform image2D first;
writeonly uniform image2D last;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    uint seed = fetch(wanted, p).x;
    imageStore(first, p, vec4(randomNumber(seed, 0u), randomNumber(seed, 1u),
                              randomNumber(seed, 2u), randomNumber(seed, 3u)));
    imageStore(last, p, vec4(randomNumber(seed, 4u)));
}
)";

float asFloat(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}
std::uint32_t asBits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

} // namespace

TEST_CASE("the numbers that follow from a seed are tile, Halton sequence and shift, to 1e-6") {
    testContext();
    const GlCheck noGlMessages;
    constexpr glm::ivec2 kSize{64, 32};
    Image<std::uint32_t> seeds(kSize);
    std::mt19937 bits(7);
    for (std::uint32_t& seed : seeds.pixels())
        seed = bits();
    // Frames whose digits are all alike, the first ones and the last ones.
    std::size_t next = 0;
    for (const std::uint32_t frame : {0u, 1u, 2u, 3u, 9u, 25u, 1000u, 59048u, 177146u, 131071u,
                                      131072u, 177147u, 262142u, 262143u})
        seeds.pixels()[next++] = reference::packSeed({101, 37}, frame);

    const SceneGpu scene(sceneNamed("tiny")); // for its noise
    GpuTexture wanted("wanted", PixelFormat::R32UI, kSize);
    wanted.write(seeds);
    GpuTexture first("first", PixelFormat::RGBA32F, kSize);
    GpuTexture last("last", PixelFormat::RGBA32F, kSize);
    ComputeProgram program(
        "random numbers",
        testShaders().source().expandText("random numbers", kShader, testShaders().common()));
    double largest = 0.0;
    int wrapped = 0;
    for (const std::uint32_t run : {0u, 1u, 12345u, 0xffffffffu}) {
        CAPTURE(run);
        FrameData frame;
        frame.uniforms.seed = run;
        frame.begin(Camera{}, kSize);
        program.dispatch(
            kSize, {{"Frame", frame.block()}, {"wanted", wanted}, {"noiseTile", scene.noiseTile}},
            {{"first", first}, {"last", last}});
        const auto numbers = first.read<glm::vec4>(), fifth = last.read<glm::vec4>();
        for (std::size_t i = 0; i < seeds.pixels().size(); ++i)
            for (std::uint32_t d = 0; d < 5; ++d) {
                const double u = d < 4 ? numbers.pixels()[i][int(d)] : fifth.pixels()[i].x;
                const double expected =
                    randomOf(run).number(reference::unpackSeed(seeds.pixels()[i]), d);
                REQUIRE(u >= 0.0);
                REQUIRE(u < 1.0);
                const double difference = std::abs(u - expected);
                wrapped += difference > 0.5; // 0 and 1 are neighbors
                largest = std::max(largest, std::min(difference, 1.0 - difference));
            }
    }
    MESSAGE("largest difference ", largest, ", wrapped ", wrapped);
    CHECK(largest < 1e-6); // a sum of three numbers below 1: llvmpipe 3e-7
    CHECK(wrapped < 4);
}

TEST_CASE("hashes are the same on both sides, and mixing bits can be undone") {
    std::mt19937 random(11);
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < 4096; ++i) // no bits of a NaN: those may change on the way
        inputs.push_back({asFloat(random() & 0x7f7fffffu), asFloat(random() & 0x7f7fffffu),
                          asFloat(random() & 0x7f7fffffu), 0.0f});
    // Sixteen bits at a time, as whole numbers: results may be the bits of a NaN.
    const char* low = "uvec4(mixBits(a), unmixBits(a), hash2(a, b), hash3(a, b, c)) & 0xffffu";
    const char* high = "uvec4(mixBits(a), unmixBits(a), hash2(a, b), hash3(a, b, c)) >> 16";
    const auto expression = [](std::string part) {
        for (const auto& [name, member] :
             {std::pair("(a", "(floatBitsToUint(x.x)"), std::pair(" b", " floatBitsToUint(x.y)"),
              std::pair(" c", " floatBitsToUint(x.z)")})
            for (std::size_t at = part.find(name); at != std::string::npos;
                 at = part.find(name, at + 1))
                part.replace(at, 2, member);
        return "vec4(" + part + ")";
    };
    const auto lows = probe({"lib/hash.glsl"}, expression(low), inputs);
    const auto highs = probe({"lib/hash.glsl"}, expression(high), inputs);
    int wrong = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const std::uint32_t a = asBits(inputs[i].x), b = asBits(inputs[i].y),
                            c = asBits(inputs[i].z);
        const auto whole = [&](int k) {
            return std::uint32_t(lows[i][k]) | std::uint32_t(highs[i][k]) << 16;
        };
        wrong += whole(0) != reference::mixBits(a);
        wrong += reference::mixBits(whole(1)) != a;
        wrong += whole(2) != reference::hash2(a, b);
        wrong += whole(3) != reference::hash3(a, b, c);
    }
    CHECK(wrong == 0);
}
