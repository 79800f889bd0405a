// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/filters/svgf_plan.h"
#include "renderer/pipeline/settings.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <cstring>
#include <set>
#include <string>
#include <tuple>

using namespace afterglow;

namespace {

template <class Block>
bool sameBits(const Block& a, const Block& b) {
    return std::memcmp(&a, &b, sizeof a) == 0; // blocks have no padding of their own
}

bool isSame(const SvgfPlan& a, const SvgfPlan& b) {
    const auto flags = [](const SvgfPlan& p) {
        return std::tuple(p.accumulate, p.carrySamples, p.useLambda, p.useChange, p.usePercentiles,
                          p.gradientIterations, p.gradientKernel, p.gradientStridesLinear,
                          p.atrousIterations, p.kernel, p.feedbackIteration);
    };
    return flags(a) == flags(b) && sameBits(a.temporal, b.temporal) &&
           sameBits(a.percentiles, b.percentiles) && sameBits(a.gradient, b.gradient) &&
           sameBits(a.gradientEdges, b.gradientEdges) && sameBits(a.variance, b.variance) &&
           sameBits(a.edges, b.edges) && sameBits(a.change, b.change);
}

} // namespace

TEST_CASE("the field table names every member of the settings once") {
    Settings settings;
    const auto* first = reinterpret_cast<const char*>(&settings);
    std::set<std::ptrdiff_t> covered;
    const auto cover = [&](const void* member) {
        const std::ptrdiff_t offset = static_cast<const char*>(member) - first;
        CHECK(covered.insert(offset).second);
    };
    for (const Field& field : fields()) {
        CAPTURE(field.key);
        std::visit([&](auto* member) { cover(member); }, field.in(settings));
    }
    // Not for a slider: chosen by name, set by the plan or by the pass, or padding.
    cover(&settings.filter);
    cover(&settings.denoiser.temporal.lambdaSource);
    cover(&settings.denoiser.percentiles.unused0);
    cover(&settings.denoiser.percentiles.unused1);
    cover(&settings.denoiser.edges.step);
    cover(&settings.denoiser.gradientEdges.step);
    cover(&settings.denoiser.gradient.unused0);
    for (std::ptrdiff_t offset = 0; offset < std::ptrdiff_t(sizeof(Settings)); offset += 4) {
        CAPTURE(offset);
        CHECK(covered.contains(offset));
    }
}

TEST_CASE("every field says what it is, and its default is in its range") {
    std::set<std::string_view> keys;
    for (const Field& field : fields()) {
        CAPTURE(field.key);
        CHECK(keys.insert(field.key).second);
        CHECK_FALSE(field.label.empty());
        CHECK_FALSE(field.meaning.empty());
        CHECK_FALSE(field.source.empty());
        Settings settings;
        const double value =
            std::visit([](auto* member) { return double(*member); }, field.in(settings));
        CHECK(value >= field.min);
        CHECK(value <= field.max);
        if (!field.choices.empty())
            CHECK(field.max == double(field.choices.size() - 1));
    }
}

TEST_CASE("settings survive a round trip through JSON") {
    Settings settings;
    settings.filter = Filter::Svgf;
    settings.denoiser.temporal.alpha = 0.1f; // no double is this float
    settings.denoiser.temporal.lambdaFetch = gpu::kLambdaBilinear;
    settings.display.exposure = -1.5f;
    const nlohmann::json json = toJson(settings);
    CHECK(json["alpha"].dump() == "0.1");
    CHECK(json["lambdaFetch"] == "bilinear");
    Settings back;
    applyJson(back, json);
    CHECK(toJson(back) == json);
    CHECK(back.denoiser.temporal.alpha == 0.1f);
}

