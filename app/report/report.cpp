#include "app/report/report.h"

#include "app/measure/metric.h"
#include "app/report/page.h"
#include "app/report/run_folder.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <system_error>

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
