// SPDX-License-Identifier: MIT
// Frames that go out to another denoiser and come back to be measured. The other denoiser is our
// own SVGF in disguise, whose figures are known.

#include "program.h"

#include "app/measure/metrics_table.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow::test {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr glm::ivec2 kSize{61, 37};
constexpr int kFrames = 14;
const Words kRun{"--frames", "14", "--seed", "3", "--light", "key=0.3@8"};

Run run(Words words, const Words& more = {}) {
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--context", "osmesa"});
    return afterglow(words);
}

void checkDone(const Run& run) {
    CAPTURE(run.err);
    CHECK(run.exitCode == 0);
    CHECK(run.err == "");
}

void checkRefused(const Run& run, int exitCode, const std::vector<std::string>& mentioned) {
    CAPTURE(run.err);
    CHECK(run.exitCode == exitCode);
    CHECK(isOneErrorLine(run.err));
    for (const std::string& text : mentioned) {
        CAPTURE(text);
        CHECK(run.err.find(text) != std::string::npos);
    }
}

std::string nameAt(const std::string& name, int frame) {
    return name + (frame < 10 ? "_000" : "_00") + std::to_string(frame);
}

Image<glm::vec4> exrAt(const fs::path& folder, const std::string& name, int frame) {
    return readExr(folder / (nameAt(name, frame) + ".exr"), {"R", "G", "B"});
}

/// An export of a scene whose light is dimmed, and denoised frames of it, in folders of their own.
struct Denoised {
    TemporaryFolder folder;
    fs::path noise = folder / "noise", svgf = folder / "render";

    Denoised() {
        Words words{"render", "tiny", "--size", "61x37"};
        words.insert(words.end(), kRun.begin(), kRun.end());
        checkDone(run(words, {"--export", "--out", noise.string()}));
        checkDone(run(words, {"--filter", "svgf", "--aov", "filtered,color,albedo,emission,raw",
                              "--out", svgf.string()}));
    }

    /// Writes one picture a frame into a folder.
    template <class MakeFrame>
    std::string frames(const std::string& name, MakeFrame make) const {
        fs::create_directories(folder / name);
        for (int frame = 0; frame < kFrames; ++frame)
            make(frame, folder / name / nameAt("x", frame));
        return folder / name;
    }
    std::string copies(const std::string& name, const fs::path& from, const std::string& image,
                       const std::string& ending) const {
        return frames(name, [&](int frame, const fs::path& stem) {
            fs::copy_file(from / (nameAt(image, frame) + ending), stem.string() + ending);
        });
    }
    std::string signal() const { return copies("signal", svgf, "filtered", ".exr"); }

    Words words(const std::string& frames, const std::string& name, const std::string& out) const {
        return {"import-frames",  noise,   frames,      "--name", name, "--spp", "16", "--cache",
                folder / "cache", "--out", folder / out};
    }
    Run import(const std::string& frames, const std::string& name, const std::string& out,
               const Words& more = {}) const {
        return run(words(frames, name, out), more);
    }
    nlohmann::json read(const std::string& file) const {
        return nlohmann::json::parse(bytesOf(folder / file));
    }
    std::vector<std::string> variants(const std::string& out) const {
        const nlohmann::json account = read(out + "/experiment.json");
        std::vector<std::string> names;
        for (const auto& variant : account.at("experiment").at("variants"))
            names.push_back(variant.at("name"));
        return names;
    }
};

/// How far the measures of two variants of a run are from each other at most, over all frames. Both
/// must have all of them.
class Distance {
public:
    Distance(const fs::path& folder, std::string left, std::string right)
        : table_(MetricsTable::parse(bytesOf(folder / "metrics.csv"), "metrics.csv")),
          left_(std::move(left)), right_(std::move(right)) {}

