// SPDX-License-Identifier: MIT
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture_array.h"
#include "renderer/resources/history.h"
#include "tests/support/gl_fixture.h"

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("a history of textures, arrays or buffers keeps its two sides apart, at its own size") {
    testContext();
    const GlCheck check;
    const glm::ivec2 size{7, 3};
    History textures("state", PixelFormat::R32UI, size);
    HistoryOf<GpuTextureArray> arrays("state", PixelFormat::R32UI, size, 5, 2);
    HistoryOf<TexelBuffer> buffers("state", 20, PixelFormat::R32F);

    const auto numberOf = [](const auto& resource) -> float {
        using Resource = std::remove_cvref_t<decltype(resource)>;
        if constexpr (std::is_same_v<Resource, GpuTexture>)
            return float(resource.template read<std::uint32_t>()({6, 2}));
        else if constexpr (std::is_same_v<Resource, GpuTextureArray>)
            return float(resource.template read<std::uint32_t>(4)({6, 2}));
        else
            return resource.template read<float>()[4];
    };
    const auto write = [&](auto& resource, int number) {
        using Resource = std::remove_cvref_t<decltype(resource)>;
        if constexpr (std::is_same_v<Resource, GpuTexture>)
            resource.write(Image<std::uint32_t>(size, std::uint32_t(number)));
        else if constexpr (std::is_same_v<Resource, GpuTextureArray>)
            resource.write(4, Image<std::uint32_t>(size, std::uint32_t(number)));
        else
            resource.write(std::vector<float>(5, float(number)));
    };
    const auto checkHistory = [&](auto& history) {
        history.clear();
        CHECK(numberOf(history.current()) == 0.0f);
        CHECK(numberOf(history.previous()) == 0.0f);
        write(history.current(), 1);
        history.swap();
        CHECK(numberOf(history.current()) == 0.0f);
        CHECK(numberOf(history.previous()) == 1.0f);
        write(history.current(), 2);
        CHECK(numberOf(history.previous()) == 1.0f);
        history.swap();
        CHECK(numberOf(history.current()) == 1.0f);
        CHECK(numberOf(history.previous()) == 2.0f);
        history.clear();
        CHECK(numberOf(history.current()) == 0.0f);
        CHECK(numberOf(history.previous()) == 0.0f);
        CHECK(history.current().label() == "state");
        CHECK(history.previous().label() == "state (previous)");
    };
    checkHistory(textures);
    checkHistory(arrays);
    checkHistory(buffers);
    CHECK(textures.previous().size() == size);
    CHECK(arrays.previous().layers() == 5);
    CHECK(arrays.current().levels() == 2);
    CHECK(buffers.previous().bytes() == 20);
    CHECK(buffers.previous().format() == PixelFormat::R32F);
}
