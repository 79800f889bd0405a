// SPDX-License-Identifier: MIT
#include "app/base/embedded.h"
#include "app/report/picture_store.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/image/image_io.h"
#include "tests/support/temporary_folder.h"

#include <cstdlib>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace afterglow;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr glm::ivec2 kSize{7, 5};

Image<glm::u8vec4> filled(glm::u8vec4 color, glm::ivec2 size = kSize) {
    return Image<glm::u8vec4>(size, color);
}

Json experimentJson(const std::string& name, const std::string& variant) {
    return {{"program", "afterglow"},
            {"experiment",
             {{"name", name},
              {"description", "ends </script><!-- here & \"there\""},
              {"size", {kSize.x, kSize.y}},
              {"frames", 4},
              {"variants", {{{"name", variant}, {"filter", "svgf"}}}}}},
            {"settled_window", {0, 2}},
            {"pictures", {0, 2}},
            {"events", {{{"frame", 2}, {"end", 3}, {"kind", "step"}, {"text", "<b>key: off"}}}},
            {"changing_frames", {2}},
            {"references",
             {{{"first", 0}, {"end", 2}, {"samples", 8}, {"residual_rmse", 0.25}},
              {{"first", 2}, {"end", 4}, {"samples", 8}, {"residual_rmse", 0.0}}}}};
}

/// The files of a small run, whole as the program writes them.
void writeRun(const fs::path& folder, const std::string& name = "small",
              const std::string& variant = "svgf") {
    fs::create_directories(folder / variant / "maps");
    fs::create_directories(folder / "reference");
    const auto json = [&](const char* file, const Json& value) {
        writeFileAtomically(folder / file, value.dump());
    };
    json("experiment.json", experimentJson(name, variant));
    json("summary.json",
         {{"experiment", name},
          {"variants", {{variant, {{"t90", nullptr}, {"ghost_frames", 1.0 / 3.0}}}}}});
    json("timing.json", {{"variants", {{variant, {{"ms_per_frame", 12.5}}}}}});
    writeFileAtomically(folder / "metrics.csv", "variant,frame,metric,value\n" + variant +
                                                    ",0,rmse,0.125\n" + variant + ",1,rmse,nan\n" +
                                                    variant + ",3,rmse,-1e-9\n" + variant +
                                                    ",2,psnr,inf\n" + variant + ",3,psnr,nan\n");
    writePng(folder / variant / "frame_0000.png", filled({250, 10, 10, 255}));
    writePng(folder / variant / "frame_0002.png", filled({10, 250, 10, 255}));
    writePng(folder / variant / "maps" / "lambda_0002.png", filled({128, 128, 128, 255}, {3, 2}));
    writePng(folder / variant / "maps" / "error_0000.png", filled({9, 9, 9, 255}));
    writePng(folder / "reference" / "frame_0000.png", filled({10, 10, 250, 255}));
    writePng(folder / "reference" / "frame_0002.png", filled({10, 250, 10, 255}));
}

/// What stands between two texts, the second looked for after the first.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const auto start = text.find(before);
    REQUIRE(start != text.npos);
    const auto end = text.find(after, start + before.size());
    REQUIRE(end != text.npos);
    return text.substr(start + before.size(), end - start - before.size());
}

Json dataOf(const std::string& page) {
    return Json::parse(between(page, "id=\"data\">", "</script>"));
}

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

std::string decoded(const std::string& base64Text) {
    static const std::string digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0, count = 0;
    for (char c : base64Text) {
        if (c == '=')
            break;
        bits = bits << 6 | unsigned(digits.find(c));
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += char(bits >> count & 255);
        }
    }
    return bytes;
}

} // namespace

TEST_CASE("base 64 is that of RFC 4648") {
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64(std::string("\xff\xfe\x00", 3)) == "//4A");
}