    double of(std::string_view metric) const {
        const auto left = table_.curve(left_, metric, kFrames);
        const auto right = table_.curve(right_, metric, kFrames);
        double largest = 0.0;
        int found = 0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            CHECK(left[i].has_value() == right[i].has_value());
            if (!left[i] || !right[i])
                continue;
            ++found;
            if (*left[i] != *right[i]) // infinite minus infinite is no number
                largest = std::max(largest, std::abs(*left[i] - *right[i]));
        }
        CHECK(found > 0);
        return largest;
    }

private:
    MetricsTable table_;
    std::string left_, right_;
};

const std::vector<std::string> kLinear{"rmse",    "relmse",         "temporal_error",
                                       "noise",   "response",       "response_before",
                                       "flicker", "trail_response", "ghost_energy"};
const std::vector<std::string> kDisplay{"psnr", "ssim", "flip"};

} // namespace

TEST_CASE("a filter's own frames, imported, score exactly as the filter did") {
    const Denoised d;
    const std::string signal = d.signal();
    const std::string pfm = d.frames("pfm", [&](int frame, const fs::path& stem) {
        writePfm(stem.string() + ".pfm", exrAt(d.svgf, "filtered", frame), 3);
    });
    const std::string lit = d.frames("lit", [&](int frame, const fs::path& stem) {
        Image<glm::vec4> image = exrAt(d.svgf, "filtered", frame);
        const auto albedo = exrAt(d.svgf, "albedo", frame);
        for (std::size_t i = 0; i < image.pixels().size(); ++i)
            image.pixels()[i] *= albedo.pixels()[i];
        writeExr(stem.string() + ".exr", image, 3);
    });
    const std::string color = d.copies("color", d.svgf, "color", ".exr");
    const std::string png = d.copies("png", d.svgf, "color", ".png");
    checkDone(d.import(signal, "e-signal", "out", {"--filter", "svgf"}));
    checkDone(d.import(pfm, "e-pfm", "out", {"--filter", "svgf", "--quantity", "signal"}));
    checkDone(d.import(lit, "e-lit", "out", {"--filter", "svgf", "--quantity", "lit"}));
    checkDone(d.import(color, "e-color", "out", {"--filter", "svgf", "--quantity", "color"}));
    const Run last = d.import(png, "e-png", "out", {"--filter", "svgf"});
    checkDone(last);
    CHECK(last.out.find("by its display") != std::string::npos);
    CHECK(d.variants("out") ==
          std::vector<std::string>{"svgf", "e-signal", "e-pfm", "e-lit", "e-color", "e-png"});

    for (const char* name : {"e-signal", "e-pfm"}) {
        CAPTURE(name);
        const Distance distance(d.folder / "out", "svgf", name);
        for (const auto* metrics : {&kLinear, &kDisplay})
            for (const std::string& metric : *metrics) {
                CAPTURE(metric);
                CHECK(distance.of(metric) == 0.0);
            }
        for (int frame = 0; frame < kFrames; ++frame)
            CHECK((bytesOf(d.folder / ("out/svgf/" + nameAt("frame", frame) + ".png")) ==
                   bytesOf(d.folder /
                           ("out/" + std::string(name) + "/" + nameAt("frame", frame) + ".png"))));
    }
    // color - emission, and dividing by albedo to show it, round in the last bit; where that tips
    // one of 2257 pixels over to the next of 255 levels, PSNR moves by some thousandths.
    for (const char* name : {"e-lit", "e-color"}) {
        CAPTURE(name);
        const Distance distance(d.folder / "out", "svgf", name);
        for (const std::string& metric : kLinear) {
            CAPTURE(metric);
            CHECK(distance.of(metric) <= (std::string(name) == "e-lit" ? 0.0 : 1e-6));
        }
        CHECK(distance.of("psnr") < 0.01);
        CHECK(distance.of("ssim") < 1e-4);
        CHECK(distance.of("flip") < 1e-4);
    }
    // A display image is the display image; back in linear light its steps of 1/255 are at most
    // 0.03 where the tone curve is flat, and average out.
    const Distance distance(d.folder / "out", "svgf", "e-png");
    for (const std::string& metric : kDisplay)
        CHECK(distance.of(metric) == 0.0);
    for (const std::string& metric : kLinear) {
        CAPTURE(metric);
        CHECK(distance.of(metric) > 0.0);
        CHECK(distance.of(metric) < 2e-3);
    }

    const auto summary = d.read("out/summary.json").at("variants");
    for (const auto& [key, value] : summary.at("e-signal").items()) {
        CAPTURE(key);
        const bool isControl =
            key.find("alpha") == 0 || key == "rays_per_frame" || key == "invalid_values";
        CHECK((isControl ? value.is_null() : value == summary.at("svgf").at(key)));
    }
    CHECK(summary.at("e-signal").at("ghost_frames") > 0.0);
    CHECK(d.read("out/timing.json").at("variants").at("e-signal").at("ms_per_frame").is_null());
    CHECK_FALSE(d.read("out/experiment.json").at("settings").contains("e-signal"));
    CHECK(d.read("out/e-png/import.json").at("quantity") == "display");
}

