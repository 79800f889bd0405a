// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/live_response.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace afterglow::test {

/// A number in [0, 1) that depends on both in no visible way (a round of splitmix64).
inline double noise(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z =
        seed * 0x9e3779b97f4a7c15u + index * 0xd1342543de82ef95u + 0x632be59bd9b4e019u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// A pane whose filter is an exponential average that shows `bias` times what it has.
struct PaneModel {
    double alpha = 1.0, bias = 1.0;
};

/// A light in front of some panes, frame by frame.
struct LightBench {
    ProbeLog log;
    std::uint32_t frame = 0;
    double light = 1.0;
    std::vector<PaneModel> panes;
    std::vector<double> state;
    std::array<std::string, kPanes> settings;
    std::uint64_t seed = 0;
    bool noisy = false; ///< 0 or twice the light, at even odds, in each pixel
    int pixels = 100;
    std::optional<double> secondLight; ///< at probe B, if it is there
    std::array<bool, kPanes> runs{true, true, true, true};

    explicit LightBench(PaneModel first) : panes{first}, state{light} {}
    LightBench(PaneModel first, PaneModel second) : panes{first, second}, state{light, light} {}

    ProbeSample rawSample(double mean) const {
        double sum = 0.0;
        for (int i = 0; i < pixels; ++i)
            sum += noisy && noise(seed, std::uint64_t(frame) * 4096 + std::uint64_t(i)) < 0.5
                       ? 0.0
                       : (noisy ? 2.0 * mean : mean);
        const double raw = sum / pixels;
        // Among values that are 0 or 2 mean.
        return {.pixels = std::uint64_t(pixels),
                .rawLit = raw,
                .rawVariance = noisy ? raw * (2.0 * mean - raw) : 0.0};
    }

    void step(std::vector<ProbeMark> marks = {}) {
        ProbeFrame now;
        now.frame = frame;
        now.marks = std::move(marks);
        now.probes[0] = probeBetween({0, 0}, {pixels - 1, 0}, {4096, 1});
        if (secondLight)
            now.probes[1] = probeBetween({0, 0}, {pixels - 1, 0}, {4096, 1});
        ProbeSample sample = rawSample(light);
        for (std::size_t i = 0; i < panes.size(); ++i) {
            now.panes[i] = {"filter", settings[i]};
            state[i] += panes[i].alpha * (sample.rawLit - state[i]);
            sample.lit = panes[i].bias * state[i];
            if (!runs[i])
                continue;
            now.samples[0][i] = sample;
            if (secondLight)
                now.samples[1][i] =
                    ProbeSample{.pixels = 4, .lit = *secondLight, .rawLit = *secondLight};
        }
        log.add(now);
        ++frame;
    }
    void run(int frames) {
        for (int i = 0; i < frames; ++i)
            step();
    }
    void change(double to, const std::string& name = "key off") {
        light = to;
        step({{name, true, {}}});
    }
    LiveResponse response(std::size_t pane = 0, std::size_t probe = 0) const {
        return liveResponse(log, probe, pane, settings[pane]);
    }
};

inline void checkNoClaim(const LiveResponse& response) {
    CHECK_FALSE(response.claimed());
    CHECK(response.p.empty());
    CHECK_FALSE(response.t50);
    CHECK_FALSE(response.t90);
    CHECK(response.ghostFrames == 0.0);
}

} // namespace afterglow::test
