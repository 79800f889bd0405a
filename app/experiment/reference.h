#pragma once

#include "renderer/image/metrics.h"
#include "renderer/pipeline/renderer.h"

#include <functional>

namespace afterglow {

/// The pixels of the last frame or reference that show a surface.
Mask foregroundOf(const Renderer& renderer);

/// The luminance of the light that surfaces reflect towards the viewer: the filtered signal times
/// albedo, linear. Without emission, which no filter touches: a light that is seen directly is so
/// much brighter than all it shines on that its going out would be all there is to measure.
Image<float> litLuminance(const Renderer& renderer);

/// A converged image and how far it can be trusted.
struct Convergence {
    const GpuTexture* display = nullptr; ///< the renderer's; until its next frame
    Image<float> lit;                    ///< litLuminance()
    /// The RMSE that `lit` still has against the limit, over the foreground, from the
    /// difference between the mean of the first half of its samples and the mean of all. Exact in
    /// expectation where samples are independent. 0 for a single sample, which has no halves.
    double residual = 0.0;
    double milliseconds = 0.0; ///< of tracing
    std::uint64_t rays = 0;
};

/// Averages so many samples a pixel at one moment. The renderer's histories are void afterwards.
/// `advanced` is told of every portion of samples as it is done.
Convergence converge(Renderer& renderer, const FrameInput& input, const Settings& settings,
                     int samples, const std::function<void(int)>& advanced = {});

} // namespace afterglow
