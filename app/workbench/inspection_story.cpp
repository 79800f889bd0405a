#include "app/workbench/inspection_story.h"

#include "app/workbench/inspection.h"
#include "renderer/image/color.h"

#include <cmath>
#include <cstdio>

namespace afterglow {
namespace {

std::string place(glm::ivec2 p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
}

std::string frames(float count) {
    return fourDigits(count) + (count == 1.0f ? " frame" : " frames");
}

/// "51 %": how large a part of something is, whatever its sign.
std::string share(double part, double whole) {
    char text[16];
    std::snprintf(text, sizeof text, "%.0f %%", 100.0 * std::abs(part) / whole);
    return text;
}

/// Which sentences a pixel deserves. Every part appends its own.
class Story {
public:
    explicit Story(const PixelFacts& facts) : f_(facts) {}

    std::vector<std::string> tell() && {
        if (!f_.isSurface())
            say("There is no surface here: this is the background, which no filter touches.");
        if (f_.plan.carrySamples)
            tellSample();
        if (f_.gradient)
            tellGradient();
        if (!f_.plan.accumulate)
            say("This filter keeps no history: what is seen is the newest sample alone.");
        else if (f_.isSurface()) {
            tellHistory();
            if (hasHistory())
                tellAlpha();
            tellLength();
        }
        return std::move(sentences_);
    }

private:
    void say(std::string sentence) { sentences_.push_back(std::move(sentence)); }
    bool hasHistory() const {
        return f_.reason == gpu::kHistoryKept && f_.fetched && f_.fetched->length > 0.0f;
    }

    void tellSample() {
        if (!f_.sample) {
            tellEmptyStratum();
            return;
        }
        const CarriedSample& sample = *f_.sample;
        std::string text = "The gradient sample of this stratum came from pixel " +
                           place(sample.source) + " of the frame before";
        const float distance = glm::length(glm::vec2(sample.landing - sample.source));
        if (distance == 0.0f)
            text += " and is at the same place";
        else
            text += ", " + fourDigits(distance) + (distance == 1.0f ? " pixel" : " pixels") +
                    " away from " + place(sample.landing) + ", where it landed";
        say(text + ".");
        if (sample.now)
            tellChange(sample.before, *sample.now);
        if (f_.hasExtraSamples)
            say("It was shaded beside the picture, by a ray of its own.");
        else if (f_.isSample())
            say("This pixel is that sample: it was shaded again with the random numbers that it "
                "had "
                "in the frame before.");
    }

    void tellEmptyStratum() {
        if (f_.fate == gpu::kFateNone) {
            say("There was no frame before, so no stratum has a gradient sample.");
            return;
        }
        std::string text = "No sample of the frame before landed in this stratum; the one that the "
                           "same stratum offered ";
        text += sampleFate(f_.fate);
        if (f_.fate == gpu::kFateCarried)
            text += " to stratum " + place(f_.offeredTo);
        if (f_.fate == gpu::kFateLostRace)
            text += " to another sample that landed in stratum " + place(f_.offeredTo);
        say(text + ".");
    }

    void tellChange(float before, float now) {
        const float delta = now - before, greater = std::max(now, before);
        if (greater == 0.0f)
            say("It saw no light, neither now nor then.");
        else if (delta == 0.0f)
            say("It saw " + fourDigits(now) + " both times: nothing changed.");
        else
            say("It saw " + fourDigits(now) + " where it had seen " + fourDigits(before) +
                ": delta is " +
                fourDigits(f_.plan.gradient.magnitude == gpu::kGradientAbsolute ? std::abs(delta)
                                                                                : delta) +
                ", " + share(delta, greater) + " of Delta.");
    }

    void tellGradient() {
        const StratumGradient& g = *f_.gradient;
        const gpu::GradientParams& params = f_.plan.gradient;
        const std::string subject = "The lambda of this stratum is ";
        if (params.forceLambda >= 0.0f) {
            say(subject + "set to " + fourDigits(g.lambda) + " by hand, as everywhere.");
            return;
        }
        const float delta = g.reconstructed.x, greater = g.reconstructed.y;
        const std::string who =
            f_.plan.gradientIterations > 0 ? "filtered over the strata around" : "as measured";
        if (greater <= params.deltaFloor)
            say(subject + "0 because Delta, " + fourDigits(greater) + " " + who +
                ", is not above its floor of " + fourDigits(params.deltaFloor) + ".");
        else
            say(subject + "|delta| / Delta = " + fourDigits(std::abs(delta)) + " / " +
                fourDigits(greater) + " = " + fourDigits(g.lambda) + ", both " + who + ".");
    }

    void tellHistory() {
        if (f_.reason == gpu::kHistoryNone)
            say("There is no history: there was no frame before.");
        else if (f_.reason != gpu::kHistoryKept)
            say("The history was lost: " + std::string(historyReason(f_.reason)) + ".");
        if (f_.reason != gpu::kHistoryKept) {
            say("So the newest sample counts alone: alpha = " + fourDigits(f_.alpha) + ".");
            return;
        }
        if (!f_.fetched)
            return;
        if (f_.fetched->length == 0.0f) {
            say("The surface was seen in the frame before, but no history was kept of it: alpha "
                "= " +
                fourDigits(f_.alpha) + ".");
            return;
        }
        std::string text = "The history is worth " + frames(f_.fetched->length) +
                           ". It comes from (" + fourDigits(f_.fetched->position.x) + ", " +
                           fourDigits(f_.fetched->position.y) + ") in the frame before, where ";
        const int valid = f_.fetched->validTaps(), used = f_.fetched->usedTaps();
        if (used == 1)
            text += "this surface was seen";
        else
            text += (valid == used ? "all " : std::to_string(valid) + " of ") +
                    std::to_string(used) + " pixels show this surface";
        for (const HistoryTap& tap : f_.fetched->taps)
            if (tap.weight > 0.0f && tap.reason != gpu::kHistoryKept)
                text += "; not " + place(tap.pixel) + ": " + std::string(historyReason(tap.reason));
        say(text + ".");
    }

