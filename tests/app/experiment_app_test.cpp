// SPDX-License-Identifier: MIT
#include "program.h"

#include "renderer/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace afterglow::test {

namespace {

Run experiment(const std::string& what, const std::string& out) {
    return afterglow({"experiment", what, "--context", "osmesa", "--no-cache", "--out", out});
}

// The key of the little scene goes out at frame 12.
std::string lightOff(const TemporaryFolder& folder) {
    return folder.write("little.json", R"({
    "name": "little", "description": "The key light goes out", "scene": "tiny", "size": [61, 37],
    "frames": 28, "seed": 3, "signal": "shadows", "variants": ["fixed", "svgf", "asvgf"],
    "timeline": [{"frame": 12, "light": "key", "on": false}],
    "referenceSamples": 64, "settledWindow": 6})");
}

std::vector<std::string> rowsOf(const std::string& file) {
    std::istringstream text(bytesOf(file));
    std::vector<std::string> rows;
    for (std::string row; std::getline(text, row);)
        rows.push_back(row);
    return rows;
}

int countOf(const std::vector<std::string>& rows, const std::string& part) {
    return int(std::ranges::count_if(
        rows, [&](const std::string& row) { return row.find(part) != row.npos; }));
}

} // namespace

TEST_CASE("an experiment writes frames, numbers and a contact sheet, and tells them") {
    const TemporaryFolder folder;
    const std::string out = folder / "out";
    const Run run = experiment(lightOff(folder), out);
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    CHECK(run.err == "");
    for (const char* word : {"fixed", "svgf", "asvgf", "t50", "t90", "ghost frames", "RMSE"})
        CHECK(run.out.find(word) != std::string::npos);
    CHECK(run.out.find("contact sheet: " + out + "/contact_sheet.png\n") != std::string::npos);

    for (const char* variant : {"fixed", "svgf", "asvgf"}) {
        const auto files = filesIn(out + "/" + variant);
        CHECK(std::ranges::count_if(files, [](const std::string& file) {
                  return file.starts_with("frame_") && file.ends_with(".png");
              }) == 28);
        CHECK(readPng(out + "/" + variant + "/frame_0027.png").size() == glm::ivec2(61, 37));
    }
    CHECK(filesIn(out + "/reference") ==
          std::vector<std::string>{"frame_0000.png", "frame_0012.png", "timing.json"});
    CHECK(bytesOf(out + "/report.html").starts_with("<!doctype html>"));
    CHECK(readPng(out + "/contact_sheet.png").size().x > 61);

    const auto summary = nlohmann::json::parse(bytesOf(out + "/summary.json"));
    CHECK(summary.size() == 2);
    CHECK(summary.at("experiment") == "little");
    REQUIRE(summary.at("variants").size() == 3);
    for (const auto& [name, variant] : summary.at("variants").items()) {
        CAPTURE(name);
        for (const char* key : {"t50", "t90", "t99"})
            CHECK((variant.at(key).is_null() || variant.at(key).is_number_integer()));
        for (const char* key : {"ghost_frames", "rmse_settled", "flip_settled", "ssim_settled",
                                "overshoot", "flicker", "noise_after_event", "rays_per_frame"})
            CHECK(variant.at(key).is_number());
        CHECK(variant.at("rmse_settled") > 0.0);
        CHECK(variant.at("rays_per_frame") > 0.0);
        CHECK(variant.at("invalid_values") == 0.0);
    }
    const auto timing = nlohmann::json::parse(bytesOf(out + "/timing.json"));
    CHECK(timing.at("variants").at("svgf").at("ms_per_frame") > 0.0);

    const auto account = nlohmann::json::parse(bytesOf(out + "/experiment.json"));
    CHECK(account.at("gl").at("backend") == "OSMesa");
    CHECK(account.at("experiment").at("seed") == 3);
    REQUIRE(account.at("references").size() == 2);
    CHECK(account.at("references").at(0).at("residual_rmse") > 0.0);
    CHECK(account.at("references").at(1).at("residual_rmse") == 0.0); // it is black
    CHECK(account.at("settled_window") == nlohmann::json{6, 12});

    const auto rows = rowsOf(out + "/metrics.csv");
    CHECK(rows.front() == "variant,frame,metric,value");
    for (const char* metric : {",rmse,", ",relmse,", ",psnr,", ",ssim,", ",flip,"})
        CHECK(countOf(rows, metric) == 3 * 28);
    CHECK(countOf(rows, ",temporal_error,") == 3 * 27);
    CHECK(countOf(rows, ",response,") == 3 * 16);       // from the event on
    CHECK(countOf(rows, ",response_before,") == 3 * 6); // the window before it
    CHECK(countOf(rows, ",flicker,") == 3);
    CHECK(countOf(rows, "asvgf,12,lambda_recall,") == 1);
}