TEST_CASE("the exported noise is what the filters get, and scores as no filter at all") {
    const Denoised d;
    Words words{"render",   "tiny",           "--size", "61x37",
                "--filter", "none",           "--aov",  "raw,albedo,depth,motion",
                "--out",    d.folder / "none"};
    words.insert(words.end(), kRun.begin(), kRun.end());
    checkDone(run(words));
    for (const char* aov : {"raw", "albedo", "depth", "motion"})
        for (int frame = 0; frame < kFrames; ++frame) {
            const std::string file = nameAt(aov, frame) + ".exr";
            CAPTURE(file);
            CHECK((bytesOf(d.noise / file) == bytesOf(d.folder / ("none/" + file))));
        }
    CHECK(filesIn(d.noise).size() == 7 * kFrames + 1);
    for (int frame = 0; frame < kFrames; ++frame) {
        const std::string file = nameAt("raw", frame) + ".exr";
        CHECK((bytesOf(d.noise / file) == bytesOf(d.svgf / file)));
    }

    const std::string raw = d.copies("raw", d.noise, "raw", ".exr");
    checkDone(d.import(raw, "nothing", "out", {"--filter", "none"}));
    const Distance distance(d.folder / "out", "none", "nothing");
    for (const auto* metrics : {&kLinear, &kDisplay})
        for (const std::string& metric : *metrics)
            CHECK(distance.of(metric) == 0.0);

    // Light where a surface reflects none is an error, and counts.
    const std::string leaked = d.frames("leaked", [&](int frame, const fs::path& stem) {
        Image<glm::vec4> image = exrAt(d.noise, "raw", frame);
        const auto albedo = exrAt(d.noise, "albedo", frame);
        const auto emission = exrAt(d.noise, "emission", frame);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            image.pixels()[i] = image.pixels()[i] * albedo.pixels()[i] + emission.pixels()[i];
            if (emission.pixels()[i].x > 0.0f)
                image.pixels()[i] += 1.0f;
        }
        writeExr(stem.string() + ".exr", image, 3);
    });
    checkDone(d.import(leaked, "leaked", "out", {"--filter", "none", "--quantity", "color"}));
    const auto summary = d.read("out/summary.json").at("variants");
    CHECK(summary.at("leaked").at("rmse_settled").get<double>() >
          1.2 * summary.at("nothing").at("rmse_settled").get<double>());
}

