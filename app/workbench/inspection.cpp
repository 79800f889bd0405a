#include "app/workbench/inspection.h"

#include "app/workbench/inspection_story.h"
#include "renderer/pipeline/aov.h"

namespace afterglow {
namespace {

std::string listOf(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers)
        text += (text.empty() ? "" : " ") + fourDigits(number);
    return text;
}

std::vector<double> numbersOf(glm::vec2 v) {
    return {v.x, v.y};
}
std::vector<double> numbersOf(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

InspectedValue line(std::string name, std::vector<double> numbers, std::string_view note) {
    std::string value = listOf(numbers);
    return {std::move(name), std::move(value), std::string(note), std::move(numbers)};
}
InspectedValue words(std::string name, std::string value, std::string_view note,
                     std::vector<double> numbers = {}) {
    return {std::move(name), std::move(value), std::string(note), std::move(numbers)};
}
/// With the note of the image of that name.
InspectedValue fromImage(std::string name, std::string_view aov, std::vector<double> numbers) {
    return line(std::move(name), std::move(numbers), aovByName(aov).meaning);
}

std::string place(glm::ivec2 p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
}
std::vector<double> numbersOf(glm::ivec2 p) {
    return {double(p.x), double(p.y)};
}

/// Lines of one group, made from the facts of a pixel.
class Lines {
public:
    Lines(const PixelFacts& facts, const Scene& scene) : f_(facts), scene_(scene) {}

    InspectedGroup surface() const {
        InspectedGroup group{"surface", {}};
        auto& v = group.values;
        v.push_back(words("instance", f_.isSurface() ? nameOfInstance() : "none: background",
                          aovByName("instance").meaning, {double(f_.instance)}));
        if (!f_.isSurface())
            return group;
        v.push_back(words("triangle", std::to_string(f_.triangle), "number in its mesh, from 0",
                          {double(f_.triangle)}));
        v.push_back(line("barycentric weights", numbersOf(f_.barycentrics),
                         "of the triangle's second and third corner"));
        v.push_back(fromImage("position", "position", numbersOf(f_.position)));
        v.push_back(fromImage("normal", "normal", numbersOf(f_.normal)));
        v.push_back(fromImage("depth", "depth", {f_.depth}));
        v.push_back(fromImage("slope", "slope", numbersOf(f_.slope)));
        v.push_back(fromImage("motion", "motion", numbersOf(glm::vec2(f_.motion))));
        v.push_back(fromImage("albedo", "albedo", numbersOf(f_.albedo)));
        v.push_back(fromImage("emission", "emission", numbersOf(f_.emission)));
        return group;
    }

    InspectedGroup rawSignal() const {
        return {"raw signal",
                {fromImage("raw", "raw", numbersOf(glm::vec3(f_.raw))),
                 line("luminance", {f_.raw.a}, "of the raw signal, radiance"),
                 words("seed",
                       place(f_.seed.tile) + " of frame " + std::to_string(f_.seed.frame) +
                           (f_.plan.carrySamples && !f_.hasExtraSamples && f_.isSample() ? ", again"
                                                                                         : ""),
                       "from where in the tile of blue noise, and from which frame, the pixel's "
                       "random numbers are",
                       {double(f_.seed.tile.x), double(f_.seed.tile.y), double(f_.seed.frame)})}};
    }

    InspectedGroup gradientSample() const {
        InspectedGroup group{"gradient sample", {}};
        auto& v = group.values;
        v.push_back(words("stratum", place(f_.stratum),
                          "of 3x3 pixels, counted from the upper left", numbersOf(f_.stratum)));
        v.push_back(words("shaded", f_.hasExtraSamples ? "beside the picture" : "in the picture",
                          "whether gradient samples take the place of pixels"));
        if (f_.sample)
            addSample(v, *f_.sample);
        else
            v.push_back(words("sample", "none", aovByName("samples").meaning));
        v.push_back(words("offered sample", std::string(sampleFate(f_.fate)),
                          aovByName("fate").meaning, {double(f_.fate)}));
        if (f_.gradient)
            addGradient(v, *f_.gradient);
        return group;
    }

    InspectedGroup history() const {
        InspectedGroup group{"history", {}};
        auto& v = group.values;
        v.push_back(words("state", std::string(historyReason(f_.reason)),
                          aovByName("reason").meaning, {double(f_.reason)}));
        if (f_.fetched) {
            v.push_back(line("came from", numbersOf(f_.fetched->position),
                             "where the surface was in the frame before, pixels"));
            v.push_back(line("length before", {f_.fetched->length},
                             "of the history as fetched, frames; 0 is none"));
        }
        v.push_back(line("luminance", {f_.historyLuminance},
                         "of the history as fetched, 0 without one, radiance"));
        if (f_.range)
            v.push_back(line("raw range", numbersOf(*f_.range),
                             "low and high percentile of the raw luminance around, radiance"));
        if (f_.plan.useLambda || f_.plan.usePercentiles)
            v.push_back(fromImage("lambda", "lambda", {f_.lambda}));
        v.push_back(fromImage("alpha", "alpha", {f_.alpha}));
        v.push_back(fromImage("length", "history", {f_.length}));
        v.push_back(fromImage("moments", "moments", numbersOf(f_.moments)));
        return group;
    }

    InspectedGroup filter() const {
        InspectedGroup group{"filter", {}};
        auto& v = group.values;
        if (f_.plan.accumulate)
            v.push_back(
                fromImage("accumulated", "accumulated", numbersOf(glm::vec3(f_.accumulated))));
        if (f_.plan.atrousIterations > 0)
            v.push_back(fromImage("variance", "variance", {f_.filtered.a}));
        v.push_back(fromImage("filtered", "filtered", numbersOf(glm::vec3(f_.filtered))));
        v.push_back(fromImage("color", "color", numbersOf(f_.color)));
        return group;
    }

private:
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

    void addSample(std::vector<InspectedValue>& v, const CarriedSample& sample) const {
        v.push_back(words("sample", "pixel " + place(sample.landing),
                          "where in the stratum its gradient sample landed",
                          numbersOf(sample.landing)));
        v.push_back(words("source", "pixel " + place(sample.source),
                          "whose sample of the frame before it is", numbersOf(sample.source)));
        v.push_back(line("luminance before", {sample.before}, "in the frame before, radiance"));
        if (sample.now)
            v.push_back(line("luminance now", {*sample.now},
                             "of the same surface with the same random numbers, radiance"));
    }

    void addGradient(std::vector<InspectedValue>& v, const StratumGradient& gradient) const {
        v.push_back(fromImage("delta, measured", "gradient_sample", {gradient.measured.x}));
        v.push_back(fromImage("Delta, measured", "gradient_sample_max", {gradient.measured.y}));
        v.push_back(line("luminance of the stratum", {gradient.mean},
                         "mean of the raw signal over its pixels, radiance"));
        v.push_back(line("variance of the stratum", {gradient.variance},
                         "of the raw luminance over its pixels, radiance squared"));
        if (f_.plan.gradientIterations > 0) {
            v.push_back(fromImage("delta, reconstructed", "gradient", {gradient.reconstructed.x}));
            v.push_back(
                fromImage("Delta, reconstructed", "gradient_max", {gradient.reconstructed.y}));
        }
        v.push_back(fromImage("lambda of the stratum", "lambda_strata", {gradient.lambda}));
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
                          .groups = {},
                          .story = storyOf(facts)};
    inspection.groups = {lines.surface(), lines.rawSignal()};
    if (facts.plan.carrySamples)
        inspection.groups.push_back(lines.gradientSample());
    if (facts.plan.accumulate && facts.isSurface())
        inspection.groups.push_back(lines.history());
    inspection.groups.push_back(lines.filter());
    return inspection;
}

} // namespace afterglow
