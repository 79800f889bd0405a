// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

namespace afterglow {

/// Milliseconds that the device worked for passes and for whole frames, smoothed so that they can
/// be read. Frames in which programs were compiled are not to be added.
class PassTimings {
public:
    struct Row {
        std::string name;
        double milliseconds = 0.0; ///< exponential average over about ten frames
    };
    static constexpr std::size_t kFrames = 120;

    /// One frame. Passes that are not in it disappear; new ones come where they stand in it.
    void addPasses(std::span<const Row> passes);
    void addFrame(double milliseconds);

    const std::vector<Row>& passes() const { return passes_; }
    /// Milliseconds of passes()[row] in the last kFrames frames, oldest first; not smoothed.
    const std::vector<float>& history(std::size_t row) const { return rings_.at(row); }
    double passTotal() const;
    double frame() const; ///< median of the last fifteen; 0 before the first
    const std::vector<float>& frames() const { return ring_; } ///< the last kFrames, oldest first

private:
    std::vector<Row> passes_;
    std::vector<std::vector<float>> rings_; ///< by pass
    std::vector<float> ring_;
};

/// "12.3 ms"; "compiling" before the first frame that is known.
std::string timeText(const PassTimings& timings);

} // namespace afterglow
