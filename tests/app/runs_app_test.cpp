// SPDX-License-Identifier: MIT
// Runs that are interrupted, split, repeated and compared.

#include "program.h"

#include "renderer/image/image_io.h"
#include "tests/support/source_dir.h"

#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace afterglow::test {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Everything that can happen, in few pixels: a light goes out, the mover glides, the camera jumps.
std::string eventful(const TemporaryFolder& folder, const std::string& name = "eventful") {
    return folder.write(name + ".json", R"({
    "name": ")" + name + R"(", "scene": "moving", "size": [61, 37], "frames": 32, "seed": 5,
    "variants": ["fixed", "asvgf"], "referenceSamples": 16, "settledWindow": 6,
    "timeline": [{ "frame": 9, "light": "key", "power": 0.5 },
                 { "frame": 15, "until": 19, "node": "mover", "by": [0.4, 0, 0] },
                 { "frame": 27, "camera": { "eye": [1, 1.5, 4], "target": [0, 0.5, 0] } }]})");
}

Words experimentWords(const Words& what, const std::string& out) {
    Words words{"experiment"};
    words.insert(words.end(), what.begin(), what.end());
    for (const char* word : {"--context", "osmesa", "--no-cache", "--out"})
        words.push_back(word);
    words.push_back(out);
    return words;
}

Run experiment(const Words& what, const std::string& out) {
    return afterglow(experimentWords(what, out));
}

// Asks a run to end as soon as it has begun to write, and returns its last words.
std::string interruptRun(const Words& what, const std::string& out) {
    std::string command = "\"$AFTERGLOW_BIN\"";
    for (const std::string& word : experimentWords(what, out))
        command += " '" + word + "'";
    command += " >/dev/null 2>'" + out + ".err' & while kill -0 $! && [ ! -e '" + out +
               "/unfinished.json' ]; do sleep 0.05; done; kill -TERM $!; wait $!";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 130);
    return bytesOf(out + ".err");
}

void checkSameRun(const fs::path& a, const fs::path& b) {
    const std::vector<std::string> files = filesIn(a);
    CHECK(files == filesIn(b));
    int compared = 0;
    for (const std::string& file : files)
        if (!tellsTimes(file)) {
            CAPTURE(file);
            CHECK((bytesOf(a / file) == bytesOf(b / file)));
            ++compared;
        }
    CHECK(compared > 60);
}

std::map<std::string, std::string> filesAndBytes(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const std::string& file : filesIn(folder))
        files[file] = bytesOf(folder / file);
    return files;
}

nlohmann::json summaryIn(const fs::path& folder) {
    return nlohmann::json::parse(bytesOf(folder / "summary.json")).at("variants");
}

} // namespace

TEST_CASE("the parts of a run, merged, are the run, byte for byte but for times") {
    const TemporaryFolder folder;
    const std::string file = eventful(folder);
    REQUIRE(experiment({file}, folder / "whole").exitCode == 0);
    Words merge{"merge"};
    for (const char* part : {"3", "1", "2"}) { // in any order
        const std::string out = folder / ("part" + std::string(part));
        const Run run = experiment({file, "--part", std::string(part) + "/3"}, out);
        CAPTURE(run.err);
        REQUIRE(run.exitCode == 0);
        CHECK_FALSE(fs::exists(fs::path(out) / "summary.json"));
        merge.push_back(out);
    }
    Words missing = merge;
    missing.erase(missing.begin() + 2);
    missing.insert(missing.end(), {"--out", folder / "merged"});
    const Run incomplete = afterglow(missing);
    CHECK(incomplete.exitCode == 3);
    CHECK(isOneErrorLine(incomplete.err));
    CHECK(incomplete.err.find("part 1 of 3 is missing") != std::string::npos);

    merge.insert(merge.end(), {"--out", folder / "merged"});
    const Run run = afterglow(merge);
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    checkSameRun(folder / "whole", folder / "merged");

    // The whole run does not make room for another one, unless it is told to.
    Words into = merge;
    into.back() = folder / "other";
    REQUIRE(experiment({file, "--spp", "4"}, folder / "other").exitCode == 0);
    const Run refused = afterglow(into);
    CAPTURE(refused.err);
    CHECK(refused.exitCode == 2);
    CHECK(refused.err.find("referenceSamples 4 and not 16; --fresh replaces it") !=
          std::string::npos);
    into.push_back("--fresh");
    REQUIRE(afterglow(into).exitCode == 0);
    checkSameRun(folder / "whole", folder / "other");

    // A part of another run is refused by name.
    REQUIRE(
        experiment({file, "--part", "1/3", "--spp", "8", "--fresh"}, folder / "part1").exitCode ==
        0);
    const Run mixed = afterglow(merge);
    CHECK(mixed.exitCode == 3);
    CHECK(isOneErrorLine(mixed.err));
    CHECK(mixed.err.find("part1/experiment.json: this is a part of another run than") !=
          std::string::npos);
}

