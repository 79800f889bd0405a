// SPDX-License-Identifier: MIT
#include "renderer/gl/readback.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace afterglow {
namespace {

constexpr std::size_t kLeastCapacity = 4096;  // bytes
constexpr std::size_t kAlignment = 16;        // bytes: of the largest pixel
constexpr GLuint64 kPatience = 1'000'000'000; // nanoseconds, of one wait of many
constexpr GLbitfield kAccess = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

std::size_t componentsOf(GLenum layout) {
    switch (layout) {
    case GL_RED:
    case GL_RED_INTEGER: return 1;
    case GL_RG:
    case GL_RG_INTEGER: return 2;
    default: return 4;
    }
}

std::size_t givenBytes(const FormatInfo& format) {
    return componentsOf(format.layout) * (format.type == GL_UNSIGNED_BYTE ? 1 : 4);
}

} // namespace

PixelReadback::~PixelReadback() {
    if (fence_)
        glDeleteSync(fence_);
}

void PixelReadback::makeRoom(std::size_t bytes) {
    if (bytes <= capacity_)
        return;
    const std::size_t capacity = std::max({bytes, 2 * capacity_, kLeastCapacity});
    auto larger = GlObject<BufferKind>::create("readback");
    // On the side of the program: it is the one who reads.
    glNamedBufferStorage(larger.id(), GLsizeiptr(capacity), nullptr,
                         kAccess | GL_CLIENT_STORAGE_BIT);
    const void* const mapped = glMapNamedBufferRange(larger.id(), 0, GLsizeiptr(capacity), kAccess);
    if (!mapped)
        throw Error("this driver does not map " + std::to_string(capacity) +
                    " bytes to read pixels from");
    if (used_ > 0)
        glCopyNamedBufferSubData(buffer_.id(), larger.id(), 0, 0, GLsizeiptr(used_));
    buffer_ = std::move(larger);
    mapped_ = static_cast<const std::byte*>(mapped);
    capacity_ = capacity;
}

std::size_t PixelReadback::place(std::size_t bytes) {
    const std::size_t offset = (used_ + kAlignment - 1) / kAlignment * kAlignment;
    makeRoom(offset + bytes);
    used_ = offset + bytes;
    return offset;
}

std::size_t PixelReadback::addBytes(const GpuBuffer& buffer, std::size_t bytes) {
    if (stage_ != Stage::Adding)
        throw std::logic_error("reading back buffer " + buffer.label() +
                               ": the batch was submitted and not cleared");
    if (bytes > buffer.bytes())
        throw std::logic_error("reading back buffer " + buffer.label() + ": it is too small");
    const std::size_t offset = place(bytes);
    glCopyNamedBufferSubData(buffer.id(), buffer_.id(), 0, GLintptr(offset), GLsizeiptr(bytes));
    return offset;
}

// Through a framebuffer: drivers copy from one into a buffer without waiting, where several of them
// wait for glGetTextureSubImage().
std::size_t PixelReadback::addBytes(const GpuTexture& texture, glm::ivec2 min, glm::ivec2 size,
                                    std::size_t pixelBytes, bool integers) {
    const FormatInfo format = info(texture.format());
    const auto mistake = [&](const std::string& what) {
        throw std::logic_error("reading back texture " + texture.label() + ": " + what);
    };
    if (stage_ != Stage::Adding)
        mistake("the batch was submitted and not cleared");
    if (texture.format() == PixelFormat::Depth32F || format.isInteger != integers ||
        givenBytes(format) != pixelBytes)
        mistake(std::string(format.name) + " does not hold pixels of this type");
    if (glm::any(glm::lessThan(min, glm::ivec2(0))) ||
        glm::any(glm::lessThanEqual(size, glm::ivec2(0))) ||
        glm::any(glm::greaterThan(size, texture.size() - min)))
        mistake("the rectangle is not inside it");

    const std::size_t offset = place(std::size_t(size.x) * std::size_t(size.y) * pixelBytes);
    if (!source_)
        source_ = GlObject<FramebufferKind>::create("readback");
    glNamedFramebufferTexture(source_.id(), GL_COLOR_ATTACHMENT0, texture.id(), 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.id());
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
    glReadPixels(min.x, min.y, size.x, size.y, format.layout, format.type,
                 reinterpret_cast<void*>(offset));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    // The framebuffer would keep a texture alive that its owner gives up.
    glNamedFramebufferTexture(source_.id(), GL_COLOR_ATTACHMENT0, 0, 0);
    return offset;
}

void PixelReadback::submit() {
    if (stage_ != Stage::Adding || empty())
        return;
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    stage_ = Stage::Submitted;
}

void PixelReadback::finish() {
    submit();
    if (stage_ != Stage::Submitted)
        return;
    GLenum status = GL_TIMEOUT_EXPIRED;
    while (status == GL_TIMEOUT_EXPIRED)
        status = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kPatience);
    glDeleteSync(std::exchange(fence_, nullptr));
    if (status == GL_WAIT_FAILED)
        throw Error("the driver does not tell when pixels have been read back");
    stage_ = Stage::Arrived;
}

void PixelReadback::clear() {
    if (fence_)
        glDeleteSync(std::exchange(fence_, nullptr));
    used_ = 0;
    stage_ = Stage::Adding;
}

const std::byte* PixelReadback::bytesAt(std::size_t offset, std::size_t bytes) const {
    if (stage_ != Stage::Arrived || offset + bytes > used_)
        throw std::logic_error("pixels are read before they have been read back");
    return mapped_ + offset;
}

} // namespace afterglow
