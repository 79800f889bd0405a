// SPDX-License-Identifier: MIT
#include "app/workbench/pointer.h"

#include <algorithm>

namespace afterglow {
namespace {

// Where a position lies in a pane's picture, also outside of it.
std::optional<glm::ivec2> pixelIn(std::span<const PanePlace> places, std::size_t pane,
                                  glm::vec2 position, glm::ivec2 image) {
    const auto place = std::ranges::find(places, pane, &PanePlace::pane);
    if (place == places.end() || place->picture.empty())
        return {};
    return pixelOf(*place, position, image);
}

// The first probe that is free, or the active one.
std::size_t nextProbe(const ViewState& state) {
    for (std::size_t i = 0; i < kProbes; ++i)
        if (!state.probes[i])
            return i;
    return state.activeProbe;
}

} // namespace

void movePointer(Pointer& pointer, ViewState& state, const PointerInput& input,
                 std::span<const PanePlace> places, glm::ivec2 image) {
    const bool hasImage = image.x > 0 && image.y > 0;
    const auto under = hasImage && input.onPicture ? pixelAt(places, input.position, image)
                                                   : std::optional<PanePixel>();
    state.hovered = under;

    const bool near = input.onPicture && hasImage &&
                      isOnDivider(state.panes, places, input.position, input.reach);

    if (input.pressed && input.onPicture && hasImage) {
        if (near) {
            pointer.holds = Pointer::Holds::Divider;
        } else if (under) {
            choosePane(state.panes, under->pane);
            pointer = {.holds = Pointer::Holds::Probe,
                       .pane = under->pane,
                       .start = input.position,
                       .corner = under->pixel,
                       .opposite = under->pixel,
                       .probe = input.adds ? nextProbe(state) : state.activeProbe,
                       .exact = input.exact};
        }
    }
    if (pointer.holds == Pointer::Holds::Divider)
        state.panes.divider = dividerAt(places, input.position);
    // A hand that trembles drags no box.
    if (pointer.holds == Pointer::Holds::Probe && hasImage &&
        (pointer.opposite != pointer.corner ||
         glm::distance(pointer.start, input.position) > 0.5f * input.reach))
        pointer.opposite =
            pixelIn(places, pointer.pane, input.position, image).value_or(pointer.opposite);
    pointer.onDivider = pointer.holds == Pointer::Holds::Divider ||
                        (pointer.holds == Pointer::Holds::Nothing && near);
    if (!input.released)
        return;
    if (const auto probe = draggedProbe(pointer, image))
        setProbe(state, pointer.probe, *probe, image);
    pointer.holds = Pointer::Holds::Nothing;
}

std::optional<Probe> draggedProbe(const Pointer& pointer, glm::ivec2 image) {
    if (pointer.holds != Pointer::Holds::Probe || image.x <= 0 || image.y <= 0)
        return {};
    if (pointer.corner == pointer.opposite && !pointer.exact)
        return probeAround(pointer.corner, image);
    return probeBetween(pointer.corner, pointer.opposite, image);
}

void probeAtMouse(ViewState& state, glm::ivec2 image) {
    if (state.hovered && image.x > 0 && image.y > 0)
        setProbe(state, state.activeProbe, probeAround(state.hovered->pixel, image), image);
}

} // namespace afterglow
