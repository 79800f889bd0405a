// SPDX-License-Identifier: MIT
#include "renderer/passes/debug_view_pass.h"

#include <stdexcept>

namespace afterglow {
namespace {

Defines definesOf(const GpuTexture& source) {
    const auto declared = [](const char* type) { return Defines{{"SOURCE", type}}; };
    const auto integers = [](const char* type) {
        return Defines{{"SOURCE", type}, {"SOURCE_IS_INTEGER", "1"}};
    };
    switch (source.format()) {
    case PixelFormat::R32F: return declared("FloatTexture");
    case PixelFormat::RG32F: return declared("Float2Texture");
    case PixelFormat::RGBA32F: return declared("Float4Texture");
    case PixelFormat::R32UI: return integers("UintTexture");
    case PixelFormat::RG32UI: return integers("Uint2Texture");
    case PixelFormat::RGBA32UI: return integers("Uint4Texture");
    default: break;
    }
    throw std::logic_error("DebugViewPass: " + source.label() + " is " +
                           std::string(info(source.format()).name) + ", of which there is no view");
}

} // namespace

DebugViewPass::DebugViewPass(ShaderLibrary& shaders) : shaders_(shaders) {}

void DebugViewPass::run(FrameContext& frame, const GpuTexture& source, GpuTexture& display,
                        const gpu::DebugViewParams& params) {
    // Compiled when it is first needed: most runs look at few kinds of images.
    ComputeProgram& program = shaders_.compute("post/debug_view.comp", definesOf(source));
    const auto scope = frame.timer.scope("debug view");
    program.dispatch(display.size(), params, {{"source", source}}, {{"display", display}});
}

} // namespace afterglow
