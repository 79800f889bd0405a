// SPDX-License-Identifier: MIT
#include "app/workbench/fields.h"
#include "app/workbench/panes.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

using Shown = std::vector<std::size_t>;

Panes panesIn(PaneLayout layout) {
    Panes panes = startPanes(Settings{});
    panes.layout = layout;
    return panes;
}

/// What holds of any panes, whatever has been done to them.
void checkWhole(const Panes& panes) {
    CHECK(panes.pair[0] != panes.pair[1]);
    CHECK(std::max({panes.pair[0], panes.pair[1], panes.active}) < panes.all.size());
    CHECK(isShown(panes, panes.active));
    const Shown shown = shownPanes(panes);
    CHECK(std::set(shown.begin(), shown.end()).size() == shown.size());
}

} // namespace

TEST_CASE("whatever filter one begins with, the four panes have four, and that one is the first") {
    for (const Filter filter : allFilters()) {
        CAPTURE(nameOf(filter));
        Settings settings;
        settings.filter = filter;
        settings.denoiser.temporal.alpha = 0.3f;
        settings.display.exposure = 1.5f;
        const Panes panes = startPanes(settings);
        CHECK(panes.all[0].settings.filter == filter);
        std::set<Filter> filters;
        for (std::size_t i = 0; i < panes.all.size(); ++i) {
            filters.insert(panes.all[i].settings.filter);
            CHECK(differingFields(settingsOf(panes, i), settings).empty());
        }
        CHECK(filters.size() == panes.all.size());
        checkWhole(panes);
    }
}

TEST_CASE("a layout shows one pane, its pair, or all") {
    Panes panes = startPanes(Settings{});
    panes.pair = {3, 1};
    panes.active = 1;
    for (const auto& [layout, shown] : {std::pair(PaneLayout::Single, Shown{1}),
                                        {PaneLayout::Wipe, {3, 1}},
                                        {PaneLayout::TwoUp, {3, 1}},
                                        {PaneLayout::FourUp, {0, 1, 2, 3}},
                                        {PaneLayout::Difference, {3, 1}}}) {
        CAPTURE(nameOf(layout));
        panes.layout = layout;
        CHECK(shownPanes(panes) == shown);
        for (std::size_t pane = 0; pane < 6; ++pane)
            CHECK(isShown(panes, pane) == (std::ranges::count(shown, pane) == 1));
    }
}

TEST_CASE("a layout is named where its name stands in the list of names, and no two alike") {
    const auto names = paneLayoutNames();
    REQUIRE(names.size() == kPaneLayouts);
    for (std::size_t i = 0; i < kPaneLayouts; ++i) {
        CHECK(names[i] == nameOf(PaneLayout(int(i))));
        CHECK(std::ranges::count(names, names[i]) == 1);
    }
}

TEST_CASE("going through layouts and panes in any order always leaves the active one in view") {
    Panes panes = startPanes(Settings{});
    std::uint32_t random = 1;
    for (int i = 0; i < 2000; ++i) {
        random = random * 1664525u + 1013904223u;
        const std::uint32_t what = (random >> 16) % 5, which = (random >> 24) % 4;
        CAPTURE(i);
        if (what == 0)
            cycleLayout(panes, which < 2 ? 1 : -1);
        else if (what == 1)
            choosePane(panes, which);
        else if (what == 2)
            cyclePane(panes, which < 2 ? 1 : -1);
        else if (what == 3)
            swapPair(panes);
        else
            chooseLayout(panes, PaneLayout(int((random >> 24) % kPaneLayouts)));
        checkWhole(panes);
    }
}

TEST_CASE("layouts come around in both directions") {
    for (const int step : {1, -1}) {
        Panes panes = startPanes(Settings{});
        std::set<PaneLayout> seen;
        for (std::size_t i = 0; i < kPaneLayouts; ++i) {
            cycleLayout(panes, step);
            seen.insert(panes.layout);
        }
        CHECK(seen.size() == kPaneLayouts);
        CHECK(panes.layout == PaneLayout::Single);
    }
}

TEST_CASE("what was looked at alone stays in view beside another") {
    for (const PaneLayout layout : {PaneLayout::Wipe, PaneLayout::TwoUp, PaneLayout::Difference})
        for (std::size_t pane = 0; pane < 4; ++pane) {
            Panes panes = panesIn(PaneLayout::Single);
            choosePane(panes, pane);
            chooseLayout(panes, layout);
            CHECK(isShown(panes, pane));
            CHECK(panes.active == pane);
            checkWhole(panes);
        }
}

