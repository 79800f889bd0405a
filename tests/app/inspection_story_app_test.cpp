// SPDX-License-Identifier: MIT
// The inspector's sentences: the origin of a sample, the reason where there is none, alpha.

#include "app/workbench/pixel_facts.h"
#include "inspected_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("the story names the reason for which a history was rejected, and the fate of a sample") {
    const GlCheck noGlMessages;
    const std::map<int, std::string_view> reasons{
        {gpu::kHistoryKept, "The history is worth"},
        {gpu::kHistoryNone, "There is no history: there was no frame before."},
        {gpu::kHistoryOffScreen, "rejected: the surface was outside the picture."},
        {gpu::kHistoryInstance, "rejected: another instance was seen there."},
        {gpu::kHistoryDepth, "rejected: the same instance was seen there, at another depth."},
        {gpu::kHistoryNormal, "rejected: the surface seen there faced another way."}};
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
        InspectedScene bench(scene);
        bench.secondsPerFrame = 0.2;
        for (const float right : {0.0f, 0.0f, step}) {
            bench.render(settings, right);
            if (bench.frame == 2)
                continue;
            const auto control =
                imageOf(bench.renderer.targets(), svgf::kControl).read<glm::vec4>();
            const auto samples = bench.renderer.targets().samples.read<glm::uvec4>();
            const auto seen = bench.renderer.targets().surfaces.visibility.read<glm::uvec4>();
            std::map<int, int> told;
            for (const glm::ivec2 p : pixelsOf(kInspectedSize, 1)) {
                const int reason = int(control(p).w);
                const glm::uvec4 sample = samples(p / 3);
                // Reading pixels one by one takes long: those that are like others may go untold.
                const bool lacksSample = sample.y == 0 && ++told[100 + int(sample.w)] <= 20;
                if (!lacksSample && ++told[reason] > 20)
                    continue;
                const Inspection inspection = inspect(bench.renderer, 0, p);
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
        InspectedScene bench("moving");
        bench.render(settings);
        bench.render(settings);
        const auto rawBefore = bench.renderer.targets().signals[0].raw.current().read<glm::vec4>();
        const auto seedsBefore = bench.renderer.targets().seeds.current().read<std::uint32_t>();
        bench.lights[0].power = 0.5f;
        bench.render(settings, 0.3f);
        const auto raw = bench.renderer.targets().signals[0].raw.current().read<glm::vec4>();
        int followed = 0, moved = 0;
        for (const glm::ivec2 p : pixelsOf(kInspectedSize, 1)) {
            if (p.x % 3 != 1 || p.y % 3 != 1)
                continue;
            const PixelFacts facts = pixelFacts(bench.renderer, 0, p);
            if (!facts.sample)
                continue;
            const CarriedSample& sample = *facts.sample;
            REQUIRE(sample.landing / 3 == p / 3);
            REQUIRE(facts.gradient);
            const auto [stratum, before, now, gradient] = *facts.gradient;
            CHECK(stratum == p / 3);
            CHECK(before == rawBefore(sample.source).a);
            // Half the light, the same random numbers; surroundings stay as they are.
            CHECK(now <= before + 1e-6f);
            const Inspection there = inspect(bench.renderer, 0, sample.landing);
            CAPTURE(storyText(there));
            CHECK(tells(there, "came from pixel (" + std::to_string(sample.source.x) + ", " +
                                   std::to_string(sample.source.y) + ") of the frame before"));
            CHECK(tells(there, "This pixel is that sample") == merged);
            CHECK(tells(there, "shaded beside the picture") == !merged);
            CHECK(tells(there, "is at the same place") == (sample.source == sample.landing));
            moved += sample.source != sample.landing;
            if (merged) {
                CHECK(now == raw(sample.landing).a);
                const std::uint32_t seed = seedsBefore(sample.source);
                CHECK(find(there, "raw signal", "seed")->numbers ==
                      std::vector{double(seed & 127), double(seed >> 7 & 127), double(seed >> 14)});
                CHECK(find(there, "raw signal", "seed")->value.ends_with(" of frame 1, again"));
            } else {
                CHECK(find(there, "raw signal", "seed")->numbers ==
                      std::vector{double(sample.landing.x), double(sample.landing.y), 2.0});
            }
            const double delta = find(there, "gradient sample", "delta, measured")->numbers[0];
            CHECK(delta == double(now - before));
            ++followed;
        }
        CHECK(followed > 60); // of 21 x 13
        CHECK(moved > 40);
    }
}

TEST_CASE(
    "the story tells what a light that goes out does to the gradient, and what darkness does") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("cornell"), kInspectedSize,
                      settingsOf(Filter::Asvgf, Signal::Shadows));
    sequence.allLightsOffBut("key");
    sequence.run(3);
    int told[4] = {};
    const auto look = [&](int which, auto expect) {
        for (const glm::ivec2 p : pixelsOf(kInspectedSize, 3)) {
            const PixelFacts facts = pixelFacts(sequence.renderer(), 0, p);
            if (!facts.sample || !facts.isSurface())
                continue;
            const Inspection inspection = inspect(sequence.renderer(), 0, p);
            CAPTURE(storyText(inspection));
            told[which] += expect(facts, inspection);
        }
    };
    look(0, [](const PixelFacts& facts, const Inspection& inspection) {
        const bool lit = facts.gradient->before > 0.0f;
        CHECK(tells(inspection, lit ? "both times: nothing changed." : "It saw no light"));
        CHECK(tells(inspection, facts.image("gradient_max") > 1e-4f
                                    ? "= 0, both filtered over the strata around."
                                    : "is not above its floor of 0.0001."));
        return lit;
    });
    sequence.light("key").on = false;
    sequence.next();
    look(1, [](const PixelFacts& facts, const Inspection& inspection) {
        const bool lit = facts.gradient->before > 0.0f;
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
        return facts.temporal->control.x == 0.25f;
    });
    for (const int count : told)
        CHECK(count > 50);
}

TEST_CASE("every filter explains its alpha in its own way") {
    const GlCheck noGlMessages;
    InspectedScene bench("tiny");
    std::vector<FilterRun> runs{{0, settingsOf(Filter::Confidence)},
                                {1, settingsOf(Filter::Percentile)},
                                {2, settingsOf(Filter::Clamp)},
                                {3, settingsOf(Filter::None)}};
    for (int i = 0; i < 6; ++i) {
        bench.lights[0].power = i == 5 ? 0.1f : 1.0f;
        bench.render(runs);
    }
    int cuts = 0, outside = 0, clamped = 0, looked = 0;
    for (const glm::ivec2 p : pixelsOf(kInspectedSize, 4)) {
        if (!pixelFacts(bench.renderer, 0, p).isSurface())
            continue;
        ++looked;
        const auto at = [&](std::size_t i) { return inspect(bench.renderer, i, p); };
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
