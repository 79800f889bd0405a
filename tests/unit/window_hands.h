// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/view_state.h"
#include "renderer/scene/procedural.h"

#include <doctest/doctest.h>

// What a person does at the window, and what the program does in a round, without a window.

namespace afterglow {

inline ViewState stateOf(std::string_view scene, const Settings& settings = {}) {
    ViewState state = startState(makeProceduralScene(scene), settings);
    state.sceneName = scene;
    return state;
}
inline ViewState cornellState() {
    return stateOf("cornell");
}

inline void press(ViewState& state, char key) {
    press(state, KeyStroke{keyOf(key)});
}

/// A frame without its picture; what it was given.
inline SceneFrame renderFrame(ViewState& state, double wallSeconds = kFixedStep) {
    REQUIRE(wantsFrame(state.time, 1e3));
    state.time.resetWanted = state.time.restoreWanted = state.time.checkpointWanted = false;
    SceneFrame given;
    if (state.time.playing) {
        given = nextFrame(state.time, {});
        follow(state, given);
    } else {
        given = nextFrame(state.time, liveFrame(state));
    }
    frameRendered(state.time, wallSeconds);
    return given;
}
inline void renderFrames(ViewState& state, int count) {
    for (int i = 0; i < count; ++i)
        renderFrame(state);
}

} // namespace afterglow
