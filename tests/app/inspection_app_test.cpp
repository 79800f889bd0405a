// SPDX-License-Identifier: MIT
// What the inspector says of a pixel, against the images that it speaks of.

#include "app/workbench/pixel_facts.h"
#include "inspected_scene.h"
#include "renderer/pipeline/aov.h"
#include "tests/stage/spoilt_shaders.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// A line of the inspector and the image that it is of.
struct Line {
    std::string_view group, name, aov;
};
constexpr std::array kLines{
    Line{"surface", "instance", "instance"},
    Line{"surface", "position", "position"},
    Line{"surface", "normal", "normal"},
    Line{"surface", "depth", "depth"},
    Line{"surface", "slope", "slope"},
    Line{"surface", "motion", "motion"},
    Line{"surface", "albedo", "albedo"},
    Line{"surface", "emission", "emission"},
    Line{"raw signal", "raw", "raw"},
    Line{"gradient sample", "offered sample", "fate"},
    Line{"gradient sample", "delta, measured", "gradient_sample"},
    Line{"gradient sample", "Delta, measured", "gradient_sample_max"},
    Line{"gradient sample", "delta, reconstructed", "gradient"},
    Line{"gradient sample", "Delta, reconstructed", "gradient_max"},
    Line{"gradient sample", "lambda of the stratum", "lambda_strata"},
    Line{"history", "state", "reason"},
    Line{"history", "luminance", "history_luminance"},
    Line{"history", "lambda", "lambda"},
    Line{"history", "alpha", "alpha"},
    Line{"history", "length", "history"},
    Line{"history", "moments", "moments"},
    Line{"filter", "accumulated", "accumulated"},
    Line{"filter", "variance", "variance"},
    Line{"filter", "filtered", "filtered"},
    Line{"filter", "color", "color"},
};

/// The four digits that are shown say what the number is.
void checkText(const InspectedValue& value) {
    std::istringstream text(value.value);
    for (const double number : value.numbers) {
        double shown = NAN;
        text >> shown;
        CHECK(std::abs(shown - number) <= 5.1e-4 * std::abs(number));
    }
}

int checkAgainstImages(Renderer& renderer, const FilterRun& run) {
    std::map<std::string_view, Image<glm::vec4>> images;
    for (const Line& line : kLines)
        if (isMadeBy(aovByName(line.aov), run.settings))
            images[line.aov] = readAov(renderer, aovByName(line.aov), run.state);
    int compared = 0;
    for (const glm::ivec2 p : pixelsOf(renderer.size(), 1)) {
        CAPTURE(p.x);
        CAPTURE(p.y);
        const Inspection inspection = inspect(renderer, run.state, p);
        const bool isSurface = images["instance"](p).x > 0.0f;
        for (const Line& line : kLines) {
            CAPTURE(line.aov);
            const AovInfo& aov = aovByName(line.aov);
            const InspectedValue* shown = find(inspection, line.group, line.name);
            const bool ofSurface = line.group == "surface" && line.name != "instance";
            const bool expected = isMadeBy(aov, run.settings) &&
                                  (isSurface || !(ofSurface || line.group == "history"));
            REQUIRE((shown != nullptr) == expected);
            if (!shown)
                continue;
            const glm::vec4 held = images[line.aov](aov.perStratum ? p / 3 : p);
            REQUIRE(shown->numbers.size() == aov.channels.size());
            for (std::size_t i = 0; i < shown->numbers.size(); ++i)
                CHECK(shown->numbers[i] == double(held[int(i)]));
            CHECK(shown->note == aov.meaning);
            if (line.aov != "instance" && line.aov != "fate" && line.aov != "reason")
                checkText(*shown);
            ++compared;
        }
    }
    return compared;
}

} // namespace

TEST_CASE("the inspector shows the numbers that the images hold, at every pixel, in every filter") {
    const GlCheck noGlMessages;
    for (const auto placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        CAPTURE(int(placement));
        const std::array batches{
            std::array{Filter::Asvgf, Filter::Confidence, Filter::Percentile, Filter::Clamp},
            std::array{Filter::Svgf, Filter::Counted, Filter::None, Filter::Asvgf}};
        for (const auto& batch : batches) {
            InspectedScene bench("moving", {19, 11});
            bench.frameSettings.lighting.gradientSamples = int(placement);
            std::vector<FilterRun> runs;
            for (std::size_t i = 0; i < batch.size(); ++i)
                runs.push_back({3 - i, withSamples(batch[i], placement)});
            if (batch.back() == Filter::Asvgf) { // variations on a row of the plan
                runs.back().settings.denoiser.feedbackIteration = 1;
                runs.back().settings.denoiser.gradientIterations = 0;
            }
            for (const bool on : {true, true, true, false}) {
                bench.lights[0].on = on;
                bench.render(runs, 0.1f);
            }
            for (const FilterRun& run : runs) {
                CAPTURE(nameOf(run.settings.filter));
                CHECK(checkAgainstImages(bench.renderer, run) >
                      1200); // 209 pixels, 6 lines or more
            }
        }
    }
}

