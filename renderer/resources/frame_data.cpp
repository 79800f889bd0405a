// SPDX-License-Identifier: MIT
#include "renderer/resources/frame_data.h"

#include "renderer/resources/render_targets.h"

#include <cmath>

namespace afterglow {

FrameData::FrameData() : buffer_("frame", sizeof(gpu::FrameUniforms)) {}

void FrameData::begin(const Camera& camera, glm::ivec2 size) {
    const float aspect = float(size.x) / float(size.y);
    gpu::FrameUniforms& u = uniforms;
    u.viewFromWorld = camera.viewFromWorld();
    u.clipFromWorld = camera.clipFromView(aspect) * u.viewFromWorld;
    u.cameraPosition = camera.position;
    u.tanHalfFov = std::tan(0.5f * camera.lens.verticalFov);
    u.size = size;
    u.strata = strataOf(size);
    u.historyValid = previous_ ? 1u : 0u;
    const View before =
        previous_.value_or(View{u.clipFromWorld, u.viewFromWorld, u.cameraPosition});
    u.previousClipFromWorld = before.clipFromWorld;
    u.previousViewFromWorld = before.viewFromWorld;
    u.previousCameraPosition = before.cameraPosition;
    upload();
}

void FrameData::upload() {
    buffer_.write(std::span<const gpu::FrameUniforms>(&uniforms, 1));
}

void FrameData::end() {
    previous_ = View{uniforms.clipFromWorld, uniforms.viewFromWorld, uniforms.cameraPosition};
}

} // namespace afterglow
