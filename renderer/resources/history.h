// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/texture.h"

#include <string>
#include <utility>

namespace afterglow {

/// Two textures, arrays of textures or buffers of texels that change places at the end of each
/// frame. They are made of the same arguments, and know no size but their own.
template <class Resource>
class HistoryOf {
public:
    HistoryOf() = default;
    template <class... Args>
    explicit HistoryOf(const std::string& label, const Args&... args)
        : current_(label, args...), previous_(label + " (previous)", args...) {}

    const Resource& previous() const { return previous_; }
    const Resource& current() const { return current_; }
    Resource& current() { return current_; }
    void swap() { std::swap(current_, previous_); }
    void clear() {
        current_.clear();
        previous_.clear();
    }

private:
    Resource current_, previous_;
};

class History : public HistoryOf<GpuTexture> {
public:
    using HistoryOf::HistoryOf;
};

} // namespace afterglow
