// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/program.h"
#include "renderer/gl/readback.h"

#include <array>

namespace afterglow {

/// The defines that compile a pass to write what it computes at one texel: see
/// shaders/lib/inspect.glsl.
inline Defines inspecting(Defines defines = {}) {
    defines.emplace_back("INSPECT", "1");
    return defines;
}

/// The buffer that such a pass writes.
template <class Findings>
class FindingsBuffer {
public:
    using Region = PixelReadback::Region<Findings>;

    /// Clears the findings for a texel of an image of that size. std::logic_error if the texel lies
    /// outside.
    Binding start(glm::ivec2 texel, glm::ivec2 size) {
        if (glm::any(glm::lessThan(texel, glm::ivec2(0))) ||
            glm::any(glm::greaterThanEqual(texel, size)))
            throw std::logic_error("a pass is inspected at a texel of its outputs only");
        if (buffer_.empty())
            buffer_ = GpuBuffer("findings", sizeof(Findings));
        Findings empty{};
        empty.texel = texel;
        buffer_.write(std::array{empty});
        return {"Inspected", buffer_};
    }
    Region copyTo(PixelReadback& readback) const { return readback.add<Findings>(buffer_); }

private:
    GpuBuffer buffer_; ///< made when it is first needed
};

} // namespace afterglow