TEST_CASE("a run of a file that is gone can be merged and reported") {
    const TemporaryFolder folder;
    const std::string scene = folder / "scene.gltf";
    fs::copy_file(sourceDir() / "assets/scenes/cornell.gltf", scene);
    const std::string file = folder.write("own.json", R"({
    "name": "own", "scene": "./scene.gltf", "size": [61, 37], "frames": 8, "variants": ["fixed"],
    "timeline": [{"frame": 4, "light": "key", "on": false}],
    "referenceSamples": 16, "settledWindow": 2})");
    REQUIRE(experiment({file}, folder / "whole").exitCode == 0);
    REQUIRE(experiment({file, "--part", "1/2"}, folder / "part1").exitCode == 0);
    REQUIRE(experiment({file, "--part", "2/2"}, folder / "part2").exitCode == 0);
    fs::remove(scene);

    const Run merged =
        afterglow({"merge", folder / "part1", folder / "part2", "--out", folder / "merged"});
    CAPTURE(merged.err);
    REQUIRE(merged.exitCode == 0);
    for (const std::string name : {"experiment.json", "summary.json", "metrics.csv"})
        CHECK(bytesOf(folder / ("whole/" + name)) == bytesOf(folder / ("merged/" + name)));
    fs::remove(folder / "merged/report.html");
    CHECK(afterglow({"report", folder / "merged"}).exitCode == 0);
    CHECK(fs::exists(folder / "merged/report.html"));
}

TEST_CASE("a run that was interrupted leaves no half file and goes on where it was") {
    const TemporaryFolder folder;
    const std::string file = eventful(folder);
    REQUIRE(experiment({file}, folder / "whole").exitCode == 0);

    // The first variant is made, the second is then stopped in its middle.
    REQUIRE(experiment({file, "--filter", "fixed"}, folder / "cut").exitCode == 0);
    const auto made = fs::last_write_time(folder / "cut/fixed/frame_0003.png");
    fs::remove(folder / "cut/experiment.json");
    fs::remove(folder / "cut/summary.json");
    CHECK(interruptRun({file, "--spp", "1000000"}, folder / "long") ==
          "afterglow: interrupted; the same command goes on from here\n");
    CHECK_FALSE(fs::exists(folder / "long/summary.json"));
    if (fs::exists(folder / "long"))
        for (const std::string& name : filesIn(folder / "long")) {
            CAPTURE(name);
            const bool isWhole =
                name.ends_with(".png") || name.ends_with(".json") || name.ends_with(".csv");
            CHECK(isWhole);
        }

    REQUIRE(experiment({file}, folder / "cut").exitCode == 0);
    checkSameRun(folder / "whole", folder / "cut");
    CHECK(fs::last_write_time(folder / "cut/fixed/frame_0003.png") == made);

    // What is finished is told again and not made again, unless that is asked for.
    const auto before = fs::last_write_time(folder / "cut/asvgf/frame_0003.png");
    const Run again = experiment({file}, folder / "cut");
    CHECK(again.exitCode == 0);
    CHECK(again.out.find("asvgf") != std::string::npos);
    CHECK(fs::last_write_time(folder / "cut/asvgf/frame_0003.png") == before);
    REQUIRE(experiment({file, "--fresh"}, folder / "cut").exitCode == 0);
    CHECK(fs::last_write_time(folder / "cut/asvgf/frame_0003.png") != before);
}

