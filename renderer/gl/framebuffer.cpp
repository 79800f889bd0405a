// SPDX-License-Identifier: MIT
#include "renderer/gl/framebuffer.h"

#include "renderer/base/error.h"

#include <stdexcept>
#include <vector>

namespace afterglow {

namespace {

std::string statusName(GLenum status) {
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT: return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT";
    case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER: return "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE: return "GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS: return "GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS";
    case GL_FRAMEBUFFER_UNSUPPORTED: return "GL_FRAMEBUFFER_UNSUPPORTED";
    case GL_FRAMEBUFFER_UNDEFINED: return "GL_FRAMEBUFFER_UNDEFINED";
    default: return "status " + std::to_string(status);
    }
}

} // namespace

Framebuffer::Framebuffer(std::string_view label, std::initializer_list<const GpuTexture*> colors,
                         const GpuTexture* depth)
    : object_(GlObject<FramebufferKind>::create(label)) {
    const auto attach = [&](GLenum point, const GpuTexture& texture) {
        if (size_ != glm::ivec2(0) && size_ != texture.size())
            throw std::logic_error("framebuffer " + std::string(label) + ": " + texture.label() +
                                   " is not of the size of the others");
        size_ = texture.size();
        glNamedFramebufferTexture(id(), point, texture.id(), 0);
    };

    std::vector<GLenum> drawBuffers;
    for (const GpuTexture* color : colors) {
        drawBuffers.push_back(GLenum(GL_COLOR_ATTACHMENT0 + drawBuffers.size()));
        attach(drawBuffers.back(), *color);
    }
    if (depth)
        attach(GL_DEPTH_ATTACHMENT, *depth);
    glNamedFramebufferDrawBuffers(id(), GLsizei(drawBuffers.size()), drawBuffers.data());

    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error("framebuffer " + std::string(label) +
                    " is not complete: " + statusName(status));
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id());
    glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::clearColor(int attachment, glm::vec4 value) const {
    glClearNamedFramebufferfv(id(), GL_COLOR, attachment, &value.x);
}

void Framebuffer::clearColor(int attachment, glm::uvec4 value) const {
    glClearNamedFramebufferuiv(id(), GL_COLOR, attachment, &value.x);
}

void Framebuffer::clearDepth(float value) const {
    glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &value);
}

} // namespace afterglow
