// What the inspector says of a pixel, against the images that it speaks of.

#include "app/workbench/pixel_facts.h"
#include "inspected_scene.h"
#include "renderer/pipeline/aov.h"

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

int checkAgainstImages(Renderer& renderer, const FrameSettings& settings,
                       const FilterRun& run) {
    std::map<std::string_view, Image<glm::vec4>> images;
    for (const Line& line : kLines)
        if (isMadeBy(aovByName(line.aov), run.settings))
            images[line.aov] = readAov(renderer, aovByName(line.aov), run.state);
    int compared = 0;
    for (const glm::ivec2 p : pixelsOf(renderer.size(), 5)) {
        CAPTURE(p.x);
        CAPTURE(p.y);
        const Inspection inspection = inspect(renderer, run.state, settings, p);
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

TEST_CASE("the inspector shows the numbers that the images hold, in every filter") {
    const GlCheck noGlMessages;
    for (const auto placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        CAPTURE(int(placement));
        const std::array batches{
            std::array{Filter::Asvgf, Filter::Confidence, Filter::Percentile, Filter::Clamp},
            std::array{Filter::Svgf, Filter::Fixed, Filter::None, Filter::Asvgf}};
        for (const auto& batch : batches) {
            InspectedScene bench("moving");
            bench.frameSettings.lighting.gradientSamples = int(placement);
            std::vector<FilterRun> runs;
            for (std::size_t i = 0; i < batch.size(); ++i)
                runs.push_back({3 - i, withSamples(batch[i], placement)});
            if (batch.back() == Filter::Asvgf) { // variations on a row of the plan
                runs.back().settings.denoiser.feedbackIteration = 0;
                runs.back().settings.denoiser.gradientIterations = 0;
            }
            for (const bool on : {true, true, true, false}) {
                bench.lights[0].on = on;
                bench.render(runs, 0.1f);
            }
            for (const FilterRun& run : runs) {
                CAPTURE(nameOf(run.settings.filter));
                CHECK(checkAgainstImages(bench.renderer, bench.frameSettings, run) >
                      600); // 104 pixels, 6 lines or more
            }
        }
    }
}

TEST_CASE("what the inspector finds again is what the temporal pass had fetched") {
    const GlCheck noGlMessages;
    int lost = 0, kept = 0, cut = 0, outside = 0;
    for (const Filter filter :
         {Filter::Svgf, Filter::Asvgf, Filter::Confidence, Filter::Percentile}) {
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
            const PixelFacts f = pixelFacts(bench.renderer, 0, settings, p);
            if (!f.isSurface())
                continue;
            REQUIRE(f.fetched);
            if (f.reason != gpu::kHistoryKept) {
                const auto heaviest =
                    std::ranges::max_element(f.fetched->taps, {}, &HistoryTap::weight);
                CHECK(heaviest->reason == f.reason);
                CHECK(f.fetched->length == 0.0f);
                CHECK(f.alpha == 1.0f);
                ++lost;
                continue;
            }
            // alpha and the length follow from what was fetched, by the equations of pipeline.md.
            ++kept;
            float n = f.fetched->length, l = f.lambda;
            REQUIRE(n > 0.0f);
            if (f.plan.cutsHistory()) {
                const float c = (1.0f - l) * (1.0f - l);
                n *= c + (1.0f - c) / (n + 1.0f);
                cut += l > 0.1f;
                l = 0.0f;
            }
            if (f.lambdaFrom)
                CHECK(
                    imageOf(bench.renderer.targets(), svgf::kLambda).readAt<float>(*f.lambdaFrom) ==
                    f.lambda);
            if (f.range) {
                const float off = std::max(
                    {0.0f, f.range->x - f.historyLuminance, f.historyLuminance - f.range->y});
                const float expected = std::min(1.0f, settings.denoiser.temporal.percentileSlope *
                                                          off / (f.range->y - f.range->x + 1e-4f));
                CHECK(std::abs(f.lambda - expected) < 1e-4f); // sums in another order
                outside += f.lambda > 0.1f;
            }
            const float alpha = (1.0f - l) * std::max(0.2f, 1.0f / (n + 1.0f)) + l;
            CHECK(std::abs(f.alpha - alpha) < 2e-6f); // rounding
        }
    }
    CHECK(lost > 30);
    CHECK(kept > 800);
    CHECK(cut > 50);
    CHECK(outside > 50);
}

TEST_CASE("an instance has its number, its node's name and its material's") {
    const GlCheck noGlMessages;
    InspectedScene bench("moving");
    const Settings settings = settingsOf(Filter::Svgf);
    bench.render(settings);
    const auto seen = bench.renderer.targets().surfaces.visibility.read<glm::uvec4>();
    std::set<std::string> names;
    for (const glm::ivec2 p : pixelsOf(kInspectedSize, 2)) {
        const Inspection inspection = inspect(bench.renderer, 0, settings, p);
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
        CHECK_THROWS_AS(inspect(bench.renderer, 0, settings, {0, 0}), std::logic_error);
        for (int i = 0; i < 3; ++i) {
            bench.render(settings);
            const Inspection inspection = inspect(bench.renderer, 0, settings, {0, 0});
            CHECK(inspection.stratum == glm::ivec2(0));
            CHECK(
                find(inspection, "history", "alpha")->numbers[0] ==
                double(
                    imageOf(bench.renderer.targets(), svgf::kControl).readAt<glm::vec4>({0, 0}).y));
            CHECK(tells(inspection, "There is no history") == (i == 0));
        }
        for (const glm::ivec2 outside : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0)})
            CHECK_THROWS_AS(inspect(bench.renderer, 0, settings, outside), std::logic_error);
        CHECK_THROWS_AS(inspect(bench.renderer, 1, settings, {0, 0}), std::logic_error);
        CHECK_THROWS_AS(inspect(bench.renderer, kFilterStates, settings, {0, 0}), std::logic_error);
    }
}