TEST_CASE("a folder that holds another run is refused and untouched; --fresh replaces it") {
    const TemporaryFolder folder;
    const std::string a = eventful(folder, "first"), b = eventful(folder, "second");
    const std::string out = folder / "out";
    const Words small{"--frames", "12", "--spp", "4"};
    const auto run = [&](Words what) {
        what.insert(what.end(), small.begin(), small.end());
        return experiment(what, out);
    };
    const auto checkRefused = [&](const Run& refused, const std::vector<std::string>& mentioned) {
        CAPTURE(refused.err);
        CHECK(refused.exitCode == 2);
        CHECK(isOneErrorLine(refused.err));
        for (const std::string& text : mentioned)
            CHECK(refused.err.find(text) != std::string::npos);
    };
    REQUIRE(run({a}).exitCode == 0);
    const auto before = filesAndBytes(out);
    checkRefused(run({b}), {out, "a run of first", "second", "--fresh"});
    checkRefused(run({a, "--size", "31x19"}), {"size [61,37] and not [31,19]", "--fresh"});
    checkRefused(run({a, "--set", "alpha=0.5"}), {"other variants", "--fresh"});
    checkRefused(run({a, "--filter", "fixed"}),
                 {R"(variants ["fixed","asvgf"] and not ["fixed"])", "--fresh"});
    checkRefused(run({a, "--part", "1/2"}), {"the whole and not part 1 of 2", "--fresh"});
    checkRefused(run({a, b}), {"a run of first", "several runs", "--fresh"});
    checkRefused(afterglow({"sweep", a, "--over", "alpha=0.1,0.2", "--out", out}),
                 {"a run of first", "first-alpha", "--fresh"});
    CHECK((filesAndBytes(out) == before));
    REQUIRE(run({a}).exitCode == 0); // the very same is told again

    // Of what is replaced only the files of the run go.
    folder.write("out/notes.txt", "mine");
    folder.write("out/asvgf/notes.txt", "mine");
    REQUIRE(run({b, "--filter", "svgf", "--fresh"}).exitCode == 0);
    std::vector<std::string> expected{"asvgf/notes.txt", "notes.txt"};
    REQUIRE(experiment({b, "--filter", "svgf", "--frames", "12", "--spp", "4"}, folder / "alone")
                .exitCode == 0);
    for (const std::string& file : filesIn(folder / "alone"))
        expected.push_back(file);
    std::ranges::sort(expected);
    CHECK(filesIn(out) == expected);
    for (const std::string& file : filesIn(folder / "alone")) {
        CAPTURE(file);
        if (!tellsTimes(file))
            CHECK((bytesOf(out + "/" + file) == bytesOf(folder / ("alone/" + file))));
    }
    // With other variants the same experiment is replaced, too.
    REQUIRE(run({b, "--filter", "fixed", "--fresh"}).exitCode == 0);
    CHECK_FALSE(fs::exists(out + "/svgf"));
    CHECK(summaryIn(out).size() == 1);
}

TEST_CASE("folders of runs and a run exclude each other; runs in folders of their own do not") {
    const TemporaryFolder folder;
    const std::string a = eventful(folder, "first"), b = eventful(folder, "second"),
                      c = eventful(folder, "third");
    const std::string out = folder / "out";
    const auto run = [&](Words what) {
        what.insert(what.end(), {"--frames", "12", "--spp", "4", "--filter", "fixed"});
        return experiment(what, out);
    };
    REQUIRE(run({a, b}).exitCode == 0);
    const auto before = filesAndBytes(out);
    for (const Words& what : {Words{a}, Words{c}}) {
        const Run refused = run(what);
        CAPTURE(refused.err);
        CHECK(refused.exitCode == 2);
        CHECK(isOneErrorLine(refused.err));
        CHECK(refused.err.find("folders of runs (first, ...)") != std::string::npos);
    }
    // One of several is another: none is begun.
    const Run other = experiment({c, b, "--frames", "12", "--spp", "8"}, out);
    CAPTURE(other.err);
    CHECK(other.exitCode == 2);
    CHECK(other.err.find(out + "/second: holds another run of second") != std::string::npos);
    CHECK((filesAndBytes(out) == before));

    REQUIRE(run({c, b}).exitCode == 0); // a third stands beside the two
    CHECK(fs::exists(out + "/first/summary.json"));
    CHECK(fs::exists(out + "/third/summary.json"));
    REQUIRE(run({c, "--fresh"}).exitCode == 0);
    for (const char* name : {"first", "second", "third"})
        CHECK_FALSE(fs::exists(out + "/" + name));
    CHECK(summaryIn(out).size() == 1);
    REQUIRE(run({a, b, "--fresh"}).exitCode == 0);
    CHECK_FALSE(fs::exists(out + "/experiment.json"));
    CHECK_FALSE(fs::exists(out + "/fixed"));
}

TEST_CASE("a run that was interrupted keeps its folder") {
    const TemporaryFolder folder;
    const std::string a = eventful(folder, "first"), b = eventful(folder, "second");
    const std::string out = folder / "out";
    interruptRun({a, "--spp", "1000000"}, out);
    CHECK(filesIn(out) == std::vector<std::string>{"unfinished.json"});
    const Run other = experiment({b}, out);
    CHECK(other.exitCode == 2);
    CHECK(other.err.find("a run of first") != std::string::npos);
    REQUIRE(experiment({b, "--frames", "4", "--fresh"}, out).exitCode == 0);
    CHECK_FALSE(fs::exists(out + "/unfinished.json"));
}

