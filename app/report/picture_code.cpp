#include "app/report/picture_code.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <stb_image_write.h>

namespace afterglow {

namespace {

// Maps as large as the frame would be most of a page at the quality of the pictures.
constexpr int kPictureQuality = 90, kMapQuality = 75;

void append(void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), std::size_t(size));
}

std::vector<std::uint8_t> channelsOf(const Image<glm::u8vec4>& picture, int count) {
    std::vector<std::uint8_t> values;
    values.reserve(picture.pixels().size() * std::size_t(count));
    for (const glm::u8vec4& pixel : picture.pixels())
        for (int c = 0; c < count; ++c)
            values.push_back(pixel[c]);
    return values;
}

std::string encodedJpeg(const Image<glm::u8vec4>& picture, int channels, int quality) {
    const auto values = channelsOf(picture, channels);
    std::string bytes;
    if (!stbi_write_jpg_to_func(append, &bytes, picture.size().x, picture.size().y, channels,
                                values.data(), quality))
        throw std::logic_error("a picture cannot be made a JPEG");
    return bytes;
}

} // namespace

std::string jpeg(const Image<glm::u8vec4>& picture) {
    return encodedJpeg(picture, 3, kPictureQuality);
}

std::string grayJpeg(const Image<glm::u8vec4>& picture) {
    return encodedJpeg(picture, 1, kMapQuality);
}

std::string grayPng(const Image<glm::u8vec4>& picture) {
    const auto values = channelsOf(picture, 1);
    const glm::ivec2 size = picture.size();
    std::string bytes;
    if (!stbi_write_png_to_func(append, &bytes, size.x, size.y, 1, values.data(), size.x))
        throw std::logic_error("a picture cannot be made a PNG");
    return bytes;
}

std::string base64(std::string_view bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

} // namespace afterglow
