// SPDX-License-Identifier: MIT
#include "renderer/passes/change_pass.h"

namespace afterglow {

void LightPairsPass::run(FrameContext& frame, const Inputs& in, const Outputs& out) {
    const auto scope =
        frame.pass("light pairs", {&out.pairs.before, &out.pairs.now, &out.pairs.products});
    Defines defines = in.defines();
    defines.emplace_back("CHANNELS", "1");
    const std::array<Binding, 4> writes{Binding{"before", out.pairs.before},
                                        {"now", out.pairs.now},
                                        {"products", out.pairs.products},
                                        {"changed", out.changed}};
    out.changed.clear();
    shaders_.compute("denoise/gradient.comp", defines)
        .dispatch(out.pairs.before.size(), in.bindings(), writes);
}

void LightPairsAtrousPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                               Kernel kernel, const gpu::EdgeStopping& params) {
    const auto scope = frame.pass(
        "light pairs a-trous", {&out.filtered.before, &out.filtered.now, &out.filtered.products});
    Defines defines = definesOf(kernel, params.sigmaNormal);
    defines.emplace_back("CHANNELS", "1");
    shaders_.compute("denoise/gradient_atrous.comp", defines)
        .dispatch(out.filtered.before.size(), params,
                  {{"before", in.pairs.before},
                   {"now", in.pairs.now},
                   {"products", in.pairs.products},
                   {"strataGuides", in.strataGuides},
                   {"strataSlope", in.strataSlope}},
                  {{"filteredBefore", out.filtered.before},
                   {"filteredNow", out.filtered.now},
                   {"filteredProducts", out.filtered.products}});
}

void ChangePass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                     const gpu::ChangeParams& params) {
    const auto scope = frame.pass("change", {&out.lambda, &out.change});
    shaders_.compute("denoise/change.comp")
        .dispatch(
            out.lambda.size(), params,
            {{"before", in.pairs.before}, {"now", in.pairs.now}, {"products", in.pairs.products}},
            {{"lambda", out.lambda}, {"change", out.change}});
}

} // namespace afterglow
