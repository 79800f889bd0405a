// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <utility>

#include <glad/gl.h>

namespace afterglow {

/// The sole owner of one OpenGL name. Kind says how to create, destroy and label it.
/// A default-constructed object holds nothing and needs no context; one that holds a name must go
/// before its context does.
template <class Kind>
class GlObject {
public:
    GlObject() = default;
    template <class... Args>
    static GlObject create(std::string_view label, Args... args) {
        GlObject object(Kind::create(args...));
        glObjectLabel(Kind::kIdentifier, object.id(), GLsizei(label.size()), label.data());
        return object;
    }
    static GlObject adopt(GLuint id) { return GlObject(id); }

    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        GlObject old(std::move(other));
        std::swap(id_, old.id_);
        return *this;
    }
    ~GlObject() {
        if (id_)
            Kind::destroy(id_);
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    explicit GlObject(GLuint id) : id_(id) {}
    GLuint id_ = 0;
};

struct TextureKind {
    static constexpr GLenum kIdentifier = GL_TEXTURE;
    static GLuint create(GLenum target) {
        GLuint id = 0;
        glCreateTextures(target, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct BufferKind {
    static constexpr GLenum kIdentifier = GL_BUFFER;
    static GLuint create() {
        GLuint id = 0;
        glCreateBuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct FramebufferKind {
    static constexpr GLenum kIdentifier = GL_FRAMEBUFFER;
    static GLuint create() {
        GLuint id = 0;
        glCreateFramebuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct VertexArrayKind {
    static constexpr GLenum kIdentifier = GL_VERTEX_ARRAY;
    static GLuint create() {
        GLuint id = 0;
        glCreateVertexArrays(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct QueryKind {
    static constexpr GLenum kIdentifier = GL_QUERY;
    static GLuint create(GLenum target) {
        GLuint id = 0;
        glCreateQueries(target, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};
struct ShaderKind {
    static constexpr GLenum kIdentifier = GL_SHADER;
    static GLuint create(GLenum stage) { return glCreateShader(stage); }
    static void destroy(GLuint id) { glDeleteShader(id); }
};
struct ProgramKind {
    static constexpr GLenum kIdentifier = GL_PROGRAM;
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};

} // namespace afterglow
