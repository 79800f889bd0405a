// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace afterglow {

/// Pixels of textures, and values of buffers, on their way from the device.
///
///     const auto region = readback.add<glm::vec4>(texture, p);   // as the commands so far leave
///     it readback.submit();
///     ...                                                        // later, after other commands
///     readback.finish();
///     const glm::vec4 value = readback.pixel(region);
///
/// Nobody waits before finish(), and there for nothing that was given to the device after submit().
class PixelReadback {
public:
    /// The place of the pixels of one add() in the buffer.
    template <class Pixel>
    struct Region {
        std::size_t offset = 0; ///< bytes
        glm::ivec2 size{0};
    };

    PixelReadback() = default; ///< needs no context before the first add()
    PixelReadback(const PixelReadback&) = delete;
    PixelReadback& operator=(const PixelReadback&) = delete;
    ~PixelReadback();

    /// Adds the rectangle [min, min + size) of a texture, which must be inside it. Pixels are as in
    /// GpuTexture::read(), but not of depth. Mistakes are std::logic_error, so is a batch that was
    /// submitted and not cleared.
    template <class Pixel>
    Region<Pixel> add(const GpuTexture& texture, glm::ivec2 min, glm::ivec2 size = glm::ivec2(1)) {
        return {addBytes(texture, min, size, sizeof(Pixel), kHoldsIntegers<Pixel>), size};
    }
    /// Adds the first value of a buffer, as one pixel.
    template <class Value>
    Region<Value> add(const GpuBuffer& buffer) {
        static_assert(std::is_trivially_copyable_v<Value>);
        return {addBytes(buffer, sizeof(Value)), glm::ivec2(1)};
    }
    void submit(); ///< nothing more will be added
    void finish(); ///< waits until everything that was submitted has arrived
    void clear();  ///< forgets everything; its memory is kept for the next batch

    bool empty() const { return used_ == 0; }

    /// Returns the pixels of a region row by row; until clear(). Before finish(): std::logic_error.
    template <class Pixel>
    std::span<const Pixel> pixels(const Region<Pixel>& region) const {
        const auto count = std::size_t(region.size.x) * std::size_t(region.size.y);
        return {reinterpret_cast<const Pixel*>(bytesAt(region.offset, count * sizeof(Pixel))),
                count};
    }
    template <class Pixel>
    Pixel pixel(const Region<Pixel>& region, glm::ivec2 p = glm::ivec2(0)) const {
        return pixels(region)[std::size_t(p.y * region.size.x + p.x)];
    }

private:
    template <class Pixel>
    static constexpr bool kHoldsIntegers =
        std::is_same_v<Pixel, std::uint32_t> || std::is_same_v<Pixel, glm::uvec2> ||
        std::is_same_v<Pixel, glm::uvec4>;

    std::size_t addBytes(const GpuTexture& texture, glm::ivec2 min, glm::ivec2 size,
                         std::size_t pixelBytes, bool integers);
    std::size_t addBytes(const GpuBuffer& buffer, std::size_t bytes);
    std::size_t place(std::size_t bytes); ///< offset of so many more
    void makeRoom(std::size_t bytes);
    const std::byte* bytesAt(std::size_t offset, std::size_t bytes) const;

    enum class Stage { Adding, Submitted, Arrived };
    Stage stage_ = Stage::Adding;
    GlObject<FramebufferKind> source_;
    GlObject<BufferKind> buffer_;
    const std::byte* mapped_ = nullptr; ///< the buffer's, for as long as it lives
    std::size_t capacity_ = 0, used_ = 0;
    GLsync fence_ = nullptr;
};

} // namespace afterglow
