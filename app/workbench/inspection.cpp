// SPDX-License-Identifier: MIT
#include "app/workbench/inspection.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace afterglow {
namespace {

template <glm::length_t count, class T>
std::vector<double> numbersOf(const glm::vec<count, T>& v) {
    return std::vector<double>(&v[0], &v[0] + count);
}
template <class Number>
std::vector<double> numbersOf(Number v) {
    return {double(v)};
}

/// A group to which lines are added.
struct Group : InspectedGroup {
    Group(std::string name, const PixelFacts& facts)
        : InspectedGroup{std::move(name), {}}, images(facts.images) {}

    void addText(std::string name, std::string value, std::string_view note,
                 std::vector<double> numbers = {}) {
        values.push_back({std::move(name), std::move(value), std::string(note), numbers});
    }
    void addNumbers(std::string name, const std::vector<double>& numbers, std::string_view note) {
        std::string value;
        for (const double number : numbers)
            value += (value.empty() ? "" : " ") + fourDigits(number);
        addText(std::move(name), std::move(value), note, numbers);
    }
    template <class Value>
    void add(std::string name, const Value& value, std::string_view note) {
        addNumbers(std::move(name), numbersOf(value), note);
    }
    /// Adds a value that is a texel of the image of that name, with its note.
    template <class Value>
    void addOf(std::string_view aov, std::string name, const Value& value) {
        add(std::move(name), value, aovByName(aov).meaning);
    }
    /// Adds the texel of an image where the filter makes it.
    void addImage(std::string_view aov, std::string name) {
        if (const auto found = images.find(aov); found != images.end())
            addNumbers(std::move(name), found->second, aovByName(aov).meaning);
    }

    const std::map<std::string_view, std::vector<double>>& images;
};

/// Results of the tests of a history tap, by gpu::kHistory... code.
constexpr std::array kTapResults{"valid", "none", "off screen", "instance", "depth", "normal"};

/// Makes the lines of one group from the facts of a pixel.
class Lines {
public:
    Lines(const PixelFacts& facts, const Scene& scene) : f_(facts), scene_(scene) {}

    Group surface() const {
        Group g("surface", f_);
        g.addText("instance", f_.isSurface() ? nameOfInstance() : "none: background",
                  aovByName("instance").meaning, {double(f_.instance)});
        if (!f_.isSurface())
            return g;
        g.addText("triangle", std::to_string(f_.triangle), "number in its mesh, from 0",
                  {double(f_.triangle)});
        g.add("barycentric weights", f_.barycentrics, "of the triangle's second and third corner");
        for (const char* const aov :
             {"position", "normal", "depth", "slope", "motion", "albedo", "emission"})
            g.addImage(aov, aov);
        return g;
    }

    Group rawSignal() const {
        Group g("raw signal", f_);
        g.addImage("raw", "raw");
        g.add("luminance", f_.rawLuminance, "of the raw signal, radiance");
        const bool again = f_.plan.carrySamples && !f_.samplesBeside && f_.isSample();
        g.addText("seed",
                  fmt::format("{} of frame {}{}", placeText(f_.seed.tile), f_.seed.frame,
                              again ? ", again" : ""),
                  "from where in the tile of blue noise, and from which frame, the pixel's random "
                  "numbers are",
                  {double(f_.seed.tile.x), double(f_.seed.tile.y), double(f_.seed.frame)});
        return g;
    }

    Group gradientSample() const {
        Group g("gradient sample", f_);
        const auto addPlace = [&](const char* name, const char* what, glm::ivec2 place,
                                  const char* note) {
            g.addText(name, what + placeText(place), note, numbersOf(place));
        };
        addPlace("stratum", "", f_.stratum, "of 3x3 pixels, counted from the upper left");
        g.addText("shaded", f_.samplesBeside ? "beside the picture" : "in the picture",
                  "whether gradient samples take the place of pixels");
        if (!f_.sample) {
            g.addText("sample", "none", aovByName("samples").meaning);
        } else {
            addPlace("sample", "pixel ", f_.sample->landing,
                     "where in the stratum its gradient sample landed");
            addPlace("source", "pixel ", f_.sample->source,
                     "whose sample of the frame before it is");
        }
        if (f_.sample && f_.gradient) {
            g.add("luminance before", f_.gradient->before, "in the frame before, radiance");
            g.add("luminance now", f_.gradient->now,
                  "of the same surface with the same random numbers, radiance");
        }
        g.addText("offered sample", std::string(sampleFate(f_.fate)), aovByName("fate").meaning,
                  {double(f_.fate)});
        if (!f_.plan.useLambda)
            return g;
        const glm::vec4 measured = f_.gradient->gradient;
        if (!f_.plan.useChange) {
            g.addOf("gradient_sample", "delta, measured", measured.x);
            g.addOf("gradient_sample_max", "Delta, measured", measured.y);
        }
        g.add("luminance of the stratum", measured.z,
              "mean of the raw signal over its pixels, radiance");
        g.add("variance of the stratum", measured.w,
              "of the raw luminance over its pixels, radiance squared");
        if (f_.plan.useChange) {
            g.addImage("light_before", "light before, reconstructed");
            g.addImage("light_now", "light now, reconstructed");
        } else {
            g.addImage("gradient", "delta, reconstructed");
            g.addImage("gradient_max", "Delta, reconstructed");
        }
        if (f_.plan.countsSamples()) {
            g.addImage("change_scale", "factor of the light");
            g.addImage("change_left", "change that is left");
            g.addImage("change_variance", "variance of a sample");
        }
        g.addImage("lambda_strata", "lambda of the stratum");
        return g;
    }

