#include "app/workbench/pass_capture.h"

#include <algorithm>
#include <set>

namespace afterglow {

void PassCapture::begin(Keep keep, std::size_t index) {
    keep_ = keep;
    wanted_ = index;
    next_ = 0;
}

void PassCapture::passDone(std::string_view pass, std::span<const GpuTexture* const> made) {
    // Passes of one name count from 1 on; a frame in which there is only one is told at its end.
    const auto before = std::count_if(made_.begin(), made_.begin() + std::ptrdiff_t(next_),
                                      [&](const Made& m) { return m.name == pass; });
    const auto images = std::ptrdiff_t(made.size());
    const std::string numbered = std::string(pass) + " " + std::to_string(before / images + 1);
    for (const GpuTexture* texture : made) {
        if (next_ == made_.size())
            made_.emplace_back();
        Made& slot = made_[next_];
        slot.pass = numbered;
        slot.name = pass;
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
    std::set<std::string> again; // names of passes that ran more than once
    for (const Made& m : made_)
        if (m.pass == m.name + " 2")
            again.insert(m.name);
    for (Made& m : made_)
        if (!again.contains(m.name))
            m.pass = m.name;
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
