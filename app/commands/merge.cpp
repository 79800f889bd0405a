// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/experiment/run_files.h"

#include <fmt/format.h>

namespace afterglow {

namespace {

/// The command merge: puts the parts of a run together.
class Merge final : public Command {
public:
    explicit Merge(Options& options) {
        options.addEach("PART", parts_, Kind<std::filesystem::path>{"DIR", anyText().read},
                        "Folders that the parts were written into");
        options.require("--out,-o", out_, anyText("DIR"),
                        "Folder of the whole run; made if it is missing");
        options.addFlag("--fresh", fresh_, "Replace another run that DIR holds");
        options.setFooter(R"(Examples:
  parallel afterglow experiment my.json --part {}/4 --out out/part{} ::: 1 2 3 4
  afterglow merge out/part1 out/part2 out/part3 out/part4 --out out/my)");
    }

    void run(HiddenContextFactory) override {
        const OutputFolder folder(out_);
        mergeRuns(parts_, folder, fresh_);
        fmt::print("report: {}\n", (folder.path() / "report.html").string());
    }

private:
    std::vector<std::filesystem::path> parts_;
    std::string out_;
    bool fresh_ = false;
};

} // namespace

const CommandRow kMergeCommand{"merge", "Puts the parts of a run together", make<Merge>};

} // namespace afterglow
