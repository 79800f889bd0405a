// SPDX-License-Identifier: MIT
#include "renderer/gl/texture_array.h"

#include "renderer/base/error.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {

namespace {

GLint asGl(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::Clamp: return GL_CLAMP_TO_EDGE;
    case TextureWrap::Repeat: return GL_REPEAT;
    case TextureWrap::MirroredRepeat: return GL_MIRRORED_REPEAT;
    }
    throw std::logic_error("a way to wrap a texture that is not in the table");
}

bool isAveraged(PixelFormat format) {
    return !info(format).isInteger && format != PixelFormat::Depth32F;
}

} // namespace

int mipLevels(glm::ivec2 size) {
    int levels = 1;
    for (int edge = std::max(size.x, size.y); edge > 1; edge /= 2)
        ++levels;
    return levels;
}

GpuTextureArray::GpuTextureArray(std::string_view label, PixelFormat format, glm::ivec2 size,
                                 int layers, int levels)
    : label_(label), format_(format), size_(size), layers_(layers), levels_(levels) {
    if (size.x <= 0 || size.y <= 0 || layers <= 0)
        throw std::logic_error("texture " + label_ + " would be " + std::to_string(layers) +
                               " layers of " + sizeText(size) + " pixels");
    if (levels < 1 || levels > mipLevels(size))
        throw std::logic_error("texture " + label_ + " of " + sizeText(size) +
                               " pixels cannot have " + std::to_string(levels) + " levels");
    GLint mostLayers = 0, mostPixels = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &mostLayers);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostPixels);
    if (layers > mostLayers || std::max(size.x, size.y) > mostPixels)
        throw Error("texture " + label_ + " needs " + std::to_string(layers) + " layers of " +
                    sizeText(size) + " pixels; this driver has textures of " +
                    std::to_string(mostLayers) + " layers and " + std::to_string(mostPixels) +
                    " pixels along a side");
    object_ = GlObject<TextureKind>::create(label, GLenum(GL_TEXTURE_2D_ARRAY));
    allocateGl("texture " + label_,
               std::to_string(layers) + " layers of " + sizeText(size) + " pixels of " +
                   std::string(info(format).name) + " with " + std::to_string(levels) + " levels",
               bytes(), [&] {
                   glTextureStorage3D(id(), levels, info(format).internal, size.x, size.y, layers);
               });
    setSampling({});
}

glm::ivec2 GpuTextureArray::sizeOf(int level) const {
    return glm::max(size_ >> level, glm::ivec2(1));
}

std::size_t GpuTextureArray::bytes() const {
    std::size_t pixels = 0;
    for (int level = 0; level < levels_; ++level)
        pixels += std::size_t(sizeOf(level).x) * std::size_t(sizeOf(level).y);
    return pixels * std::size_t(layers_) * std::size_t(info(format_).bytes);
}

void GpuTextureArray::checkPlace(int layer, int level) const {
    if (layer < 0 || layer >= layers_)
        throw std::logic_error("texture " + label_ + " has " + std::to_string(layers_) +
                               " layers, but was asked for layer " + std::to_string(layer));
    if (level < 0 || level >= levels_)
        throw std::logic_error("texture " + label_ + " has " + std::to_string(levels_) +
                               " levels, but was asked for level " + std::to_string(level));
}

template <class Pixel>
void GpuTextureArray::write(int layer, const Image<Pixel>& image) {
    checkPixel(label_, format_, kPixelInfo<Pixel>);
    checkPlace(layer, 0);
    if (image.size() != size_)
        throw std::logic_error("texture " + label_ + " is " + sizeText(size_) +
                               " pixels, but was given " + sizeText(image.size()));
    const FormatInfo format = info(format_);
    glTextureSubImage3D(id(), 0, 0, 0, layer, size_.x, size_.y, 1, format.layout, format.type,
                        image.pixels().data());
}

template <class Pixel>
Image<Pixel> GpuTextureArray::read(int layer, int level) const {
    checkPixel(label_, format_, kPixelInfo<Pixel>);
    checkPlace(layer, level);
    Image<Pixel> image(sizeOf(level));
    const FormatInfo format = info(format_);
    glGetTextureSubImage(id(), level, 0, 0, layer, image.size().x, image.size().y, 1, format.layout,
                         format.type, GLsizei(image.pixels().size_bytes()), image.pixels().data());
    return image;
}

void GpuTextureArray::makeMips() {
    if (!isAveraged(format_))
        throw std::logic_error("texture " + label_ + " is " + std::string(info(format_).name) +
                               ", of which there are no averages");
    glGenerateTextureMipmap(id());
}

void GpuTextureArray::clear() {
    const FormatInfo format = info(format_);
    for (int level = 0; level < levels_; ++level)
        glClearTexImage(id(), level, format.layout, format.type, nullptr);
}

void GpuTextureArray::setSampling(const TextureSampling& sampling) {
    const bool isNearest = sampling.filter == TextureFilter::Nearest;
    if (!isNearest && !isAveraged(format_))
        throw std::logic_error("texture " + label_ + " is " + std::string(info(format_).name) +
                               ", of which there are no averages");
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER,
                        isNearest ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, isNearest ? GL_NEAREST : GL_LINEAR);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, asGl(sampling.wrapX));
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, asGl(sampling.wrapY));
}

#define INSTANTIATE(Pixel)                                                                         \
    template void GpuTextureArray::write(int, const Image<Pixel>&);                                \
    template Image<Pixel> GpuTextureArray::read(int, int) const;
AFTERGLOW_FOR_EACH_PIXEL(INSTANTIATE)
#undef INSTANTIATE

} // namespace afterglow
