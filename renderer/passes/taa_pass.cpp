// SPDX-License-Identifier: MIT
#include "renderer/passes/taa_pass.h"

#include <array>
#include <vector>

namespace afterglow {

void TaaPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                  const gpu::TaaParams& params) {
    const auto scope = frame.pass("anti-aliasing", {&out.resolved});
    std::vector<Binding> reads{frame.block(),
                               {"color", in.color},
                               {"guides", in.guides},
                               {"motion", in.motion},
                               {"history", in.history}};
    if (in.exposure)
        reads.emplace_back("exposure", *in.exposure);
    const std::array<Binding, 1> writes{Binding{"resolved", out.resolved}};
    shaders_.compute("post/taa.comp", in.exposure ? Defines{{"AUTO_EXPOSURE", "1"}} : Defines{})
        .dispatch(out.resolved.size(), params, reads, writes);
}

} // namespace afterglow
