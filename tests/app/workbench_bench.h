// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/workbench.h"
#include "program.h"
#include "renderer/scene/procedural.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

namespace afterglow::test {

inline constexpr glm::ivec2 kBenchSize{61, 37};
inline constexpr double kRound = 0.01; // seconds

/// A workbench in a folder of its own, which renders 61 x 37 pixels.
struct WorkbenchBench {
    explicit WorkbenchBench(std::string_view scene, Filter filter = Filter::Asvgf)
        : workbench(testShaders(), glInfo(testContext()), makeProceduralScene(scene),
                    stateOf(scene, filter), {folder.path(), folder.path() / "presets"}) {}

    static ViewState stateOf(std::string_view scene, Filter filter) {
        ViewState state = startState(makeProceduralScene(scene), settingsOf(filter));
        state.sceneName = scene;
        state.resolution = {.followWindow = false, .scale = 1.0f, .fixed = kBenchSize};
        return state;
    }

    void press(char key, bool control = false, bool shift = false) {
        press(keyOf(key), control, shift);
    }
    void press(Key key, bool control = false, bool shift = false) {
        REQUIRE(actionOf({key, control, shift}));
        afterglow::press(state, {key, control, shift});
    }
    /// So many frames, and not one more.
    void frames(int count) {
        for (int i = 0; i < count; ++i)
            REQUIRE(workbench.advance(kRound, kBenchSize));
    }
    bool round() { return workbench.advance(kRound, kBenchSize); }
    /// With the last frame.
    const ProbeLog& log() {
        workbench.finishMeasuring();
        return workbench.probeLog();
    }
    Image<glm::u8vec4> picture(std::size_t pane) {
        const GpuTexture* const texture = workbench.picture(pane);
        REQUIRE(texture);
        return texture->read<glm::u8vec4>();
    }

    TemporaryFolder folder;
    Workbench workbench;
    ViewState& state = workbench.state;
};

} // namespace afterglow::test
