#pragma once

#include "app/workbench/probe_log.h"
#include "app/workbench/view_state.h"
#include "renderer/passes/probe_pass.h"
#include "renderer/passes/reason_pass.h"
#include "renderer/pipeline/renderer.h"

namespace afterglow {

/// Measures frames: what the probes read in every pane, and how many pixels have lost their
/// history for which reason. Both wait for the GPU.
class Instruments {
public:
    explicit Instruments(ShaderLibrary& shaders) : probe_(shaders), reasons_(shaders) {}

    /// Of the frame that was just rendered. Probes are those of the state, on an image of the
    /// renderer's size. A filter that makes no variance has NaN for one; one that does not
    /// accumulate has an alpha of 1, no history and no lambda.
    ProbeFrame read(Renderer& renderer, const ViewState& state, std::uint32_t frame,
                    const FrameMoment& moment);

    /// Of a pane that ran; its history counts are 0 where the filter does not accumulate.
    ReasonCounts countReasons(Renderer& renderer, const ViewState& state, std::size_t pane);

private:
    ProbePass probe_;
    ReasonPass reasons_;
};

} // namespace afterglow
