// SPDX-License-Identifier: MIT
#include "app/workbench/panes.h"

#include "app/workbench/fields.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr std::array<std::string_view, kPaneLayouts> kLayoutNames{"single", "wipe", "two-up",
                                                                  "four-up", "difference"};

// A field's name beside its value.
std::string_view shortName(const Field& field) {
    return field.key == "alpha" ? "\xce\xb1" : field.key;
}

// The active pane is one of those shown.
void keepActiveShown(Panes& panes) {
    if (!isShown(panes, panes.active))
        panes.active = shownPanes(panes).front();
}

} // namespace

std::size_t wrapped(std::size_t index, int step, std::size_t count) {
    const int n = int(count);
    return std::size_t((((int(index) + step) % n) + n) % n);
}

bool showsPair(PaneLayout layout) {
    return layout != PaneLayout::Single && layout != PaneLayout::FourUp;
}

std::string_view nameOf(PaneLayout layout) {
    return kLayoutNames[std::size_t(layout)];
}

std::span<const std::string_view> paneLayoutNames() {
    return kLayoutNames;
}

Panes startPanes(const Settings& settings) {
    Panes panes;
    panes.frame = settings;
    for (Pane& pane : panes.all)
        pane.settings = settings;
    std::size_t next = 1;
    for (const Filter filter : {Filter::Asvgf, Filter::Svgf, Filter::Fixed, Filter::Clamp})
        if (filter != settings.filter && next < panes.all.size())
            setFilter(panes.all[next++].settings, filter);
    return panes;
}

std::vector<std::size_t> shownPanes(const Panes& panes) {
    if (panes.layout == PaneLayout::Single)
        return {panes.active};
    if (showsPair(panes.layout))
        return {panes.pair[0], panes.pair[1]};
    std::vector<std::size_t> all(panes.count);
    std::iota(all.begin(), all.end(), std::size_t(0));
    return all;
}

bool isShown(const Panes& panes, std::size_t pane) {
    const auto shown = shownPanes(panes);
    return std::ranges::find(shown, pane) != shown.end();
}

Settings settingsOf(const Panes& panes, std::size_t pane) {
    return {panes.frame, panes.all.at(pane).settings};
}

bool carriesSamples(const Panes& panes) {
    return std::ranges::any_of(shownPanes(panes), [&](std::size_t pane) {
        return needsOf(panes.all[pane].settings).samples;
    });
}

std::vector<std::size_t> changedPanes(const Panes& before, const Panes& after) {
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < before.all.size(); ++i)
        if (!differingFields(settingsOf(before, i), settingsOf(after, i)).empty() ||
            before.all[i].settings.filter != after.all[i].settings.filter)
            changed.push_back(i);
    return changed;
}

bool offersLayout(const Panes& panes, PaneLayout layout) {
    return layout == PaneLayout::Single || panes.count > (layout == PaneLayout::FourUp ? 2 : 1);
}

void chooseLayout(Panes& panes, PaneLayout layout) {
    if (!offersLayout(panes, layout))
        return;
    // What was looked at alone stays in view.
    if (showsPair(layout) && panes.layout == PaneLayout::Single && panes.active != panes.pair[0] &&
        panes.active != panes.pair[1])
        panes.pair[0] = panes.active;
    panes.layout = layout;
    keepActiveShown(panes);
}

void cycleLayout(Panes& panes, int step) {
    std::size_t next = std::size_t(panes.layout);
    do
        next = wrapped(next, step, kPaneLayouts);
    while (!offersLayout(panes, PaneLayout(next)));
    chooseLayout(panes, PaneLayout(next));
}

void choosePane(Panes& panes, std::size_t pane) {
    if (pane >= panes.count)
        return;
    if (showsPair(panes.layout) && !isShown(panes, pane))
        panes.pair[panes.active == panes.pair[1] ? 1 : 0] = pane;
    panes.active = pane;
}

void cyclePane(Panes& panes, int step) {
    if (panes.layout == PaneLayout::Single)
        return choosePane(panes, wrapped(panes.active, step, panes.count));
    const auto shown = shownPanes(panes);
    const auto place = std::size_t(std::ranges::find(shown, panes.active) - shown.begin());
    panes.active = shown[wrapped(place, step, shown.size())];
}

void swapPair(Panes& panes) {
    std::swap(panes.pair[0], panes.pair[1]);
}

void moveDivider(Panes& panes, float by) {
    panes.divider = std::clamp(panes.divider + by, 0.0f, 1.0f);
}

void copyPane(Panes& panes, std::size_t from, std::size_t to) {
    panes.all.at(to) = panes.all.at(from);
}

void setField(Panes& panes, const Field& field, double value) {
    setFieldValue(panes.frame, panes.all[panes.active].settings, field, value);
}

void setFilter(Panes& panes, std::size_t pane, Filter filter) {
    setFilter(panes.all.at(pane).settings, filter);
    panes.all.at(pane).title.clear();
}

void setPane(Panes& panes, std::size_t pane, std::string title, const FilterSettings& settings) {
    panes.all.at(pane) = {std::move(title), settings, settings};
}

std::string titleOf(const Pane& pane) {
    return pane.title.empty() ? std::string(titleOf(pane.settings.filter)) : pane.title;
}