TEST_CASE("a chosen pane that is not in view takes the place of the active one") {
    Panes panes = panesIn(PaneLayout::TwoUp);
    panes.active = 1;
    choosePane(panes, 3);
    CHECK(shownPanes(panes) == Shown{0, 3});
    CHECK(panes.active == 3);
    choosePane(panes, 0);
    CHECK(shownPanes(panes) == Shown{0, 3});
    choosePane(panes, 2);
    CHECK(shownPanes(panes) == Shown{2, 3});
    choosePane(panes, 4); // there is none
    CHECK(panes.active == 2);
}

TEST_CASE("panes come around among those shown, or among all where one is seen alone") {
    for (const auto& [layout, count] : {std::pair(PaneLayout::Single, 4u),
                                        {PaneLayout::Wipe, 2u},
                                        {PaneLayout::TwoUp, 2u},
                                        {PaneLayout::FourUp, 4u}})
        for (const int step : {1, -1}) {
            CAPTURE(nameOf(layout));
            Panes panes = panesIn(layout);
            const Shown before = shownPanes(panes);
            std::set<std::size_t> seen;
            for (unsigned i = 0; i < count; ++i) {
                cyclePane(panes, step);
                seen.insert(panes.active);
            }
            CHECK(seen.size() == count);
            CHECK(panes.active == 0);
            CHECK(shownPanes(panes) == before);
        }
}

TEST_CASE("swapping changes sides and nothing else") {
    Panes panes = panesIn(PaneLayout::Wipe);
    panes.pair = {2, 0};
    swapPair(panes);
    CHECK(shownPanes(panes) == Shown{0, 2});
    CHECK(panes.active == 0);
}

TEST_CASE("the divider stays within the picture") {
    Panes panes = panesIn(PaneLayout::Wipe);
    moveDivider(panes, 0.25f);
    CHECK(panes.divider == 0.75f);
    moveDivider(panes, 2.0f);
    CHECK(panes.divider == 1.0f);
    moveDivider(panes, -3.0f);
    CHECK(panes.divider == 0.0f);
}

TEST_CASE("lighting and display are set for all panes, a parameter for the active one") {
    std::size_t frameWide = 0;
    for (const Field& field : fields()) {
        CAPTURE(field.key);
        Panes panes = panesIn(PaneLayout::FourUp);
        panes.active = 2;
        const Panes before = panes;
        const double start = fieldValue(settingsOf(before, 0), field);
        setField(panes, field, start == field.max ? field.min : field.max);
        CHECK(changedPanes(before, panes) == (field.isFrameWide() ? Shown{0, 1, 2, 3} : Shown{2}));
        for (std::size_t i = 0; i < panes.all.size(); ++i)
            for (const Field& other : fields())
                if (&other != &field)
                    CHECK(isDefault(settingsOf(panes, i), other));
        setField(panes, field, field.max + 1e6);
        CHECK(fieldValue(settingsOf(panes, 2), field) == doctest::Approx(field.max));
        frameWide += field.isFrameWide();
    }
    CHECK(fieldByKey("exposure").isFrameWide());
    CHECK(fieldByKey("signal").isFrameWide());
    CHECK_FALSE(fieldByKey("alpha").isFrameWide());
    CHECK(frameWide < fields().size() / 2);
}

TEST_CASE("a preset changes the filter and parameters of its pane, not lighting and display") {
    Panes panes = startPanes(Settings{});
    setField(panes, fieldByKey("exposure"), 2.0);
    setField(panes, fieldByKey("aoRadius"), 0.1);
    const Panes before = panes;
    Settings preset;
    preset.filter = Filter::Percentile;
    preset.denoiser.temporal.alpha = 0.05f;
    preset.display.exposure = -3.0f;
    preset.lighting.signal = int(Signal::Shadows);
    setPane(panes, 1, "Mine", preset);
    CHECK(changedPanes(before, panes) == Shown{1});
    const Settings now = settingsOf(panes, 1);
    CHECK(now.filter == Filter::Percentile);
    CHECK(now.denoiser.temporal.alpha == 0.05f);
    CHECK(now.display.exposure == 2.0f);
    CHECK(now.lighting.aoRadius == 0.1f);
    CHECK(now.lighting.signal == int(Signal::Both));
    CHECK(titleOf(panes.all[1]) == "Mine");

    copyPane(panes, 1, 3);
    CHECK(titleOf(panes.all[3]) == "Mine");
    CHECK(panes.all[3].settings.filter == Filter::Percentile);
    CHECK(differingFields(settingsOf(panes, 3), now).empty());
}

TEST_CASE("a pane is called after its preset, until it gets another filter") {
    Panes panes = startPanes(Settings{});
    setPane(panes, 0, "Mine", panes.all[0].settings);
    CHECK(titleOf(panes.all[0]) == "Mine");
    setFilter(panes, 0, Filter::Svgf);
    CHECK(titleOf(panes.all[0]) == "SVGF");
    std::set<std::string> titles;
    for (const Filter filter : allFilters())
        titles.insert(std::string(titleOf(filter)));
    CHECK(titles.size() == allFilters().size());
    CHECK_FALSE(titles.contains(""));
}

