// SPDX-License-Identifier: MIT
#include "renderer/passes/difference_pass.h"

#include "shared/instrument_params.h"

#include <stdexcept>

namespace afterglow {
namespace {

const char* declarationOf(const GpuTexture& source) {
    switch (source.format()) {
    case PixelFormat::R32F: return "FloatTexture";
    case PixelFormat::RG32F: return "Float2Texture";
    case PixelFormat::RGBA32F: return "Float4Texture";
    default: break;
    }
    throw std::logic_error("DifferencePass: " + source.label() + " is " +
                           std::string(info(source.format()).name) +
                           ", of which there is no difference");
}

void requireAlike(const GpuTexture& a, const GpuTexture& b, PixelFormat format) {
    if (b.format() != format || b.size() != a.size())
        throw std::logic_error("DifferencePass: " + b.label() + " does not go with " + a.label());
}

} // namespace

DifferencePass::DifferencePass(ShaderLibrary& shaders) : shaders_(shaders) {}

void DifferencePass::run(FrameContext& frame, const GpuTexture& a, const GpuTexture& b,
                         GpuTexture& difference, Difference kind) {
    const char* source = declarationOf(a);
    requireAlike(a, b, a.format());
    requireAlike(a, difference, PixelFormat::RGBA32F);
    // Compiled when it is first needed: most runs compare nothing.
    ComputeProgram& program = shaders_.compute("post/difference.comp", {{"SOURCE", source}});
    const auto scope = frame.timer.scope(frame.prefix + "difference");
    const gpu::DifferenceParams params{kind == Difference::Absolute ? 1 : 0, 0, 0, 0};
    program.dispatch(difference.size(), params, {{"minuend", a}, {"subtrahend", b}},
                     {{"difference", difference}});
}

} // namespace afterglow
