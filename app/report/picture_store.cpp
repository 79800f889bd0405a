// SPDX-License-Identifier: MIT
#include "app/report/picture_store.h"

#include "renderer/image/image_io.h"

#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>
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

std::string grayPng(const Image<glm::u8vec4>& picture) {
    const auto values = channelsOf(picture, 1);
    const glm::ivec2 size = picture.size();
    std::string bytes;
    if (!stbi_write_png_to_func(append, &bytes, size.x, size.y, 1, values.data(), size.x))
        throw std::logic_error("a picture cannot be made a PNG");
    return bytes;
}

} // namespace

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

int PictureStore::add(const char* type, const std::string& bytes) {
    const auto [at, isNew] = numbers_.try_emplace(bytes, int(pictures_.size()));
    if (isNew)
        pictures_.push_back({type, base64(bytes)});
    return at->second;
}

int PictureStore::addPhoto(const std::filesystem::path& file) {
    return add("image/jpeg", encodedJpeg(readPng(file), 3, kPictureQuality));
}

int PictureStore::addMap(const std::filesystem::path& file, glm::ivec2 frame) {
    const auto map = readPng(file);
    return map.size() == frame ? add("image/jpeg", encodedJpeg(map, 1, kMapQuality))
                               : add("image/png", grayPng(map));
}

std::string PictureStore::html() const {
    std::string html;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        html += fmt::format("<script type=\"{}\" id=\"p{}\">{}</script>\n", pictures_[i].type, i,
                            pictures_[i].text);
    }
    return html;
}

} // namespace afterglow
