// SPDX-License-Identifier: MIT
#include "app/workbench/pictures.h"

#include "renderer/pipeline/aov.h"

#include <algorithm>
#include <cstring>

namespace afterglow {
namespace {

using namespace gpu;

/// The label of a texture without what tells apart textures that hold the same: those that change
/// places with every frame, those of strata and their samples, the two that iterations alternate.
std::string_view contentOf(std::string_view label) {
    label = label.substr(0, label.find(" (previous)"));
    for (const std::string_view prefix : {"sample ", "strata "})
        if (label.starts_with(prefix))
            label.remove_prefix(prefix.size());
    if (label.ends_with(" 0") || label.ends_with(" 1"))
        label.remove_suffix(2);
    return label;
}

bool isWhole(PixelFormat format) {
    return format == PixelFormat::R32UI || format == PixelFormat::RG32UI ||
           format == PixelFormat::RGBA32UI;
}

std::size_t signalIn(const Pictures::Sources& from) {
    return shownSignal(from.state, from.renderer.signals().size());
}

bool same(const DebugViewParams& a, const DebugViewParams& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace

void Pictures::Choice::show(const AovSource& source, const ImageDisplay& display,
                            glm::ivec2 picture) {
    image = &source.texture;
    params = debugViewParams(display, source, picture);
    legend.display = display;
}

Pictures::Pictures(ShaderLibrary& shaders) : debugView_(shaders), difference_(shaders) {}

Pictures::Choice Pictures::imageChoice(const Sources& from, std::size_t pane) const {
    const std::size_t index = from.state.shown.index, signal = signalIn(from);
    const AovInfo& info = images()[index];
    const auto signals = from.renderer.signals();
    Choice choice;
    choice.legend = {
        fileStem(info, signals[signal], signals.size()), std::string(info.meaning), {}, {}};
    std::optional<AovSource> source;
    if (!isTruth(index)) {
        if (isMadeBy(info, from.renderer.ran(pane)->settings))
            source.emplace(sourceOf(from.renderer, info, pane, signal));
        else
            choice.legend.note =
                titleOf(from.state.panes.all[pane]) + " does not make it: this is the picture.";
    } else if (!from.oracle.isDone()) {
        choice.legend.note = "It is shown when the reference has converged.";
    } else if (const auto* image = from.oracle.image(index - aovs().size(), pane, signal)) {
        source.emplace(*image);
    } else {
        choice.legend.note =
            titleOf(from.state.panes.all[pane]) + " has none: this is the picture.";
    }
    if (source)
        choice.show(*source, from.state.displays[index], from.renderer.size());
    return choice;
}

Pictures::Choice Pictures::passChoice(const Sources& from) const {
    const auto& made = from.passes.made();
    Choice choice;
    if (from.state.shown.index >= made.size()) {
        choice.legend.note = "No such image in this frame: this is the picture.";
        return choice;
    }
    const PassCapture::Made& chosen = made[from.state.shown.index];
    choice.legend.name = chosen.title();
    choice.image = from.passes.image(from.state.shown.index);
    if (!choice.image) {
        choice.legend.note = "It is shown from the next frame on.";
        return choice;
    }
    if (choice.image->format() == PixelFormat::RGBA8) // the finished picture
        return choice;
    const glm::ivec2 size = from.renderer.size();
    for (const std::size_t pane : shownPanes(from.state.panes))
        for (std::size_t i = 0; i < aovs().size(); ++i) {
            const AovInfo& aov = aovs()[i];
            const RanFilter* const ran = from.renderer.ran(pane);
            if (!ran || !isMadeBy(aov, ran->settings))
                continue;
            const AovSource kept = sourceOf(from.renderer, aov, pane, signalIn(from));
            if (contentOf(kept.texture.label()) != contentOf(chosen.image))
                continue;
            choice.legend.meaning =
                "shown as " + std::string(aov.name) + ": " + std::string(aov.meaning);
            choice.show({*choice.image, kept.channel, kept.isFloatBits}, from.state.displays[i],
                        size);
            return choice;
        }
    // No image of the frame is kept in such a texture.
    choice.show({*choice.image}, isWhole(choice.image->format()) ? numbersUpTo(1.0f) : radiance(),
                size);
    return choice;
}

Pictures::Choice Pictures::choiceFor(const Sources& from, std::size_t pane) const {
    switch (from.state.shown.kind) {
    case Shown::Kind::Picture: return {};
    case Shown::Kind::Image: return imageChoice(from, pane);
    case Shown::Kind::Pass: return pane == from.state.panes.active ? passChoice(from) : Choice{};
    }
    return {};
}

const GpuTexture* Pictures::mapped(const Sources& from, Slot& slot, const GpuTexture& image,
                                   const DebugViewParams& params) {
    const glm::ivec2 size = from.renderer.size();
    if (slot.picture.size() != size) {
        slot.picture = GpuTexture("debug view", PixelFormat::RGBA8, size);
        slot.version = 0;
    }
    if (slot.version != version_ || slot.image != &image || !same(slot.params, params)) {
        FrameContext context{from.renderer.timer()};
        debugView_.run(context, image, slot.picture, params);
        slot.version = version_;
        slot.image = &image;
        slot.params = params;
    }
    return &slot.picture;
}

const GpuTexture* Pictures::of(const Sources& from, std::size_t pane) {
    if (!from.renderer.ran(pane))
        return nullptr;
    if (from.state.panes.layout == PaneLayout::Difference)
        return difference(from);
    const Choice choice = choiceFor(from, pane);
    if (!choice.image)
        return &from.renderer.display(pane);
    if (choice.image->format() == PixelFormat::RGBA8)
        return choice.image;
    return mapped(from, slots_[pane], *choice.image, choice.params);
}

// Of what both panes show; where that cannot be subtracted, of the linear pictures.
Pictures::Subtraction Pictures::subtractionFor(const Sources& from) const {
    const Panes& panes = from.state.panes;
    const auto [first, second] = panes.pair;
    const Choice a = choiceFor(from, first), b = choiceFor(from, second);
    const auto isFloat = [](const Choice& c) {
        return c.image &&
               (c.image->format() == PixelFormat::R32F || c.image->format() == PixelFormat::RG32F ||
                c.image->format() == PixelFormat::RGBA32F);
    };
    Subtraction result{a, a.image, b.image};
    const bool subtracts =
        isFloat(a) && isFloat(b) && a.image->size() == b.image->size() && a.image != b.image;
    if (!subtracts) {
        const auto& filters = from.renderer.targets().filters;
        result.first = &filters[first].composed;
        result.second = &filters[second].composed;
        result.shown.params = {};
        result.shown.params.map = kMapRadiance;
        result.shown.params.pixelsPerTexel = 1;
        result.shown.params.high = std::exp2(-panes.frame.display.exposure);
        if (!a.legend.name.empty())
            result.shown.legend.note = "It cannot be subtracted: this is of the pictures.";
    }
    // One channel keeps its sign; colors and directions show by how much.
    DebugViewParams& params = result.shown.params;
    const bool isRange = params.map == kMapScalar || params.map == kMapLogarithm;
    const bool scalar = isRange || params.map == kMapSigned;
    const float range = isRange ? params.high - params.low : params.high;
    params.map = scalar ? kMapSigned : kMapRadiance;
    params.high = std::max(range, 1e-9f) / panes.gain;
    params.low = scalar ? -params.high : 0.0f;
    PictureLegend& legend = result.shown.legend;
    legend.display = ImageDisplay{params.map, params.low, params.high,
                                  a.legend.display ? a.legend.display->unit : ""};
    if (legend.name.empty())
        legend.meaning = "linear radiance of the one picture minus the other, without its sign";
    legend.name = legend.name.empty() ? "difference" : "difference of " + legend.name;
    return result;
}

const GpuTexture* Pictures::difference(const Sources& from) {
    if (!from.renderer.ran(from.state.panes.pair[1]))
        return nullptr;
    const Subtraction wanted = subtractionFor(from);
    Slot& slot = slots_.back();
    if (differences_.size() != wanted.first->size()) {
        differences_ = GpuTexture("difference", PixelFormat::RGBA32F, wanted.first->size());
        slot.version = 0;
    }
    if (slot.version != version_ || !same(slot.params, wanted.shown.params)) {
        FrameContext context{from.renderer.timer()};
        difference_.run(context, *wanted.first, *wanted.second, differences_,
                        wanted.shown.params.map == kMapSigned ? Difference::Signed
                                                              : Difference::Absolute);
        slot.version = 0; // to be mapped
    }
    return mapped(from, slot, differences_, wanted.shown.params);
}

PictureLegend Pictures::legendOf(const Sources& from, std::size_t pane) const {
    const Panes& panes = from.state.panes;
    if (panes.layout == PaneLayout::Difference && from.renderer.ran(panes.pair[1]))
        return subtractionFor(from).shown.legend;
    return choiceFor(from, pane).legend;
}

std::size_t Pictures::bytes() const {
    std::size_t sum = 0;
    for (const Slot& slot : slots_)
        if (slot.picture.size().x > 0)
            sum += slot.picture.bytes();
    return sum + (differences_.size().x > 0 ? differences_.bytes() : 0);
}

Image<glm::u8vec4> composed(const Panes& panes,
                            const std::array<Image<glm::u8vec4>, kFilterStates>& pictures) {
    glm::ivec2 size{0};
    for (const std::size_t pane : shownPanes(panes))
        size = glm::max(size, pictures[pane].size());
    const bool twoUp = panes.layout == PaneLayout::TwoUp,
               fourUp = panes.layout == PaneLayout::FourUp;
    const glm::ivec2 count{twoUp || fourUp ? 2 : 1, fourUp ? 2 : 1};
    Image<glm::u8vec4> result(size * count, glm::u8vec4(0, 0, 0, 255));
    for (const PanePlace& place : placesOf(panes, {{0, 0}, size * count}, size)) {
        const Image<glm::u8vec4>& from = pictures[place.pane];
        if (from.size() != size) // it has not run yet
            continue;
        for (int y = 0; y < place.shown.size.y; ++y)
            for (int x = 0; x < place.shown.size.x; ++x) {
                const glm::ivec2 to = place.shown.min + glm::ivec2(x, y);
                result(to) = from(to - place.picture.min);
            }
    }
    return result;
}

} // namespace afterglow
