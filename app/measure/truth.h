#pragma once

#include "app/measure/reference.h"
#include "app/scenario/run_plan.h"
#include "renderer/image/flip.h"

namespace afterglow {

/// The reference of one signal in one moment, and the ideal lambda that follows from it.
struct SignalTruth {
    Image<float> luminance; ///< of the converged signal, as the filter sees it
    Image<float> variance;  ///< of the luminance of one sample
    // Per stratum, where lambda means something, and what it should be: in the moment's first frame
    // and in those after it, in which nothing changes.
    Mask litFirst, litLater;
    Image<float> idealLambda; ///< of the first; the later ones have 0
};

/// The reference that the frames of one moment are compared with.
struct Truth {
    Image<glm::vec4> lit; ///< sum of converged signals times albedo, linear rgb
    Image<glm::u8vec4> display;
    Mask foreground;                  ///< pixels that show a surface
    std::vector<SignalTruth> signals; ///< by signal
    bool knowsChange = false;         ///< litFirst and idealLambda of them are there
    double residual = 0.0;            ///< the RMSE that `lit` still has itself
    double milliseconds = 0.0;        ///< of tracing, when it was traced
};

/// The truths of a run. References end the histories of the renderer, so all that will be needed
/// are made first.
class Truths {
public:
    Truths(const Experiment& experiment, const RunPlan& plan);

    /// Converges the moments that the frames of `range` are compared with, where that has not been
    /// done; tells `advanced` of samples as they are done.
    void make(Renderer& renderer, ReferenceStore& store, FrameRange range,
              const std::function<void(int)>& advanced);
    /// How many references make() would ask the store for.
    int countFor(FrameRange range) const;

    const Truth& of(std::size_t moment) const { return *truths_.at(moment); }
    bool has(std::size_t moment) const { return truths_.at(moment).has_value(); }
    const Truth& at(int frame) const { return of(momentAt(plan_.moments, frame)); }

    /// The input of a frame. Its lights are those of the plan, which must outlive it.
    FrameInput inputAt(int frame) const;

private:
    std::vector<std::size_t> neededFor(FrameRange range) const;
    FrameInput referenceInput(const Moment& moment) const;
    FrameInput input(int frame, const Moment& moment, std::uint32_t seed) const;

    const Experiment& experiment_;
    const RunPlan& plan_;
    std::vector<std::optional<Truth>> truths_;
};

} // namespace afterglow