TEST_CASE("the numbers between what was fetched and the result follow from one another") {
    const GlCheck noGlMessages;
    int rejected = 0, kept = 0, cut = 0, outside = 0, clamped = 0;
    for (const Filter filter :
         {Filter::Svgf, Filter::Asvgf, Filter::Confidence, Filter::Percentile, Filter::Clamp}) {
        CAPTURE(nameOf(filter));
        const bool moving = filter == Filter::Svgf || filter == Filter::Confidence;
        InspectedScene bench(moving ? "moving" : "rooms");
        const Settings settings = settingsOf(filter);
        for (int i = 0; i < 4; ++i) {
            bench.lights[0].power = i == 3 ? 0.2f : 1.0f;
            bench.render(settings, moving ? 0.4f : -0.08f);
        }
        for (const glm::ivec2 p : pixelsOf(kInspectedSize, 2)) {
            CAPTURE(p.x);
            CAPTURE(p.y);
            const PixelFacts f = pixelFacts(bench.renderer, 0, p);
            if (!f.isSurface())
                continue;
            const gpu::TemporalFindings& found = *f.temporal;
            const gpu::TemporalParams& params = f.plan.temporal;
            const float alpha = found.control.y;
            CHECK(found.texel == p);
            REQUIRE(f.hasTaps());
            float weights = 0.0f, valid = 0.0f;
            for (const gpu::HistoryTap& tap : found.taps) {
                weights += tap.weight;
                valid += tap.reason == gpu::kHistoryKept ? tap.weight : 0.0f;
                if (tap.reason == gpu::kHistoryInstance)
                    CHECK(tap.instance != f.instance);
                if (tap.reason == gpu::kHistoryDepth)
                    CHECK(std::abs(tap.depth - found.depth) > found.depthTolerance);
                if (tap.reason == gpu::kHistoryNormal)
                    CHECK(tap.cosine < params.normalTolerance);
            }
            CHECK(std::abs(weights - 1.0f) < 1e-6f);
            CHECK(std::abs(valid - found.validWeight) < 1e-6f);
            if (!f.hasHistory()) {
                const auto heaviest =
                    std::ranges::max_element(found.taps, {}, &gpu::HistoryTap::weight);
                CHECK(heaviest->reason == f.reason());
                CHECK(f.reason() != gpu::kHistoryKept);
                CHECK(alpha == 1.0f);
                ++rejected;
                continue;
            }
            // By the equations of pipeline.md.
            ++kept;
            float n = found.fetchedSamples, l = found.control.x;
            if (f.plan.cutsHistory()) {
                const float c = (1.0f - l) * (1.0f - l);
                n *= c + (1.0f - c) / (n + 1.0f);
                cut += l > 0.1f;
                l = 0.0f;
            }
            if (f.plan.cutsByPower())
                n *= std::pow(1.0f - l, 10.0f);
            CHECK(std::abs(found.usedSamples - n) < 1e-5f * n + 1e-6f); // rounding, as all below
            if (f.plan.useLambda)
                CHECK(imageOf(bench.renderer.targets(), svgf::kLambda)
                          .readAt<float>(found.lambdaStratum) == found.control.x);
            if (f.plan.usePercentiles) {
                const float luminance = found.accumulated.a;
                const float off =
                    std::max({0.0f, found.range.x - luminance, luminance - found.range.y});
                CHECK(found.outside == off);
                CHECK(std::abs(l - std::min(1.0f, params.percentileSlope * off /
                                                      (found.range.y - found.range.x + 1e-4f))) <
                      2e-6f);
                outside += l > 0.1f;
            }
            CHECK(std::abs(found.leastWeight - 1.0f / (n + 1.0f)) < 2e-6f);
            CHECK(std::abs(alpha - ((1.0f - l) * std::max(0.2f, found.leastWeight) + l)) < 2e-6f);
            const glm::vec3 bounded =
                f.plan.clampsHistory()
                    ? glm::clamp(found.fetchedColor, found.clampLow, found.clampHigh)
                    : found.fetchedColor;
            CHECK(found.usedColor == bounded);
            clamped += found.usedColor != found.fetchedColor;
            for (int i = 0; i < 3; ++i)
                CHECK(found.accumulated[i] ==
                      doctest::Approx(glm::mix(double(found.usedColor[i]), f.images.at("raw")[i],
                                               double(alpha)))
                          .epsilon(1e-5));
        }
    }
    CHECK(rejected > 30);
    CHECK(kept > 1000);
    CHECK(cut > 50);
    CHECK(outside > 50);
    CHECK(clamped > 100);
}

