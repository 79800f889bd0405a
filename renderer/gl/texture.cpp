#include "renderer/gl/texture.h"

#include <stdexcept>

#include <glm/gtc/type_precision.hpp>

namespace afterglow {

namespace {

/// How a pixel type of ours is called by OpenGL.
struct PixelInfo {
    GLenum layout, type;
    std::string_view name;
};
template <class Pixel>
constexpr PixelInfo kPixelInfo{};
template <>
constexpr PixelInfo kPixelInfo<float>{GL_RED, GL_FLOAT, "float"};
template <>
constexpr PixelInfo kPixelInfo<glm::vec2>{GL_RG, GL_FLOAT, "vec2"};
template <>
constexpr PixelInfo kPixelInfo<glm::vec4>{GL_RGBA, GL_FLOAT, "vec4"};
template <>
constexpr PixelInfo kPixelInfo<std::uint32_t>{GL_RED_INTEGER, GL_UNSIGNED_INT, "uint"};
template <>
constexpr PixelInfo kPixelInfo<glm::uvec2>{GL_RG_INTEGER, GL_UNSIGNED_INT, "uvec2"};
template <>
constexpr PixelInfo kPixelInfo<glm::uvec4>{GL_RGBA_INTEGER, GL_UNSIGNED_INT, "uvec4"};
template <>
constexpr PixelInfo kPixelInfo<glm::u8vec4>{GL_RGBA, GL_UNSIGNED_BYTE, "u8vec4"};

void checkPixel(const GpuTexture& texture, const PixelInfo& pixel) {
    const FormatInfo format = info(texture.format());
    const bool oneFloat = texture.format() == PixelFormat::Depth32F && pixel.layout == GL_RED;
    if (pixel.type != format.type || (pixel.layout != format.layout && !oneFloat))
        throw std::logic_error("texture " + texture.label() + " is " + std::string(format.name) +
                               ", which does not hold pixels of type " + std::string(pixel.name));
}

std::string text(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

} // namespace

FormatInfo info(PixelFormat format) {
    switch (format) {
    case PixelFormat::R32F: return {GL_R32F, GL_RED, GL_FLOAT, 4, "R32F", false};
    case PixelFormat::RG32F: return {GL_RG32F, GL_RG, GL_FLOAT, 8, "RG32F", false};
    case PixelFormat::RGBA32F: return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, "RGBA32F", false};
    case PixelFormat::RGBA16F: return {GL_RGBA16F, GL_RGBA, GL_FLOAT, 8, "RGBA16F", false};
    case PixelFormat::R32UI: return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, "R32UI", true};
    case PixelFormat::RG32UI: return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8, "RG32UI", true};
    case PixelFormat::RGBA32UI:
        return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16, "RGBA32UI", true};
    case PixelFormat::RGBA8: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, "RGBA8", false};
    case PixelFormat::Depth32F:
        return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4, "Depth32F", false};
    }
    throw std::logic_error("a pixel format that is not in the table");
}

GpuTexture::GpuTexture(std::string_view label, PixelFormat format, glm::ivec2 size)
    : label_(label), format_(format), size_(size) {
    if (size.x <= 0 || size.y <= 0)
        throw std::logic_error("texture " + label_ + " would be " + text(size) + " pixels");
    object_ = GlObject<TextureKind>::create(label, GLenum(GL_TEXTURE_2D));
    glTextureStorage2D(id(), 1, info(format).internal, size.x, size.y);
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
    checkPixel(*this, kPixelInfo<Pixel>);
    if (image.size() != size_)
        throw std::logic_error("texture " + label_ + " is " + text(size_) +
                               " pixels, but was given " + text(image.size()));
    const FormatInfo format = info(format_);
    glTextureSubImage2D(id(), 0, 0, 0, size_.x, size_.y, format.layout, format.type,
                        image.pixels().data());
}

template <class Pixel>
Image<Pixel> GpuTexture::read() const {
    checkPixel(*this, kPixelInfo<Pixel>);
    Image<Pixel> image(size_);
    const FormatInfo format = info(format_);
    glGetTextureImage(id(), 0, format.layout, format.type, GLsizei(image.pixels().size_bytes()),
                      image.pixels().data());
    return image;
}

template <class Pixel>
Pixel GpuTexture::readAt(glm::ivec2 p) const {
    checkPixel(*this, kPixelInfo<Pixel>);
    if (p.x < 0 || p.y < 0 || p.x >= size_.x || p.y >= size_.y)
        throw std::logic_error("texture " + label_ + " has no pixel " + text(p));
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
INSTANTIATE(float)
INSTANTIATE(glm::vec2)
INSTANTIATE(glm::vec4)
INSTANTIATE(std::uint32_t)
INSTANTIATE(glm::uvec2)
INSTANTIATE(glm::uvec4)
INSTANTIATE(glm::u8vec4)
#undef INSTANTIATE

} // namespace afterglow
