#include "app/workbench/pictures.h"

#include "renderer/pipeline/aov.h"

#include <algorithm>
#include <cstring>

namespace afterglow {
namespace {

using namespace gpu;

/// What the images of a frame hold, by the beginnings of their labels.
struct Content {
    std::string_view label;
    std::string_view aov; ///< shown as this one is
    int channel = 0;
    bool isFloatBits = false;
};
constexpr Content kContents[] = {
    {"ids", "instance"},
    {"visibility", "instance"},
    {"sample visibility", "instance"},
    {"seeds", "instance"},
    {"sample seeds", "instance"},
    {"surface", "position", 0, true},
    {"sample surface", "position", 0, true},
    {"guides", "normal"},
    {"sample guides", "normal"},
    {"slope", "slope"},
    {"sample slope", "slope"},
    {"motion", "motion"},
    {"sample motion", "motion"},
    {"albedo", "albedo"},
    {"sample albedo", "albedo"},
    {"emission", "emission"},
    {"sample emission", "emission"},
    {"raw", "raw"},
    {"sample raw", "raw"},
    {"samples", "samples", 1},
    {"gradient samples", "gradient_sample"},
    {"gradient 0", "gradient"},
    {"gradient 1", "gradient"},
    {"lambda", "lambda_strata"},
    {"luminance range", "history_luminance"},
    {"accumulated", "accumulated"},
    {"color", "accumulated"},
    {"moments", "moments"},
    {"control", "alpha", 1},
    {"filtered 0", "filtered"},
    {"filtered 1", "filtered"},
    {"composed", "color"},
};

std::size_t indexOf(std::string_view aov) {
    const auto all = aovs();
    return std::size_t(std::ranges::find(all, aov, &AovInfo::name) - all.begin());
}

std::size_t signalIn(const Pictures::Sources& from) {
    return shownSignal(from.state, from.renderer.signals().size());
}

bool same(const DebugViewParams& a, const DebugViewParams& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace

Pictures::Pictures(ShaderLibrary& shaders) : debugView_(shaders), difference_(shaders) {}

Pictures::Choice Pictures::aovChoice(const Sources& from, std::size_t pane) const {
    const AovInfo& aov = aovs()[from.state.shown.index];
    const auto signals = from.renderer.signals();
    Choice choice;
    choice.legend = {
        fileStem(aov, signals[signalIn(from)], signals.size()), std::string(aov.meaning), {}, {}};
    if (!isMadeBy(aov, from.renderer.ran(pane)->settings)) {
        choice.legend.note =
            titleOf(from.state.panes.all[pane]) + " does not make it: this is the picture.";
        return choice;
    }
    const ImageDisplay& display = from.state.displays[from.state.shown.index];
    const AovSource source = sourceOf(from.renderer, aov, pane, signalIn(from));
    choice.image = &source.texture;
    choice.params = debugViewParams(display, source, from.renderer.size());
    choice.legend.display = display;
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
    choice.legend.name = chosen.pass + ": " + chosen.image;
    choice.image = from.passes.image(from.state.shown.index);
    if (!choice.image) {
        choice.legend.note = "It is shown from the next frame on.";
        return choice;
    }
    const auto content =
        std::ranges::find(kContents, std::string_view(chosen.image), &Content::label);
    if (content == std::end(kContents)) // the finished picture
        return choice;
    const std::size_t index = indexOf(content->aov);
    const ImageDisplay& display = from.state.displays[index];
    choice.legend.meaning =
        "shown as " + std::string(content->aov) + ": " + std::string(aovs()[index].meaning);
    choice.legend.display = display;
    choice.params = debugViewParams(
        display, {*choice.image, content->channel, content->isFloatBits}, from.renderer.size());
    return choice;
}

Pictures::Choice Pictures::oracleChoice(const Sources& from, std::size_t pane) const {
    const auto wanted = OracleImage(from.state.shown.index);
    const ImageDisplay& display = from.state.oracleDisplays[from.state.shown.index];
    Choice choice;
    choice.legend = {std::string(nameOf(wanted)), std::string(describe(wanted)), {}, {}};
    if (!from.oracle.isDone()) {
        choice.legend.note = "It is shown when the reference has converged.";
        return choice;
    }
    choice.image = from.oracle.image(wanted, pane, signalIn(from));
    if (!choice.image) {
        choice.legend.note =
            titleOf(from.state.panes.all[pane]) + " has none: this is the picture.";
        return choice;
    }
    choice.legend.display = display;
    choice.params = debugViewParams(display, {*choice.image}, from.renderer.size());
    return choice;
}

Pictures::Choice Pictures::choiceFor(const Sources& from, std::size_t pane) const {
    switch (from.state.shown.kind) {
    case Shown::Kind::Picture: return {};
    case Shown::Kind::Aov: return aovChoice(from, pane);
    case Shown::Kind::Pass: return pane == from.state.panes.active ? passChoice(from) : Choice{};
    case Shown::Kind::Oracle: return oracleChoice(from, pane);
    }
    return {};
}

const GpuTexture* Pictures::developed(const Sources& from, Slot& slot, const GpuTexture& image,
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
    return developed(from, slots_[pane], *choice.image, choice.params);
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
    legend.display = ImageDisplay{.name = "difference",
                                  .map = params.map,
                                  .low = params.low,
                                  .high = params.high,
                                  .unit = a.legend.display ? a.legend.display->unit : ""};
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
        slot.version = 0; // to be developed
    }
    return developed(from, slot, differences_, wanted.shown.params);
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