TEST_CASE("a mistake in the temporal filter is one in the inspector") {
    const GlCheck noGlMessages;
    using Findings = gpu::TemporalFindings;
    struct Mistake {
        std::size_t state; ///< of the filter in which it shows
        const char *from, *to;
        bool (*shows)(const Findings& healthy, const Findings& spoilt);
    };
    const std::array mistakes{
        Mistake{0, "vec2(p) + moved.xy", "vec2(p) - moved.xy",
                [](const Findings& a, const Findings& b) { return a.position != b.position; }},
        Mistake{0, ">= params.normalTolerance", ">= 2.0",
                [](const Findings& a, const Findings& b) {
                    return a.validWeight > 0.0f && b.validWeight == 0.0f;
                }},
        Mistake{
            1, "(1.0 - l) * (1.0 - l)", "(1.0 - l)",
            [](const Findings& a, const Findings& b) { return a.usedSamples != b.usedSamples; }},
        Mistake{2, "/ float(kTileSize) - 0.5", "/ float(kTileSize)",
                [](const Findings& a, const Findings& b) { return a.range != b.range; }},
        Mistake{3, "params.clampSigmas * sqrt", "sqrt",
                [](const Findings& a, const Findings& b) { return a.clampLow != b.clampLow; }}};
    // The findings of one filter at pixels of the last of some frames, which are those of its
    // images.
    const auto render = [](ShaderLibrary& shaders, std::size_t state) {
        InspectedScene bench("moving", kInspectedSize, shaders);
        std::vector<FilterRun> runs{{0, settingsOf(Filter::Svgf)},
                                    {1, settingsOf(Filter::Confidence)},
                                    {2, settingsOf(Filter::Percentile)},
                                    {3, settingsOf(Filter::Clamp)}};
        runs[3].settings.denoiser.temporal.clampSigmas = 0.5f;
        for (const float power : {1.0f, 1.0f, 1.0f, 0.2f}) {
            bench.lights[0].power = power;
            bench.render(runs, 0.1f);
        }
        const auto control =
            imageOf(bench.renderer.targets(), svgf::kControl, state).read<glm::vec4>();
        std::vector<Findings> all;
        for (const glm::ivec2 p : pixelsOf(kInspectedSize, 3)) {
            all.push_back(*pixelFacts(bench.renderer, state, p, 0, shaders).temporal);
            CHECK(all.back().control == control(p));
        }
        return all;
    };
    SpoiltShaders folder;
    const std::string file = "denoise/temporal.comp";
    for (const Mistake& mistake : mistakes) {
        CAPTURE(mistake.from);
        const std::vector<Findings> healthy = render(testShaders(), mistake.state);
        REQUIRE(folder.spoil(file, mistake.from, mistake.to) == 1);
        ShaderLibrary shaders = folder.library();
        const std::vector<Findings> spoilt = render(shaders, mistake.state);
        folder.mend(file);
        int shown = 0;
        for (std::size_t i = 0; i < healthy.size(); ++i)
            shown += mistake.shows(healthy[i], spoilt[i]);
        CHECK(shown > 50); // of 273
    }
}

TEST_CASE("an instance has its number, its node's name and its material's") {
    const GlCheck noGlMessages;
    InspectedScene bench("moving");
    const Settings settings = settingsOf(Filter::Svgf);
    bench.render(settings);
    const auto seen = bench.renderer.targets().surfaces.visibility.read<glm::uvec4>();
    std::set<std::string> names;
    for (const glm::ivec2 p : pixelsOf(kInspectedSize, 2)) {
        const Inspection inspection = inspect(bench.renderer, 0, p);
        const InspectedValue& instance = *find(inspection, "surface", "instance");
        CHECK(instance.numbers[0] == double(seen(p).x));
        names.insert(instance.value);
        if (seen(p).x > 0)
            CHECK(find(inspection, "surface", "triangle")->numbers[0] == double(seen(p).y));
    }
    CHECK(names.contains("none: background"));
    CHECK(names.contains("1: set (floor)"));
    CHECK(names.contains("2: set (wall)"));
    CHECK(std::ranges::any_of(
        names, [](const std::string& name) { return name.ends_with(": mover (box)"); }));
}

TEST_CASE("the inspector works on a picture of one pixel, and on no pixel outside") {
    const GlCheck noGlMessages;
    for (const auto placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        InspectedScene bench("tiny", {1, 1});
        const Settings settings = withSamples(Filter::Asvgf, placement);
        CHECK_THROWS_AS(inspect(bench.renderer, 0, {0, 0}), std::logic_error);
        for (int i = 0; i < 3; ++i) {
            bench.render(settings);
            const Inspection inspection = inspect(bench.renderer, 0, {0, 0});
            CHECK(inspection.stratum == glm::ivec2(0));
            CHECK(
                find(inspection, "history", "alpha")->numbers[0] ==
                double(
                    imageOf(bench.renderer.targets(), svgf::kControl).readAt<glm::vec4>({0, 0}).y));
            CHECK(tells(inspection, "There is no history") == (i == 0));
        }
        for (const glm::ivec2 outside : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0)})
            CHECK_THROWS_AS(inspect(bench.renderer, 0, outside), std::logic_error);
        CHECK_THROWS_AS(inspect(bench.renderer, 1, {0, 0}), std::logic_error);
        CHECK_THROWS_AS(inspect(bench.renderer, kFilterStates, {0, 0}), std::logic_error);
    }
}
