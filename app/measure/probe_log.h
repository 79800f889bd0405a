// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/resources/render_targets.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

constexpr std::size_t kProbes = 4;            ///< at most
constexpr std::size_t kPanes = kFilterStates; ///< at most; each shows one filter, on one noise

/// 'A' for 0, and so on: how probes and panes are called.
constexpr char letterOf(std::size_t index) {
    return char('A' + index);
}

/// A box of pixels of the rendered picture that is measured in every frame: [min, min + size).
struct Probe {
    glm::ivec2 min{0}, size{1};
    bool operator==(const Probe&) const = default;
};

// `image` is a size in pixels, at least 1 x 1. What lies outside it is moved to its edge.

/// Returns a probe of that pixel alone. The noise of one pixel hides most changes of light.
Probe probeAt(glm::ivec2 pixel, glm::ivec2 image);
/// Pixels along each edge of the box that a click sets.
constexpr int kClickBox = 9;
/// Returns a probe of kClickBox x kClickBox pixels around a pixel, moved to lie inside the picture.
Probe probeAround(glm::ivec2 pixel, glm::ivec2 image);
/// The box with these pixels in two opposite corners, whichever they are; both belong to it.
Probe probeBetween(glm::ivec2 corner, glm::ivec2 opposite, glm::ivec2 image);
/// The same part of a picture of another size, at least one pixel. It rounds to pixels: for a size
/// that changes often, start from the probe as it was set.
Probe rescaled(const Probe& probe, glm::ivec2 from, glm::ivec2 to);

/// What a probe's box holds in one frame of one pane. Luminances are linear and with albedo.
struct ProbeSample {
    std::uint64_t pixels = 0; ///< that show a surface; 0: nothing else counts
    double lit = 0.0;         ///< mean luminance of the filtered picture
    double rawLit = 0.0;      ///< mean luminance of the noisy signal that the filter is given
    double rawVariance = 0.0; ///< of that signal's luminance among the pixels
    double variance = 0.0;    ///< mean of what the filter takes for its own variance
    double lambda = 0.0;      ///< mean, in [0, 1]
    double alpha = 0.0;       ///< mean weight of the new frame, in [0, 1]
    double history = 0.0;     ///< mean length, frames
};

/// A pane in one frame, and all that its picture was made with.
struct ProbePane {
    std::string title;    ///< "Fixed alpha 0.1"; empty: there is no such pane
    std::string settings; ///< "filter=fixed alpha=0.1"; a response is bound to them

    bool operator==(const ProbePane&) const = default;
};

/// Something that happened for the first time in a frame.
struct ProbeMark {
    std::string text;                ///< "key off"
    bool step = false;               ///< a change of light: what a response can be measured to
    std::optional<std::size_t> pane; ///< the only pane that it concerns; empty: all
};

struct ProbeFrame {
    std::uint32_t frame = 0;
    std::vector<ProbeMark> marks;
    std::array<ProbePane, kPanes> panes;
    std::array<std::optional<Probe>, kProbes> probes;
    /// By probe, then pane. Empty: there is no such probe, or the pane did not run.
    std::array<std::array<std::optional<ProbeSample>, kPanes>, kProbes> samples;
};

/// What the probes read in the last frames, and what happened in them.
class ProbeLog {
public:
    static constexpr std::size_t kFrames = 600;

    /// A probe that is not where it was in the frame before starts again: what it read is
    /// forgotten. A pane whose settings are not those of the frame before gets a mark, "pane B:
    /// SVGF", and goes on. std::logic_error for a sample without its probe or its pane.
    void add(ProbeFrame frame);
    void clear() { frames_.clear(); }
    void restart(std::size_t probe);

    /// At most kFrames, oldest first.
    const std::deque<ProbeFrame>& frames() const { return frames_; }

    /// The sample of a probe in a pane, if it shows a surface and its luminances are numbers.
    const ProbeSample* measured(std::size_t index, std::size_t probe, std::size_t pane) const;

private:
    std::deque<ProbeFrame> frames_;
};

enum class ProbeQuantity { Lit, RawLit, Lambda, Alpha, History, RawVariance, Variance };

// Not together with app/experiment/import_frames.h, which has another.

/// How a quantity is drawn.
struct QuantityInfo {
    ProbeQuantity quantity;
    std::string_view name;
    std::string_view unit;          ///< may be empty
    std::optional<glm::vec2> range; ///< low and high; empty: as the values are
    bool logarithmic = false;
    double ProbeSample::*value;
};
std::span<const QuantityInfo> quantities(); ///< all, in the order of the enumeration
const QuantityInfo& infoOf(ProbeQuantity quantity);

/// One value a frame of the log, oldest first; NaN where there is none.
std::vector<float> seriesOf(const ProbeLog& log, std::size_t probe, std::size_t pane,
                            ProbeQuantity quantity);

} // namespace afterglow