TEST_CASE("references are kept in the cache that is named, and give the same bytes from there") {
    const TemporaryFolder folder;
    const std::string file = eventful(folder), cache = folder / "cache";
    const auto run = [&](const std::string& out, const Words& more) {
        Words words{"experiment", file, "--context", "osmesa", "--out", out};
        words.insert(words.end(), more.begin(), more.end());
        return afterglow(words);
    };
    REQUIRE(run(folder / "plain", {"--no-cache"}).exitCode == 0);
    REQUIRE(run(folder / "first", {"--cache", cache}).exitCode == 0);
    const auto entries = filesIn(cache);
    // 7 moments; what lit the surfaces of the 4 frames in which the mover moves, a frame before
    CHECK(entries.size() == 2 * (7 + 4));
    REQUIRE(run(folder / "second", {"--cache", cache}).exitCode == 0);
    CHECK(filesIn(cache) == entries);
    checkSameRun(folder / "plain", folder / "first");
    checkSameRun(folder / "plain", folder / "second");
    const Run both = run(folder / "x", {"--cache", cache, "--no-cache"});
    CHECK(both.exitCode == 2);
}

TEST_CASE("several experiments get a folder each and one page") {
    const TemporaryFolder folder;
    const std::string a = eventful(folder, "first"), b = eventful(folder, "second");
    const Run run = experiment({a, b, "--frames", "12"}, folder / "suite");
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    for (const char* name : {"first", "second"})
        CHECK(fs::exists(folder / ("suite/" + std::string(name) + "/summary.json")));
    const std::string page = bytesOf(folder / "suite/report.html");
    CHECK(page.find("first") != std::string::npos);
    CHECK(page.find("second") != std::string::npos);
    CHECK(experiment({a, a}, folder / "twice").exitCode == 2);

    fs::remove(folder / "suite/report.html");
    REQUIRE(afterglow({"report", folder / "suite"}).exitCode == 0);
    CHECK((bytesOf(folder / "suite/report.html") == page));
    const Run nothing = afterglow({"report", folder / "empty"});
    CHECK(nothing.exitCode == 3);
    CHECK(isOneErrorLine(nothing.err));
}

TEST_CASE("a sweep runs every variant with every value, and lag falls where noise rises") {
    const TemporaryFolder folder;
    const std::string file = folder.write("off.json", R"({
    "name": "off", "scene": "tiny", "size": [61, 37], "frames": 72, "signal": "shadows",
    "variants": ["fixed", "asvgf"], "referenceSamples": 64, "settledWindow": 12,
    "timeline": [{ "frame": 30, "light": "key", "on": false }]})");
    const Run run = afterglow({"sweep", file, "--over", "alpha=0.1,0.2,0.4", "--context", "osmesa",
                               "--no-cache", "--out", folder / "out"});
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    const auto variants = summaryIn(folder / "out");
    REQUIRE(variants.size() == 6);
    CHECK(variants.at("fixed-alpha-0.1").at("sweep") ==
          nlohmann::json({{"variant", "fixed"}, {"key", "alpha"}, {"value", "0.1"}}));
    const auto of = [&](const std::string& name, const char* key) {
        return variants.at(name).at(key).get<double>();
    };
    // 0.9^22, 0.8^11 and 0.6^5 are the first powers below 0.1.
    CHECK(of("fixed-alpha-0.1", "t90") == 21);
    CHECK(of("fixed-alpha-0.2", "t90") == 10);
    CHECK(of("fixed-alpha-0.4", "t90") == 4);
    CHECK(of("fixed-alpha-0.1", "rmse_settled") < of("fixed-alpha-0.2", "rmse_settled"));
    CHECK(of("fixed-alpha-0.2", "rmse_settled") < of("fixed-alpha-0.4", "rmse_settled"));
    for (const char* value : {"0.1", "0.2", "0.4"})
        CHECK(of(std::string("asvgf-alpha-") + value, "t90") <= 1);
    CHECK(afterglow({"sweep", file, "--over", "alhpa=1", "--out", folder / "x"}).exitCode == 2);
    CHECK(afterglow({"sweep", file, "--over", "alpha=7", "--out", folder / "x"}).exitCode == 2);
    CHECK_FALSE(fs::exists(folder / "x"));
}

} // namespace afterglow::test
