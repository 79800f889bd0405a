// SPDX-License-Identifier: MIT
#include "app/report/report.h"

#include "app/base/embedded.h"
#include "app/measure/metric.h"
#include "app/report/run_folder.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <system_error>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// The folders of runs in a suite: those with an experiment.json. One that is not finished lacks
/// other files, which are then named.
std::vector<fs::path> runsIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> runs;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (fs::exists(entry.path() / "experiment.json"))
            runs.push_back(entry.path());
    if (error)
        throw InputError(folder.string() + ": " + error.message());
    if (runs.empty())
        throw InputError(folder.string() +
                         ": neither a run (it has no experiment.json) nor a folder of runs");
    std::ranges::sort(runs);
    return runs;
}

std::string htmlText(std::string_view text) {
    std::string escaped;
    for (char c : text) {
        switch (c) {
        case '&': escaped += "&amp;"; break;
        case '<': escaped += "&lt;"; break;
        case '>': escaped += "&gt;"; break;
        case '"': escaped += "&quot;"; break;
        default: escaped += c;
        }
    }
    return escaped;
}

/// Returns JSON that cannot end the element it stands in, or open a comment there: "<" occurs in
/// strings alone, where an escape says the same.
std::string scriptJson(const Json& data) {
    const std::string json = jsonText(data);
    std::string escaped;
    escaped.reserve(json.size());
    for (char c : json) {
        if (c == '<')
            escaped += "\\u003c";
        else
            escaped += c;
    }
    return escaped;
}

/// The files of assets/report with this ending, one after the other.
std::string assets(std::string_view ending) {
    std::string bytes;
    for (const EmbeddedFile& file : embeddedReport())
        if (file.name.ends_with(ending))
            bytes += file.bytes;
    return bytes;
}

/// Returns the page: the document with its style and script, `data` as JSON for the script to read,
/// and the pictures. Whatever the texts in `data` and the title hold, they stay texts.
std::string reportPage(std::string_view title, const Json& data, const PictureStore& pictures) {
    const std::map<std::string_view, std::string> parts{{"title", htmlText(title)},
                                                        {"style", assets(".css")},
                                                        {"script", assets(".js")},
                                                        {"data", scriptJson(data)},
                                                        {"pictures", pictures.html()}};
    std::string page;
    const std::string html = assets(".html");
    std::string_view rest = html;
    for (auto open = rest.find("{{"); open != rest.npos; open = rest.find("{{")) {
        const auto close = rest.find("}}", open);
        if (close == rest.npos)
            throw std::logic_error("report.html: {{ without }}");
        page += rest.substr(0, open);
        page += parts.at(rest.substr(open + 2, close - open - 2));
        rest.remove_prefix(close + 2);
    }
    page += rest;
    return page;
}

} // namespace

void writeReport(const fs::path& folder) {
    const bool isRun = fs::exists(folder / "experiment.json");
    PictureStore pictures;
    Json runs = Json::array();
    for (const fs::path& run : isRun ? std::vector{folder} : runsIn(folder))
        runs.push_back(readRunFolder(run, pictures));
    const std::string title = isRun ? runs[0]["run"]["experiment"]["name"].get<std::string>()
                                    : "Suite of " + std::to_string(runs.size()) +
                                          (runs.size() == 1 ? " experiment" : " experiments");
    const Json data{{"suite", !isRun}, {"metrics", metricsJson()}, {"runs", std::move(runs)}};
    writeFileAtomically(folder / "report.html", reportPage(title + " - Afterglow", data, pictures));
}

} // namespace afterglow