TEST_CASE("a wrong setting is refused by name, and nothing of it is applied") {
    Settings settings;
    const auto messageOf = [&](std::string_view key, std::string_view value) {
        try {
            setField(settings, key, value);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(messageOf("alfa", "0.1").find("did you mean 'alpha'") != std::string::npos);
    CHECK(messageOf("alpha", "2").find("in [0.005, 1], not 2") != std::string::npos);
    CHECK(messageOf("alpha", "nan").find("not nan") != std::string::npos);
    CHECK(messageOf("alpha", "much").find("not 'much'") != std::string::npos);
    CHECK(messageOf("atrousIterations", "2.5").find("whole number") != std::string::npos);
    CHECK(messageOf("lambdaFetch", "maximum").find("known: nearest, bilinear, max") !=
          std::string::npos);
    CHECK(messageOf("alpha", "0.05").empty());
    CHECK(settings.denoiser.temporal.alpha == 0.05f);

    const Settings before = settings;
    CHECK_THROWS_AS(applyJson(settings, {{"alpha", 0.5}, {"sigma", 1}}), UsageError);
    CHECK(toJson(settings) == toJson(before));
}

TEST_CASE("filters differ in the rows of one plan") {
    const SvgfPlan svgf = makePlan({Filter::Svgf, {}});
    CHECK(svgf.accumulate);
    CHECK(svgf.temporal.historyLaw == gpu::kHistoryPower);
    CHECK(svgf.temporal.clampRadius == -1);
    CHECK(svgf.temporal.lambdaSource == gpu::kLambdaFromNothing);
    CHECK(svgf.atrousIterations == 5);
    CHECK(svgf.feedbackIteration == 0);
    CHECK_FALSE((svgf.carrySamples || svgf.useLambda || svgf.usePercentiles));

    SvgfPlan fixed = svgf, none = svgf, asvgf = svgf, clamp = svgf, percentile = svgf;
    fixed.atrousIterations = fixed.feedbackIteration = 0;
    CHECK(isSame(makePlan({Filter::Fixed, {}}), fixed));
    none = fixed;
    none.accumulate = false;
    CHECK(isSame(makePlan({Filter::None, {}}), none));
    asvgf.carrySamples = asvgf.useLambda = true;
    asvgf.temporal.lambdaSource = gpu::kLambdaFromGradient;
    CHECK(isSame(makePlan({Filter::Asvgf, {}}), asvgf));
    clamp.temporal.clampRadius = DenoiserSettings{}.temporal.clampRadius;
    CHECK(isSame(makePlan({Filter::Clamp, {}}), clamp));
    percentile.usePercentiles = true;
    percentile.temporal.lambdaSource = gpu::kLambdaFromRange;
    CHECK(isSame(makePlan({Filter::Percentile, {}}), percentile));

    SvgfPlan confidence = asvgf;
    confidence.temporal.lambdaUse = gpu::kLambdaCuts;
    confidence.temporal.historyLaw = gpu::kHistoryEffective;
    confidence.gradient.magnitude = gpu::kGradientAbsolute;
    confidence.gradientStridesLinear = true;
    confidence.gradientEdges.sigmaLuminance = 0.0f;
    confidence.gradientKernel = Kernel::B3Spline5x5;
    CHECK(isSame(makePlan({Filter::Confidence, {}}), confidence));

    SvgfPlan counted = asvgf;
    counted.useChange = true;
    counted.change.over = gpu::kChangeOfChannels;
    counted.temporal.lambdaUse = gpu::kLambdaCounts;
    counted.temporal.lambdaFetch = gpu::kLambdaLight;
    counted.temporal.historyLaw = gpu::kHistoryFrames;
    counted.variance.varianceExponent = 1.25f;
    counted.atrousIterations = 3;
    CHECK(isSame(makePlan(defaultSettings(Filter::Counted)), counted));
}

TEST_CASE("a variance of the mean needs a count of samples, a mean by light a change of light") {
    DenoiserSettings settings;
    settings.varianceExponent = 1.0f;
    settings.temporal.lambdaFetch = gpu::kLambdaLight;
    CHECK(makePlan({Filter::Asvgf, settings}).variance.varianceExponent == 0.0f);
    CHECK(makePlan({Filter::Counted, settings}).variance.varianceExponent == 1.0f);
    CHECK(makePlan({Filter::Asvgf, settings}).useChange);
    CHECK(makePlan({Filter::Confidence, settings}).temporal.lambdaFetch == gpu::kLambdaMax);
    settings.temporal.historyLaw = gpu::kHistoryEffective;
    CHECK(makePlan({Filter::Asvgf, settings}).variance.varianceExponent == 1.0f);
    settings.temporal.lambdaFetch = gpu::kLambdaMax;
    CHECK_FALSE(makePlan({Filter::Asvgf, settings}).useChange);
    settings.gradientOver = gpu::kChangeOfChannels;
    CHECK(makePlan({Filter::Asvgf, settings}).useChange);
    CHECK_FALSE(makePlan({Filter::Svgf, settings}).useChange);
}

TEST_CASE("what is at a filter's default follows to the next filter's, and what was set stays") {
    Settings settings = defaultSettings(Filter::Svgf);
    settings.denoiser.temporal.alpha = 0.1f;
    settings.denoiser.feedbackIteration = 2;
    setFilter(settings, Filter::Counted);
    CHECK(settings.filter == Filter::Counted);
    CHECK(settings.denoiser.atrousIterations == 3);
    CHECK(settings.denoiser.feedbackIteration == 2);
    CHECK(settings.denoiser.temporal.alpha == 0.1f);
    setFilter(settings, Filter::Asvgf);
    CHECK(settings.denoiser.atrousIterations == 5);
    CHECK(settings.denoiser.feedbackIteration == 2);
    setFilter(settings, Filter::Svgf);
    setField(settings, "alpha", "0.2");
    setField(settings, "feedbackIteration", "0");
    CHECK(toJson(settings) == toJson(defaultSettings(Filter::Svgf)));

    Settings read = defaultSettings(Filter::Asvgf);
    applyJson(read, {{"filter", "counted"}, {"alpha", 0.5}});
    Settings expected = defaultSettings(Filter::Counted);
    expected.denoiser.temporal.alpha = 0.5f;
    CHECK(toJson(read) == toJson(expected));
}

TEST_CASE("what cannot cut a history blends") {
    DenoiserSettings settings;
    settings.temporal.lambdaUse = gpu::kLambdaCuts;
    CHECK(makePlan({Filter::Asvgf, settings}).cutsHistory());
    CHECK(makePlan({Filter::Percentile, settings}).cutsHistory());
    CHECK_FALSE(makePlan({Filter::Svgf, settings}).cutsHistory());
}

TEST_CASE("every filter has a name of its own, a sentence, and a place in the list") {
    std::set<std::string_view> names, titles;
    for (const Filter filter : allFilters()) {
        CHECK(names.insert(nameOf(filter)).second);
        CHECK(filterFromName(nameOf(filter)) == filter);
        CHECK_FALSE(describe(filter).empty());
        CHECK(titles.insert(titleOf(filter)).second);
        CHECK(infoOf(filter).filter == filter);
        CHECK(allFilters()[std::size_t(filter)] == filter);
    }
}

TEST_CASE("what confidence does differently can be set for A-SVGF, piece by piece") {
    DenoiserSettings settings;
    settings.temporal.lambdaUse = gpu::kLambdaCuts;
    settings.temporal.historyLaw = gpu::kHistoryEffective;
    settings.gradient.magnitude = gpu::kGradientAbsolute;
    settings.gradientStrides = gpu::kStridesLinear;
    settings.gradientLuminanceStop = 0;
    settings.gradientKernel = int(Kernel::B3Spline5x5);
    CHECK(isSame(makePlan({Filter::Asvgf, settings}), makePlan({Filter::Confidence, {}})));
}

TEST_CASE("what is fed back is never later than the last iteration") {
    DenoiserSettings settings;
    settings.feedbackIteration = 4;
    settings.atrousIterations = 2;
    CHECK(makePlan({Filter::Svgf, settings}).feedbackIteration == 2);
}
