// SPDX-License-Identifier: MIT
#include "app/report/run_folder.h"

#include "app/base/json_reader.h"
#include "app/base/output.h"
#include "app/measure/metrics_table.h"
#include "app/measure/run_outline.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostFrames = 100000;
constexpr std::size_t kMostItems = 1000000;

/// A file that was looked at by `check`, with its members in the order in which they were written.
template <class Check>
Json readJson(const fs::path& file, Check check) {
    const std::string text = readFile(file);
    const JsonDocument document(text, file.string());
    check(document.root());
    return parseJson(text);
}

/// The parts of a run that decide which files there are.
struct Plan {
    std::vector<std::string> variants;
    glm::ivec2 size{0}; ///< of a frame
    RunOutline outline;

    explicit Plan(const JsonReader& run);
};

std::string folderName(const JsonReader& json) {
    std::string name = json.text();
    if (name.empty() || name == "." || name == ".." || name == "reference" ||
        name.find('/') != name.npos || name.find('\0') != name.npos)
        json.fail("a name that a folder can have");
    return name;
}

Plan::Plan(const JsonReader& run) {
    const JsonReader experiment = run.at("experiment");
    experiment.at("name").text();
    std::set<std::string> names;
    for (const JsonReader& variant :
         experiment.at("variants").list("a list of variants", 1, kMostItems)) {
        variants.push_back(folderName(variant.at("name")));
        if (!names.insert(variants.back()).second)
            variant.at("name").fail("a name that no other variant has");
    }
    size = experiment.at("size").vector<glm::ivec2>("width and height", 1, 65536);
    const int frames = int(experiment.at("frames").wholeNumber(1, kMostFrames));
    outline = readOutline(run, frames);
}

/// `file` must have an object for each variant in its member "variants".
Json readVariants(const fs::path& file, const Plan& plan) {
    return readJson(file, [&](const JsonReader& root) {
        const JsonReader variants = root.at("variants");
        for (const std::string& name : plan.variants)
            variants.at(name).members();
    })["variants"];
}

Json asJson(double value) {
    if (std::isnan(value))
        return nullptr;
    if (std::isinf(value))
        return value > 0 ? "inf" : "-inf";
    return value;
}

/// The metrics of each variant, in the order in which they first occur.
Json readCurves(const fs::path& file, const std::vector<std::string>& variants) {
    const MetricsTable table = MetricsTable::parse(readFile(file), file.string());
    Json curves = Json::object();
    for (const std::string& variant : variants)
        curves[variant] = Json::object();
    for (const MetricsTable::Row& row : table.rows()) {
        if (std::ranges::find(variants, row.variant) == variants.end())
            throw InputError(fmt::format("{}: no variant of the experiment is named \"{}\"",
                                         file.string(), row.variant));
        Json& series = curves[row.variant][row.metric];
        if (series.is_null())
            series = {{"first", row.frame}, {"values", Json::array()}};
        Json& values = series["values"];
        const int next = series["first"].get<int>() + int(values.size());
        if (row.frame < next || row.frame >= kMostFrames)
            throw InputError(fmt::format("{}: frame {} of {} is not later than the one before",
                                         file.string(), row.frame, row.metric));
        for (int gap = next; gap < row.frame; ++gap)
            values.push_back(nullptr);
        values.push_back(asJson(row.value));
    }
    return curves;
}

Json variantPictures(const fs::path& folder, const Plan& plan, PictureStore& store) {
    Json images = Json::object();
    for (int frame : plan.outline.pictures)
        images["picture"].push_back(store.addPhoto(folder / (frameStem("frame", frame) + ".png")));
    for (const char* map : {"error", "lambda", "lambda_ideal", "alpha", "alpha_ideal"}) {
        Json numbers = Json::array();
        bool any = false;
        for (int frame : plan.outline.pictures) {
            const fs::path file = folder / "maps" / (frameStem(map, frame) + ".png");
            if (!fs::exists(file)) {
                numbers.push_back(nullptr);
                continue;
            }
            any = true;
            numbers.push_back(store.addMap(file, plan.size));
        }
        if (any)
            images[map] = numbers;
    }
    return images;
}

Json referencePictures(const fs::path& folder, const Plan& plan, PictureStore& store) {
    Json numbers = Json::array();
    for (int frame : plan.outline.pictures) {
        Json number = nullptr;
        for (const FrameRange& reference : plan.outline.references)
            if (reference.contains(frame))
                number = store.addPhoto(folder / (frameStem("frame", reference.first) + ".png"));
        numbers.push_back(number);
    }
    return {{"picture", numbers}};
}

} // namespace

Json readRunFolder(const fs::path& folder, PictureStore& pictures) {
    std::optional<Plan> plan;
    Json run =
        readJson(folder / "experiment.json", [&](const JsonReader& root) { plan.emplace(root); });
    run.erase("metrics"); // the page has the table of this program
    Json images = Json::object();
    for (const std::string& variant : plan->variants)
        images[variant] = variantPictures(folder / variant, *plan, pictures);
    images["reference"] = referencePictures(folder / "reference", *plan, pictures);
    return {{"run", std::move(run)},
            {"summary", readVariants(folder / "summary.json", *plan)},
            {"timing", readVariants(folder / "timing.json", *plan)},
            {"metrics", readCurves(folder / "metrics.csv", plan->variants)},
            {"images", std::move(images)}};
}

} // namespace afterglow
