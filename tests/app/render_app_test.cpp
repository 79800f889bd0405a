// SPDX-License-Identifier: MIT
#include "program.h"

#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"

#include <cmath>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace afterglow::test {

namespace {

constexpr glm::ivec2 kSize{61, 37};

// `render tiny` at a small odd size, with these words at its end.
Run render(const std::string& out, std::vector<std::string> words,
           const std::map<std::string, std::string>& environment = {}) {
    words.insert(words.begin(),
                 {"render", "tiny", "--size", "61x37", "--context", "osmesa", "--out", out});
    return afterglow(words, environment);
}

void checkDone(const Run& run) {
    CAPTURE(run.err);
    CHECK(run.exitCode == 0);
    CHECK(run.err == "");
}

// What was rendered: every file but the one that holds times.
std::map<std::string, std::string> picturesIn(const std::string& folder) {
    std::map<std::string, std::string> pictures;
    for (const std::string& name : filesIn(folder))
        if (name != "run.json")
            pictures[name] = bytesOf(folder + "/" + name);
    return pictures;
}

Image<float> luminanceIn(const std::string& file) {
    return luminanceOf(readExr(file));
}

} // namespace

TEST_CASE("render writes a picture a frame, the AOVs asked for, and an account of the run") {
    const TemporaryFolder folder;
    const std::string out = folder / "new/folder";
    const Run run = render(out, {"--frames", "5", "--seed", "7", "--light", "key=0.5@3", "--aov",
                                 "color,depth,motion,normal,lambda,lambda_strata", "--every", "2"});
    checkDone(run);
    CHECK(run.out.find("5 frames") != std::string::npos);
    CHECK(run.out.find("ms a frame") != std::string::npos);
    CHECK(run.out.find("rays/s") != std::string::npos);
    CHECK(run.out.find("a software renderer: times are of the CPU\n") != std::string::npos);
    CHECK(run.out.find(out) != std::string::npos);

    std::vector<std::string> expected{"run.json"};
    for (const char* frame : {"0000", "0002", "0004"}) {
        expected.push_back(std::string("color_") + frame + ".png");
        for (const char* aov : {"color", "depth", "motion", "normal", "lambda", "lambda_strata"})
            expected.push_back(std::string(aov) + "_" + frame + ".exr");
    }
    std::ranges::sort(expected);
    CHECK(filesIn(out) == expected);

    CHECK(readPng(out + "/color_0004.png").size() == kSize);
    CHECK(readExr(out + "/color_0004.exr").size() == kSize);
    CHECK(readExr(out + "/lambda_strata_0004.exr").size() == glm::ivec2(21, 13));
    const auto normals = readExr(out + "/normal_0004.exr", {"X", "Y", "Z"});
    const auto depths = readExr(out + "/depth_0004.exr", {"Y"});
    int surfaces = 0;
    for (std::size_t i = 0; i < depths.pixels().size(); ++i) {
        const float length = glm::length(glm::vec3(normals.pixels()[i]));
        if (depths.pixels()[i].x > 0.0f) {
            ++surfaces;
            CHECK(std::abs(length - 1.0f) < 1e-3f);
        } else {
            CHECK(length == 0.0f);
        }
    }
    CHECK(surfaces > 61 * 37 / 4);

    const auto json = nlohmann::json::parse(bytesOf(out + "/run.json"));
    CHECK(json.at("program") == "afterglow");
    CHECK(json.at("seed") == 7);
    CHECK(json.at("size") == nlohmann::json{61, 37});
    CHECK(json.at("filter") == "asvgf");
    CHECK(json.at("signal") == "both");
    CHECK(json.at("gl").at("backend") == "OSMesa");
    CHECK(json.at("scene").at("triangles") > 0);
    CHECK(json.at("scene").at("bvh_build_ms") >= 0.0);
    CHECK(json.at("settings").is_object());
    CHECK(json.at("light_changes").at(0).at("frame") == 3);
    const auto& timing = json.at("timing");
    CHECK(timing.at("frame_ms").size() == 5);
    CHECK(timing.at("warmup_frames") == 3);
    CHECK(timing.at("frame_ms_median") > 0.0);
    CHECK(timing.at("pass_ms_median").size() >= 5);
    CHECK(timing.at("rays") > 0);
    CHECK(timing.at("rays_per_second") > 0.0);
    CHECK(timing.at("invalid_values") == 0);
    CHECK(timing.at("pass_ms").at("lighting").size() == 5);
    // The passes make up the frame: no more than it, and most of it.
    double passes = 0.0;
    for (const auto& [name, ms] : timing.at("pass_ms_median").items())
        passes += double(ms);
    CHECK(passes < 1.2 * double(timing.at("frame_ms_median")));
}

