// SPDX-License-Identifier: MIT
// mergeRuns(): what parts of a run have written, as one run would have.

#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/experiment/runner.h"
#include "app/measure/metrics_table.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One part: its folder and its experiment.json.
struct PartFolder {
    fs::path path;
    Json account;
    int index = 1;
};

/// The account without what differs between parts of one run.
Json commonOf(Json account) {
    for (const char* key : {"part", "references", "machine"})
        account.erase(key);
    return account;
}

std::vector<PartFolder> readParts(const std::vector<fs::path>& folders) {
    std::map<int, PartFolder> parts;
    int count = 0;
    for (const fs::path& folder : folders) {
        PartFolder part{folder, readJson(folder / "experiment.json")};
        const fs::path file = folder / "experiment.json";
        const Json which = part.account.value("part", Json());
        if (!which.is_array() || which.size() != 2)
            throw InputError(file.string() + ": this is not a part of a run");
        part.index = which[0];
        if (count == 0)
            count = which[1];
        if (which[1] != count ||
            (!parts.empty() && commonOf(part.account) != commonOf(parts.begin()->second.account)))
            throw InputError(file.string() + ": this is a part of another run than " +
                             parts.begin()->second.path.string());
        if (const auto same = parts.find(part.index); same != parts.end())
            throw InputError(file.string() + ": this is the same part as " +
                             same->second.path.string());
        parts.emplace(part.index, std::move(part));
    }
    std::vector<PartFolder> sorted;
    for (int index = 1; index <= count; ++index) {
        if (!parts.contains(index))
            throw InputError("part " + std::to_string(index) + " of " + std::to_string(count) +
                             " is missing");
        sorted.push_back(std::move(parts.at(index)));
    }
    return sorted;
}

void copyPictures(const fs::path& from, const OutputFolder& to) {
    if (!fs::exists(from))
        return;
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(from))
        if (entry.path().extension() == ".png")
            files.insert(entry.path());
    for (const fs::path& file : files)
        to.writeText(file.filename().string(), readFile(file));
}

void mergeVariant(const std::string& name, const std::vector<PartFolder>& parts,
                  const OutputFolder& out) {
    forgetFinished(out.path());
    MetricsTable table;
    Json timings = Json::array();
    for (const PartFolder& part : parts) {
        const fs::path folder = part.path / name;
        // A part without frames has made nothing; any other is finished or it is no good.
        const FrameRange own = framesOf({part.index, int(parts.size())},
                                        part.account.at("experiment").at("frames").get<int>());
        if (own.frames() == 0)
            continue;
        const fs::path rows = folder / "metrics.csv";
        table.append(MetricsTable::parse(readFile(rows), rows.string()));
        const Json times = readJson(folder / "timing.json");
        for (const Json& timing : times.at("parts"))
            timings.push_back(timing);
        copyPictures(folder, out);
        if (fs::exists(folder / "maps"))
            copyPictures(folder / "maps", out.subfolder("maps"));
    }
    out.writeText("metrics.csv", table.csv({name}));
    markFinished(out, "merged", timings);
}

void mergeOne(const std::vector<PartFolder>& parts, const OutputFolder& out, bool fresh) {
    takeFolder({parts.front().account.at("experiment")}, out, fresh);
    Json account = parts.front().account;
    account.erase("part");
    account["references"] = Json::array();
    Json spent = Json::array();
    const OutputFolder references = out.subfolder("reference");
    for (const PartFolder& part : parts) {
        for (const Json& reference : part.account.at("references"))
            account["references"].push_back(reference);
        const fs::path folder = part.path / "reference";
        if (!fs::exists(folder))
            continue;
        copyPictures(folder, references);
        const Json timing = readJson(folder / "timing.json");
        for (const Json& reference : timing.at("references"))
            spent.push_back(reference);
    }
    references.writeJson("timing.json", {{"references", spent}});
    for (const Json& variant : account.at("experiment").at("variants")) {
        const std::string name = variant.at("name");
        mergeVariant(name, parts, out.subfolder(name));
    }
    writeAccount(out, account);
    finishRun(out);
}

} // namespace

void mergeRuns(const std::vector<fs::path>& parts, const OutputFolder& out, bool fresh) {
    if (parts.empty())
        throw InputError("there is nothing to merge");
    if (fs::exists(parts.front() / "experiment.json"))
        return mergeOne(readParts(parts), out, fresh);
    std::set<std::string> names;
    if (fs::is_directory(parts.front()))
        for (const auto& entry : fs::directory_iterator(parts.front()))
            if (fs::exists(entry.path() / "experiment.json"))
                names.insert(entry.path().filename().string());
    if (names.empty())
        throw InputError(parts.front().string() + ": there is no experiment.json in it");
    std::map<std::string, std::vector<PartFolder>> runs;
    for (const std::string& name : names) {
        std::vector<fs::path> folders;
        for (const fs::path& part : parts)
            folders.push_back(part / name);
        runs[name] = readParts(folders);
        if (!fresh)
            requireFolderFor({runs[name].front().account.at("experiment")}, out.path() / name);
    }
    takeFolderForRuns(out, fresh);
    for (const auto& [name, run] : runs)
        mergeOne(run, out.subfolder(name), fresh);
    writeReport(out.path());
}

} // namespace afterglow
