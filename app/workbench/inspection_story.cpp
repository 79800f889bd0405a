// SPDX-License-Identifier: MIT
#include "app/workbench/inspection.h"
#include "renderer/image/color.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace afterglow {
namespace {

/// "1 frame", "2.5 frames"
std::string counted(double count, std::string_view what) {
    const std::string number = fourDigits(count);
    return fmt::format("{} {}{}", number, what, number == "1" ? "" : "s");
}

/// Chooses the sentences that a pixel deserves. Every part appends its own.
class Story {
public:
    explicit Story(const PixelFacts& facts) : f_(facts) {}

    std::vector<std::string> sentences() && {
        if (!f_.isSurface())
            add("There is no surface here: this is the background, which no filter touches.");
        if (f_.plan.carrySamples)
            addSample();
        if (f_.plan.useLambda)
            addGradient();
        if (!f_.temporal)
            add("This filter keeps no history: what is seen is the newest sample alone.");
        else if (f_.isSurface()) {
            addHistory(*f_.temporal);
            if (f_.hasHistory())
                addAlpha(*f_.temporal);
            addLength(f_.temporal->moments.z);
        }
        return std::move(sentences_);
    }

private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        sentences_.push_back(fmt::format(format, std::forward<Args>(args)...));
    }
    static std::string d(double value) { return fourDigits(value); }

    void addSample() {
        if (!f_.sample)
            return addEmptyStratum();
        const auto [landing, source] = *f_.sample;
        const double distance = glm::length(glm::dvec2(landing - source));
        add("The gradient sample of this stratum came from pixel {} of the frame before{}.",
            placeText(source),
            distance == 0.0 ? " and is at the same place"
                            : fmt::format(", {} away from {}, where it landed",
                                          counted(distance, "pixel"), placeText(landing)));
        if (f_.gradient)
            addChange(*f_.gradient);
        if (f_.samplesBeside)
            add("It was shaded beside the picture, by a ray of its own.");
        else if (f_.isSample())
            add("This pixel is that sample: it was shaded again with the random numbers that it "
                "had in the frame before.");
    }

    void addEmptyStratum() {
        if (f_.fate == gpu::kFateNone)
            return add("There was no frame before, so no stratum has a gradient sample.");
        std::string where;
        if (f_.fate == gpu::kFateCarried)
            where = " to stratum " + placeText(f_.offeredTo);
        if (f_.fate == gpu::kFateLostRace)
            where = " to another sample that landed in stratum " + placeText(f_.offeredTo);
        add("No sample of the frame before landed in this stratum; the one that the same stratum "
            "offered {}{}.",
            sampleFate(f_.fate), where);
    }

    void addChange(const gpu::GradientFindings& found) {
        const float delta = found.gradient.x, larger = found.gradient.y;
        if (larger == 0.0f)
            add("It saw no light, neither now nor then.");
        else if (delta == 0.0f)
            add("It saw {} both times: nothing changed.", d(found.now));
        else
            add("It saw {} where it had seen {}: delta is {}, {:.0f} % of Delta.", d(found.now),
                d(found.before), d(delta), 100.0 * std::abs(delta) / larger);
    }

    void addGradient() {
        const gpu::GradientParams& params = f_.plan.gradient;
        const std::string lambda = d(f_.image("lambda_strata"));
        if (params.forceLambda >= 0.0f)
            return add("The lambda of this stratum is set to {} by hand, as everywhere.", lambda);
        if (f_.plan.useChange)
            return addLightChange(lambda);
        const bool filtered = f_.plan.gradientIterations > 0;
        const double delta = f_.image(filtered ? "gradient" : "gradient_sample");
        const double larger = f_.image(filtered ? "gradient_max" : "gradient_sample_max");
        const char* const how = filtered ? "filtered over the strata around" : "as measured";
        if (larger <= double(params.deltaFloor))
            add("The lambda of this stratum is {} because Delta, {} {}, is not above its floor of "
                "{}.",
                lambda, d(larger), how, d(params.deltaFloor));
        else
            add("The lambda of this stratum is |delta| / Delta = {} / {} = {}, both {}.",
                d(std::abs(delta)), d(larger), lambda, how);
    }

    void addLightChange(const std::string& lambda) {
        add("The lambda of this stratum is {}: the {} between the light of the samples around in "
            "the "
            "two frames.",
            lambda,
            f_.plan.change.over == gpu::kChangeOfChannels ? "largest relative change of a channel"
                                                          : "relative change of luminance");
        if (!f_.plan.countsSamples())
            return;
        const double scale = f_.image("change_scale");
        if (scale != 1.0)
            add("One factor, {}, explains some of it; of its square {} is left.", d(scale),
                d(f_.image("change_left")));
    }

    void addCount(const gpu::TemporalFindings& found) {
        addLambda(found);
        const int strata = int(found.change.w);
        if (strata == 0)
            add("No light has changed anywhere: the history counts for all of its samples.");
        else if (found.control.x > 0.0f && found.change.z != 1.0f)
            add("The history was multiplied by {}, as the light was.", d(found.change.z));
        if (found.usedSamples != found.fetchedSamples)
            add("It counts for {}, no longer for {}.", counted(found.usedSamples, "sample"),
                d(found.fetchedSamples));
        if (found.newSamples < 1.0f)
            add("The newest sample is a reused one, which the history holds already: it counts for "
                "{}.",
                counted(found.newSamples, "sample"));
        add("alpha = n / (N + n) = {} / ({} + {}) = {}.", d(found.newSamples), d(found.usedSamples),
            d(found.newSamples), d(found.control.y));
    }