TEST_CASE("a report holds the numbers of its run to the last digit, and null where there is none") {
    TemporaryFolder folder;
    writeRun(folder.path());
    writeReport(folder.path());
    const Json data = dataOf(readFile(folder / "report.html"));
    CHECK(data["suite"] == false);
    REQUIRE(data["runs"].size() == 1);
    const Json& run = data["runs"][0];
    CHECK(run["run"] == experimentJson("small", "svgf"));
    CHECK(run["summary"]["svgf"]["t90"].is_null());
    CHECK(run["summary"]["svgf"]["ghost_frames"].get<double>() == 1.0 / 3.0);
    CHECK(run["timing"]["svgf"]["ms_per_frame"] == 12.5);
    CHECK(run["metrics"]["svgf"]["rmse"] ==
          Json{{"first", 0}, {"values", {0.125, nullptr, nullptr, -1e-9}}});
    CHECK(run["metrics"]["svgf"]["psnr"] == Json{{"first", 2}, {"values", {"inf", nullptr}}});
}

TEST_CASE("a report shows the pictures of its run, equal ones stored once") {
    TemporaryFolder folder;
    writeRun(folder.path());
    writeReport(folder.path());
    const std::string page = readFile(folder / "report.html");
    const Json images = dataOf(page)["runs"][0]["images"];
    const Json frames = images["svgf"]["picture"], references = images["reference"]["picture"];
    REQUIRE(frames.size() == 2);
    CHECK(frames[0] != frames[1]);
    CHECK(references[0] != frames[0]);
    CHECK(references[1] == frames[1]);
    CHECK(images["svgf"]["lambda"][0].is_null());
    CHECK(images["svgf"]["error"][1].is_null());
    CHECK_FALSE(images["svgf"].contains("alpha"));
    CHECK(countOf(page, "<script type=\"image/") == 5);

    const std::string frame = decoded(between(
        page, "<script type=\"image/jpeg\" id=\"p" + frames[0].dump() + "\">", "</script>"));
    CHECK(frame.substr(0, 3) == "\xff\xd8\xff");

    // Maps per stratum are exact.
    const std::string png = decoded(between(
        page, "<script type=\"image/png\" id=\"p" + images["svgf"]["lambda"][1].dump() + "\">",
        "</script>"));
    const auto map = readPng(folder.write("map.png", png));
    REQUIRE(map.size() == glm::ivec2(3, 2));
    for (const glm::u8vec4& pixel : map.pixels())
        CHECK(pixel == glm::u8vec4(128, 128, 128, 255));
}

TEST_CASE("names and descriptions stay texts, whatever they hold") {
    TemporaryFolder folder;
    const std::string name = "<img src=x onerror=alert(1)>", variant = "<i>\"a&b\"";
    writeRun(folder.path(), name, variant);
    writeReport(folder.path());
    const std::string page = readFile(folder / "report.html");
    CHECK(page.find("<img") == page.npos);
    CHECK(page.find("<i>") == page.npos);
    CHECK(page.find("<b>key") == page.npos);
    CHECK(page.find("</script><!-- here") == page.npos);
    CHECK(between(page, "<title>", "</title>") == "&lt;img src=x onerror=alert(1)&gt; - Afterglow");
    const Json run = dataOf(page)["runs"][0];
    CHECK(run["run"]["experiment"]["name"] == name);
    CHECK(run["run"]["experiment"]["description"] == "ends </script><!-- here & \"there\"");
    CHECK(run["summary"].contains(variant));
}

TEST_CASE("a page refers to nothing outside itself") {
    std::string parts, script;
    for (const EmbeddedFile& file : embeddedReport())
        (file.name.ends_with(".js") ? script : parts) += file.bytes;
    CHECK(parts.find("default-src 'none'") != parts.npos);
    CHECK(script.find("</script") == script.npos);
    parts += script;
    CHECK(parts.find("https:") == parts.npos);
    CHECK(countOf(parts, "http:") == countOf(parts, "http://www.w3.org/2000/svg"));
    CHECK(parts.find("@import") == parts.npos);
}

