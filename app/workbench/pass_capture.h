// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/passes/frame_context.h"

#include <string>
#include <vector>

namespace afterglow {

/// What the passes of a frame made, one after the other: the list always, the images as far as
/// wanted.
class PassCapture final : public PassListener {
public:
    struct Made {
        std::string name{};   ///< "a-trous": as the timer calls it
        int run = 1;          ///< of the runs of a pass of that name, counted from 1
        bool isOnly = true;   ///< there is no other run
        std::string image{};  ///< the texture's label: "filtered 1"
        GpuTexture texture{}; ///< a copy as of when it was made; empty if it was not wanted

        /// "a-trous 3: filtered 1": with a number where a pass runs more than once.
        std::string title() const { return pass() + ": " + image; }
        std::string pass() const { return isOnly ? name : name + " " + std::to_string(run); }
    };
    enum class Keep { Nothing, One, All };

    /// Before a frame. `index`: of the one to be kept.
    void begin(Keep keep, std::size_t index = 0);
    void passDone(std::string_view pass, std::span<const GpuTexture* const> made) override;
    /// After it: what is left from longer frames goes.
    void end();

    const std::vector<Made>& made() const { return made_; } ///< of the last frame listened to
    /// Null where it was not kept.
    const GpuTexture* image(std::size_t index) const;
    std::size_t bytes() const; ///< on the device
    void clear();

private:
    Keep keep_ = Keep::Nothing;
    std::size_t wanted_ = 0, next_ = 0;
    std::vector<Made> made_;
};

} // namespace afterglow
