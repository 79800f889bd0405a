// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/probe_log.h"
#include "app/workbench/inspection.h"
#include "app/workbench/pixel_facts.h"
#include "app/workbench/view_state.h"
#include "renderer/passes/probe_pass.h"
#include "renderer/passes/reason_pass.h"
#include "renderer/pipeline/renderer.h"

namespace afterglow {

/// Measures frames: what the probes read in every pane, how many pixels have lost their history for
/// which reason, and what one pixel holds. Nobody waits for the device before the results are
/// collected, which is best done when it has the next frame to work on.
class Instruments {
public:
    explicit Instruments(ShaderLibrary& shaders)
        : probe_(shaders), reasons_(shaders), pixel_(shaders) {}

    /// Measures the frame that was just rendered. Probes are those of the state, on an image of the
    /// renderer's size. A filter that makes no variance has NaN for one; one that does not
    /// accumulate has an alpha of 1, no history and no lambda. Reasons are counted while the
    /// inspector is open; those of the history are 0 where the filter does not accumulate.
    void measure(Renderer& renderer, const ViewState& state, std::uint32_t frame,
                 const SceneFrame& given);
    void count(const Renderer& renderer); ///< what FrameStats tells of the last frame
    /// A pixel of the last frame, as PixelQuery::ask().
    void inspect(Renderer& renderer, std::size_t pane, glm::ivec2 pixel, std::size_t signal);
    void submit(); ///< after the last of these, and before the commands of the next frame

    struct Measured {
        std::optional<ProbeFrame> frame;
        std::array<std::optional<ReasonCounts>, kPanes> reasons; ///< of that frame
        std::optional<FrameStats> stats;
        std::optional<Inspection> inspection;
    };
    /// Everything that was submitted since the last time. Waits until it is there.
    Measured collect(const Scene& scene);
    void drop(); ///< what was not collected

private:
    struct PendingProbe {
        std::size_t probe, pane;
        SvgfPlan plan;
        ProbePass::Region sums;
    };
    struct PendingReasons {
        std::size_t pane;
        SvgfPlan plan;
        ReasonPass::Region counts;
    };

    void measurePane(Renderer& renderer, const ViewState& state, std::size_t pane);

    ProbePass probe_;
    ReasonPass reasons_;
    PixelQuery pixel_;
    PixelReadback readback_;
    std::optional<ProbeFrame> frame_; ///< without what is in pendingProbes_
    std::vector<PendingProbe> pendingProbes_;
    std::vector<PendingReasons> pendingReasons_;
    std::optional<PixelReadback::Region<std::uint32_t>> pendingCounters_;
    struct Inspected {
        std::size_t pane, signal;
    };
    std::optional<Inspected> inspected_;
};

} // namespace afterglow
