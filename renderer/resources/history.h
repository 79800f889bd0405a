#pragma once

#include "renderer/gl/texture.h"

#include <string>
#include <utility>

namespace afterglow {

/// Two textures that change places at the end of each frame.
class History {
public:
    History() = default;
    History(const std::string& label, PixelFormat format, glm::ivec2 size)
        : current_(label, format, size), previous_(label + " (previous)", format, size) {}

    const GpuTexture& previous() const { return previous_; }
    const GpuTexture& current() const { return current_; }
    GpuTexture& current() { return current_; }
    void swap() { std::swap(current_, previous_); }
    void clear() {
        current_.clear();
        previous_.clear();
    }

private:
    GpuTexture current_, previous_;
};

} // namespace afterglow
