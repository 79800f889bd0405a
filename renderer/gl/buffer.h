// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/object.h"
#include "renderer/gl/pixel_format.h"

#include <cstddef>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace afterglow {

/// A buffer of a size that does not change. Its bytes are zero at first.
class GpuBuffer {
public:
    GpuBuffer() = default;
    GpuBuffer(std::string_view label, std::size_t bytes);

    GLuint id() const { return object_.id(); }
    std::size_t bytes() const { return bytes_; }
    bool empty() const { return bytes_ == 0; }
    const std::string& label() const { return label_; }

    /// Replaces the bytes from `offset` on. Throws std::logic_error if there is no room for them.
    template <class T>
    void write(std::span<const T> values, std::size_t offset = 0) {
        static_assert(std::is_trivially_copyable_v<T>);
        writeBytes(std::as_bytes(values), offset);
    }
    template <std::ranges::contiguous_range Values>
    void write(const Values& values, std::size_t offset = 0) {
        write(std::span<const std::ranges::range_value_t<Values>>(values), offset);
    }

    /// Returns as many values as the buffer has room for.
    template <class T>
    std::vector<T> read() const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(bytes_ / sizeof(T));
        readBytes(std::as_writable_bytes(std::span(values)));
        return values;
    }

    void clear(); ///< to zero

private:
    void writeBytes(std::span<const std::byte> bytes, std::size_t offset);
    void readBytes(std::span<std::byte> bytes) const;

    GlObject<BufferKind> object_;
    std::string label_;
    std::size_t bytes_ = 0;
};

/// A buffer that shaders see as an array of texels: a samplerBuffer or an imageBuffer, with a u in
/// front where the format is of integers (measured faster than a storage buffer on llvmpipe, and
/// equal elsewhere).
class TexelBuffer {
public:
    TexelBuffer() = default;
    /// Makes room for `bytes`, rounded up to whole texels, at least one. Zero at first. The format
    /// has 32 bits a channel and no depth; any other is std::logic_error.
    TexelBuffer(std::string_view label, std::size_t bytes,
                PixelFormat format = PixelFormat::RGBA32UI);

    GLuint texture() const { return texture_.id(); }
    GLuint buffer() const { return buffer_.id(); }
    PixelFormat format() const { return format_; }
    std::size_t bytes() const { return buffer_.bytes(); }
    const std::string& label() const { return buffer_.label(); }

    /// Replaces the values from the first on. Grows when they do not fit, and then drops the rest
    /// of what it held. Throws Error when there are more than the driver can address, and
    /// std::logic_error unless a value is whole texels, or a texel whole values.
    template <class T>
    void write(std::span<const T> values) {
        checkValues(sizeof(T), values.size());
        if (values.size_bytes() > bytes())
            *this = TexelBuffer(std::string(label()), values.size_bytes(), format_);
        buffer_.write(values);
    }
    template <std::ranges::contiguous_range Values>
    void write(const Values& values) {
        write(std::span<const std::ranges::range_value_t<Values>>(values));
    }
    /// Replaces values from number `first` on. More than there is room for is std::logic_error, and
    /// so is a value that is not whole texels.
    template <class T>
    void writeAt(std::size_t first, std::span<const T> values) {
        checkValues(sizeof(T), values.size());
        buffer_.write(values, first * sizeof(T));
    }

    template <class T>
    std::vector<T> read() const {
        return buffer_.read<T>();
    }

    void clear() { buffer_.clear(); } ///< to zero

private:
    void checkValues(std::size_t bytesOfOne, std::size_t count) const;

    GpuBuffer buffer_;
    PixelFormat format_ = PixelFormat::RGBA32UI;
    GlObject<TextureKind> texture_;
};

} // namespace afterglow
