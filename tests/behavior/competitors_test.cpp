// SPDX-License-Identifier: MIT
// The competing filters against A-SVGF and SVGF: what they gain, what they cost, what they cannot
// do. Bounds are around measured values, with their causes.

#include "app/measure/response.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/procedural.h"
#include "tests/behavior/comparisons.h"
#include "tests/support/gl_fixture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{96, 54};
constexpr glm::ivec2 kOddSize{61, 37};
constexpr int kSettle = 40; // frames before the event
constexpr int kWatch = 30;  // frames from the event on

/// The same raw frames for every filter: gradient samples are merged whether they are used or not.
/// Histories are counted as history confidence counts them.
Settings onMergedFrames(Filter filter, Signal signal = Signal::Both) {
    Settings settings = settingsOf(filter, signal);
    settings.denoiser.alwaysCarrySamples = 1;
    settings.denoiser.temporal.historyLaw = gpu::kHistoryEffective;
    return settings;
}

/// Two filters side by side while the key light blinks and the camera moves.
void checkEqualInMotion(const Settings& left, const Settings& right) {
    Sequence a(makeProceduralScene("cornell"), kOddSize, left);
    Sequence b(makeProceduralScene("cornell"), kOddSize, right);
    for (int i = 0; i < 8; ++i) {
        CAPTURE(i);
        for (Sequence* sequence : {&a, &b}) {
            sequence->light("key").on = i != 3 && i != 4;
            sequence->camera.position.x += 0.01f;
            sequence->next();
        }
        checkEqualOutputs(a, b);
    }
}

/// What happens to cornell's key light.
struct Event {
    std::string name;
    bool alone;     ///< the other lights are off, and no surroundings
    float from, to; ///< its power
};
const Event kOffAlone{"off, alone", true, 1.0f, 0.0f};
const Event kOff{"off, among others", false, 1.0f, 0.0f};
const Event kOn{"on, among others", false, 0.0f, 1.0f};
const Event kDimmed{"dimmed by half, among others", false, 1.0f, 0.5f};

void setKey(Sequence& sequence, float power) {
    sequence.light("key").on = power > 0.0f;
    sequence.light("key").power = power;
}

Sequence begun(Filter filter, const Event& event, float power) {
    Sequence sequence(makeProceduralScene("cornell"), kSize,
                      onMergedFrames(filter, event.alone ? Signal::Shadows : Signal::Both));
    if (event.alone)
        sequence.allLightsOffBut("key");
    setKey(sequence, power);
    return sequence;
}

/// Between the filter's own settled values, as in lag_test.cpp.
ResponseSummary respond(Filter filter, const Event& event) {
    const Image<glm::vec4> from = begun(filter, event, event.from).reference(128);
    const Image<glm::vec4> to = begun(filter, event, event.to).reference(128);
    const auto change = PictureChange::between(from, to);
    REQUIRE(change);
    Sequence sequence = begun(filter, event, event.from);
    std::vector<double> before, after;
    for (int i = 0; i < kSettle + kWatch; ++i) {
        if (i == kSettle)
            setKey(sequence, event.to);
        sequence.next();
        (i < kSettle ? before : after).push_back(change->response(sequence.signal()));
    }
    const auto own = betweenOwnValues(after, settledValue(before, 10), settledValue(after, 10));
    REQUIRE(own);
    const ResponseSummary summary = summarize(*own);
    MESSAGE(std::string(nameOf(filter)), ", ", event.name, ": t90 ", summary.t90.value_or(-1),
            ", ghost frames ", summary.ghostFrames);
    REQUIRE(summary.t90);
    return summary;
}

Settled settle(Filter filter, std::string_view scene, glm::ivec2 size, const Image<float>& truth) {
    Sequence sequence(makeProceduralScene(scene), size, onMergedFrames(filter));
    sequence.run(kSettle);
    return settledOf(sequence, truth);
}

Image<float> truthOf(std::string_view scene, glm::ivec2 size, int samples) {
    Sequence sequence(makeProceduralScene(scene), size, settingsOf(Filter::None));
    return luminanceOf(sequence.reference(samples));
}

} // namespace

TEST_CASE("where nothing changes, history confidence is SVGF, bit for bit") {
    const GlCheck noGlMessages;
    for (const char* scene : {"cornell", "hall"}) {
        CAPTURE(scene);
        Sequence confident(makeProceduralScene(scene), kOddSize, settingsOf(Filter::Confidence));
        Sequence plain(makeProceduralScene(scene), kOddSize, onMergedFrames(Filter::Svgf));
        for (int i = 0; i < 10; ++i) {
            CAPTURE(i);
            confident.next();
            plain.next();
            checkEqualOutputs(confident, plain);
        }
    }
}

TEST_CASE(
    "history confidence is A-SVGF with six other settings, and SVGF with lambda forced to 0") {
    const GlCheck noGlMessages;
    Settings asvgf = settingsOf(Filter::Asvgf);
    asvgf.denoiser.temporal.lambdaUse = gpu::kLambdaCuts;
    asvgf.denoiser.gradient.magnitude = gpu::kGradientAbsolute;
    asvgf.denoiser.gradientStrides = gpu::kStridesLinear;
    asvgf.denoiser.gradientLuminanceStop = 0;
    asvgf.denoiser.gradientKernel = int(Kernel::B3Spline5x5);
    asvgf.denoiser.temporal.historyLaw = gpu::kHistoryEffective;
    checkEqualInMotion(settingsOf(Filter::Confidence), asvgf);

    Settings certain = settingsOf(Filter::Confidence);
    certain.denoiser.gradient.forceLambda = 0.0f;
    checkEqualInMotion(certain, onMergedFrames(Filter::Svgf));
}