    void tellLambda() {
        const int fetch = f_.plan.temporal.lambdaFetch;
        if (f_.plan.useLambda && fetch == gpu::kLambdaMax)
            say("lambda here is " + fourDigits(f_.lambda) +
                ", the largest of the 3x3 strata around" +
                (f_.lambda > 0.0f && f_.lambdaFrom ? ": that of " + place(*f_.lambdaFrom) : "") +
                ".");
        if (f_.plan.useLambda && fetch == gpu::kLambdaBilinear)
            say("lambda here is " + fourDigits(f_.lambda) +
                ", interpolated between the strata around.");
        if (f_.range)
            tellRange(*f_.range);
    }

    void tellRange(glm::vec2 range) {
        const float l = f_.historyLuminance;
        const std::string between =
            fourDigits(range.x) + " to " + fourDigits(range.y) + ", the range of raw light around";
        if (l >= range.x && l <= range.y) {
            say("lambda is 0: the history's luminance, " + fourDigits(l) + ", is within " +
                between + ".");
            return;
        }
        const float outside = std::max(range.x - l, l - range.y);
        say("The history's luminance, " + fourDigits(l) + ", is " + fourDigits(outside) +
            " outside of " + between + ": lambda = min(1, " +
            fourDigits(f_.plan.temporal.percentileSlope) + " * " + fourDigits(outside) + " / " +
            fourDigits(range.y - range.x) + ") = " + fourDigits(f_.lambda) + ".");
    }

    void tellAlpha() {
        tellLambda();
        const bool hasLambda = f_.plan.useLambda || f_.plan.usePercentiles;
        const float least = f_.plan.temporal.alpha;
        float length = f_.fetched->length, lambda = hasLambda ? f_.lambda : 0.0f;
        if (f_.plan.cutsHistory()) {
            const float confidence = (1.0f - lambda) * (1.0f - lambda);
            const float cut =
                length * (confidence + (1.0f - confidence) / (length + 1.0f)); // [NRD]
            if (lambda > 0.0f)
                say("lambda cuts the history from " + fourDigits(length) + " to " + frames(cut) +
                    ".");
            length = cut;
        }
        const std::string blend =
            "max(" + fourDigits(least) + ", 1 / (" + fourDigits(length) + " + 1))";
        if (hasLambda && !f_.plan.cutsHistory())
            say("alpha = (1 - lambda) max(least, 1 / (N + 1)) + lambda = (1 - " +
                fourDigits(lambda) + ") " + blend + " + " + fourDigits(lambda) + " = " +
                fourDigits(f_.alpha) + ".");
        else
            say("alpha = max(least, 1 / (N + 1)) = " + blend + " = " + fourDigits(f_.alpha) + ".");
        if (f_.plan.clampsHistory())
            tellClamp();
    }

    // The clamped history is kept nowhere: it is the blend without the newest sample.
    void tellClamp() {
        if (f_.alpha > 0.99f)
            return;
        const glm::vec3 clamped =
            (glm::vec3(f_.accumulated) - f_.alpha * glm::vec3(f_.raw)) / (1.0f - f_.alpha);
        const float before = f_.historyLuminance, after = luminance(clamped);
        constexpr float kRounding = 1e-4f;
        if (std::abs(after - before) <= kRounding * std::max(before, after))
            say("The history is as the raw signal around lets it be: the clamp did nothing.");
        else
            say("The clamp brought the history's luminance from " + fourDigits(before) + " to " +
                fourDigits(after) + ", towards the raw signal around.");
    }

    void tellLength() {
        const float most = f_.plan.temporal.maxHistory;
        say("For the next frame the history is worth " + frames(f_.length) +
            (f_.length == most ? ", the most that is allowed." : "."));
        if (f_.plan.atrousIterations > 0 && f_.length < f_.plan.variance.minHistory)
            say("That is less than " + fourDigits(f_.plan.variance.minHistory) +
                ", so the variance was estimated from the pixels around.");
    }

    const PixelFacts& f_;
    std::vector<std::string> sentences_;
};

} // namespace

std::string fourDigits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value + 0.0); // -0 becomes 0
    return text;
}

std::string_view historyReason(int code) {
    switch (code) {
    case gpu::kHistoryKept: return "there is a history";
    case gpu::kHistoryNone: return "there was no frame before";
    case gpu::kHistoryOffScreen: return "the surface was outside the picture";
    case gpu::kHistoryInstance: return "another instance was seen there";
    case gpu::kHistoryDepth: return "the same instance was seen there, at another depth";
    case gpu::kHistoryNormal: return "the surface seen there faced another way";
    }
    return "unknown";
}

std::string_view sampleFate(std::uint32_t code) {
    switch (code) {
    case gpu::kFateNone: return "there was none";
    case gpu::kFateCarried: return "was carried";
    case gpu::kFateBackground: return "was background";
    case gpu::kFateWasSample: return "was a gradient sample itself, and none is used twice";
    case gpu::kFateOffScreen: return "was off screen";
    case gpu::kFateInstance: return "landed where another instance is seen";
    case gpu::kFateDepth: return "landed where the same instance is seen, at another depth";
    case gpu::kFateLostRace: return "lost the race";
    }
    return "unknown";
}

std::vector<std::string> storyOf(const PixelFacts& facts) {
    return Story(facts).tell();
}

} // namespace afterglow