TEST_CASE("a light that goes out is dark from its frame on, and not before") {
    const TemporaryFolder folder;
    checkDone(render(folder / "on", {"--frames", "4", "--filter", "none", "--signal", "shadows"}));
    checkDone(render(folder / "off", {"--frames", "4", "--filter", "none", "--signal", "shadows",
                                      "--light", "key=off@2", "--aov", "filtered"}));
    for (const char* frame : {"color_0000.png", "color_0001.png"})
        CHECK(bytesOf(folder / (std::string("on/") + frame)) ==
              bytesOf(folder / (std::string("off/") + frame)));
    CHECK(bytesOf(folder / "on/color_0002.png") != bytesOf(folder / "off/color_0002.png"));
    const auto dark = readExr(folder / "off/filtered_0002.exr");
    for (const glm::vec4& p : dark.pixels())
        CHECK(glm::vec3(p) == glm::vec3(0.0f)); // only one light, and no surroundings
}

TEST_CASE("the same words give the same files, with one thread or two") {
    const TemporaryFolder folder;
    for (const char* filter : {"none", "fixed", "svgf", "asvgf"}) {
        CAPTURE(filter);
        const std::vector<std::string> words{"--frames", "4",         "--filter", filter,
                                             "--light",  "key=off@2", "--aov",    "color,filtered"};
        const std::string name = filter;
        checkDone(render(folder / (name + "-1"), words, {{"LP_NUM_THREADS", "1"}}));
        checkDone(render(folder / (name + "-2"), words, {{"LP_NUM_THREADS", "2"}}));
        checkDone(render(folder / (name + "-3"), words, {{"LP_NUM_THREADS", "2"}}));
        const auto one = picturesIn(folder / (name + "-1"));
        CHECK(one.size() == 12);
        CHECK((one == picturesIn(folder / (name + "-2"))));
        CHECK((one == picturesIn(folder / (name + "-3"))));
    }
}

TEST_CASE("another seed gives other noise") {
    const TemporaryFolder folder;
    checkDone(render(folder / "a", {"--frames", "1", "--filter", "none", "--seed", "1"}));
    checkDone(render(folder / "b", {"--frames", "1", "--filter", "none", "--seed", "2"}));
    CHECK(bytesOf(folder / "a/color_0000.png") != bytesOf(folder / "b/color_0000.png"));
}

TEST_CASE("the error of --spp N falls at least like the square root of N") {
    const TemporaryFolder folder;
    const auto reference = [&](const char* samples, const char* seed) {
        const std::string out = folder / (std::string("spp-") + samples + "-" + seed);
        checkDone(
            render(out, {"--filter", "none", "--spp", samples, "--seed", seed, "--aov", "color"}));
        CHECK(filesIn(out) ==
              std::vector<std::string>{"color_0000.exr", "color_0000.png", "run.json"});
        return luminanceIn(out + "/color_0000.exr");
    };
    const Image<float> truth = reference("4096", "99");
    const double at4 = rmse(reference("4", "1"), truth);
    const double at64 = rmse(reference("64", "1"), truth);
    const double at1024 = rmse(reference("1024", "1"), truth);
    CAPTURE(at4);
    CAPTURE(at64);
    CAPTURE(at1024);
    // Sixteen times the samples: a quarter of the error, or less where samples spread evenly. The
    // rest is for chance, and for what the last still misses itself.
    CHECK(at64 < at4 / 4.0 * 1.25);
    CHECK(at1024 < at64 / 4.0 * 1.25);
    CHECK(at1024 > 0.0);
}

