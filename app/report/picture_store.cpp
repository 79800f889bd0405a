#include "app/report/picture_store.h"

#include "app/report/picture_code.h"
#include "renderer/image/image_io.h"

namespace afterglow {

int PictureStore::add(const char* type, const std::string& bytes) {
    const auto [at, isNew] = numbers_.try_emplace(bytes, int(pictures_.size()));
    if (isNew)
        pictures_.push_back({type, base64(bytes)});
    return at->second;
}

int PictureStore::addPhoto(const std::filesystem::path& file) {
    return add("image/jpeg", jpeg(readPng(file)));
}

int PictureStore::addMap(const std::filesystem::path& file, glm::ivec2 frame) {
    const auto map = readPng(file);
    return map.size() == frame ? add("image/jpeg", grayJpeg(map)) : add("image/png", grayPng(map));
}

std::string PictureStore::html() const {
    std::string html;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        html += "<script type=\"" + std::string(pictures_[i].type) + "\" id=\"p" +
                std::to_string(i) + "\">" + pictures_[i].text + "</script>\n";
    }
    return html;
}

} // namespace afterglow