TEST_CASE("cameras, depth and motion of an export fit together") {
    const TemporaryFolder folder;
    const std::string file = folder.write("pan.json", R"({
    "name": "pan", "scene": "tiny", "size": [61, 37], "frames": 5, "variants": ["svgf"],
    "timeline": [{ "frame": 1, "until": 5,
                   "camera": { "eye": [1, 1.5, 3.9], "target": [0.2, 0.5, 0] } }]})");
    const std::string out = folder / "noise";
    checkDone(run({"render", file, "--export", "--aov", "position", "--out", out}));
    const auto json = nlohmann::json::parse(bytesOf(out + "/export.json"));
    const auto matrix = [&](int frame, const char* name) {
        const auto& rows = json.at("frames").at(std::size_t(frame)).at("camera").at(name);
        glm::mat4 m;
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column)
                m[column][row] = rows.at(std::size_t(row)).at(std::size_t(column));
        return m;
    };
    const glm::vec2 size(kSize);
    int checked = 0;
    float largestMotion = 0.0f;
    for (int frame = 1; frame < 5; ++frame) {
        const auto at = [&](const char* name, const std::vector<std::string>& channels) {
            return readExr(out + "/" + nameAt(name, frame) + ".exr", channels);
        };
        const auto depth = at("depth", {"Y"}), before = at("previous_depth", {"Y"});
        const auto motion = at("motion", {"X", "Y"}), position = at("position", {"X", "Y", "Z"});
        const glm::mat4 view = matrix(frame, "view_from_world");
        const glm::mat4 clip = matrix(frame, "clip_from_view");
        const glm::mat4 viewBefore = matrix(frame - 1, "view_from_world");
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x) {
                const float z = depth({x, y}).x;
                if (z == 0.0f) {
                    CHECK(before({x, y}).x == 0.0f);
                    continue;
                }
                const glm::vec2 pixel = glm::vec2(x, y) + 0.5f;
                const glm::vec2 ndc = glm::vec2(2.0f, -2.0f) * pixel / size - glm::vec2(1, -1);
                const glm::vec4 seen(ndc.x * z / clip[0][0], ndc.y * z / clip[1][1], -z, 1.0f);
                const glm::vec4 world = glm::inverse(view) * seen;
                const glm::vec4 was = viewBefore * world;
                const glm::vec4 c = clip * was;
                const glm::vec2 moved =
                    (glm::vec2(0.5f, -0.5f) * glm::vec2(c) / c.w + 0.5f) * size - pixel;
                // 32-bit floats at 5 m and 61 pixels: about 1e-5
                CHECK(glm::distance(glm::vec3(world), glm::vec3(position({x, y}))) < 1e-3f);
                CHECK(glm::distance(moved, glm::vec2(motion({x, y}))) < 5e-3f);
                CHECK(std::abs(-was.z - before({x, y}).x) < 1e-3f);
                largestMotion = std::max(largestMotion, glm::length(moved));
                ++checked;
            }
    }
    CHECK(checked > 61 * 37);
    CHECK(largestMotion > 1.0f);
    CHECK(json.at("experiment").at("variants").at(0).at("name") == "svgf");
}

TEST_CASE("a second denoiser stands beside the first, and the run can be told again") {
    const Denoised d;
    const std::string signal = d.signal();
    const std::string raw = d.copies("raw", d.noise, "raw", ".exr");
    checkDone(d.import(signal, "one", "out", {"--only"}));
    CHECK(d.variants("out") == std::vector<std::string>{"one"});
    const auto first = d.read("out/summary.json").at("variants").at("one");
    checkDone(d.import(raw, "two", "out", {"--filter", "fixed"}));
    CHECK(d.variants("out") == std::vector<std::string>{"fixed", "one", "two"});
    CHECK(d.read("out/summary.json").at("variants").at("one") == first);
    // Imported again it is measured again, and is not there twice.
    checkDone(d.import(raw, "one", "out", {"--only"}));
    CHECK(d.variants("out") == std::vector<std::string>{"two", "one"});
    CHECK_FALSE(fs::exists(d.folder / "out/fixed")); // its measures are no longer told
    auto summary = d.read("out/summary.json").at("variants");
    CHECK(summary.at("one") == summary.at("two"));

    // The experiment as a file: what is external is there, or it cannot be had.
    const std::string file =
        d.folder.write("again.json", d.read("out/experiment.json").at("experiment").dump());
    checkDone(run({"experiment", file, "--no-cache", "--fresh", "--out", d.folder / "out"}));
    CHECK(d.read("out/summary.json").at("variants") == summary);
    checkRefused(run({"experiment", file, "--no-cache", "--out", d.folder / "other"}), 3,
                 {"two", "other/two", "import-frames"});

    // With other references it is another run.
    Words words = d.words(signal, "three", "out");
    *(std::ranges::find(words, "16")) = "8";
    checkRefused(run(words, {"--only"}), 2, {"referenceSamples 16 and not 8", "--fresh"});
    CHECK(d.variants("out") == std::vector<std::string>{"two", "one"});
    checkDone(run(words, {"--only", "--fresh"}));
    CHECK(d.variants("out") == std::vector<std::string>{"three"});
    CHECK_FALSE(fs::exists(d.folder / "out/two"));

    // What another program has measured is left out.
    d.folder.write("out/three/timing.json", R"({"key": "another", "parts": []})");
    *(std::ranges::find(words, "three")) = "four";
    const Run left = run(words, {"--only"});
    CHECK(left.exitCode == 0);
    CHECK(left.err.find("out/three was measured by another program") != std::string::npos);
    CHECK(d.variants("out") == std::vector<std::string>{"four"});
}

