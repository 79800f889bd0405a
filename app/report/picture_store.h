// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

std::string base64(std::string_view bytes); ///< with padding, without line breaks

/// The pictures of a page, each kept once however often it is shown.
class PictureStore {
public:
    /// Reads a PNG of what is shown as it is, and returns the picture's number. InputError names
    /// the file. It becomes a JPEG of quality 90; the same picture gives the same bytes.
    int addPhoto(const std::filesystem::path& file);

    /// The same of a map, whose red channel holds values: exact if it has a value per stratum; a
    /// JPEG if it is as large as the frame, for those are most of the bytes.
    int addMap(const std::filesystem::path& file, glm::ivec2 frame);

    std::size_t size() const { return pictures_.size(); }

    /// An inert script element for each, "p0" and so on, that holds its bytes in base 64: the
    /// browser decodes none of them before the page asks.
    std::string html() const;

private:
    struct Picture {
        const char* type; ///< "image/png"
        std::string text; ///< base 64
    };

    int add(const char* type, const std::string& bytes);

    std::vector<Picture> pictures_;
    std::unordered_map<std::string, int> numbers_; ///< by their bytes
};

} // namespace afterglow
