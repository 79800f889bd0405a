#include "renderer/gl/buffer.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {

namespace {

constexpr std::size_t kTexelBytes = 16; // RGBA32UI

std::size_t wholeTexels(std::size_t bytes) {
    return std::max<std::size_t>(1, (bytes + kTexelBytes - 1) / kTexelBytes);
}

} // namespace

GpuBuffer::GpuBuffer(std::string_view label, std::size_t bytes) : label_(label), bytes_(bytes) {
    if (bytes == 0)
        return; // OpenGL has no empty buffers
    object_ = GlObject<BufferKind>::create(label);
    glNamedBufferStorage(id(), GLsizeiptr(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
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

TexelBuffer::TexelBuffer(std::string_view label, std::size_t bytes) {
    const std::size_t texels = wholeTexels(bytes);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (texels > std::size_t(most))
        throw Error("buffer " + std::string(label) + " needs " + std::to_string(texels) +
                    " texels; this driver addresses " + std::to_string(most));
    buffer_ = GpuBuffer(label, texels * kTexelBytes);
    texture_ = GlObject<TextureKind>::create(label, GLenum(GL_TEXTURE_BUFFER));
    glTextureBuffer(texture_.id(), GL_RGBA32UI, buffer_.id());
}

} // namespace afterglow
