// SPDX-License-Identifier: MIT
#include "app/base/embedded.h"
#include "app/scenario/experiment.h"
#include "app/scenario/presets.h"
#include "app/workbench/preset_store.h"
#include "renderer/base/error.h"
#include "renderer/filters/svgf_plan.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <filesystem>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

Settings settingsOf(const Preset& preset) {
    return afterglow::settingsOf(preset.variant, Signal::Both);
}

Preset ownPreset(std::string name) {
    Settings settings;
    settings.filter = Filter::Svgf;
    settings.denoiser.temporal.alpha = 0.05f;
    Preset preset = presetOf(name, settings);
    preset.title = "My own";
    return preset;
}

std::vector<std::string> namesIn(const PresetStore& store, bool builtIn) {
    std::vector<std::string> names;
    for (const PresetStore::Entry& entry : store.list())
        if (entry.builtIn == builtIn)
            names.push_back(entry.preset.name);
    return names;
}

} // namespace

TEST_CASE("the presets in the program are the files of assets/presets, each with its source") {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sourceDir() / "assets/presets")) {
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
        CHECK(preset.title != preset.name); // every one has a title of its own
        CHECK(isPresetName(preset.name));
    }
}

TEST_CASE("no two presets of the program do the same") {
    for (const Preset& a : presets())
        for (const Preset& b : presets()) {
            if (a.name >= b.name)
                continue;
            CAPTURE(a.name);
            CAPTURE(b.name);
            const Settings x = settingsOf(a), y = settingsOf(b);
            CHECK_FALSE(differencesOf(x, y).empty());
            // Every preset blends, so alpha counts in all of them.
            CHECK(x.denoiser.temporal.alpha > 0.0f);
            CHECK(makePlan(x).accumulate);
            CHECK(a.title != b.title);
        }
}

TEST_CASE("a preset that is written and read again is the same") {
    for (const Preset& preset : presets()) {
        CAPTURE(preset.name);
        const Preset again = parsePreset(presetText(preset), "again.json");
        CHECK(again.name == preset.name);
        CHECK(again.title == preset.title);
        CHECK(again.description == preset.description);
        CHECK(again.source == preset.source);
        CHECK(differencesOf(settingsOf(preset), settingsOf(again)).empty());
        CHECK(presetText(again) == presetText(preset));
    }
    // Any number of single precision, and names in place of enumerations.
    Settings settings;
    settings.filter = Filter::Percentile;
    settings.denoiser.temporal.alpha = 1.0f / 3.0f;
    settings.denoiser.gradient.deltaFloor = 1.2345678e-4f;
    settings.denoiser.temporal.historyLaw = gpu::kHistoryFrames;
    Preset mine = presetOf("mine", settings);
    mine.description = "\"quoted\", \\ and \xE2\x82\xAC";
    const Preset again = parsePreset(presetText(mine), "again.json");
    CHECK(again.title == "mine");
    CHECK(again.description == mine.description);
    CHECK(settingsOf(again).denoiser.temporal.alpha == 1.0f / 3.0f);
    CHECK(settingsOf(again).denoiser.gradient.deltaFloor == 1.2345678e-4f);
    CHECK(differencesOf(settings, settingsOf(again)).empty());
}

TEST_CASE("the text of a preset says its filter and what is not at its default, and no more") {
    CHECK(presetText(ownPreset("mine")) == R"({
    "name": "mine",
    "title": "My own",
    "description": "",
    "source": "",
    "filter": "svgf",
    "settings": {
        "alpha": 0.05
    }
}
)");
}

TEST_CASE(
    "two filters differ in the filter and in fields of the denoiser, not in light or exposure") {
    Settings a, b;
    CHECK(differencesOf(a, b).empty());
    b.lighting.aoRadius = 0.5f;
    b.lighting.signal = int(Signal::Shadows);
    b.display.exposure = 1.0f;
    CHECK(differencesOf(a, b).empty());
    b.filter = Filter::Clamp;
    b.denoiser.temporal.alpha = 0.05f;
    b.denoiser.kernel = int(Kernel::Box3x3);
    b.denoiser.atrousIterations = 3;
    CHECK(differencesOf(a, b) ==
          std::vector<SettingDifference>{{"Filter", "filter", "asvgf", "clamp"},
                                         {"Alpha", "alpha", "0.2", "0.05"},
                                         {"A-trous iterations", "atrousIterations", "5", "3"},
                                         {"Kernel", "kernel", "b3-5x5", "box-3x3"}});
    CHECK(differencesOf(b, a)[1] == SettingDifference{"Alpha", "alpha", "0.05", "0.2"});

    // Every field of the denoiser counts.
    for (const Field& field : fields()) {
        CAPTURE(field.key);
        Settings changed;
        const Field::Ref ref = field.in(changed);
        if (float* const* number = std::get_if<float*>(&ref))
            **number = float(field.min + 0.37 * (field.max - field.min));
        else
            *std::get<int*>(ref) = *std::get<int*>(ref) == 0 ? 1 : 0;
        const auto differences = differencesOf(Settings{}, changed);
        if (field.isFrameWide())
            CHECK(differences.empty());
        else
            CHECK((differences.size() == 1 && differences[0].key == field.key));
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
    CHECK(refusal(R"({"name": "a b", "description": "", "source": "", "filter": "svgf",
                      "settings": {}})") ==
          "mine.json: name: expected at most 64 letters, digits, \"-\" and \"_\", found \"a b\"");
    CHECK(refusal(R"({"name": "../a", "description": "", "source": "", "filter": "svgf",
                      "settings": {}})") != "accepted");
    CHECK(refusal(R"({"name": "a", "titel": "", "description": "", "source": "", "filter": "svgf",
                      "settings": {}})")
              .starts_with("mine.json: unknown key \"titel\"; known are \"name\", \"title\""));
    CHECK(refusal(R"({"name": "a", "title": "1234567890123456789012345", "description": "",
                      "source": "", "filter": "svgf", "settings": {}})")
              .starts_with("mine.json: title: expected at most 24 characters"));
    CHECK(refusal(R"({"name": "a", "title": "ÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄÄ", "description": "",
                      "source": "", "filter": "svgf", "settings": {}})") == "accepted");
    CHECK(refusal(R"({"name": "a", "description": "", "source": "", "filter": "svgf",
                      "settings": {"exposure": 1}})") ==
          "mine.json: settings.exposure: belongs to the whole frame, not to a filter");
}

