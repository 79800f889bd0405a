// SPDX-License-Identifier: MIT
// Ghosting and lag as numbers: what the whole program is about.

#include "app/measure/response.h"
#include "renderer/scene/procedural.h"
#include "tests/behavior/comparisons.h"
#include "tests/support/gl_fixture.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{96, 54};
constexpr int kSettle = 40; // frames before the event
constexpr int kWatch = 40;  // frames from the event on

Sequence keyLightAlone(Filter filter, bool on) {
    Sequence sequence(makeProceduralScene("cornell"), kSize, settingsOf(filter, Signal::Shadows));
    sequence.allLightsOffBut("key");
    sequence.light("key").on = on;
    return sequence;
}

/// The response to the key light, the only one, being switched on or off. A spatial filter blurs
/// what has settled too, so 0 and 1 are the filter's own settled responses before the event and at
/// the end.
ResponseSummary respond(Filter filter, bool switchedOn) {
    const Image<glm::vec4> dark = keyLightAlone(filter, false).reference(1);
    const Image<glm::vec4> lit = keyLightAlone(filter, true).reference(256);
    const auto change =
        switchedOn ? PictureChange::between(dark, lit) : PictureChange::between(lit, dark);
    REQUIRE(change);

    Sequence sequence = keyLightAlone(filter, !switchedOn);
    std::vector<double> before, p;
    for (int i = 0; i < kSettle + kWatch; ++i) {
        if (i == kSettle)
            sequence.light("key").on = switchedOn;
        sequence.next();
        (i < kSettle ? before : p).push_back(change->response(sequence.signal()));
    }
    const double start = settledValue(before, 10), end = settledValue(p, 10);
    const auto own = betweenOwnValues(p, start, end);
    REQUIRE(own);
    const ResponseSummary summary = summarize(*own);
    MESSAGE(std::string(nameOf(filter)), switchedOn ? " on" : " off", ": settled from ", start,
            " to ", end, ", t90 ", summary.t90.value_or(-1), ", ghost frames ",
            summary.ghostFrames);
    return summary;
}

Settled settle(Filter filter, const Image<float>& truth) {
    Sequence sequence(makeProceduralScene("cornell"), kSize, settingsOf(filter));
    sequence.run(kSettle);
    return settledOf(sequence, truth);
}

} // namespace

TEST_CASE(
    "after the only light goes out, A-SVGF is dark within a frame; SVGF and fixed alpha are not") {
    const GlCheck noGlMessages;
    const ResponseSummary adaptive = respond(Filter::Asvgf, false);
    REQUIRE(adaptive.t90);
    CHECK(*adaptive.t90 <= 1);
    CHECK(adaptive.ghostFrames <= 1.0);
    // An average with weight 0.2 has taken in 1 - 0.8^11 = 0.914 of a step ten frames after it, and
    // leaves (1 - 0.2) / 0.2 = 4 frames' worth of old light.
    const ResponseSummary fixed = respond(Filter::Fixed, false);
    REQUIRE(fixed.t90);
    CHECK(*fixed.t90 == 10);
    CHECK(fixed.ghostFrames == doctest::Approx(4.0).epsilon(0.02));
    // SVGF fades by the same weight; while it does, its variance stays high, and it blurs the more.
    const ResponseSummary svgf = respond(Filter::Svgf, false);
    REQUIRE(svgf.t90);
    CHECK(*svgf.t90 >= 9);
    CHECK(*svgf.t90 <= 10);
    CHECK(svgf.ghostFrames == doctest::Approx(4.0).epsilon(0.15));
}

TEST_CASE("after the only light comes on from black, A-SVGF is there within a frame; SVGF is not") {
    const GlCheck noGlMessages;
    const ResponseSummary adaptive = respond(Filter::Asvgf, true);
    REQUIRE(adaptive.t90);
    CHECK(*adaptive.t90 <= 1);
    CHECK(adaptive.ghostFrames <= 1.0);
    const ResponseSummary lagging = respond(Filter::Svgf, true);
    REQUIRE(lagging.t90);
    CHECK(*lagging.t90 >= 9);
    CHECK(*lagging.t90 <= 11);
}

TEST_CASE("where nothing changes, A-SVGF is as quiet as SVGF and much quieter than a fixed alpha") {
    const GlCheck noGlMessages;
    Sequence reference(makeProceduralScene("cornell"), kSize, settingsOf(Filter::None));
    const Image<float> truth = luminanceOf(reference.reference(1024));
    const Settled adaptive = settle(Filter::Asvgf, truth), svgf = settle(Filter::Svgf, truth);
    const Settled fixed = settle(Filter::Fixed, truth), raw = settle(Filter::None, truth);
    // One sample in nine is the last frame's again: a little less new information.
    CHECK(adaptive.rmse == doctest::Approx(svgf.rmse).epsilon(0.05));
    CHECK(adaptive.flicker < 1.25 * svgf.flicker);
    CHECK(svgf.flicker < 0.5 * fixed.flicker);
    // Independent frames would give sqrt(alpha / (2 - alpha)) = 1/3 of the deviation of one.
    CHECK(fixed.rmse < 0.4 * raw.rmse);
}
