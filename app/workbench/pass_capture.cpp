// SPDX-License-Identifier: MIT
#include "app/workbench/pass_capture.h"

#include <algorithm>

namespace afterglow {

void PassCapture::begin(Keep keep, std::size_t index) {
    keep_ = keep;
    wanted_ = index;
    next_ = 0;
}

void PassCapture::passDone(std::string_view pass, std::span<const GpuTexture* const> made) {
    const auto last = std::find_if(made_.rend() - std::ptrdiff_t(next_), made_.rend(),
                                   [&](const Made& m) { return m.name == pass; });
    const int run = last == made_.rend() ? 1 : last->run + 1;
    for (const GpuTexture* texture : made) {
        if (next_ == made_.size())
            made_.emplace_back();
        Made& slot = made_[next_];
        slot.name = pass;
        slot.run = run;
        // Of two that change places with every frame, either may be the one.
        slot.image = texture->label().substr(0, texture->label().find(" (previous)"));
        const bool keeps = keep_ == Keep::All || (keep_ == Keep::One && next_ == wanted_);
        ++next_;
        if (!keeps) {
            slot.texture = {};
            continue;
        }
        const bool fits =
            slot.texture.size() == texture->size() && slot.texture.format() == texture->format();
        if (fits)
            slot.texture.copyFrom(*texture);
        else
            slot.texture = texture->copy();
    }
}

void PassCapture::end() {
    made_.resize(next_);
    for (Made& m : made_)
        m.isOnly = std::ranges::none_of(
            made_, [&](const Made& other) { return other.name == m.name && other.run != m.run; });
}

const GpuTexture* PassCapture::image(std::size_t index) const {
    if (index >= made_.size() || made_[index].texture.size().x == 0)
        return nullptr;
    return &made_[index].texture;
}

std::size_t PassCapture::bytes() const {
    std::size_t sum = 0;
    for (const Made& m : made_)
        if (m.texture.size().x > 0)
            sum += m.texture.bytes();
    return sum;
}

void PassCapture::clear() {
    made_.clear();
    next_ = 0;
}

} // namespace afterglow
