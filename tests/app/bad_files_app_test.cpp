// SPDX-License-Identifier: MIT
#include "program.h"

#include <doctest/doctest.h>

namespace afterglow::test {

namespace {

void checkBadScene(const TemporaryFolder& folder, const std::string& file,
                   const std::string& mentioned = "") {
    CAPTURE(file);
    const Run run = afterglow({"render", file, "--size", "8x8", "--frames", "1", "--context",
                               "osmesa", "--out", folder / "out"});
    CAPTURE(run.err);
    CHECK(run.exitCode == 3);
    CHECK(isOneErrorLine(run.err));
    CHECK(run.err.find(file) != std::string::npos);
    CHECK(run.err.find(mentioned) != std::string::npos);
    CHECK(run.out == "");
    CHECK(filesIn(folder / "out").empty());
}

std::string littleEndian(std::uint32_t value) {
    return {char(value), char(value >> 8), char(value >> 16), char(value >> 24)};
}

// One triangle whose corners are in a buffer at `uri`.
std::string triangleAt(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":")" +
           uri + R"("}]})";
}

} // namespace

TEST_CASE("a scene file that cannot be used is exit code 3 and one line that names it") {
    const TemporaryFolder folder;
    checkBadScene(folder, folder / "missing.gltf");
    checkBadScene(folder, folder / "missing.glb");
    checkBadScene(folder, folder.write("empty.gltf", ""));
    checkBadScene(folder, folder.write("empty.glb", ""));
    checkBadScene(folder, folder.write("text.gltf", "this is no scene\n"));
    checkBadScene(folder, folder.write("cut.gltf", R"({"asset": {"version": "2.0")"));
    checkBadScene(folder, folder.write("old.gltf", R"({"asset": {"version": "1.0"}})"));
    checkBadScene(folder, folder.write("bare.gltf", R"({"asset": {"version": "2.0"}})"));
    checkBadScene(folder, folder.write("words.glb", "this is no scene either\n"));
    const std::string header = "glTF" + littleEndian(2) + littleEndian(1000);
    checkBadScene(folder, folder.write("header.glb", header));
    checkBadScene(folder, folder.write("cut.glb", header + littleEndian(900) + "JSON{\"asset\":{"));
    std::filesystem::create_directories(folder / "folder.gltf");
    checkBadScene(folder, folder / "folder.gltf");
}

TEST_CASE("a scene file may not reach out of its folder") {
    const TemporaryFolder folder;
    const std::string outside = folder.write("secret.bin", std::string(36, '\0'));
    checkBadScene(folder, folder.write("scene/up.gltf", triangleAt("../secret.bin")),
                  "../secret.bin");
    checkBadScene(folder, folder.write("scene/absolute.gltf", triangleAt(outside)), outside);
    checkBadScene(folder, folder.write("scene/web.gltf", triangleAt("http://localhost/a.bin")),
                  "http:");
    checkBadScene(folder, folder.write("scene/none.gltf", triangleAt("none.bin")), "none.bin");
    std::filesystem::create_symlink(outside, folder / "scene/link.bin");
    checkBadScene(folder, folder.write("scene/link.gltf", triangleAt("link.bin")), "link.bin");
}

TEST_CASE("an experiment file that cannot be used is exit code 3 and one line that names it") {
    const TemporaryFolder folder;
    const auto checkBad = [&](const std::string& file, const std::string& mentioned) {
        CAPTURE(file);
        const Run run =
            afterglow({"experiment", file, "--out", folder / "out", "--context", "osmesa"});
        CAPTURE(run.err);
        CHECK(run.exitCode == 3);
        CHECK(isOneErrorLine(run.err));
        CHECK(run.err.find(std::filesystem::path(file).filename()) != std::string::npos);
        CHECK(run.err.find(mentioned) != std::string::npos);
        CHECK(filesIn(folder / "out").empty());
    };
    const auto with = [](const std::string& more) {
        return R"({"name": "mine", "scene": "tiny", "frames": 8, "variants": ["svgf"])" + more +
               "}";
    };
    checkBad(folder / "missing.json", "");
    checkBad(folder.write("empty.json", ""), "");
    checkBad(folder.write("cut.json", "{\"name\":"), "");
    checkBad(folder.write("list.json", "[1]"), "");
    checkBad(folder.write("key.json", with(R"(, "sede": 3)")), "sede");
    checkBad(folder.write("type.json", with(R"(, "seed": "x")")), "seed");
    checkBad(folder.write("frame.json",
                          with(R"(, "timeline": [{"frame": "x", "light": "key", "on": false}])")),
             "timeline[0].frame");
    checkBad(folder.write("variant.json",
                          R"({"name":"m","scene":"tiny","frames":8,"variants":["asvfg"]})"),
             "asvfg");
}

TEST_CASE("a light that the scene does not have is exit code 3 and names both") {
    const TemporaryFolder folder;
    const std::string file = folder.write(
        "lights.json", R"({"name": "lights", "scene": "tiny", "frames": 8, "variants": ["svgf"],
"timeline": [{"frame": 2, "light": "kye", "on": false}]})");
    const Run run = afterglow({"experiment", file, "--out", folder / "out", "--context", "osmesa"});
    CAPTURE(run.err);
    CHECK(run.exitCode == 3);
    CHECK(isOneErrorLine(run.err));
    CHECK(run.err.find("did you mean 'key'?") != std::string::npos);
}

TEST_CASE("an output folder that cannot be made is exit code 1 and one line that names it") {
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "not a folder");
    for (const std::string& out : {file, file + "/below"}) {
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"render", "tiny", "--size", "8x8", "--frames", "1"},
              std::vector<std::string>{"experiment", "static", "--size", "8x8", "--frames", "1",
                                       "--spp", "1"},
              std::vector<std::string>{"bench", "tiny", "--size", "8x8", "--frames", "4"}}) {
            std::vector<std::string> all = words;
            all.insert(all.end(), {"--context", "osmesa"});
            if (words.front() == "bench")
                all.insert(all.end(), {"--json", out + "/bench.json"});
            else
                all.insert(all.end(), {"--out", out});
            CAPTURE(words.front());
            CAPTURE(out);
            const Run run = afterglow(all);
            CAPTURE(run.err);
            CHECK(run.exitCode == 1);
            CHECK(isOneErrorLine(run.err));
            CHECK(run.err.find(out) != std::string::npos);
        }
    }
    CHECK(bytesOf(file) == "not a folder");
}

TEST_CASE("a file that is in the way of a result is exit code 1 and one line that names it") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "out/color_0000.png"); // a folder by that name
    const Run run = afterglow({"render", "tiny", "--size", "8x8", "--frames", "1", "--context",
                               "osmesa", "--out", folder / "out"});
    CAPTURE(run.err);
    CHECK(run.exitCode == 1);
    CHECK(isOneErrorLine(run.err));
    CHECK(run.err.find("color_0000.png") != std::string::npos);
    CHECK(filesIn(folder / "out").empty());
}

} // namespace afterglow::test
