// SPDX-License-Identifier: MIT
#include "tests/driver/poison.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace afterglow::test {

namespace {

constexpr std::uint32_t kNotANumber =
    0x7fc12345u; // as a float; as an integer larger than any index

} // namespace

PoisonedStorage* PoisonedStorage::active = nullptr;

PoisonedStorage::PoisonedStorage(std::set<std::string> clearedForUse)
    : clearedForUse_(std::move(clearedForUse)), storage2D_(glad_glTextureStorage2D, storage2D),
      storage3D_(glad_glTextureStorage3D, storage3D), clear_(glad_glClearTexImage, clearImage),
      buffer_(glad_glNamedBufferStorage, bufferStorage),
      clearBuffer_(glad_glClearNamedBufferData, clearBuffer),
      dispatch_(glad_glDispatchCompute, dispatch), draw_(glad_glDrawElements, draw) {
    active = this;
}

PoisonedStorage::~PoisonedStorage() {
    active = nullptr;
}

void PoisonedStorage::poison(GLuint texture, GLsizei levels, GLenum format) {
    ++textures_;
    const std::array<std::uint32_t, 4> bits{kNotANumber, kNotANumber, kNotANumber, kNotANumber};
    const float depth = 0.9f;
    const auto fill = [&](GLenum layout, GLenum type, const void* with) {
        for (GLsizei level = 0; level < levels; ++level)
            clear_.before()(texture, level, layout, type, with);
    };
    switch (format) {
    case GL_R32F: return fill(GL_RED, GL_FLOAT, bits.data());
    case GL_RG32F: return fill(GL_RG, GL_FLOAT, bits.data());
    case GL_RGBA16F:
    case GL_RGBA32F: return fill(GL_RGBA, GL_FLOAT, bits.data());
    case GL_R32UI: return fill(GL_RED_INTEGER, GL_UNSIGNED_INT, bits.data());
    case GL_RG32UI: return fill(GL_RG_INTEGER, GL_UNSIGNED_INT, bits.data());
    case GL_RGBA32UI: return fill(GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.data());
    case GL_SRGB8_ALPHA8:
    case GL_RGBA8: return fill(GL_RGBA, GL_UNSIGNED_BYTE, bits.data());
    case GL_DEPTH_COMPONENT32F: return fill(GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    default: throw std::logic_error("poison: no garbage for format " + std::to_string(format));
    }
}

void PoisonedStorage::storage2D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                                GLsizei height) {
    active->storage2D_.before()(texture, levels, format, width, height);
    active->fresh_.insert(texture);
    active->poison(texture, levels, format);
}

void PoisonedStorage::storage3D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                                GLsizei height, GLsizei depth) {
    active->storage3D_.before()(texture, levels, format, width, height, depth);
    active->fresh_.insert(texture);
    active->poison(texture, levels, format);
}

void PoisonedStorage::clearImage(GLuint texture, GLint level, GLenum format, GLenum type,
                                 const void* data) {
    std::array<char, 256> label{};
    glGetObjectLabel(GL_TEXTURE, texture, GLsizei(label.size()), nullptr, label.data());
    if (!active->fresh_.count(texture) || active->clearedForUse_.count(label.data()))
        active->clear_.before()(texture, level, format, type, data);
}

void PoisonedStorage::dispatch(GLuint x, GLuint y, GLuint z) {
    active->fresh_.clear();
    active->dispatch_.before()(x, y, z);
}

void PoisonedStorage::draw(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    active->fresh_.clear();
    active->draw_.before()(mode, count, type, indices);
}

void PoisonedStorage::bufferStorage(GLuint buffer, GLsizeiptr size, const void* data,
                                    GLbitfield flags) {
    active->buffer_.before()(buffer, size, data, flags);
    if (data)
        return;
    ++active->buffers_;
    active->clearBuffer_.before()(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &kNotANumber);
}

// Buffers are cleared when they are made and at no other time.
void PoisonedStorage::clearBuffer(GLuint, GLenum, GLenum, GLenum, const void*) {}

} // namespace afterglow::test