std::string titleOf(const Panes& panes, std::size_t pane) {
    constexpr std::size_t kMostTold = 2;
    const Pane& self = panes.all.at(pane);
    const std::string title = titleOf(self);
    std::vector<const Field*> differing;
    for (std::size_t i = 0; i < panes.count; ++i)
        if (titleOf(panes.all[i]) == title)
            for (const Field* field :
                 differingFields(settingsOf(panes, i), settingsOf(panes, pane)))
                if (std::ranges::find(differing, field) == differing.end())
                    differing.push_back(field);
    if (differing.empty())
        differing = differingFields(self.title.empty() ? defaultSettings(self.settings.filter)
                                                       : Settings{{}, self.preset},
                                    {{}, self.settings});
    std::string text = title;
    for (std::size_t i = 0; i < std::min(differing.size(), kMostTold); ++i) {
        const Field& field = *differing[i];
        text += i > 0 || !self.title.empty() ? ", " : " ";
        if (!text.ends_with(fmt::format("{} ", shortName(field)))) // "Fixed alpha" has it
            text += fmt::format("{} ", shortName(field));
        text += valueText(field, fieldValue(settingsOf(panes, pane), field));
    }
    return text + (differing.size() > kMostTold ? ", ..." : "");
}

ProbePane recordOf(const Panes& panes, std::size_t pane) {
    return {titleOf(panes, pane), settingsText(settingsOf(panes, pane))};
}

std::string parametersOf(const Pane& pane) {
    if (pane.settings.filter == Filter::None)
        return {};
    const gpu::TemporalParams& temporal = pane.settings.denoiser.temporal;
    std::string text = pane.settings.filter == Filter::Counted
                           ? fmt::format("up to {:.3g} samples", double(temporal.maxHistory))
                           : fmt::format("\xce\xb1 {:.3g}", double(temporal.alpha));
    const Settings settings{{}, pane.settings};
    for (const Field* field : differingFields(settings, defaultSettings(settings.filter)))
        if (field->key != "alpha" &&
            !(field->key == "maxHistory" && pane.settings.filter == Filter::Counted))
            text += ", " + std::string(field->key) + " " +
                    valueText(*field, fieldValue(settings, *field));
    return text;
}

std::vector<PanePlace> placesOf(const Panes& panes, const Rect& view, glm::ivec2 image) {
    const auto whole = [&](std::size_t pane, const Rect& cell) {
        const Rect picture = fitAspect(cell, image);
        return PanePlace{pane, cell, picture, picture};
    };
    // Cells may differ by a pixel; their pictures, which are to be compared, do not.
    const auto part = [&](std::size_t pane, glm::ivec2 place, glm::ivec2 count) {
        const glm::ivec2 low = view.min + view.size * place / count;
        const glm::ivec2 high = view.min + view.size * (place + 1) / count;
        PanePlace result = whole(pane, {low, view.size / count});
        result.cell.size = high - low;
        return result;
    };
    const auto [first, second] = panes.pair;
    switch (panes.layout) {
    case PaneLayout::Single: return {whole(panes.active, view)};
    case PaneLayout::Difference: return {whole(first, view)};
    case PaneLayout::TwoUp: return {part(first, {0, 0}, {2, 1}), part(second, {1, 0}, {2, 1})};
    case PaneLayout::FourUp: {
        std::vector<PanePlace> places;
        for (int i = 0; i < int(panes.count); ++i)
            places.push_back(part(std::size_t(i), {i % 2, i / 2}, {2, 2}));
        return places;
    }
    case PaneLayout::Wipe: break;
    }
    PanePlace left = whole(first, view), right = whole(second, view);
    const int width = int(std::lround(panes.divider * float(left.picture.size.x)));
    left.shown.size.x = width;
    right.shown.min.x += width;
    right.shown.size.x -= width;
    return {left, right};
}

std::optional<PanePixel> pixelAt(std::span<const PanePlace> places, glm::vec2 position,
                                 glm::ivec2 image) {
    for (const PanePlace& place : places) {
        const glm::vec2 low(place.shown.min), high(place.shown.min + place.shown.size);
        if (place.shown.empty() || glm::any(glm::lessThan(position, low)) ||
            glm::any(glm::greaterThanEqual(position, high)))
            continue;
        return PanePixel{place.pane, pixelOf(place, position, image)};
    }
    return {};
}

glm::ivec2 pixelOf(const PanePlace& place, glm::vec2 position, glm::ivec2 image) {
    const glm::vec2 part =
        (position - glm::vec2(place.picture.min)) / glm::vec2(place.picture.size);
    return glm::clamp(glm::ivec2(glm::floor(part * glm::vec2(image))), glm::ivec2(0), image - 1);
}

glm::vec2 positionOf(const PanePlace& place, glm::vec2 pixel, glm::ivec2 image) {
    return glm::vec2(place.picture.min) + pixel / glm::vec2(image) * glm::vec2(place.picture.size);
}

bool isOnDivider(const Panes& panes, std::span<const PanePlace> places, glm::vec2 position,
                 float reach) {
    if (panes.layout != PaneLayout::Wipe || places.size() != 2)
        return false;
    const Rect& picture = places[0].picture;
    const float x = float(picture.min.x) + panes.divider * float(picture.size.x);
    return std::abs(position.x - x) <= reach && position.y >= float(picture.min.y) &&
           position.y < float(picture.min.y + picture.size.y);
}

float dividerAt(std::span<const PanePlace> places, glm::vec2 position) {
    if (places.empty() || places[0].picture.size.x <= 0)
        return 0.5f;
    const Rect& picture = places[0].picture;
    return std::clamp((position.x - float(picture.min.x)) / float(picture.size.x), 0.0f, 1.0f);
}

} // namespace afterglow
