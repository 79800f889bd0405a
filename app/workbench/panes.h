// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/probe_log.h"
#include "app/workbench/layout.h"
#include "renderer/pipeline/settings.h"
#include "renderer/resources/render_targets.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace afterglow {

/// How filters share the view.
enum class PaneLayout {
    Single,     ///< the active one alone
    Wipe,       ///< two, the same picture on both sides of a divider
    TwoUp,      ///< two, beside each other
    FourUp,     ///< all that are in use
    Difference, ///< the first of the pair minus the second
};
inline constexpr std::size_t kPaneLayouts = 5;
std::string_view nameOf(PaneLayout layout); ///< "single", "wipe", "two-up", "four-up", "difference"
bool showsPair(PaneLayout layout);          ///< of panes: a left and a right one, or a difference
std::span<const std::string_view> paneLayoutNames();

/// Returns the index so many steps on, or back, in a circle of `count`.
std::size_t wrapped(std::size_t index, int step, std::size_t count);

/// A filter with its parameters, as one of four that can be compared. Each has its own histories:
/// FilterRun::state is the pane's index.
struct Pane {
    std::string title; ///< of the preset that it was set to; empty: that of the filter
    FilterSettings settings;
    FilterSettings preset; ///< those that the title was given to
};

struct Panes {
    FrameSettings frame; ///< of all
    std::array<Pane, kFilterStates> all;
    std::size_t count = kFilterStates; ///< the first so many are in use, at least one
    PaneLayout layout = PaneLayout::Single;
    std::size_t active = 0; ///< what keys and panels speak to; always a shown one
    std::array<std::size_t, 2> pair{0,
                                    1}; ///< left and right of a wipe and so on; two different ones
    float divider = 0.5f;               ///< of a wipe: the share of the picture left of it
    float gain = 4.0f;                  ///< of the difference
};

/// Every pane with a filter of its own: what was asked for, then SVGF, a fixed alpha and clamping.
Panes startPanes(const Settings& settings);

/// Those that run, in the order in which they are shown.
std::vector<std::size_t> shownPanes(const Panes& panes);
bool isShown(const Panes& panes, std::size_t pane);
/// All that a pane's picture is made with.
Settings settingsOf(const Panes& panes, std::size_t pane);
/// Returns whether one of the shown panes makes frames carry gradient samples.
bool carriesSamples(const Panes& panes);
std::vector<std::size_t> changedPanes(const Panes& before, const Panes& after);

/// Returns whether there are as many panes in use as a layout needs.
bool offersLayout(const Panes& panes, PaneLayout layout);
void chooseLayout(Panes& panes, PaneLayout layout); ///< nothing where it is not offered
void cycleLayout(Panes& panes, int step);
/// Makes it the active one. Where it is not shown it takes the place of the one that was active.
void choosePane(Panes& panes, std::size_t pane);
void cyclePane(Panes& panes, int step); ///< among those shown; in a single view among all
void swapPair(Panes& panes);
void moveDivider(Panes& panes, float by); ///< stays within [0, 1]
void copyPane(Panes& panes, std::size_t from, std::size_t to);

/// Of the active pane, or of the frame where it is frame-wide. Clamped to its range.
void setField(Panes& panes, const Field& field, double value);
void setFilter(Panes& panes, std::size_t pane, Filter filter);
void setPane(Panes& panes, std::size_t pane, std::string title, const FilterSettings& settings);

/// "SVGF", or the title of the preset.
std::string titleOf(const Pane& pane);
/// Returns the title with the setting that differs from other panes of that title, or else with the
/// one that was changed: "Fixed alpha 0.1".
std::string titleOf(const Panes& panes, std::size_t pane);
/// Returns the pane's entry in the log of the probes: its title, and its filter with all settings.
ProbePane recordOf(const Panes& panes, std::size_t pane);
/// The parameters that are not at their defaults: "alpha 0.1, history law frames"; never empty for
/// a filter that accumulates, since alpha is always told.
std::string parametersOf(const Pane& pane);

/// Where one pane is in the view.
struct PanePlace {
    std::size_t pane = 0;
    Rect cell;    ///< its part of the view
    Rect picture; ///< where its whole picture would be
    Rect shown;   ///< the part of `picture` that is seen
};
/// In framebuffer pixels. A difference has one place, that of the first of the pair.
std::vector<PanePlace> placesOf(const Panes& panes, const Rect& view, glm::ivec2 image);

/// The pixel of the rendered image under a position of the framebuffer.
struct PanePixel {
    std::size_t pane = 0;
    glm::ivec2 pixel{0};
};
std::optional<PanePixel> pixelAt(std::span<const PanePlace> places, glm::vec2 position,
                                 glm::ivec2 image);
/// The nearest pixel of a pane's picture to a position; the picture must not be empty.
glm::ivec2 pixelOf(const PanePlace& place, glm::vec2 position, glm::ivec2 image);
/// Where a pixel's square is in the framebuffer, in a pane's picture: its upper left corner, with
/// fractions.
glm::vec2 positionOf(const PanePlace& place, glm::vec2 pixel, glm::ivec2 image);
/// Whether a position is on the divider of a wipe, within `reach` pixels.
bool isOnDivider(const Panes& panes, std::span<const PanePlace> places, glm::vec2 position,
                 float reach);
/// Where the divider is to be so that it is under a position.
float dividerAt(std::span<const PanePlace> places, glm::vec2 position);

} // namespace afterglow
