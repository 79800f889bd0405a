// What the inspector says of a pixel, against the images that it speaks of.

#include "app/workbench/inspection.h"
#include "app/workbench/pixel_facts.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

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

constexpr glm::ivec2 kSize{61, 37};

const InspectedValue* find(const Inspection& inspection, std::string_view group,
                           std::string_view name) {
    for (const InspectedGroup& g : inspection.groups)
        if (g.title == group)
            for (const InspectedValue& value : g.values)
                if (value.name == name)
                    return &value;
    return nullptr;
}

bool hasGroup(const Inspection& inspection, std::string_view title) {
    return std::ranges::any_of(inspection.groups,
                               [&](const InspectedGroup& g) { return g.title == title; });
}

bool tells(const Inspection& inspection, std::string_view words) {
    return std::ranges::any_of(inspection.story, [&](const std::string& sentence) {
        return sentence.find(words) != std::string::npos;
    });
}

std::string storyText(const Inspection& inspection) {
    std::string text;
    for (const std::string& sentence : inspection.story)
        text += sentence + "\n";
    return text;
}

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

Settings withSamples(Filter filter, SamplePlacement placement) {
    Settings settings = settingsOf(filter);
    settings.lighting.gradientSamples = int(placement);
    return settings;
}

/// Frames of a scene in which all moves: its bodies, the camera, and the light goes out.
struct Bench {
    explicit Bench(std::string_view scene, glm::ivec2 size = kSize)
        : renderer(testShaders(), glInfo(testContext())) {
        renderer.setScene(makeProceduralScene(scene));
        renderer.resize(size);
        camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
        lights.resize(renderer.scene().lights.size());
    }
    /// With the camera moved to its right by so many metres.
    void render(std::span<const FilterRun> runs, float right = 0.0f) {
        camera.position += camera.orientation * glm::vec3(right, 0.0f, 0.0f);
        renderer.render({.camera = camera,
                         .seconds = double(frame) * secondsPerFrame,
                         .frame = frame,
                         .seed = 3,
                         .lights = lights},
                        runs);
        ++frame;
    }
    void render(const Settings& settings, float right = 0.0f) {
        const FilterRun run{0, settings};
        render({&run, 1}, right);
    }

    Renderer renderer;
    Camera camera;
    std::vector<LightState> lights;
    double secondsPerFrame = 1.0 / 15.0;
    std::uint32_t frame = 0;
};

/// Every so many pixels in x and in y.
std::vector<glm::ivec2> pixelsOf(glm::ivec2 size, int stride) {
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < size.y; y += stride)
        for (int x = 0; x < size.x; x += stride)
            pixels.emplace_back(x, y);
    return pixels;
}

/// The four digits that are shown say what the number is.
void checkText(const InspectedValue& value) {
    std::istringstream text(value.value);
    for (const double number : value.numbers) {
        double shown = NAN;
        text >> shown;
        CHECK(std::abs(shown - number) <= 5.1e-4 * std::abs(number));
    }
}