TEST_CASE("the residual error that --spp tells is the error that it has") {
    const TemporaryFolder folder;
    checkDone(render(folder / "few", {"--filter", "none", "--spp", "64", "--aov", "color,depth"}));
    checkDone(render(folder / "many",
                     {"--filter", "none", "--spp", "4096", "--seed", "5", "--aov", "color"}));
    const auto told =
        double(nlohmann::json::parse(bytesOf(folder / "few/run.json")).at("residual_rmse"));
    const auto depths = readExr(folder / "few/depth_0000.exr", {"Y"});
    Mask foreground(depths.size());
    for (std::size_t i = 0; i < depths.pixels().size(); ++i)
        foreground.pixels()[i] = depths.pixels()[i].x > 0.0f;
    const double found = rmse(luminanceIn(folder / "few/color_0000.exr"),
                              luminanceIn(folder / "many/color_0000.exr"), &foreground);
    CAPTURE(told);
    CAPTURE(found);
    // Evenly spread samples make halves that err in opposite ways: then it tells more than it has.
    CHECK(told > 0.7 * found);
    CHECK(told < 4.0 * found);
}

TEST_CASE("PFM holds the same numbers as EXR") {
    const TemporaryFolder folder;
    checkDone(render(folder / "exr", {"--frames", "2", "--last", "--aov", "color,depth"}));
    checkDone(render(folder / "pfm",
                     {"--frames", "2", "--last", "--aov", "color,depth", "--format", "pfm"}));
    CHECK(filesIn(folder / "pfm") == std::vector<std::string>{"color_0001.pfm", "color_0001.png",
                                                              "depth_0001.pfm", "run.json"});
    const auto exr = readExr(folder / "exr/color_0001.exr"),
               pfm = readPfm(folder / "pfm/color_0001.pfm");
    REQUIRE(exr.size() == pfm.size());
    for (std::size_t i = 0; i < exr.pixels().size(); ++i)
        CHECK(glm::vec3(exr.pixels()[i]) == glm::vec3(pfm.pixels()[i]));
}

TEST_CASE("one pixel is a picture, too") {
    const TemporaryFolder folder;
    for (const char* size : {"1x1", "1x50", "50x1"}) {
        CAPTURE(size);
        const Run run = afterglow({"render", "tiny", "--size", size, "--frames", "3", "--context",
                                   "osmesa", "--out", folder / size});
        checkDone(run);
        CHECK(filesIn(folder / size).size() == 4);
    }
}

TEST_CASE("EGL renders what OSMesa renders, where both are software") {
    const TemporaryFolder folder;
    const auto with = [&](const char* context) {
        const Run run = afterglow({"render", "tiny", "--size", "61x37", "--frames", "3",
                                   "--context", context, "--out", folder / context},
                                  {{"LIBGL_ALWAYS_SOFTWARE", "1"}});
        checkDone(run);
        return picturesIn(folder / context);
    };
    const auto egl = with("egl"), osmesa = with("osmesa");
    const auto json = nlohmann::json::parse(bytesOf(folder / "egl/run.json"));
    CHECK(json.at("gl").at("backend") == "EGL");
    if (json.at("gl").at("software_rasterizer") == true)
        CHECK((egl == osmesa));
    else
        CHECK(egl.size() == osmesa.size()); // a GPU rounds in its own ways
}

} // namespace afterglow::test
