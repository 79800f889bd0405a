// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/texture.h"

#include <initializer_list>

namespace afterglow {

/// Textures to draw into, all of one size. They must outlive it.
class Framebuffer {
public:
    Framebuffer() = default;
    /// Throws Error naming the driver's status when the attachments do not go together.
    Framebuffer(std::string_view label, std::initializer_list<const GpuTexture*> colors,
                const GpuTexture* depth = nullptr);

    GLuint id() const { return object_.id(); }
    glm::ivec2 size() const { return size_; }

    void bind() const; ///< for drawing, with the viewport over all of it
    void clearColor(int attachment, glm::vec4 value) const;  ///< float and normalized formats
    void clearColor(int attachment, glm::uvec4 value) const; ///< unsigned integer formats
    void clearDepth(float value) const;                      ///< in [0, 1]

private:
    GlObject<FramebufferKind> object_;
    glm::ivec2 size_{0};
};

} // namespace afterglow
