// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// A row-major array of pixels. Row 0 is the top of the picture.
template <class Pixel>
class Image {
public:
    Image() = default;
    explicit Image(glm::ivec2 size, Pixel fill = Pixel{})
        : size_(size), pixels_(std::size_t(size.x) * std::size_t(size.y), fill) {}

    glm::ivec2 size() const { return size_; }
    bool contains(glm::ivec2 p) const {
        return p.x >= 0 && p.y >= 0 && p.x < size_.x && p.y < size_.y;
    }
    Pixel& operator()(glm::ivec2 p) { return pixels_[index(p)]; }
    const Pixel& operator()(glm::ivec2 p) const { return pixels_[index(p)]; }
    std::span<const Pixel> pixels() const& { return pixels_; }
    std::span<Pixel> pixels() & { return pixels_; }
    void pixels() const&& = delete; ///< they would be gone at the end of the expression

private:
    std::size_t index(glm::ivec2 p) const {
        assert(contains(p));
        return std::size_t(p.y) * std::size_t(size_.x) + std::size_t(p.x);
    }

    glm::ivec2 size_{0};
    std::vector<Pixel> pixels_;
};

} // namespace afterglow
