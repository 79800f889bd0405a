// SPDX-License-Identifier: MIT
#include "renderer/passes/composite_pass.h"

#include "renderer/resources/render_targets.h"

#include <array>
#include <stdexcept>
#include <vector>

namespace afterglow {
namespace {

constexpr std::array<std::string_view, kMaxSignals> kSignalNames{"signal0", "signal1"};
constexpr std::array<std::string_view, kMaxSignals> kDemodulationNames{"demodulation0",
                                                                       "demodulation1"};

Defines definesFor(std::size_t signals) {
    return {{"SIGNALS", std::to_string(signals)}};
}

} // namespace

CompositePass::CompositePass(ShaderLibrary& shaders) : shaders_(shaders) {
    shaders_.compute("post/composite.comp", definesFor(1)); // others where they are needed
}

void CompositePass::run(FrameContext& frame, const Inputs& in, const Outputs& out) {
    if (in.terms.empty() || in.terms.size() > kMaxSignals)
        throw std::logic_error("CompositePass: no frame has so many signals");
    const auto scope = frame.pass("composite", {&out.composed});
    std::vector<Binding> reads{frame.block(), {"emission", in.emission}, {"guides", in.guides}};
    for (std::size_t i = 0; i < in.terms.size(); ++i) {
        reads.emplace_back(kSignalNames[i], in.terms[i].signal);
        reads.emplace_back(kDemodulationNames[i], in.terms[i].demodulation);
    }
    const std::array<Binding, 1> writes{Binding{"composed", out.composed}};
    shaders_.compute("post/composite.comp", definesFor(in.terms.size()))
        .dispatch(out.composed.size(), reads, writes);
}

} // namespace afterglow
