// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/oracle.h"
#include "app/measure/reference.h"
#include "app/scenario/run_plan.h"

namespace afterglow {

/// The references of one signal, as the filter sees it.
struct SignalTruth {
    Image<float> luminance; ///< of the converged signal
    Image<float> variance;  ///< of the luminance of one sample
    /// The luminance that the same surfaces had in the light of the frame before; empty where
    /// nothing has changed since.
    Image<float> before{};
};

/// The ground truth of a frame, and of those after it as long as nothing changes.
struct Truth {
    Image<glm::vec4> lit; ///< sum of converged signals times albedo, linear rgb
    Image<glm::u8vec4> display;
    Mask foreground;                  ///< pixels that show a surface
    std::vector<SignalTruth> signals; ///< by signal
    double residual = 0.0;            ///< the RMSE that `lit` still has itself
    double milliseconds = 0.0;        ///< of tracing, when it was traced

    /// lambda* of a signal: of the frame itself or, if not `isFirst`, of one of those after it.
    /// `floor`: see idealLambda().
    StrataTruth idealLambda(std::size_t signal, float floor, bool isFirst = true) const;
    /// alpha* of a signal; 0 on the background. See idealAlpha() for the history.
    Image<float> idealAlpha(std::size_t signal, const Image<float>& history,
                            const Mask& hasHistory) const;
};

/// Computes the ground truth of a frame, portion by portion; its bits do not depend on the
/// portions. Uses the renderer as a ReferenceTask does.
class GroundTruth {
public:
    /// Two frames as they were rendered, and their run's settings. The lights must outlive it.
    struct Request {
        FrameInput now;
        /// A second reference is made if light or geometry have changed since.
        std::optional<FrameInput> before;
        FrameSettings settings;
        int samples; ///< a pixel of a reference, at least 1
    };
    /// The renderer and the store must outlive it. Without a store references are always converged.
    GroundTruth(Renderer& renderer, const Request& request, ReferenceStore* store = nullptr);

    /// As ReferenceTask::advance().
    int advance(double milliseconds);
    bool isDone() const { return !task_; }
    double progress() const { return double(done_) / total_; } ///< [0, 1]
    Truth take() { return std::move(truth_); }                 ///< once it is done

private:
    void startOn(const FrameInput& world);
    void keepNow();

    Renderer& renderer_;
    Request request_;
    ReferenceStore* store_;
    bool changed_;
    int total_, done_ = 0; ///< samples
    std::optional<ReferenceTask> task_;
    Truth truth_;
};

/// The input of a frame of a run. Its lights are those of the plan, which must outlive it.
FrameInput inputAt(const Experiment& experiment, const RunPlan& plan, int frame);

/// The truths of a run. References end the histories of the renderer, so all that will be needed
/// are made first.
class Truths {
public:
    Truths(const Experiment& experiment, const RunPlan& plan);

    /// Makes those that the frames of `range` are compared with; tells `advanced` of samples as
    /// they are done. Once.
    void make(Renderer& renderer, ReferenceStore& store, FrameRange range,
              const std::function<void(int)>& advanced);
    /// Returns the number of references that make() would ask the store for.
    int countFor(FrameRange range) const;

    const Truth& of(std::size_t interval) const { return *truths_.at(interval); }
    bool has(std::size_t interval) const { return truths_.at(interval).has_value(); }
    const Truth& at(int frame) const { return of(intervalAt(plan_.intervals, frame)); }

private:
    std::vector<std::size_t> neededFor(FrameRange range) const;

    const Experiment& experiment_;
    const RunPlan& plan_;
    std::vector<std::optional<Truth>> truths_;
};

} // namespace afterglow
