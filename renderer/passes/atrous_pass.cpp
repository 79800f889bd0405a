// SPDX-License-Identifier: MIT
#include "renderer/passes/atrous_pass.h"

#include <bit>
#include <stdexcept>

namespace afterglow {
namespace {

constexpr const char* kShader = "denoise/atrous.comp";

/// Returns the threads of one iteration: one a pixel, or by image one for each two rows that are a
/// step apart.
glm::ivec2 threadsFor(glm::ivec2 size, int step, bool byImage) {
    if (!byImage)
        return size;
    const int rows = 2 * step;
    return {size.x, (size.y + rows - 1) / rows * step};
}

} // namespace

void AtrousPass::prepare(const gpu::EdgeStopping& params) {
    shaders_.compute(kShader, definesOf(kernel_, params.sigmaNormal));
}

void AtrousPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                     const gpu::EdgeStopping& params) {
    if (params.step < 1 || !std::has_single_bit(unsigned(params.step)))
        throw std::logic_error("AtrousPass: a step of " + std::to_string(params.step) +
                               " is no power of two");
    const auto scope = frame.pass("a-trous", {&out.filtered});
    const glm::ivec2 threads =
        threadsFor(out.filtered.size(), params.step, shaders_.fetchesByImage());
    shaders_.compute(kShader, definesOf(kernel_, params.sigmaNormal))
        .dispatch(threads, params,
                  {{"signal", in.signal}, {"guides", in.guides}, {"slope", in.slope}},
                  {{"filtered", out.filtered}});
}

} // namespace afterglow