TEST_CASE("each of the switches changes the picture of A-SVGF when one light replaces another") {
    const GlCheck noGlMessages;
    const auto after = [](const Settings& settings) {
        Sequence sequence(makeProceduralScene("cornell"), kOddSize, settings);
        sequence.light("fill").on = false;
        sequence.run(4);
        sequence.light("key").on = false; // some pixels darken and some brighten
        sequence.light("fill").on = true;
        sequence.next();
        return sequence.signal();
    };
    const Image<glm::vec4> plain = after(settingsOf(Filter::Asvgf));
    for (const auto& [key, value] : {std::pair("lambdaUse", "confidence"),
                                     {"gradientMagnitude", "absolute"},
                                     {"gradientStrides", "linear"},
                                     {"gradientLuminanceStop", "off"}}) {
        CAPTURE(key);
        Settings settings = settingsOf(Filter::Asvgf);
        setField(settings, key, value);
        CHECK(differingPixels(after(settings), plain) > 61 * 37 / 3);
    }
}

TEST_CASE(
    "after the only light goes out, clamp and percentile are dark at once, confidence is not") {
    const GlCheck noGlMessages;
    // Raw frames are black: no deviation to clamp to, no range to be in.
    CHECK(respond(Filter::Clamp, kOffAlone).ghostFrames < 0.05);
    CHECK(respond(Filter::Percentile, kOffAlone).ghostFrames < 0.05);
    // N falls from the 9 frames of alpha = 0.2 to 0.9, so the first frame after has the weight
    // 1 / 1.9, and N grows again: 0.47 + 0.47 * 0.65 + ... = 1.8 frames' worth of old light.
    const ResponseSummary confidence = respond(Filter::Confidence, kOffAlone);
    CHECK(*confidence.t90 >= 4);
    CHECK(*confidence.t90 <= 7);
    CHECK(confidence.ghostFrames == doctest::Approx(1.8).epsilon(0.15));
    CHECK(respond(Filter::Asvgf, kOffAlone).ghostFrames < 0.05);
}

TEST_CASE(
    "among other lights clamp and percentile lag less than SVGF, confidence at most as much") {
    const GlCheck noGlMessages;
    for (const Event& event : {kOff, kOn, kDimmed}) {
        const double svgf = respond(Filter::Svgf, event).ghostFrames; // 4 of alpha = 0.2, and blur
        CHECK(svgf > 3.3);
        CHECK(svgf < 4.6);
        // A deviation of one frame's noise is let through, whatever the change.
        CHECK(respond(Filter::Clamp, event).ghostFrames < 0.65 * svgf);
        // What is within the range of one frame's noise fades as in SVGF.
        CHECK(respond(Filter::Percentile, event).ghostFrames < 0.55 * svgf);
        // A frame takes away half of a history at most. And what still has 4 frames after the cut
        // has a weight of 1/5 = alpha: with a lambda of 0.35, as after the dimming, nothing
        // happens.
        const double confidence = respond(Filter::Confidence, event).ghostFrames;
        CHECK(confidence < 1.01 * svgf);
        if (event.to == 0.0f || event.from == 0.0f)
            CHECK(confidence < 0.8 * svgf);
        CHECK(confidence > respond(Filter::Asvgf, event).ghostFrames);
    }
}

TEST_CASE("where light is even, competitors are as quiet as A-SVGF and almost as true") {
    const GlCheck noGlMessages;
    const Image<float> truth = truthOf("cornell", kSize, 1024);
    const Settled svgf = settle(Filter::Svgf, "cornell", kSize, truth);
    const Settled asvgf = settle(Filter::Asvgf, "cornell", kSize, truth);
    const Settled clamp = settle(Filter::Clamp, "cornell", kSize, truth);
    const Settled percentile = settle(Filter::Percentile, "cornell", kSize, truth);
    const Settled confidence = settle(Filter::Confidence, "cornell", kSize, truth);
    CHECK(confidence.rmse == svgf.rmse); // the same frames, bit for bit
    CHECK(confidence.flicker == asvgf.flicker);
    // A clamp to the mean of 5x5 pixels is one more blur.
    CHECK(clamp.rmse < 1.12 * svgf.rmse);
    CHECK(clamp.flicker < 1.15 * svgf.flicker);
    CHECK(percentile.rmse < 1.19 * svgf.rmse); // what is fed back is not blurred: rarer samples
    CHECK(percentile.flicker < 1.3 * svgf.flicker);
}

TEST_CASE(
    "beside a lamp one frame says little: clamp and percentile fail there, gradients do not") {
    const GlCheck noGlMessages;
    // Hall's lanterns light spots that are a few pixels wide, by samples that are rare and bright.
    // Such a spot is far above its neighborhood and above nearly all of one frame, which looks like
    // a change to whoever has no more than that. A gradient compares a sample with itself.
    const Image<float> truth = truthOf("hall", kOddSize, 512);
    const double svgf = settle(Filter::Svgf, "hall", kOddSize, truth).rmse;
    CHECK(settle(Filter::Asvgf, "hall", kOddSize, truth).rmse == svgf);
    CHECK(settle(Filter::Confidence, "hall", kOddSize, truth).rmse == svgf);
    CHECK(settle(Filter::Clamp, "hall", kOddSize, truth).rmse > 1.3 * svgf);
    CHECK(settle(Filter::Percentile, "hall", kOddSize, truth).rmse > 1.3 * svgf);
}