TEST_CASE("frames that are not of the quantity that is said are told by their mean") {
    const Denoised d;
    const std::string color = d.copies("color", d.svgf, "color", ".exr");
    const Run wrong = d.import(color, "wrong", "out", {"--filter", "svgf"}); // as a signal
    CHECK(wrong.exitCode == 0);
    CAPTURE(wrong.err);
    CHECK(wrong.err.starts_with("warning: wrong: its settled mean is 0."));
    CHECK(wrong.err.find('\n') == wrong.err.size() - 1); // once
    CHECK(wrong.err.find("the quantity signal?") != std::string::npos);
    CHECK(wrong.out.find("  mean ") != std::string::npos);
    const double mean = d.read("out/wrong/import.json").at("mean");
    CHECK(mean < 0.9);
    CHECK(mean > 0.1);
    CHECK(wrong.out.find(fmt::format("  {:.3f}  ", mean)) != std::string::npos);

    checkDone(d.import(color, "right", "out", {"--filter", "svgf", "--quantity", "color"}));
    // SVGF's own bias: README, "What looks wrong".
    CHECK(std::abs(d.read("out/right/import.json").at("mean").get<double>() - 1.0) < 0.05);
    CHECK_FALSE(d.read("out/summary.json").at("variants").at("right").contains("mean"));
}

TEST_CASE("frames that cannot be measured are refused by name, and nothing is written") {
    const Denoised d;
    const std::string signal = d.signal();
    const auto damaged = [&](const std::string& name, auto damage) {
        fs::copy(signal, d.folder / name);
        damage(fs::path(d.folder / name));
        return (d.folder / name).string();
    };
    const auto refused = [&](const std::string& frames, const std::vector<std::string>& mentioned,
                             const Words& more = {}) {
        checkRefused(d.import(frames, "mine", "out", more), 3, mentioned);
        CHECK_FALSE(fs::exists(d.folder / "out"));
    };
    refused(d.folder / "nowhere", {"nowhere: cannot be read"});
    refused(damaged("gap", [](const fs::path& f) { fs::remove(f / "x_0007.exr"); }),
            {"gap: frame 7 is missing", "13"});
    refused(
        damaged("twice", [](const fs::path& f) { fs::copy(f / "x_0007.exr", f / "y_0007.exr"); }),
        {"twice/y_0007.exr: this is frame 7, and so is x_0007.exr"});
    refused(damaged("small",
                    [](const fs::path& f) {
                        writeExr(f / "x_0003.exr", Image<glm::vec4>({60, 37}), 3);
                    }),
            {"small/x_0003.exr: is 60x37; the exported frames are 61x37"});
    refused(damaged("nan",
                    [](const fs::path& f) {
                        Image<glm::vec4> image(kSize);
                        image({5, 36}).y = std::numeric_limits<float>::quiet_NaN();
                        writeExr(f / "x_0013.exr", image, 3);
                    }),
            {"nan/x_0013.exr: pixel (5, 36) holds a value that is not finite"});
    refused(
        damaged("gray",
                [](const fs::path& f) { writeExr(f / "x_0000.exr", Image<glm::vec4>(kSize), 1); }),
        {"gray/x_0000.exr: has no channel named R"});
    refused(damaged("mixed",
                    [](const fs::path& f) {
                        fs::remove(f / "x_0009.exr");
                        writePng(f / "x_0009.png", Image<glm::u8vec4>(kSize));
                    }),
            {"mixed/x_0009.png: PNG and linear frames cannot be mixed"});
    refused(signal, {"signal: frame 0 is missing"}, {"--quantity", "display"});
    refused(damaged("half", [](const fs::path& f) { fs::resize_file(f / "x_0002.exr", 400); }),
            {"half/x_0002.exr: is not a whole EXR"});

    fs::rename(d.noise / "export.json", d.noise / "kept.json");
    refused(signal, {"noise/export.json"});
    const std::pair<const char*, std::string> spoilt[] = {
        {"{", "noise/export.json:1: this is not JSON"},
        {"{}", "noise/export.json: \"experiment\" is missing"},
        {"[]", "noise/export.json: expected an object, found a list of 0"},
        {R"({"experiment": {"name": "x"}})",
         "noise/export.json: experiment: \"scene\" is missing"}};
    for (const auto& [text, cause] : spoilt) {
        d.folder.write("noise/export.json", text);
        refused(signal, {cause});
    }
}