    void addHistory(const gpu::TemporalFindings& found) {
        const std::string alpha = d(found.control.y);
        if (f_.reason() != gpu::kHistoryKept) {
            if (f_.reason() == gpu::kHistoryNone)
                add("There is no history: there was no frame before.");
            else
                add("The history was rejected: {}.", historyReason(f_.reason()));
            return add("So the newest sample counts alone: alpha = {}.", alpha);
        }
        if (!f_.hasHistory())
            return add("The surface was seen in the frame before, but no history was kept of it: "
                       "alpha = {}.",
                       alpha);
        int used = 0, valid = 0;
        std::string others;
        for (const gpu::HistoryTap& tap : found.taps) {
            if (tap.weight == 0.0f)
                continue;
            ++used;
            if (tap.reason == gpu::kHistoryKept)
                ++valid;
            else
                others +=
                    fmt::format("; not {}: {}", placeText(tap.pixel), historyReason(tap.reason));
        }
        add("The history is worth {}. It comes from ({}, {}) in the frame before, where {}{}.",
            counted(found.fetchedSamples, "frame"), d(found.position.x), d(found.position.y),
            used == 1       ? "this surface was seen"
            : valid == used ? fmt::format("all {} pixels show this surface", used)
                            : fmt::format("{} of {} pixels show this surface", valid, used),
            others);
    }

    void addLambda(const gpu::TemporalFindings& found) {
        const float lambda = found.control.x;
        const int fetch = f_.plan.temporal.lambdaFetch;
        if (f_.plan.useLambda && fetch == gpu::kLambdaMax)
            add("lambda here is {}, the largest of the 3x3 strata around{}.", d(lambda),
                lambda > 0.0f ? ": that of " + placeText(found.lambdaStratum) : "");
        if (f_.plan.useLambda && fetch == gpu::kLambdaBilinear)
            add("lambda here is {}, interpolated between the strata around.", d(lambda));
        if (f_.plan.useLambda && fetch == gpu::kLambdaLight)
            add("lambda here is {}, the mean of the 3x3 strata around, weighted by their light.",
                d(lambda));
        if (!f_.plan.usePercentiles)
            return;
        const std::string luminance = d(found.accumulated.a);
        const std::string range = fmt::format("{} to {}, the range of raw light around",
                                              d(found.range.x), d(found.range.y));
        if (found.outside == 0.0f)
            add("lambda is 0: the history's luminance, {}, is within {}.", luminance, range);
        else
            add("The history's luminance, {}, is {} outside of {}: lambda = min(1, {} * {} / {}) = "
                "{}.",
                luminance, d(found.outside), range, d(f_.plan.temporal.percentileSlope),
                d(found.outside), d(found.range.y - found.range.x), d(lambda));
    }

    void addAlpha(const gpu::TemporalFindings& found) {
        if (f_.plan.countsSamples())
            return addCount(found);
        addLambda(found);
        if ((f_.plan.cutsHistory() || f_.plan.cutsByPower()) && found.control.x > 0.0f)
            add("lambda cuts the history from {} to {}.", d(found.fetchedSamples),
                counted(found.usedSamples, "frame"));
        const std::string blend =
            fmt::format("max({}, 1 / ({} + 1))", d(f_.plan.temporal.alpha), d(found.usedSamples));
        const std::string lambda = d(found.control.x), alpha = d(found.control.y);
        if ((f_.plan.useLambda || f_.plan.usePercentiles) && !f_.plan.cutsHistory())
            add("alpha = (1 - lambda) max(least, 1 / (N + 1)) + lambda = (1 - {}) {} + {} = {}.",
                lambda, blend, lambda, alpha);
        else
            add("alpha = max(least, 1 / (N + 1)) = {} = {}.", blend, alpha);
        if (!f_.plan.clampsHistory())
            return;
        if (found.usedColor == found.fetchedColor)
            add("The history is as the raw signal around lets it be: the clamp did nothing.");
        else
            add("The clamp brought the history's luminance from {} to {}, towards the raw signal "
                "around.",
                d(found.accumulated.a), d(luminance(found.usedColor)));
    }

    void addLength(float length) {
        add("For the next frame the history is worth {}{}", counted(length, "frame"),
            length == f_.plan.temporal.maxHistory ? ", the most that is allowed." : ".");
        if (f_.plan.atrousIterations > 0 && length < f_.plan.variance.minHistory)
            add("That is less than {}, so the variance was estimated from the pixels around.",
                d(f_.plan.variance.minHistory));
    }

    const PixelFacts& f_;
    std::vector<std::string> sentences_;
};

} // namespace

std::string fourDigits(double value) {
    return fmt::format("{:.4g}", value + 0.0); // -0 becomes 0
}

std::string placeText(glm::ivec2 p) {
    return fmt::format("({}, {})", p.x, p.y);
}

std::string_view historyReason(int code) {
    static constexpr std::array kReasons{"there is a history",
                                         "there was no frame before",
                                         "the surface was outside the picture",
                                         "another instance was seen there",
                                         "the same instance was seen there, at another depth",
                                         "the surface seen there faced another way"};
    return std::size_t(code) < kReasons.size() ? kReasons[std::size_t(code)] : "unknown";
}

std::string_view sampleFate(std::uint32_t code) {
    static constexpr std::array<std::string_view, gpu::kFateCount> kFates{
        "there was none",
        "was carried",
        "was background",
        "was a gradient sample itself, and none is used twice",
        "was off screen",
        "landed where another instance is seen",
        "landed where the same instance is seen, at another depth",
        "lost the race"};
    return code < kFates.size() ? kFates[code] : "unknown";
}

std::vector<std::string> storyOf(const PixelFacts& facts) {
    return Story(facts).sentences();
}

} // namespace afterglow
