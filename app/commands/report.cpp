// SPDX-License-Identifier: MIT
#include "app/report/report.h"

#include "app/commands/command.h"

#include <fmt/format.h>

namespace afterglow {

namespace {

/// The command report: makes the page of a run, or of a folder of runs, anew.
class Report final : public Command {
public:
    explicit Report(Options& options) {
        options.require("DIR", folder_, anyText(""), "Folder of a run, or of several");
        options.setFooter(R"(Makes DIR/report.html anew from the files of the runs.)");
    }

    void run(HiddenContextFactory) override {
        writeReport(folder_);
        fmt::print("report: {}\n", (std::filesystem::path(folder_) / "report.html").string());
    }

private:
    std::string folder_;
};

} // namespace

const CommandRow kReportCommand{"report", "Makes the page of a run anew", make<Report>};

} // namespace afterglow
