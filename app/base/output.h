// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"
#include "renderer/image/image.h"
#include "renderer/pipeline/aov.h"
#include "renderer/pipeline/renderer.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The version of the program: "0.1.0".
std::string_view version();

/// The folder that a command writes into. Every file appears under its name when it is whole, or
/// not at all.
class OutputFolder {
public:
    /// Creates it with its parents where it is missing. Error names the path if that fails, or if
    /// it cannot be written to.
    explicit OutputFolder(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    OutputFolder subfolder(std::string_view name) const { return OutputFolder(path_ / name); }

    void writeJson(std::string_view file, const nlohmann::ordered_json& json) const;
    void writeText(std::string_view file, std::string_view text) const;
    void writePng(std::string_view file, const Image<glm::u8vec4>& image) const;
    /// 32-bit float. `format` is "exr" or "pfm"; `channels` as AovInfo::channels. A PFM holds one
    /// or three channels; two are given a third of zeros.
    void writeFloat(std::string_view stem, std::string_view format, const Image<glm::vec4>& image,
                    std::string_view channels) const;

private:
    std::filesystem::path path_;
};

/// "color_0007": the stem of a file that belongs to a frame.
std::string frameStem(std::string_view name, int frame);

/// Writes an image of the last frame, or one of each signal where it has several: "raw", or
/// "raw_shadows" and "raw_ao", with the frame's number behind it where one is given. Returns how
/// many files that were.
int writeAov(const OutputFolder& folder, std::string_view format, const Renderer& renderer,
             const AovInfo& aov, std::optional<int> frame = {}, std::size_t state = 0);

/// How long frames took, and what they traced. Frames are finished before the clock is read;
/// reading back and writing are left out. Times of passes are those of the very frame.
class FrameClock {
public:
    /// Renders one frame and takes its measures. Returns the display image.
    const GpuTexture& render(Renderer& renderer, const FrameInput& input, const Settings& settings);

    /// How many first frames the medians leave out: those in which shaders are still being
    /// compiled.
    int warmup() const;
    double medianMilliseconds() const;
    double raysPerSecond() const; ///< while frames were being rendered, without the first ones
    std::uint64_t rays() const;   ///< of all frames
    std::uint64_t invalidValues() const;

    const std::vector<double>& milliseconds() const { return milliseconds_; }
    const std::vector<FrameStats>& stats() const { return stats_; }

    struct Pass {
        std::string name;
        std::vector<std::optional<double>> milliseconds{}; ///< one a frame; empty: it did not run
        std::optional<double>
            median{}; ///< of the frames after the warm-up in which it ran; empty: none
    };
    std::vector<Pass> passes() const; ///< in the order in which they run

private:
    std::vector<double> milliseconds_;
    std::vector<FrameStats> stats_;
    std::vector<std::vector<GpuTimer::Entry>> passes_;
};

double median(std::vector<double> values); ///< 0 of none

nlohmann::ordered_json describe(const GlInfo& gl);
nlohmann::ordered_json describe(const Scene& scene, const SceneStats& stats);
nlohmann::ordered_json describe(const FrameClock& clock);

/// A line for each pass that ran after the warm-up, with its median.
std::string passTable(const FrameClock& clock);

/// "12.3 M rays/s"
std::string raysText(double raysPerSecond);

} // namespace afterglow
