// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/transport.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace afterglow::test {

/// A program that renders with a transport. Each picture is told apart from every other by all that
/// goes into it, the pictures before included.
struct Program {
    struct Rendered {
        std::uint32_t frame;
        SceneFrame given;
        std::string picture;

        bool operator==(const Rendered&) const = default;
    };

    Transport t;
    SceneFrame live{.lights = std::vector<LightState>(2)};
    std::string histories = "none", checkpoint = "none";
    int resets = 0, restores = 0, checkpoints = 0;
    std::vector<Rendered> rendered;

    /// One round of its loop, with the clock that much further; whether it rendered.
    bool round(double seconds = 0.02) {
        if (!wantsFrame(t, seconds))
            return false;
        if (std::exchange(t.resetWanted, false)) {
            histories = "none";
            ++resets;
        }
        if (std::exchange(t.restoreWanted, false)) {
            histories = checkpoint;
            ++restores;
        }
        if (std::exchange(t.checkpointWanted, false)) {
            checkpoint = histories;
            ++checkpoints;
        }
        if (repeatIsDue(t))
            toggle(0, "key");
        const SceneFrame given = nextFrame(t, live);
        live.marks.clear();
        live.step = false;
        std::string input = histories + "|" + std::to_string(t.frame) + "|" +
                            std::to_string(given.seconds) + "|" +
                            std::to_string(given.camera.position.x);
        for (const LightState& light : given.lights)
            input += light.on ? "1" : "0";
        histories = std::to_string(std::hash<std::string>{}(input));
        rendered.push_back({t.frame, given, histories});
        frameRendered(t, seconds);
        return true;
    }

    void rounds(int count, double seconds = 0.02) {
        for (int i = 0; i < count; ++i)
            REQUIRE(round(seconds));
    }

    void toggle(std::size_t slot, const std::string& name) {
        live.lights[slot].on = !live.lights[slot].on;
        live.marks.push_back(name + (live.lights[slot].on ? " on" : " off"));
        live.step = true;
    }

    /// Leaves the take as the window does.
    void stop() {
        if (const auto last = stopPlaying(t)) {
            live.camera = last->camera;
            live.lights = last->lights;
        }
    }

    std::vector<Rendered> between(std::size_t first, std::size_t end) const {
        return {rendered.begin() + std::ptrdiff_t(first), rendered.begin() + std::ptrdiff_t(end)};
    }

    /// 5 frames, in, 4 frames, key off, 6 frames, out.
    void recordTenFrames() {
        rounds(5);
        markIn(t);
        rounds(4);
        toggle(0, "key");
        live.camera.position.x = 3.0f;
        rounds(6);
        markOut(t);
    }
};

/// A walk with a light that goes out in its third frame.
inline Take walkOf(int frames, std::uint32_t first = 0) {
    Take take{.name = "walk"};
    for (int i = 0; i < frames; ++i) {
        SceneFrame given{.frame = first + std::uint32_t(i),
                         .seconds = 0.25 * (i + 1),
                         .lights = std::vector<LightState>(2)};
        given.camera.position.x = 10.0f + float(i);
        given.lights[1].on = i < 2;
        if (i == 2) {
            given.marks = {"fill off"};
            given.step = true;
        }
        take.frames.push_back(given);
    }
    return take;
}

} // namespace afterglow::test