TEST_CASE("a user's preset is saved, found, replaced and removed, and survives the program") {
    const TemporaryFolder folder;
    const std::filesystem::path place = folder / "config/presets";
    PresetStore store(place);
    CHECK(store.list().size() == presets().size());
    CHECK_FALSE(std::filesystem::exists(place)); // looking makes nothing

    store.save(ownPreset("z"));
    store.save(ownPreset("a-b_1"));
    CHECK(namesIn(store, false) == std::vector<std::string>{"a-b_1", "z"});
    CHECK(std::ranges::is_sorted(namesIn(store, true)));
    CHECK(store.list().front().builtIn);
    CHECK_FALSE(store.list().back().builtIn);

    const PresetStore later(place);
    REQUIRE(later.find("z"));
    CHECK(later.find("z")->title == "My own");
    CHECK(settingsOf(*later.find("z")).denoiser.temporal.alpha == 0.05f);
    CHECK(later.find("paper"));
    CHECK_FALSE(later.find("y"));

    Settings other;
    other.filter = Filter::Clamp;
    store.save(presetOf("z", other));
    CHECK(settingsOf(*store.find("z")).filter == Filter::Clamp);
    CHECK(namesIn(store, false).size() == 2);
    // Nothing is left of what writing needed.
    CHECK(std::distance(std::filesystem::directory_iterator(place), {}) == 2);

    store.remove("z");
    CHECK(namesIn(store, false) == std::vector<std::string>{"a-b_1"});
    CHECK_FALSE(std::filesystem::exists(place / "z.json"));
}

TEST_CASE("what cannot be saved or removed is refused, and nothing is written") {
    const TemporaryFolder folder;
    PresetStore store(folder.path());
    CHECK(messageOf<UsageError>([&] { store.save(ownPreset("paper")); }) ==
          "the preset 'paper' comes with the program; save under another name");
    CHECK_THROWS_AS(store.save(ownPreset("svgf")), UsageError);
    CHECK_THROWS_AS(store.save(ownPreset("../up")), UsageError);
    CHECK_THROWS_AS(store.save(ownPreset("")), UsageError);
    Preset longTitle = ownPreset("long");
    longTitle.title = std::string(25, 'x');
    CHECK_THROWS_AS(store.save(longTitle), InputError);
    CHECK_THROWS_AS(store.remove("paper"), UsageError);
    CHECK_THROWS_AS(store.remove("nobody"), UsageError);
    CHECK(std::filesystem::is_empty(folder.path()));

    PresetStore inFile(std::filesystem::path(folder.write("file", "")) / "presets");
    CHECK_THROWS_AS(inFile.save(ownPreset("mine")), Error);
}

TEST_CASE("a broken file among the user's presets is listed with its fault and hides no other") {
    const TemporaryFolder folder;
    PresetStore store(folder.path());
    store.save(ownPreset("good"));
    folder.write("bad.json", "{\n\n]");
    folder.write("other.json", presetText(ownPreset("name")));
    folder.write("paper.json", presetText(ownPreset("paper")));
    folder.write("keys.json", R"({"name": "keys", "color": 1})");
    folder.write("notes.txt", "not a preset");
    std::filesystem::create_directory(folder / "dir.json");
    store.reload();
    CHECK(namesIn(store, false) ==
          std::vector<std::string>{"bad", "dir", "good", "keys", "other", "paper"});
    const auto errorOf = [&](std::string_view name) {
        for (const PresetStore::Entry& entry : store.list())
            if (!entry.builtIn && entry.preset.name == name)
                return entry.error;
        return std::string("not listed");
    };
    const std::string at = folder.path().string() + "/";
    CHECK(errorOf("good").empty());
    CHECK(errorOf("bad") == at + "bad.json:3: this is not JSON");
    CHECK(errorOf("dir") == at + "dir.json: is a folder, not a file");
    CHECK(errorOf("keys").starts_with(at + "keys.json: unknown key \"color\""));
    CHECK(errorOf("other") ==
          at + "other.json: name: expected \"other\", as the file is named, found \"name\"");
    CHECK(errorOf("paper") == at + "paper.json: a preset of this name comes with the program");
    CHECK_FALSE(store.find("bad"));
    CHECK(store.find("paper") != nullptr); // the built-in one
    CHECK(store.find("paper")->title != "My own");

    store.remove("bad"); // a way out
    CHECK(errorOf("bad") == "not listed");
}