TEST_CASE("two panes of one filter are told apart by what differs between them") {
    Panes panes = startPanes(Settings{});
    setFilter(panes, 1, Filter::Fixed);
    setFilter(panes, 2, Filter::Fixed);
    CHECK(titleOf(panes, 1) == "Fixed \xce\xb1"); // nothing differs
    panes.all[1].settings.denoiser.temporal.alpha = 0.1f;
    panes.all[2].settings.denoiser.temporal.alpha = 0.3f;
    CHECK(titleOf(panes, 1) == "Fixed \xce\xb1 0.1");
    CHECK(titleOf(panes, 2) == "Fixed \xce\xb1 0.3");
    CHECK(titleOf(panes, 0) == "A-SVGF");
    panes.all[1].settings.denoiser.temporal.alpha = 0.2f; // the default, beside another
    CHECK(titleOf(panes, 1) == "Fixed \xce\xb1 0.2");
    CHECK(recordOf(panes, 1) == ProbePane{"Fixed \xce\xb1 0.2", "filter=fixed"});
    CHECK(recordOf(panes, 2) == ProbePane{"Fixed \xce\xb1 0.3", "filter=fixed alpha=0.3"});
    // Alone, by what is not at its default.
    setFilter(panes, 2, Filter::Clamp);
    CHECK(titleOf(panes, 1) == "Fixed \xce\xb1");
    CHECK(titleOf(panes, 2) == std::string(titleOf(Filter::Clamp)) + " \xce\xb1 0.3");
    // A preset is called by its name while it is unchanged.
    setPane(panes, 0, "Mine", panes.all[2].settings);
    CHECK(titleOf(panes, 0) == "Mine");
    panes.all[0].settings.denoiser.temporal.alpha = 0.25f;
    CHECK(titleOf(panes, 0) == "Mine, \xce\xb1 0.25");
    // The display changes no number, and what belongs to all panes is recorded of each.
    setField(panes, fieldByKey("exposure"), 2.0);
    CHECK(recordOf(panes, 1).settings == "filter=fixed");
    setField(panes, fieldByKey("signal"), double(Signal::Shadows));
    CHECK(recordOf(panes, 1).settings == "filter=fixed signal=shadows");
}

TEST_CASE("panes that are not in use are never shown or chosen") {
    for (std::size_t count = 1; count <= kFilterStates; ++count) {
        CAPTURE(count);
        Panes panes = startPanes(Settings{});
        panes.count = count;
        std::set<PaneLayout> layouts;
        for (int i = 0; i < 20; ++i) {
            cycleLayout(panes, i < 10 ? 1 : -1);
            layouts.insert(panes.layout);
            for (std::size_t pane = 0; pane < kFilterStates; ++pane) {
                choosePane(panes, pane);
                CHECK(panes.active < count);
                cyclePane(panes, i % 2 ? 1 : -1);
                for (const std::size_t shown : shownPanes(panes))
                    CHECK(shown < count);
            }
            CHECK(placesOf(panes, {{0, 0}, {90, 60}}, {9, 6}).size() ==
                  (panes.layout == PaneLayout::Difference ? 1 : shownPanes(panes).size()));
        }
        CHECK(layouts.size() == (count == 1 ? 1u : count == 2 ? 4u : 5u));
        chooseLayout(panes, PaneLayout::FourUp);
        CHECK((panes.layout == PaneLayout::FourUp) == (count > 2));
    }
}

TEST_CASE("the parameters told of a pane are alpha and what is not at its default") {
    Panes panes = startPanes(Settings{});
    Pane& pane = panes.all[0];
    CHECK(parametersOf(pane) == "\xce\xb1 0.2");
    setField(panes, fieldByKey("alpha"), 0.1);
    CHECK(parametersOf(pane) == "\xce\xb1 0.1");
    setField(panes, fieldByKey("exposure"), 2.0); // of the frame, not of the filter
    CHECK(parametersOf(pane) == "\xce\xb1 0.1");
    for (const Field& field : fields()) {
        if (field.isFrameWide() || field.key == "alpha")
            continue;
        CAPTURE(field.key);
        const bool isHigh = fieldValue(settingsOf(panes, 0), field) == field.max;
        setField(panes, field, isHigh ? field.min : field.max);
        const std::string text = std::string(field.key) + " " +
                                 valueText(field, fieldValue(settingsOf(panes, 0), field));
        CHECK(parametersOf(pane) == "\xce\xb1 0.1, " + text);
        setField(panes, field, fieldValue(Settings{}, field));
    }
    setFilter(panes, 0, Filter::None);
    CHECK(parametersOf(pane).empty());
}