int checkAgainstImages(const Renderer& renderer, const FilterRun& run) {
    std::map<std::string_view, Image<glm::vec4>> images;
    for (const Line& line : kLines)
        images[line.aov] = readAov(renderer, aovByName(line.aov), run.state);
    int compared = 0;
    for (const glm::ivec2 p : pixelsOf(renderer.size(), 5)) {
        CAPTURE(p.x);
        CAPTURE(p.y);
        const Inspection inspection = inspect(renderer, run.state, run.settings, p);
        const bool isSurface = images["instance"](p).x > 0.0f;
        for (const Line& line : kLines) {
            CAPTURE(line.aov);
            const AovInfo& aov = aovByName(line.aov);
            const InspectedValue* shown = find(inspection, line.group, line.name);
            const bool ofSurface = line.group == "surface" && line.name != "instance";
            const bool expected = isMadeBy(aov, run.settings.filter, run.settings.denoiser) &&
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
            Bench bench("moving");
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
                CHECK(checkAgainstImages(bench.renderer, run) > 600); // 104 pixels, 6 lines or more
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
        Bench bench(moving ? "moving" : "rooms");
        const Settings settings = settingsOf(filter);
        for (int i = 0; i < 4; ++i) {
            bench.lights[0].power = i == 3 ? 0.2f : 1.0f;
            bench.render(settings, moving ? 0.4f : -0.08f);
        }
        for (const glm::ivec2 p : pixelsOf(kSize, 2)) {
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
            if (f.plan.cutHistory) {
                const float c = (1.0f - l) * (1.0f - l);
                n *= c + (1.0f - c) / (n + 1.0f);
                cut += l > 0.1f;
                l = 0.0f;
            }
            if (f.lambdaFrom)
                CHECK(bench.renderer.targets().filters[0].lambda.readAt<float>(*f.lambdaFrom) ==
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

TEST_CASE("the story names the reason for which a history was lost, and the fate of a sample") {
    const GlCheck noGlMessages;
    const std::map<int, std::string_view> reasons{
        {gpu::kHistoryKept, "The history is worth"},
        {gpu::kHistoryNone, "There is no history: there was no frame before."},
        {gpu::kHistoryOffScreen, "lost: the surface was outside the picture."},
        {gpu::kHistoryInstance, "lost: another instance was seen there."},
        {gpu::kHistoryDepth, "lost: the same instance was seen there, at another depth."},
        {gpu::kHistoryNormal, "lost: the surface seen there faced another way."}};
    const std::map<std::uint32_t, std::string_view> fates{
        {gpu::kFateNone, "There was no frame before, so no stratum has a gradient sample."},
        {gpu::kFateCarried, "offered was carried to stratum ("},
        {gpu::kFateBackground, "offered was background."},
        {gpu::kFateWasSample, "offered was a gradient sample itself"},
        {gpu::kFateOffScreen, "offered was off screen."},
        {gpu::kFateInstance, "offered landed where another instance is seen."},
        {gpu::kFateDepth, "offered landed where the same instance is seen, at another depth."},
        {gpu::kFateLostRace, "offered lost the race to another sample that landed in stratum ("}};
    std::map<int, int> seenReasons;
    std::map<std::uint32_t, int> seenFates;
    Settings settings = settingsOf(Filter::Asvgf);
    settings.denoiser.temporal.normalTolerance = 0.99f; // that of a sphere turns within a pixel
    for (const auto& [scene, step] :
         {std::pair("moving", 0.8f), std::pair("rooms", -0.3f), std::pair("hall", 0.5f)}) {
        CAPTURE(scene);
        Bench bench(scene);
        bench.secondsPerFrame = 0.2;
        for (const float right : {0.0f, 0.0f, step}) {
            bench.render(settings, right);
            if (bench.frame == 2)
                continue;
            const auto control = bench.renderer.targets().filters[0].control.read<glm::vec4>();
            const auto samples = bench.renderer.targets().samples.read<glm::uvec4>();
            const auto seen = bench.renderer.targets().visibility.current().read<glm::uvec4>();
            std::map<int, int> told;
            for (const glm::ivec2 p : pixelsOf(kSize, 1)) {
                const int reason = int(control(p).w);
                const glm::uvec4 sample = samples(p / 3);
                // Reading pixels one by one takes long: those that are like others may go untold.
                const bool lacksSample = sample.y == 0 && ++told[100 + int(sample.w)] <= 20;
                if (!lacksSample && ++told[reason] > 20)
                    continue;
                const Inspection inspection = inspect(bench.renderer, 0, settings, p);
                CAPTURE(p.x);
                CAPTURE(p.y);
                CAPTURE(storyText(inspection));
                if (seen(p).x == 0) {
                    CHECK(tells(inspection, "There is no surface here"));
                    CHECK_FALSE(hasGroup(inspection, "history"));
                    CHECK_FALSE(tells(inspection, "The history"));
                } else {
                    ++seenReasons[reason];
                    for (const auto& [code, words] : reasons)
                        CHECK(tells(inspection, words) == (code == reason));
                    CHECK(tells(inspection, "the newest sample counts alone") ==
                          (reason != gpu::kHistoryKept));
                }
                for (const auto& [code, words] : fates)
                    CHECK(tells(inspection, words) == (sample.y == 0 && code == sample.w));
                seenFates[sample.w] += sample.y == 0;
            }
        }
    }
    for (const auto& [code, words] : reasons) {
        CAPTURE(code);
        CHECK(seenReasons[code] > 0);
    }
    for (const auto& [code, words] : fates) {
        CAPTURE(code);
        CHECK(seenFates[code] > 0);
    }
}

TEST_CASE("a gradient sample is followed from its pixel of the frame before to where it landed") {
    const GlCheck noGlMessages;
    for (const auto placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        CAPTURE(int(placement));
        const bool merged = placement == SamplePlacement::Merged;
        const Settings settings = withSamples(Filter::Asvgf, placement);
        Bench bench("moving");
        bench.render(settings);
        bench.render(settings);
        const auto rawBefore = bench.renderer.targets().raw.current().read<glm::vec4>();
        const auto seedsBefore = bench.renderer.targets().seeds.current().read<std::uint32_t>();
        bench.lights[0].power = 0.5f;
        bench.render(settings, 0.3f);
        const auto raw = bench.renderer.targets().raw.current().read<glm::vec4>();
        int followed = 0, moved = 0;
        for (const glm::ivec2 p : pixelsOf(kSize, 1)) {
            if (p.x % 3 != 1 || p.y % 3 != 1)
                continue;
            const PixelFacts facts = pixelFacts(bench.renderer, 0, settings, p);
            if (!facts.sample)
                continue;
            const CarriedSample& sample = *facts.sample;
            REQUIRE(sample.landing / 3 == p / 3);
            CHECK(sample.before == rawBefore(sample.source).a);
            REQUIRE(sample.now);
            // Half the light, the same random numbers; surroundings stay as they are.
            CHECK(*sample.now <= sample.before + 1e-6f);
            const Inspection there = inspect(bench.renderer, 0, settings, sample.landing);
            CAPTURE(storyText(there));
            CHECK(tells(there, "came from pixel (" + std::to_string(sample.source.x) + ", " +
                                   std::to_string(sample.source.y) + ") of the frame before"));
            CHECK(tells(there, "This pixel is that sample") == merged);
            CHECK(tells(there, "shaded beside the picture") == !merged);
            CHECK(tells(there, "is at the same place") == (sample.source == sample.landing));
            moved += sample.source != sample.landing;
            if (merged) {
                CHECK(*sample.now == raw(sample.landing).a);
                const std::uint32_t seed = seedsBefore(sample.source);
                CHECK(find(there, "raw signal", "seed")->numbers ==
                      std::vector{double(seed & 127), double(seed >> 7 & 127), double(seed >> 14)});
                CHECK(find(there, "raw signal", "seed")->value.ends_with(" of frame 1, again"));
            } else {
                CHECK(find(there, "raw signal", "seed")->numbers ==
                      std::vector{double(sample.landing.x), double(sample.landing.y), 2.0});
            }
            const double delta = find(there, "gradient sample", "delta, measured")->numbers[0];
            CHECK(delta == double(*sample.now - sample.before));
            ++followed;
        }
        CHECK(followed > 60); // of 21 x 13
        CHECK(moved > 40);
    }
}

TEST_CASE(
    "the story tells what a light that goes out does to the gradient, and what darkness does") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("cornell"), kSize,
                      settingsOf(Filter::Asvgf, Signal::Shadows));
    sequence.allLightsOffBut("key");
    sequence.run(3);
    int told[4] = {};
    const auto look = [&](int which, auto expect) {
        for (const glm::ivec2 p : pixelsOf(kSize, 3)) {
            const PixelFacts facts = pixelFacts(sequence.renderer(), 0, sequence.settings, p);
            if (!facts.sample || !facts.isSurface())
                continue;
            const Inspection inspection = inspect(sequence.renderer(), 0, sequence.settings, p);
            CAPTURE(storyText(inspection));
            told[which] += expect(facts, inspection);
        }
    };
    look(0, [](const PixelFacts& facts, const Inspection& inspection) {
        const bool lit = facts.sample->before > 0.0f;
        CHECK(tells(inspection, lit ? "both times: nothing changed." : "It saw no light"));
        CHECK(tells(inspection, facts.gradient->reconstructed.y > 1e-4f
                                    ? "= 0, both filtered over the strata around."
                                    : "is not above its floor of 0.0001."));
        return lit;
    });
    sequence.light("key").on = false;
    sequence.next();
    look(1, [](const PixelFacts& facts, const Inspection& inspection) {
        const bool lit = facts.sample->before > 0.0f;
        if (lit) {
            CHECK(tells(inspection, "It saw 0 where it had seen "));
            CHECK(tells(inspection, ", 100 % of Delta."));
            CHECK(tells(inspection, " = 1, both filtered over the strata around."));
            CHECK(tells(inspection, "lambda here is 1, the largest of the 3x3 strata around"));
        }
        return lit;
    });
    sequence.next();
    look(2, [](const PixelFacts&, const Inspection& inspection) {
        CHECK(tells(inspection, "It saw no light, neither now nor then."));
        CHECK(tells(inspection, "lambda of this stratum is 0 because Delta, 0 filtered over the "
                                "strata around, is not above its floor of 0.0001."));
        return true;
    });
    sequence.settings.denoiser.gradient.forceLambda = 0.25f;
    sequence.next();
    look(3, [](const PixelFacts& facts, const Inspection& inspection) {
        CHECK(tells(inspection, "lambda of this stratum is set to 0.25 by hand"));
        CHECK(tells(inspection, "alpha = (1 - lambda) max(least, 1 / (N + 1)) + lambda = (1 - "
                                "0.25) max(0.2, 1 / ("));
        return facts.lambda == 0.25f;
    });
    for (const int count : told)
        CHECK(count > 50);
}

TEST_CASE("every filter explains its alpha in its own way") {
    const GlCheck noGlMessages;
    Bench bench("tiny");
    std::vector<FilterRun> runs{{0, settingsOf(Filter::Confidence)},
                                {1, settingsOf(Filter::Percentile)},
                                {2, settingsOf(Filter::Clamp)},
                                {3, settingsOf(Filter::None)}};
    for (int i = 0; i < 6; ++i) {
        bench.lights[0].power = i == 5 ? 0.1f : 1.0f;
        bench.render(runs);
    }
    int cuts = 0, outside = 0, clamped = 0, looked = 0;
    for (const glm::ivec2 p : pixelsOf(kSize, 4)) {
        if (!pixelFacts(bench.renderer, 0, runs[0].settings, p).isSurface())
            continue;
        ++looked;
        const auto at = [&](std::size_t i) {
            return inspect(bench.renderer, i, runs[i].settings, p);
        };
        const Inspection confidence = at(0), percentile = at(1), clamp = at(2), none = at(3);
        CAPTURE(storyText(confidence) + storyText(percentile) + storyText(clamp));
        const auto number = [](const Inspection& inspection, std::string_view name) {
            return find(inspection, "history", name)->numbers[0];
        };
        CHECK(tells(confidence, "alpha = max(least, 1 / (N + 1)) = max(0.2, 1 / ("));
        CHECK(tells(confidence, "lambda cuts the history from ") ==
              (number(confidence, "lambda") > 0.0));
        cuts += tells(confidence, "lambda cuts the history from ");

        CHECK(tells(percentile, "is within ") == (number(percentile, "lambda") == 0.0));
        CHECK(tells(percentile, " outside of ") == (number(percentile, "lambda") > 0.0));
        outside += tells(percentile, " outside of ");

        CHECK(tells(clamp, "the clamp did nothing.") != tells(clamp, "The clamp brought"));
        clamped += tells(clamp, "The clamp brought");

        CHECK(none.story == std::vector<std::string>{"This filter keeps no history: what is seen "
                                                     "is the newest sample alone."});
        CHECK_FALSE(hasGroup(none, "history"));
        CHECK_FALSE(hasGroup(none, "gradient sample"));
        CHECK(hasGroup(confidence, "gradient sample"));
        CHECK_FALSE(hasGroup(percentile, "gradient sample"));
        CHECK(find(percentile, "history", "raw range"));
        CHECK_FALSE(find(clamp, "history", "lambda"));
    }
    CHECK(looked > 60);
    CHECK(cuts > looked / 2);
    CHECK(outside > 5);
    CHECK(clamped > looked / 2);
}

TEST_CASE("an instance has its number, its node's name and its material's") {
    const GlCheck noGlMessages;
    Bench bench("moving");
    const Settings settings = settingsOf(Filter::Svgf);
    bench.render(settings);
    const auto seen = bench.renderer.targets().visibility.current().read<glm::uvec4>();
    std::set<std::string> names;
    for (const glm::ivec2 p : pixelsOf(kSize, 2)) {
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
        Bench bench("tiny", {1, 1});
        const Settings settings = withSamples(Filter::Asvgf, placement);
        CHECK_THROWS_AS(inspect(bench.renderer, 0, settings, {0, 0}), std::logic_error);
        for (int i = 0; i < 3; ++i) {
            bench.render(settings);
            const Inspection inspection = inspect(bench.renderer, 0, settings, {0, 0});
            CHECK(inspection.stratum == glm::ivec2(0));
            CHECK(find(inspection, "history", "alpha")->numbers[0] ==
                  double(bench.renderer.targets().filters[0].control.readAt<glm::vec4>({0, 0}).y));
            CHECK(tells(inspection, "There is no history") == (i == 0));
        }
        for (const glm::ivec2 outside : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0)})
            CHECK_THROWS_AS(inspect(bench.renderer, 0, settings, outside), std::logic_error);
        CHECK_THROWS_AS(inspect(bench.renderer, 1, settings, {0, 0}), std::logic_error);
        CHECK_THROWS_AS(inspect(bench.renderer, kFilterStates, settings, {0, 0}), std::logic_error);
    }
}
