// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/truth_images.h"
#include "app/scenario/scene_frame.h"

#include <map>

namespace afterglow {

/// The ground truth of a frozen frame, made a little at a time by a renderer of its own, so that
/// the histories of the one that is watched stay as they are.
class OracleView {
public:
    OracleView(ShaderLibrary& shaders, const GlInfo& gl) : shaders_(shaders), gl_(gl) {}
    OracleView(const OracleView&) = delete;
    OracleView& operator=(const OracleView&) = delete;

    /// The frame that was rendered last, and the one before it, if there was one.
    struct Frozen {
        SceneFrame now;
        std::uint32_t seed = 0; ///< of the whole run
        std::optional<SceneFrame> before = {};
    };
    /// Freezes a frame, in place of an earlier one. `settings` are those of that frame; its filters
    /// are those that ran. `samples` a pixel, at least 1, of each reference. The watched renderer
    /// must have rendered; else std::logic_error. Copies what it needs.
    void begin(const Renderer& watched, Frozen frame, const FrameSettings& settings, int samples);
    /// Traces for about that time, and one sample at least; nothing once it is done. Returns
    /// whether it has just become done.
    bool advance(double milliseconds);
    void end(); ///< forgets the frame

    bool isActive() const { return samples_ > 0; } ///< there is a frame, done or not
    bool isDone() const { return truth_.has_value(); }
    double progress() const { return isDone() ? 1.0 : making_ ? making_->progress() : 0.0; }
    int samples() const { return samples_; } ///< a pixel, of each reference; 0 without a frame

    /// Returns one of truthImages() for a filter of the frozen frame: RGBA32F, per pixel or per
    /// stratum. Null before the truth is done, and where the filter did not run or does not make
    /// the image it is compared with. Lives until the frame is forgotten.
    const GpuTexture* image(std::size_t image, std::size_t state, std::size_t signal = 0);
    /// Root mean square error of the filter's light on surfaces (signal times albedo) against that
    /// of the reference, over red, green and blue. Empty before it is done, where the filter did
    /// not run, and where no surface is seen.
    std::optional<double> rmse(std::size_t state);

private:
    /// The result of one filter for the frozen frame, and what was made from it.
    struct Filter {
        FrameImages images;
        float deltaFloor = 0.0f;
        std::optional<double> rmse{};
        std::map<std::pair<std::size_t, std::size_t>, GpuTexture> textures{}; ///< signal, image
    };

    ShaderLibrary& shaders_;
    GlInfo gl_;
    Frozen frame_;
    int samples_ = 0;
    std::array<std::optional<Filter>, kFilterStates> filters_;
    // While it converges.
    std::optional<Renderer> renderer_;
    std::optional<GroundTruth> making_;
    std::optional<Truth> truth_; ///< once it is there
};

} // namespace afterglow
