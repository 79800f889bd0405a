// SPDX-License-Identifier: MIT
#include "program.h"

#include <doctest/doctest.h>

namespace afterglow::test {

namespace {

const std::vector<std::string> kCommands{"view", "render", "experiment", "bench", "list"};

void checkRefused(const std::vector<std::string>& words, int exitCode,
                  const std::vector<std::string>& mentioned) {
    std::string line;
    for (const std::string& word : words)
        line += word + " ";
    CAPTURE(line);
    const Run run = afterglow(words);
    CAPTURE(run.err);
    CHECK(run.exitCode == exitCode);
    CHECK(run.out == "");
    CHECK(isOneErrorLine(run.err));
    for (const std::string& word : mentioned) {
        CAPTURE(word);
        CHECK(run.err.find(word) != std::string::npos);
    }
}

// A whole `render` command with these words at its end; what it is to write must not exist after
// it.
void checkRenderRefused(std::vector<std::string> words, int exitCode,
                        const std::vector<std::string>& mentioned, const char* scene = "tiny") {
    const TemporaryFolder folder;
    const std::string out = folder / "out";
    words.insert(words.begin(), {"render", scene, "--out", out, "--context", "osmesa"});
    checkRefused(words, exitCode, mentioned);
    CHECK(filesIn(out).empty());
}

} // namespace

TEST_CASE("help of the program and of every command ends well, with examples and exit codes") {
    const Run all = afterglow({"--help"});
    CHECK(all.exitCode == 0);
    CHECK(all.err == "");
    for (const std::string& command : kCommands) {
        CAPTURE(command);
        CHECK(all.out.find("\n  " + command) != std::string::npos);
        const Run run = afterglow({command, "--help"});
        CHECK(run.exitCode == 0);
        CHECK(run.err == "");
        CHECK(run.out.find("Examples:") != std::string::npos);
        CHECK(run.out.find("Exit codes:") != std::string::npos);
        CHECK(run.out.find("afterglow " + command) != std::string::npos);
    }
    const Run render = afterglow({"render", "--help"});
    for (const char* option :
         {"--filter", "--signal", "--frames", "--size", "--seed", "--context", "--light", "--aov",
          "--format", "--spp", "--set", "--animate", "--camera", "--every", "--last", "--out"}) {
        CAPTURE(option);
        CHECK(render.out.find(option) != std::string::npos);
    }
}

TEST_CASE("the version is told") {
    const Run run = afterglow({"--version"});
    CHECK(run.exitCode == 0);
    CHECK(run.out.starts_with("afterglow 0."));
}

TEST_CASE("a wrong word is refused with exit code 2 and the nearest right one") {
    checkRefused({}, 2, {"command", "view, render"});
    checkRefused({"rendr"}, 2, {"'rendr'", "did you mean 'render'?"});
    checkRefused({"render", "tiny", "--out", "x", "--fitler", "svgf"}, 2,
                 {"--fitler", "did you mean '--filter'?"});
    checkRefused({"render", "tiny", "more", "--out", "x"}, 2, {"'more'"});
    checkRefused({"render", "tiny"}, 2, {"--out"});
    checkRefused({"render", "--out", "x"}, 2, {"SCENE"});
    checkRefused({"list", "scense"}, 2, {"'scense'", "did you mean 'scenes'?"});
    checkRefused({"experiment", "light-of", "--out", "x"}, 2, {"'light-of'", "light-off"});
    checkRefused({"view", "tiny", "--screenshot", "x.png"}, 2, {"--frames"});
    checkRefused({"bench", "tiny", "--filter", "svgf,"}, 2, {"--filter"});
}

TEST_CASE("a wrong value is refused with exit code 2, and nothing is written") {
    checkRenderRefused({"--filter", "asvfg"}, 2, {"'asvfg'", "did you mean 'asvgf'?"});
    checkRenderRefused({"--signal", "shadow"}, 2, {"'shadow'", "shadows"});
    checkRenderRefused({"--context", "osmsa"}, 2, {});
    checkRenderRefused({"--aov", "lamda"}, 2, {"'lamda'", "did you mean 'lambda'?"});
    checkRenderRefused({"--aov", "lambda", "--filter", "svgf"}, 2, {"lambda", "svgf", "asvgf"});
    checkRenderRefused({"--format", "jpg"}, 2, {"'jpg'", "png, exr, pfm"});
    checkRenderRefused({"--light", "kye=off"}, 2, {"'kye'", "did you mean 'key'?"});
    checkRenderRefused({"--light", "key"}, 2, {"--light", "'key'"});
    checkRenderRefused({"--light", "key=dim"}, 2, {"key=dim"});
    checkRenderRefused({"--light", "key=-1"}, 2, {"key=-1"});
    checkRenderRefused({"--light", "key=nan"}, 2, {"key=nan"});
    checkRenderRefused({"--light", "key=off@x"}, 2, {"frame", "'x'"});
    checkRenderRefused({"--camera", "nobody"}, 2, {"camera", "'nobody'"});
    checkRenderRefused({"--set", "alhpa=0.1"}, 2, {"'alhpa'", "alpha"});
    checkRenderRefused({"--set", "alpha=7"}, 2, {"alpha"});
    checkRenderRefused({"--set", "alpha=often"}, 2, {"alpha", "often"});
    checkRenderRefused({"--set", "alpha"}, 2, {"--set", "KEY=VALUE"});
    checkRenderRefused({"--seed", "-1"}, 2, {"--seed", "'-1'"});
    checkRenderRefused({"--frames", "0"}, 2, {"--frames", "'0'"});
    checkRenderRefused({"--frames", "2.5"}, 2, {"--frames", "'2.5'"});
    checkRenderRefused({"--every", "0"}, 2, {"--every"});
    checkRenderRefused({"--every", "2", "--last"}, 2, {"--every", "--last"});
    checkRenderRefused({"--spp", "4", "--filter", "svgf"}, 2, {"--spp", "none"});
    checkRenderRefused({"--spp", "0", "--filter", "none"}, 2, {"--spp"});
    checkRenderRefused({"--filter"}, 2, {"--filter"});
}

TEST_CASE("no scene by that name is a wrong word; no such file is a bad file") {
    checkRenderRefused({}, 2, {"cornel", "did you mean", "cornell"}, "cornel");
    checkRenderRefused({}, 3, {"nowhere/box.glb"}, "nowhere/box.glb");
}

TEST_CASE("sizes that cannot be rendered are refused with exit code 2") {
    for (const char* size :
         {"0x0", "0x10", "10x0", "-4x4", "4x-4", "x", "10", "10x", "axb", "10x10x10", "16385x1",
          "1x16385", "16384x16384", "99999999999999999999x1", "1e3x10"}) {
        checkRenderRefused({std::string("--size=") + size}, 2, {"--size", size});
    }
}

TEST_CASE("a context that cannot be had is exit code 4") {
    const TemporaryFolder folder;
    const Run run = afterglow({"render", "tiny", "--size", "8x8", "--frames", "1", "--context",
                               "glfw", "--out", folder / "out"},
                              {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}});
    CAPTURE(run.err);
    CHECK(run.exitCode == 4);
    CHECK(isOneErrorLine(run.err));
    CHECK(filesIn(folder / "out").empty());
}

