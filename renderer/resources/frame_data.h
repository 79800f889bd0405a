// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/scene/camera.h"
#include "shared/frame.h"

#include <optional>

namespace afterglow {

/// The frame block. The only place where matrices of the frame before are kept.
class FrameData {
public:
    FrameData();

    /// The caller sets all that does not come from the camera; begin() sets matrices, strata and
    /// historyValid.
    gpu::FrameUniforms uniforms{};

    /// Starts a frame of `size` pixels seen by `camera` and uploads the block. Uniforms that the
    /// caller sets must be in place.
    void begin(const Camera& camera, glm::ivec2 size);
    /// Uploads the block again after a change to `uniforms` within the frame.
    void upload();
    const GpuBuffer& block() const { return buffer_; } ///< what was uploaded last
    /// Makes the frame the previous one.
    void end();
    /// Makes the next frame begin without history.
    void forget() { previous_.reset(); }

    /// The part of a frame that the next one needs; empty: nothing.
    struct View {
        glm::mat4 clipFromWorld, viewFromWorld;
        glm::vec3 cameraPosition;
    };
    const std::optional<View>& previous() const { return previous_; }
    void setPrevious(const std::optional<View>& previous) { previous_ = previous; }

private:
    GpuBuffer buffer_;
    std::optional<View> previous_;
};

} // namespace afterglow