TEST_CASE("after a light goes out an average of weight alpha lags as the closed form says") {
    // p after k frames is 1 - (1 - a)^(k + 1); the raw signal is dark at once.
    const TemporaryFolder folder;
    const Run run = experiment(lightOff(folder), folder / "out");
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    int compared = 0;
    for (const std::string& row : rowsOf(folder / "out/metrics.csv")) {
        int frame = 0;
        double p = 0.0;
        if (std::sscanf(row.c_str(), "fixed,%d,response,%lf", &frame, &p) != 2)
            continue;
        ++compared;
        // The picture before the event is itself only an average of a dozen noisy frames: 10 %.
        CHECK(std::abs(p - (1.0 - std::pow(0.8, frame - 12 + 1))) < 0.1);
    }
    CHECK(compared == 16);
    const auto variants =
        nlohmann::json::parse(bytesOf(folder / "out/summary.json")).at("variants");
    CHECK(variants.at("asvgf").at("ghost_frames") < variants.at("svgf").at("ghost_frames"));
}

TEST_CASE("where nothing changes, there is no response and never a t50") {
    const TemporaryFolder folder;
    const std::string file = folder.write("still.json", R"({
    "name": "still", "scene": "tiny", "size": [31, 19], "frames": 8, "variants": ["none", "asvgf"],
    "referenceSamples": 16, "settledWindow": 4})");
    const Run run = experiment(file, folder / "out");
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    const auto variants =
        nlohmann::json::parse(bytesOf(folder / "out/summary.json")).at("variants");
    for (const auto& [name, variant] : variants.items()) {
        CAPTURE(name);
        for (const char* key : {"t50", "t90", "t99", "ghost_frames", "overshoot"})
            CHECK_FALSE(variant.contains(key));
        CHECK(variant.at("flicker") > 0.0);
    }
    CHECK(variants.at("asvgf").at("rmse_settled") < variants.at("none").at("rmse_settled"));
}

TEST_CASE("an experiment gives the same files twice, times aside") {
    const TemporaryFolder folder;
    const std::string file = lightOff(folder);
    REQUIRE(experiment(file, folder / "a").exitCode == 0);
    REQUIRE(experiment(file, folder / "b").exitCode == 0);
    CHECK(filesIn(folder / "a") == filesIn(folder / "b"));
    for (const std::string& name : filesIn(folder / "a")) {
        CAPTURE(name);
        if (!tellsTimes(name))
            CHECK((bytesOf(folder / ("a/" + name)) == bytesOf(folder / ("b/" + name))));
    }
}

TEST_CASE(
    "the oracles know that nothing changes in a still picture, and that all does in the dark") {
    const TemporaryFolder folder;
    REQUIRE(experiment(lightOff(folder), folder / "out").exitCode == 0);
    const auto rows = rowsOf(folder / "out/metrics.csv");
    int still = 0, event = 0, alphas = 0;
    for (const std::string& row : rows) {
        int frame = 0;
        double value = 0.0;
        CAPTURE(row);
        if (std::sscanf(row.c_str(), "asvgf,%d,lambda_ideal_mean,%lf", &frame, &value) == 2) {
            CHECK(value == (frame == 12 ? 1.0 : 0.0));
            (frame == 12 ? event : still) += 1;
        }
        if (std::sscanf(row.c_str(), "asvgf,%d,lambda_mean,%lf", &frame, &value) == 2) {
            if (frame == 12)
                CHECK(value > 0.95);
            else
                CHECK(value == 0.0);
        }
        if (row.find(",alpha_ideal_mean,") != row.npos) {
            value = std::strtod(row.c_str() + row.rfind(',') + 1, nullptr);
            CHECK(value >= 0.0);
            CHECK(value <= 1.0);
            ++alphas;
        }
    }
    CHECK(event == 1);
    CHECK(still == 11); // frames 1 to 11; from frame 13 on there is no light for lambda to tell of
    CHECK(alphas > 3 * 20);
    // With the light gone, the history is wrong and a sample is right: alpha* is 1 where it was
    // lit.
    const auto ideal = readPng(folder / "out/asvgf/maps/alpha_ideal_0012.png");
    const auto before = readPng(folder / "out/reference/frame_0000.png");
    CHECK(before.size() == ideal.size());
    int lit = 0, ones = 0;
    for (std::size_t i = 0; i < ideal.pixels().size(); ++i)
        if (before.pixels()[i].g > 128) {
            ++lit;
            ones += ideal.pixels()[i].r == 255;
        }
    CHECK(lit > 200);
    CHECK(ones > 0.9 * lit);
}

} // namespace afterglow::test