TEST_CASE("a device of EGL is chosen by its number in the list; any other is refused") {
    const Run list = afterglow({"list", "contexts"});
    CHECK(list.exitCode == 0);
    CHECK(list.out.find("\ndevice 0  ") != std::string::npos); // Mesa's own, where there is no GPU
    int count = 0;
    while (list.out.find("\ndevice " + std::to_string(count) + "  ") != std::string::npos)
        ++count;
    const std::string all = "EGL has " + std::to_string(count) + " device";
    const TemporaryFolder folder;
    const std::string out = folder / "out";
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"render", "tiny", "--out", out},
          {"experiment", "static", "--out", out},
          {"sweep", "static", "--over", "alpha=0.1", "--out", out},
          {"import-frames", "a", "b", "--name", "c", "--out", out},
          {"bench", "tiny"}}) {
        const auto with = [&](const std::vector<std::string>& words) {
            std::vector<std::string> line = command;
            line.insert(line.end(), words.begin(), words.end());
            return line;
        };
        checkRefused(with({"--device", std::to_string(count)}), 2, {all, "list contexts"});
        checkRefused(with({"--device", "-1", "--context", "egl"}), 2, {"--device", "'-1'"});
        checkRefused(with({"--device", "0", "--context", "osmesa"}), 2, {"--device 0", "osmesa"});
    }
    for (const char* context : {"egl", "auto"}) {
        const Run run = afterglow({"render", "tiny", "--size", "8x8", "--frames", "1", "--context",
                                   context, "--device", "0", "--out", out});
        CAPTURE(run.err);
        CHECK(run.exitCode == 0);
        CHECK(bytesOf(out + "/run.json").find("\"EGL\"") != std::string::npos);
    }
    CHECK(filesIn(out).size() == 2);
}

TEST_CASE("lists tell names and meanings") {
    const std::map<std::string, std::vector<std::string>> expected{
        {"scenes", {"hall", "cornell", "tiny"}},
        {"experiments", {"static", "light-off", "light-on", "fill-light"}},
        {"filters", {"none", "fixed", "svgf", "asvgf"}},
        {"aovs", {"color", "filtered", "lambda", "history", "alpha", "normal", "depth"}},
        {"contexts", {"auto", "osmesa", "egl", "glfw"}},
        {"settings", {"alpha"}},
        {"metrics", {"t90", "rmse", "rmse_settled", "ms_per_frame"}}};
    for (const auto& [kind, names] : expected) {
        CAPTURE(kind);
        const Run run = afterglow({"list", kind});
        CHECK(run.exitCode == 0);
        CHECK(run.err == "");
        for (const std::string& name : names) {
            CAPTURE(name);
            CHECK(("\n" + run.out).find("\n" + name + "  ") != std::string::npos);
        }
    }
}

} // namespace afterglow::test
