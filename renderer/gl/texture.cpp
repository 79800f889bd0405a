// SPDX-License-Identifier: MIT
#include "renderer/gl/texture.h"

#include "renderer/gl/errors.h"

#include <stdexcept>

namespace afterglow {

GpuTexture::GpuTexture(std::string_view label, PixelFormat format, glm::ivec2 size)
    : label_(label), format_(format), size_(size) {
    if (size.x <= 0 || size.y <= 0)
        throw std::logic_error("texture " + label_ + " would be " + sizeText(size) + " pixels");
    object_ = GlObject<TextureKind>::create(label, GLenum(GL_TEXTURE_2D));
    allocateGl("texture " + label_, sizeText(size) + " pixels of " + std::string(info(format).name),
               bytes(),
               [&] { glTextureStorage2D(id(), 1, info(format).internal, size.x, size.y); });
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

std::size_t GpuTexture::bytes() const {
    return std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(info(format_).bytes);
}

template <class Pixel>
void GpuTexture::write(const Image<Pixel>& image) {
    checkPixel(label_, format_, kPixelInfo<Pixel>);
    if (image.size() != size_)
        throw std::logic_error("texture " + label_ + " is " + sizeText(size_) +
                               " pixels, but was given " + sizeText(image.size()));
    const FormatInfo format = info(format_);
    glTextureSubImage2D(id(), 0, 0, 0, size_.x, size_.y, format.layout, format.type,
                        image.pixels().data());
}

template <class Pixel>
Image<Pixel> GpuTexture::read() const {
    checkPixel(label_, format_, kPixelInfo<Pixel>);
    Image<Pixel> image(size_);
    const FormatInfo format = info(format_);
    glGetTextureImage(id(), 0, format.layout, format.type, GLsizei(image.pixels().size_bytes()),
                      image.pixels().data());
    return image;
}

template <class Pixel>
Pixel GpuTexture::readAt(glm::ivec2 p) const {
    checkPixel(label_, format_, kPixelInfo<Pixel>);
    if (p.x < 0 || p.y < 0 || p.x >= size_.x || p.y >= size_.y)
        throw std::logic_error("texture " + label_ + " has no pixel " + sizeText(p));
    Pixel pixel;
    const FormatInfo format = info(format_);
    glGetTextureSubImage(id(), 0, p.x, p.y, 0, 1, 1, 1, format.layout, format.type,
                         GLsizei(sizeof pixel), &pixel);
    return pixel;
}

void GpuTexture::copyFrom(const GpuTexture& other) {
    if (other.format_ != format_ || other.size_ != size_)
        throw std::logic_error("texture " + label_ + " cannot take the pixels of " + other.label_ +
                               ", which is of another kind");
    glCopyImageSubData(other.id(), GL_TEXTURE_2D, 0, 0, 0, 0, id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       size_.x, size_.y, 1);
}

GpuTexture GpuTexture::copy() const {
    GpuTexture twin(label_, format_, size_);
    twin.copyFrom(*this);
    return twin;
}

void GpuTexture::clear() {
    const FormatInfo format = info(format_);
    glClearTexImage(id(), 0, format.layout, format.type, nullptr);
}

#define INSTANTIATE(Pixel)                                                                         \
    template void GpuTexture::write(const Image<Pixel>&);                                          \
    template Image<Pixel> GpuTexture::read() const;                                                \
    template Pixel GpuTexture::readAt(glm::ivec2) const;
AFTERGLOW_FOR_EACH_PIXEL(INSTANTIATE)
#undef INSTANTIATE

} // namespace afterglow
