// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/variant.h"
#include "app/workbench/view_state.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// Something that happens again and again at a stop.
struct TourEvent {
    EventKind kind = EventKind::Toggle;
    std::string light = {}; ///< its name; empty: the event concerns none
    int every = 60;         ///< frames; it first happens after so many
};

/// One stop of the guided tour: what is said, and what is set up to show it.
struct TourStop {
    std::string title = {};
    std::string text = {};  ///< two or three short sentences
    std::string scene = {}; ///< a name, as loadScene() takes it
    Signal signal = Signal::Both;

    /// Pane A and so on: a filter or a preset, and settings that differ from it; where there is
    /// none, the pane is as in startPanes().
    std::array<std::optional<Variant>, kFilterStates> panes = {};
    PaneLayout layout = PaneLayout::Single;
    std::array<std::size_t, 2> pair{0, 1};
    float gain = 4.0f;      ///< of a difference
    std::string image = {}; ///< the AOV that is shown; empty: the picture

    /// Those that are on at first; the others are off. "*": all.
    std::vector<std::string> lights{"*"};
    std::optional<TourEvent> repeats = {};
    bool animated = true;    ///< what can move in the scene moves
    bool cameraPath = false; ///< the camera is on its way
    int frameLimit = 0;      ///< frames per second, one of kFrameLimits; 0: as fast as possible

    /// In parts of the picture, from its upper left corner: left, top, right, bottom.
    std::optional<std::array<float, 4>> probe = {};
    ProbeQuantity curve = ProbeQuantity::Lit;
    bool curves = false, strip = false, inspector = false; ///< what is open
};

/// The stops that come with the program, in their order. Each names one thought.
const std::vector<TourStop>& tourStops();

/// Stops from the text of a file; InputError names the file and the place in it.
std::vector<TourStop> parseTour(std::string_view text, std::string_view source);

/// Sets everything that the stop is about; to be called after its scene has been opened. Panes,
/// lights, probes and what repeats are replaced, histories start anew, time runs from frame 0. What
/// a person has recorded, preferences, exposure, resolution and bookmarks stay. With the inspector,
/// the middle of the probe is pinned. `image`: the size of the rendered image; where it is empty,
/// any will do. std::logic_error if the scene lacks a light of the stop.
void enterStop(ViewState& state, const TourStop& stop, glm::ivec2 image);

} // namespace afterglow
