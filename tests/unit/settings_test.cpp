#include "renderer/base/error.h"
#include "renderer/pipeline/denoise_plan.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <set>
#include <string>

using namespace afterglow;

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
        std::visit([&](auto* member) { cover(member); }, field.ref(settings));
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
            std::visit([](auto* member) { return double(*member); }, field.ref(settings));
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
    const DenoiserSettings settings;
    const DenoisePlan none = makePlan(Filter::None, settings),
                      fixed = makePlan(Filter::Fixed, settings);
    const DenoisePlan svgf = makePlan(Filter::Svgf, settings),
                      asvgf = makePlan(Filter::Asvgf, settings);
    CHECK(none == DenoisePlan{});
    CHECK(fixed == DenoisePlan{.accumulate = true, .historyLaw = gpu::kHistoryPower});
    CHECK(svgf == DenoisePlan{.accumulate = true,
                              .historyLaw = gpu::kHistoryPower,
                              .atrousIterations = 5,
                              .feedbackIteration = 1});
    DenoisePlan adaptive = svgf;
    adaptive.carrySamples = adaptive.useLambda = true;
    adaptive.gradientIterations = 5;
    adaptive.gradientKernel = Kernel::Box3x3;
    adaptive.gradientLuminanceStop = true;
    CHECK(asvgf == adaptive);

    DenoisePlan clamp = svgf, percentile = svgf, confidence = asvgf;
    clamp.clampHistory = true;
    CHECK(makePlan(Filter::Clamp, settings) == clamp);
    percentile.usePercentiles = true;
    CHECK(makePlan(Filter::Percentile, settings) == percentile);
    confidence.cutHistory = confidence.gradientAbsolute = true;
    confidence.gradientStridesLinear = true;
    confidence.gradientLuminanceStop = false;
    confidence.gradientKernel = Kernel::B3Spline5x5;
    confidence.historyLaw = gpu::kHistoryEffective;
    CHECK(makePlan(Filter::Confidence, settings) == confidence);
}

TEST_CASE("every filter has a name of its own, a sentence, and a place in the list") {
    std::set<std::string_view> names;
    for (const Filter filter : allFilters()) {
        CHECK(names.insert(nameOf(filter)).second);
        CHECK(filterFromName(nameOf(filter)) == filter);
        CHECK_FALSE(describe(filter).empty());
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
    CHECK(makePlan(Filter::Asvgf, settings) == makePlan(Filter::Confidence, DenoiserSettings{}));
}

TEST_CASE("what is fed back is never later than the last iteration") {
    DenoiserSettings settings;
    settings.feedbackIteration = 4;
    settings.atrousIterations = 2;
    CHECK(makePlan(Filter::Svgf, settings).feedbackIteration == 2);
}
