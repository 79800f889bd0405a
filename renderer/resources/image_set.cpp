// SPDX-License-Identifier: MIT
#include "renderer/resources/image_set.h"

#include "shared/bindings.h"

#include <stdexcept>

namespace afterglow {

glm::ivec2 strataOf(glm::ivec2 size) {
    return (size + int(gpu::kStratumSize) - 1) / int(gpu::kStratumSize);
}

glm::ivec2 tilesOf(glm::ivec2 size) {
    return (size + int(gpu::kTileSize) - 1) / int(gpu::kTileSize);
}

glm::ivec2 cellsOf(ImageGrid grid, glm::ivec2 size) {
    switch (grid) {
    case ImageGrid::Pixels: return size;
    case ImageGrid::Strata: return strataOf(size);
    case ImageGrid::Tiles: return tilesOf(size);
    case ImageGrid::One: return glm::ivec2(1);
    }
    return size;
}

ImageSet::ImageSet(std::span<const ImageDecl> declared, glm::ivec2 size)
    : declared_(declared), size_(size), current_(declared.size()), previous_(declared.size()) {
    for (std::size_t i = 0; i < declared.size(); ++i) {
        const ImageDecl& image = declared[i];
        if (!image.isHistory)
            continue;
        (*this)[i];
        previous_[i] = GpuTexture(std::string(image.label) + " (previous)", image.format,
                                  cellsOf(image.grid, size));
        previous_[i].clear();
    }
}

GpuTexture& ImageSet::operator[](std::size_t image) {
    GpuTexture& texture = current_.at(image);
    if (texture.size().x == 0) {
        const ImageDecl& wanted = declared_[image];
        texture = GpuTexture(wanted.label, wanted.format, cellsOf(wanted.grid, size_));
        texture.clear();
    }
    return texture;
}

const GpuTexture* ImageSet::find(std::size_t image) const {
    const GpuTexture& texture = current_.at(image);
    return texture.size().x == 0 ? nullptr : &texture;
}

const GpuTexture& ImageSet::previous(std::size_t image) const {
    if (!declared_[image].isHistory)
        throw std::logic_error("image " + std::string(declared_[image].label) + " is no history");
    return previous_[image];
}

void ImageSet::swapHistories() {
    for (std::size_t i = 0; i < declared_.size(); ++i)
        if (declared_[i].isHistory)
            std::swap(current_[i], previous_[i]);
}

void ImageSet::clearHistories() {
    for (std::size_t i = 0; i < declared_.size(); ++i)
        if (declared_[i].isHistory) {
            current_[i].clear();
            previous_[i].clear();
        }
}

std::vector<GpuTexture*> ImageSet::kept() {
    std::vector<GpuTexture*> images;
    for (std::size_t i = 0; i < declared_.size(); ++i)
        if (declared_[i].isHistory)
            images.push_back(&current_[i]);
    return images;
}

std::vector<const GpuTexture*> ImageSet::all() const {
    std::vector<const GpuTexture*> images;
    for (const auto* textures : {&current_, &previous_})
        for (const GpuTexture& texture : *textures)
            if (texture.size().x != 0)
                images.push_back(&texture);
    return images;
}

std::size_t bytesOf(std::span<const ImageDecl> declared, glm::ivec2 size) {
    std::size_t sum = 0;
    for (const ImageDecl& image : declared) {
        const glm::ivec2 cells = cellsOf(image.grid, size);
        sum += std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(info(image.format).bytes) *
               (image.isHistory ? 2 : 1);
    }
    return sum;
}

} // namespace afterglow
