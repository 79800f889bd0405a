#include "renderer/passes/composite_pass.h"

namespace afterglow {

CompositePass::CompositePass(ShaderLibrary& shaders)
    : program_(shaders.compute("post/composite.comp")) {}

void CompositePass::run(FrameContext& frame, const Inputs& in, const Outputs& out) {
    const auto scope = frame.pass("composite", {&out.composed});
    program_.dispatch(out.composed.size(),
                      {{"signal", in.signal},
                       {"albedo", in.albedo},
                       {"emission", in.emission},
                       {"guides", in.guides}},
                      {{"composed", out.composed}});
}

} // namespace afterglow