TEST_CASE("the report of a suite holds the runs of its folders by name, and passes over the rest") {
    TemporaryFolder folder;
    writeRun(folder / "b", "second");
    writeRun(folder / "a", "first");
    folder.write("cache/notes.txt", "not a run");
    writeReport(folder.path());
    const Json data = dataOf(readFile(folder / "report.html"));
    CHECK(data["suite"] == true);
    REQUIRE(data["runs"].size() == 2);
    CHECK(data["runs"][0]["run"]["experiment"]["name"] == "first");
    CHECK(data["runs"][1]["run"]["experiment"]["name"] == "second");
}

TEST_CASE("the same run gives the same bytes of a report") {
    TemporaryFolder one, other;
    writeRun(one.path());
    writeRun(other.path());
    writeReport(one.path());
    writeReport(other.path());
    writeReport(other.path());
    CHECK(readFile(one / "report.html") == readFile(other / "report.html"));
}

TEST_CASE("a file that a report misses is named, and the page of before stays") {
    for (const char* file : {"summary.json", "timing.json", "metrics.csv", "svgf/frame_0002.png",
                             "reference/frame_0002.png"}) {
        TemporaryFolder folder;
        writeRun(folder.path());
        folder.write("report.html", "of before");
        fs::remove(folder / file);
        const std::string message = messageOf<InputError>([&] { writeReport(folder.path()); });
        CHECK_MESSAGE(message.find((folder / file).string()) == 0, file, ": ", message);
        CHECK(readFile(folder / "report.html") == "of before");
    }
    TemporaryFolder empty;
    CHECK(messageOf<InputError>([&] { writeReport(empty.path()); }).find(empty.path().string()) ==
          0);
    CHECK(messageOf<InputError>([&] { writeReport(empty / "nowhere"); }) != "");
}

TEST_CASE("a malformed file of a run is named with the place") {
    const auto fault = [](const char* file, std::string_view text) {
        TemporaryFolder folder;
        writeRun(folder.path());
        folder.write(file, text);
        const std::string message = messageOf<InputError>([&] { writeReport(folder.path()); });
        const std::string path = (folder / file).string();
        REQUIRE_MESSAGE(message.find(path) == 0, file, ": ", message);
        CHECK_FALSE(fs::exists(folder / "report.html"));
        return message.substr(path.size());
    };
    CHECK(fault("experiment.json", "{") != "");
    CHECK(fault("experiment.json", "{}").find("experiment") != std::string::npos);
    CHECK(fault("summary.json", "{\"variants\": {}}").find("svgf") != std::string::npos);
    CHECK(fault("timing.json", "[]") != "");
    CHECK(fault("svgf/frame_0000.png", "GIF89a") == ": is not a PNG");
    CHECK(fault("metrics.csv", "").find(":1: not a row of") == 0);
    CHECK(fault("metrics.csv", "frame,value\n").find(":1: ") == 0);
    const std::string head = "variant,frame,metric,value\n";
    CHECK(fault("metrics.csv", head + "svgf,0,rmse\n").find(":2: not a row of") == 0);
    CHECK(fault("metrics.csv", head + "svgf,0,rmse,1,2\n").find(":2: not a row of") == 0);
    CHECK(fault("metrics.csv", head + "svgf,0,rmse,1\nsvgf,x,rmse,1\n").find(":3: ") == 0);
    CHECK(fault("metrics.csv", head + "svgf,0,rmse,much\n").find(":2: ") == 0);
    CHECK(fault("metrics.csv", head + "other,0,rmse,1\n").find("\"other\"") != std::string::npos);
    CHECK(fault("metrics.csv", head + "svgf,1,rmse,1\nsvgf,1,rmse,2\n")
              .find("frame 1 of rmse is not later") != std::string::npos);
}

TEST_CASE("a variant cannot name a folder outside its run") {
    for (const char* name : {"../svgf", "..", ".", "", "reference"}) {
        TemporaryFolder folder;
        writeRun(folder.path());
        folder.write("experiment.json", experimentJson("small", name).dump());
        const std::string message = messageOf<InputError>([&] { writeReport(folder.path()); });
        CHECK_MESSAGE(message.find("variants[0].name") != message.npos, name, ": ", message);
    }
}
