// SPDX-License-Identifier: MIT
#include "renderer/gl/buffer.h"

#include "renderer/base/error.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {

GpuBuffer::GpuBuffer(std::string_view label, std::size_t bytes) : label_(label), bytes_(bytes) {
    if (bytes == 0)
        return; // OpenGL has no empty buffers
    object_ = GlObject<BufferKind>::create(label);
    allocateGl("buffer " + label_, std::to_string(bytes) + " bytes", bytes, [&] {
        glNamedBufferStorage(id(), GLsizeiptr(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    });
    clear();
}

void GpuBuffer::clear() {
    if (!empty())
        glClearNamedBufferData(id(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
}

void GpuBuffer::writeBytes(std::span<const std::byte> bytes, std::size_t offset) {
    if (offset > bytes_ || bytes.size() > bytes_ - offset)
        throw std::logic_error("buffer " + label_ + " has " + std::to_string(bytes_) +
                               " bytes, but " + std::to_string(bytes.size()) +
                               " were given for offset " + std::to_string(offset));
    if (!bytes.empty())
        glNamedBufferSubData(id(), GLintptr(offset), GLsizeiptr(bytes.size()), bytes.data());
}

void GpuBuffer::readBytes(std::span<std::byte> bytes) const {
    if (!bytes.empty())
        glGetNamedBufferSubData(id(), 0, GLsizeiptr(bytes.size()), bytes.data());
}

TexelBuffer::TexelBuffer(std::string_view label, std::size_t bytes, PixelFormat format)
    : format_(format) {
    const FormatInfo texel = info(format);
    if (!texel.isImage || (texel.type != GL_FLOAT && texel.type != GL_UNSIGNED_INT) ||
        format == PixelFormat::RGBA16F)
        throw std::logic_error("buffer " + std::string(label) + " cannot have texels of format " +
                               std::string(texel.name));
    const auto size = std::size_t(texel.bytes);
    const std::size_t texels = std::max<std::size_t>(1, (bytes + size - 1) / size);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (texels > std::size_t(most))
        throw Error("buffer " + std::string(label) + " needs " + std::to_string(texels) +
                    " texels; this driver addresses " + std::to_string(most));
    buffer_ = GpuBuffer(label, texels * size);
    texture_ = GlObject<TextureKind>::create(label, GLenum(GL_TEXTURE_BUFFER));
    glTextureBuffer(texture_.id(), texel.internal, buffer_.id());
}

void TexelBuffer::checkValues(std::size_t bytesOfOne, std::size_t count) const {
    const auto texel = std::size_t(info(format_).bytes);
    if ((bytesOfOne % texel != 0 && texel % bytesOfOne != 0) || bytesOfOne * count % texel != 0)
        throw std::logic_error("buffer " + label() + " has texels of " + std::to_string(texel) +
                               " bytes, but was given " + std::to_string(count) + " values of " +
                               std::to_string(bytesOfOne));
}

} // namespace afterglow
