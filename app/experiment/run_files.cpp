// SPDX-License-Identifier: MIT
#include "app/experiment/run_files.h"

#include "app/base/json_reader.h"
#include "app/measure/metrics_table.h"
#include "app/measure/summary.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"

#include <map>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int kWarmupFrames = 3; // in which shaders are still being compiled

/// What timing.json tells of a variant; null where no frame was timed.
Json timingOf(const Json& parts) {
    std::vector<double> frames;
    double spent = 0.0, rays = 0.0;
    std::map<std::string, std::vector<double>> passes;
    for (const Json& part : parts) {
        const int first = part.at("first");
        for (std::size_t i = 0; i < part.at("frame_ms").size(); ++i) {
            if (first + int(i) < kWarmupFrames)
                continue;
            frames.push_back(part.at("frame_ms")[i]);
            spent += frames.back();
            rays += part.at("rays_per_frame")[i].get<double>();
            for (const auto& [name, ms] : part.at("pass_ms").items())
                if (!ms.at(i).is_null())
                    passes[name].push_back(ms[i]);
        }
    }
    Json medians = Json::object();
    if (!parts.empty())
        for (const auto& [name, ms] : parts.back().at("pass_ms").items())
            medians[name] = median(passes[name]);
    return {{"ms_per_frame", frames.empty() ? Json(nullptr) : Json(median(frames))},
            {"rays_per_second", spent > 0.0 ? Json(rays / spent * 1000.0) : Json(nullptr)},
            {"pass_ms_median", medians},
            {"parts", parts}};
}

} // namespace

Json readJson(const fs::path& file) {
    try {
        return parseJson(readFile(file));
    } catch (const Json::exception&) {
        throw InputError(file.string() + ": this is not JSON");
    }
}

std::string finishedKey(const fs::path& folder) {
    const fs::path file = folder / "timing.json";
    if (!fs::exists(file) || !fs::exists(folder / "metrics.csv"))
        return {};
    try {
        const Json json = parseJson(readFile(file));
        return json.is_object() ? json.value("key", std::string()) : std::string();
    } catch (const Json::parse_error&) {
        return {};
    }
}

void forgetFinished(const fs::path& folder) {
    fs::remove(folder / "timing.json");
}

void markFinished(const OutputFolder& folder, const std::string& key, const Json& parts) {
    folder.writeJson("timing.json", {{"key", key}, {"parts", parts}});
}

void finishRun(const OutputFolder& folder) {
    const fs::path& path = folder.path();
    const fs::path account = path / "experiment.json";
    const std::string text = readFile(account);
    const JsonDocument document(text, account.string());
    const Experiment experiment = readExperiment(document.root().at("experiment"));
    const RunOutline outline = readOutline(document.root(), experiment.frames());

    MetricsTable table;
    Json timing = {{"variants", Json::object()}};
    std::vector<std::string> names;
    for (const Variant& variant : experiment.variants) {
        const fs::path rows = path / variant.name / "metrics.csv";
        table.append(MetricsTable::parse(readFile(rows), rows.string()));
        const Json parts = readJson(path / variant.name / "timing.json");
        timing["variants"][variant.name] = timingOf(parts.at("parts"));
        names.push_back(variant.name);
    }
    if (fs::exists(path / "reference" / "timing.json"))
        timing["references"] = readJson(path / "reference" / "timing.json").at("references");

    const Json summary = summaryOf(experiment, outline, table);
    fs::remove(path / "summary.json"); // it says that all others are there
    folder.writeText("metrics.csv", table.csv(names));
    folder.writeJson("timing.json", timing);
    folder.writePng("contact_sheet.png",
                    drawRunSheet(experiment, outline, table, summary, timing, path));
    folder.writeJson("summary.json", summary);
    writeReport(path);
}

} // namespace afterglow
