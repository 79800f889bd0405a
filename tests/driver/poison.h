// SPDX-License-Identifier: MIT
#pragma once

#include "tests/driver/gl_override.h"

#include <set>
#include <string>

namespace afterglow::test {

/// While it lives, new textures and buffers hold garbage: not-a-number, large numbers, 0.9 in depth
/// images. OpenGL leaves them undefined, and a driver that gives zeros hides a missing clear.
///
/// Fills storage again with garbage when it is cleared before the next shader runs: no frame may
/// rely on the clear of new storage. `clearedForUse` names the textures whose clear is a part of
/// the algorithm.
class PoisonedStorage {
public:
    explicit PoisonedStorage(std::set<std::string> clearedForUse);
    ~PoisonedStorage();

    int texturesPoisoned() const { return textures_; }
    int buffersPoisoned() const { return buffers_; }

private:
    static void GLAPIENTRY storage2D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                                     GLsizei height);
    static void GLAPIENTRY storage3D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                                     GLsizei height, GLsizei depth);
    static void GLAPIENTRY clearImage(GLuint texture, GLint level, GLenum format, GLenum type,
                                      const void* data);
    static void GLAPIENTRY bufferStorage(GLuint buffer, GLsizeiptr size, const void* data,
                                         GLbitfield flags);
    static void GLAPIENTRY clearBuffer(GLuint buffer, GLenum internal, GLenum format, GLenum type,
                                       const void* data);
    static void GLAPIENTRY dispatch(GLuint x, GLuint y, GLuint z);
    static void GLAPIENTRY draw(GLenum mode, GLsizei count, GLenum type, const void* indices);
    void poison(GLuint texture, GLsizei levels, GLenum format);

    static PoisonedStorage* active;
    std::set<std::string> clearedForUse_;
    std::set<GLuint> fresh_; ///< textures that were made since a shader last ran
    int textures_ = 0, buffers_ = 0;
    GlOverride<PFNGLTEXTURESTORAGE2DPROC> storage2D_;
    GlOverride<PFNGLTEXTURESTORAGE3DPROC> storage3D_;
    GlOverride<PFNGLCLEARTEXIMAGEPROC> clear_;
    GlOverride<PFNGLNAMEDBUFFERSTORAGEPROC> buffer_;
    GlOverride<PFNGLCLEARNAMEDBUFFERDATAPROC> clearBuffer_;
    GlOverride<PFNGLDISPATCHCOMPUTEPROC> dispatch_;
    GlOverride<PFNGLDRAWELEMENTSPROC> draw_;
};

} // namespace afterglow::test
