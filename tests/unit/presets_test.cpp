#include "app/experiment/embedded.h"
#include "app/experiment/experiment.h"
#include "app/experiment/presets.h"
#include "renderer/base/error.h"

#include <filesystem>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("the presets in the program are the files of assets/presets, each with its source") {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(AFTERGLOW_SOURCE_DIR "/assets/presets")) {
        const std::string name = entry.path().stem().string();
        CAPTURE(name);
        ++files;
        CHECK(variantNamed(name).name == name);
        CHECK_FALSE(variantNamed(name).changes.empty());
    }
    REQUIRE(presets().size() == files);
    for (const Preset& preset : presets()) {
        CAPTURE(preset.name);
        CHECK_FALSE(preset.description.empty());
        CHECK_FALSE(preset.source.empty());
    }
}

TEST_CASE("a preset is a variant like any other") {
    const Experiment e = parseExperiment(R"({"name": "e", "scene": "tiny", "frames": 2,
                                             "variants": ["asvgf", "paper"]})",
                                         "e.json");
    REQUIRE(e.variants.size() == 2);
    CHECK(e.variants[1] == variantNamed("paper"));
    const Settings settings = settingsOf(e.variants[1], Signal::Shadows);
    CHECK(settings.filter == Filter::Asvgf);
    CHECK(settings.denoiser.temporal.historyLaw == gpu::kHistoryFrames);
    CHECK(settings.lighting.signal == int(Signal::Shadows));
    CHECK(variantNamed("fixed") == variantOf(Filter::Fixed));
    CHECK_THROWS_AS(variantNamed("papers"), UsageError);
}

TEST_CASE("a preset that is none is refused by file and place") {
    const auto refusal = [](const char* text) -> std::string {
        try {
            parsePreset(text, "mine.json");
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(refusal(R"({"name": "a", "description": "", "source": "", "filter": "svgf",
                      "settings": {"alpha": 0.5}})") == "accepted");
    CHECK(refusal(R"({"name": "svgf", "description": "", "source": "", "filter": "svgf",
                      "settings": {}})") ==
          "mine.json: name: expected a name that is no filter's, found \"svgf\"");
    CHECK(refusal(R"({"name": "a", "description": "", "source": "", "filter": "svgf",
                      "settings": {"alfa": 1}})")
              .starts_with("mine.json: settings: "));
    CHECK(refusal(R"({"name": "a", "description": "", "source": "", "filter": "svgf",
                      "settings": {"alpha": []}})")
              .starts_with("mine.json: settings.alpha: expected a number or a name, found a list"));
    CHECK(refusal(R"({"name": "a"})") == "mine.json: \"description\" is missing");
}
