// SPDX-License-Identifier: MIT
#include "app/base/aov_files.h"

namespace afterglow {

int writeAov(const OutputFolder& folder, std::string_view format, const Renderer& renderer,
             const AovInfo& aov, std::optional<int> frame, std::size_t state) {
    const auto signals = renderer.signals();
    const std::size_t count = aov.perSignal ? signals.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string stem = fileStem(aov, signals[i], signals.size());
        folder.writeFloat(frame ? frameStem(stem, *frame) : stem, format,
                          readAov(renderer, aov, state, i), aov.channels);
    }
    return int(count);
}

} // namespace afterglow
