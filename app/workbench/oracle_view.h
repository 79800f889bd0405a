#pragma once

#include "app/workbench/view_state.h"
#include "renderer/pipeline/renderer.h"

#include <memory>
#include <optional>
#include <vector>

namespace afterglow {

/// The truth of a frozen frame, converged a little at a time by a renderer of its own, so that the
/// histories of the one that is watched stay as they are. docs/experiments.md defines the ideal
/// lambda and alpha; for the same frame the values are those of an experiment, bit for bit.
class OracleView {
public:
    OracleView(ShaderLibrary& shaders, const GlInfo& gl);
    ~OracleView();

    /// The frame that was rendered last, and the one before it, if there was one.
    struct Moment {
        SceneFrame now;
        std::uint32_t seed = 0; ///< of the whole run
        std::optional<SceneFrame> before = {};
    };
    /// Takes the place of an earlier moment. `settings` are those of that frame; its filters are
    /// those that ran. `samples` a pixel, at least 1, for each of the two references; the second is
    /// not traced where nothing has changed since the frame before. The watched renderer must have
    /// rendered; else std::logic_error. Copies what it needs.
    void begin(const Renderer& watched, Moment moment, const FrameSettings& settings, int samples);
    /// Traces for about so long, and one sample at least; nothing once it is done. True if it has
    /// just become done.
    bool advance(double milliseconds);
    void end(); ///< forgets the moment

    bool isActive() const; ///< there is a moment, done or not
    bool isDone() const;
    double progress() const; ///< [0, 1]; 0 without a moment
    int samples() const;     ///< a pixel, of each reference; 0 without a moment

    /// What can be said of a filter of the frozen frame, as an image of its own: R32F per pixel, or
    /// per stratum where it is of lambda; RGBA32F, linear radiance, for the reference. Null before
    /// it is done, where the filter did not run or has no such thing (no history, no lambda from
    /// gradients), and for lambda where there was no frame before. Ideal and error are 0 on the
    /// background; so are the error of lambda where there is no light in either frame, and that of
    /// alpha where there is no history. The image lives until the moment is forgotten.
    /// Ideals are those of one signal, and so are lambda and alpha; error and reference are of all.
    const GpuTexture* image(OracleImage image, std::size_t state, std::size_t signal = 0);
    /// Root mean square error of the filter's light on surfaces (signal times albedo) against that
    /// of the reference, over red, green and blue. Empty before it is done, where the filter did
    /// not run, and where no surface is seen.
    std::optional<double> rmse(std::size_t state);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace afterglow
