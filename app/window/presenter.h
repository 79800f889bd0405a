// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/layout.h"
#include "renderer/gl/object.h"
#include "renderer/gl/texture.h"

namespace afterglow {

/// Brings a picture to the window and back: the only part that touches the default framebuffer
/// beside the panels.
class Presenter {
public:
    Presenter();

    /// Fills the back buffer of that size with a dark ground.
    void clear(glm::ivec2 framebuffer);
    /// Scales a picture (RGBA8, sRGB-encoded, row 0 on top) into `where`; only what lies in `shown`
    /// is drawn.
    void draw(const GpuTexture& picture, const Rect& where, const Rect& shown,
              glm::ivec2 framebuffer, bool smooth);

    /// What is in the back buffer now; opaque, row 0 on top.
    Image<glm::u8vec4> readWindow(glm::ivec2 framebuffer) const;

private:
    GlObject<FramebufferKind> source_;
};

} // namespace afterglow