    Group history() const {
        const gpu::TemporalFindings& found = *f_.temporal;
        const bool kept = f_.hasHistory();
        Group g("history", f_);
        g.addText("state", std::string(historyReason(f_.reason())), aovByName("reason").meaning,
                  {double(f_.reason())});
        if (f_.hasTaps()) {
            g.add("came from", found.position, "where the surface was in the frame before, pixels");
            g.add("depth before", glm::vec2(found.depth, found.depthTolerance),
                  "of the surface in the frame before, and how far a pixel there may be from it, "
                  "meters");
            g.add("valid weight", found.validWeight,
                  fmt::format("B: bilinear, of the pixels there that passed all tests; below {} "
                              "there is no history",
                              gpu::kLeastWeight));
        }
        g.add("length before", found.fetchedSamples,
              "N of the history as fetched, frames; 0 is none");
        if (kept) {
            g.add("color before", found.fetchedColor, "of the history as fetched, radiance");
            g.add("moments before", found.fetchedMoments, "of the history as fetched");
        }
        g.addOf("history_luminance", "luminance", found.accumulated.a);
        if (kept && f_.plan.clampsHistory()) {
            g.add("clamp from", found.clampLow, "lower bound of the history's color, radiance");
            g.add("clamp to", found.clampHigh, "upper bound of the history's color, radiance");
            g.add("color clamped", found.usedColor, "of the history as it is blended, radiance");
        }
        if (kept && f_.plan.usePercentiles)
            g.add("raw range", found.range,
                  "low and high percentile of the raw luminance around, radiance");
        if (f_.plan.useLambda || f_.plan.usePercentiles)
            g.addOf("lambda", "lambda", found.control.x);
        if (kept && (f_.plan.cutsHistory() || f_.plan.cutsByPower() || f_.plan.countsSamples()))
            g.add("length cut", found.usedSamples, "N that lambda leaves of the history, frames");
        if (kept && f_.plan.countsSamples())
            g.add("new samples", found.newSamples,
                  "how much of a sample the newest one adds to the history");
        else if (kept)
            g.add("1 / (N + 1)", found.leastWeight, "what the newest frame weighs in a mean");
        g.addOf("alpha", "alpha", found.control.y);
        g.addOf("history", "length", found.moments.z);
        g.addOf("moments", "moments", glm::vec2(found.moments));
        return g;
    }

    /// Makes a line for each pixel that the history is interpolated between.
    Group taps() const {
        Group g("history taps", f_);
        for (const gpu::HistoryTap& tap : f_.temporal->taps)
            g.addText("pixel " + placeText(tap.pixel),
                      fmt::format("{} {}", fourDigits(tap.weight),
                                  kTapResults.at(std::size_t(tap.reason))),
                      noteOf(tap), {tap.weight, double(tap.reason)});
        return g;
    }

    Group filter() const {
        Group g("filter", f_);
        if (f_.temporal)
            g.addOf("accumulated", "accumulated", glm::vec3(f_.temporal->accumulated));
        for (const char* const aov : {"variance", "filtered", "color"})
            g.addImage(aov, aov);
        return g;
    }

private:
    std::string noteOf(const gpu::HistoryTap& tap) const {
        if (tap.reason == gpu::kHistoryOffScreen)
            return "bilinear weight; outside the picture";
        std::string note = fmt::format("bilinear weight; instance {} was seen there", tap.instance);
        if (tap.reason == gpu::kHistoryInstance)
            return note;
        note +=
            fmt::format(", at a depth of {}, {} from that of the surface", fourDigits(tap.depth),
                        fourDigits(std::abs(tap.depth - f_.temporal->depth)));
        if (tap.reason != gpu::kHistoryDepth)
            note +=
                fmt::format("; the cosine between the normals is {}, of at least {}",
                            fourDigits(tap.cosine), fourDigits(f_.plan.temporal.normalTolerance));
        return note;
    }

    std::string nameOfInstance() const {
        std::string name = std::to_string(f_.instance);
        if (f_.instance > scene_.instances.size())
            return name;
        const Instance& instance = scene_.instances[f_.instance - 1];
        const std::string& node = scene_.nodes[instance.node].name;
        const std::string& material = scene_.materials[instance.material].name;
        if (!node.empty())
            name += ": " + node;
        if (!material.empty())
            name += " (" + material + ")";
        return name;
    }

    const PixelFacts& f_;
    const Scene& scene_;
};

} // namespace

Inspection inspectionOf(const PixelFacts& facts, const Scene& scene, std::size_t state,
                        std::size_t signal) {
    const Lines lines(facts, scene);
    Inspection inspection{.pixel = facts.pixel,
                          .stratum = facts.stratum,
                          .state = state,
                          .signal = signal,
                          .groups = {lines.surface(), lines.rawSignal()},
                          .story = storyOf(facts)};
    if (facts.plan.carrySamples)
        inspection.groups.push_back(lines.gradientSample());
    if (facts.temporal && facts.isSurface()) {
        inspection.groups.push_back(lines.history());
        if (facts.hasTaps())
            inspection.groups.push_back(lines.taps());
    }
    inspection.groups.push_back(lines.filter());
    return inspection;
}

} // namespace afterglow