TEST_CASE("wrong words about exports and imports are refused with exit code 2") {
    const TemporaryFolder folder;
    const auto exported = [&](const std::string& what, const Words& more,
                              const std::vector<std::string>& mentioned) {
        Words words{"render", what, "--export", "--out", folder / "out"};
        checkRefused(run(words, more), 2, mentioned);
        CHECK_FALSE(fs::exists(folder / "out"));
    };
    exported("tiny", {"--spp", "4"}, {"--export", "--spp"});
    exported("tiny", {"--every", "4"}, {"--export", "--every"});
    exported("tiny", {"--last"}, {"--export", "--last"});
    exported("tiny", {"--set", "alpha=0.1"}, {"--export", "--set"});
    exported("tiny", {"--filter", "svgf"}, {"--filter svgf", "none"});
    exported("tiny", {"--aov", "lambda"}, {"--aov lambda", "none"});
    exported("tiny", {"--light", "kye=off@3"}, {"'kye'", "did you mean 'key'?"});
    exported("tiny", {"--camera", "nobody"}, {"camera", "'nobody'"});
    exported("light-off", {"--light", "key=off@3"}, {"--light", "light-off is an experiment"});
    exported("light-off", {"--animate"}, {"--animate", "light-off is an experiment"});
    exported("light-offf", {}, {"'light-offf'"});

    checkDone(run({"render", "tiny", "--export", "--size", "8x8", "--frames", "2", "--out",
                   folder / "noise"}));
    const auto imported = [&](const std::string& name, const Words& more,
                              const std::vector<std::string>& mentioned) {
        Words words{"import-frames", folder / "noise", folder / "noise", "--name", name,
                    "--out",         folder / "out"};
        checkRefused(run(words, more), 2, mentioned);
        CHECK_FALSE(fs::exists(folder / "out"));
    };
    imported("mine", {"--quantity", "colr"}, {"'colr'", "did you mean 'color'?"});
    imported("a b", {}, {"--name", "'a b'"});
    imported("../x", {}, {"--name", "'../x'"});
    imported("asvgf", {}, {"--name asvgf", "of our own"});
    imported("reference", {}, {"--name reference", "of our own"});
    imported("mine", {"--only", "--filter", "svgf"}, {"--only", "--filter"});
    imported("mine", {"--filter", "svfg"}, {"'svfg'", "did you mean 'svgf'?"});
    imported("mine", {"--spp", "0"}, {"--spp"});
    imported("mine", {"--cache", "x", "--no-cache"}, {"--cache", "--no-cache"});
}

} // namespace afterglow::test
