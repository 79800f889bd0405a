// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/metrics_table.h"
#include "app/measure/response.h"
#include "app/measure/truth.h"
#include "renderer/image/flip.h"

namespace afterglow {

/// The weights and the history of one signal in one frame. An image that the filter does not make
/// is empty.
struct ControlImages {
    Image<float> lambda;  ///< per stratum
    Image<float> alpha;   ///< alpha' per pixel
    Image<float> history; ///< luminance of the history that was fetched
    Mask hasHistory{};
};

/// The result of a filter for one frame.
struct FrameImages {
    Image<glm::vec4> lit; ///< sum of filtered signals times albedo
    Image<glm::u8vec4> display;
    std::vector<ControlImages> control; ///< by signal; empty if it was not asked for
};
/// Of the last frame that was rendered, by the filter with this state; what is for the oracles only
/// if `withControl`.
FrameImages readFrame(const Renderer& renderer, bool withControl, std::size_t state = 0);

/// Images in [0, 1] that explain a frame: "error" (FLIP), "lambda", "lambda_ideal", "alpha",
/// "alpha_ideal", as far as they are there; of a second signal "lambda_ao" and so on.
using FrameMaps = std::vector<std::pair<std::string, Image<float>>>;

/// Takes the measures of one variant, frame by frame. The parts of a frame's measures that do not
/// share anything run on all threads of the machine; what they find does not depend on that.
class Meter {
public:
    /// All three must outlive it, and the truths of the frames that are measured must be there.
    Meter(const Experiment& experiment, const RunPlan& plan, const Truths& truths);

    /// Frames come in their order, each once: all of [range.first - 1, range.end) as far as they
    /// exist, and those of the settled window if its last one is to be measured.
    void skip(int frame, const FrameImages& images);
    /// Adds rows for the frame. `maps`, if given, gets the maps.
    void measure(int frame, const FrameImages& images, MetricsTable& table,
                 const std::string& variant, FrameMaps* maps = nullptr);

private:
    /// The rows and maps of one part.
    struct Findings {
        std::vector<std::pair<std::string, double>> rows{};
        FrameMaps maps{};
        void add(std::string metric, double value) { rows.emplace_back(std::move(metric), value); }
    };
    void measureError(int frame, const FrameImages& images, Findings& found) const;
    void measureSimilarity(int frame, const FrameImages& images, Findings& found) const;
    void measureFlip(int frame, const FrameImages& images, Findings& found);
    void measureTime(int frame, const FrameImages& images, Findings& found);
    void measureChange(int frame, const FrameImages& images, Findings& found);
    void measureTrail(int frame, const FrameImages& images, Findings& found) const;
    void measureControl(int frame, const FrameImages& images, Findings& found) const;
    void keep(int frame, const FrameImages& images);
    const PictureChange* changeTo(std::size_t interval);

    const Experiment& experiment_;
    const RunPlan& plan_;
    const Truths& truths_;
    std::vector<std::optional<PictureChange>> steps_; ///< by interval, made when first asked for
    std::vector<bool> stepKnown_;
    std::optional<Flip> flip_; ///< against the display image of flipInterval_
    std::size_t flipInterval_ = 0;
    Image<glm::vec4> before_; ///< the frame before
    int beforeFrame_ = -1;
    Flicker flicker_;
};

} // namespace afterglow
