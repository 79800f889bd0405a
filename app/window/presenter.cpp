// SPDX-License-Identifier: MIT
#include "app/window/presenter.h"

namespace afterglow {
namespace {

constexpr GLuint kWindow = 0;                               // the default framebuffer
constexpr float kGround[] = {0.043f, 0.047f, 0.055f, 1.0f}; // encoded as it is shown

} // namespace

Presenter::Presenter() : source_(GlObject<FramebufferKind>::create("picture to window")) {}

void Presenter::clear(glm::ivec2 framebuffer) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, kWindow);
    glDrawBuffer(GL_BACK);
    glDisable(GL_FRAMEBUFFER_SRGB); // all colors are encoded already
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, framebuffer.x, framebuffer.y);
    glClearBufferfv(GL_COLOR, 0, kGround);
}

void Presenter::draw(const GpuTexture& picture, const Rect& where, const Rect& shown,
                     glm::ivec2 framebuffer, bool smooth) {
    if (where.empty() || shown.empty())
        return;
    glNamedFramebufferTexture(source_.id(), GL_COLOR_ATTACHMENT0, picture.id(), 0);
    const glm::ivec2 size = picture.size();
    // Row 0 is the top of the picture and the bottom of the window.
    const int top = framebuffer.y - where.min.y;
    const int bottom = top - where.size.y;
    // A blit heeds the scissor: a part of the picture stands where it would stand in the whole.
    glEnable(GL_SCISSOR_TEST);
    glScissor(shown.min.x, framebuffer.y - shown.min.y - shown.size.y, shown.size.x, shown.size.y);
    glBlitNamedFramebuffer(source_.id(), kWindow, 0, 0, size.x, size.y, where.min.x, top,
                           where.min.x + where.size.x, bottom, GL_COLOR_BUFFER_BIT,
                           smooth && size != where.size ? GL_LINEAR : GL_NEAREST);
    glDisable(GL_SCISSOR_TEST);
    // The texture may be gone before the next frame.
    glNamedFramebufferTexture(source_.id(), GL_COLOR_ATTACHMENT0, 0, 0);
}

Image<glm::u8vec4> Presenter::readWindow(glm::ivec2 framebuffer) const {
    Image<glm::u8vec4> upsideDown(framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, kWindow);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, framebuffer.x, framebuffer.y, GL_RGBA, GL_UNSIGNED_BYTE,
                 upsideDown.pixels().data());
    Image<glm::u8vec4> image(framebuffer);
    for (int y = 0; y < framebuffer.y; ++y)
        for (int x = 0; x < framebuffer.x; ++x) {
            const glm::u8vec4 color = upsideDown({x, framebuffer.y - 1 - y});
            image({x, y}) = {color.r, color.g, color.b, 255};
        }
    return image;
}

} // namespace afterglow
