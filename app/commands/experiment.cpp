// SPDX-License-Identifier: MIT
#include "app/commands/experiment_run.h"

namespace afterglow {

namespace {

/// The command experiment: measures every variant of experiments.
class ExperimentCommand final : public Command {
public:
    explicit ExperimentCommand(Options& options) {
        o_.addTo(options, "Names (afterglow list experiments), .json files, or all");
        options.setFooter(
            R"(Runs every variant over the same frames with the same seed, and compares each frame with
a converged picture of the same moment. Writes DIR/report.html, DIR/contact_sheet.png,
DIR/summary.json, DIR/metrics.csv, DIR/experiment.json and every frame; with more than one
experiment, a folder for each. What an interrupted run has done is not done again; a
folder of another run is refused.

t50, t90, t99: frames from the event (its own is 0) until the response stays above that
part of the change. ghost frames: the area above the response curve. lag: the same between
the filter's own settled values. rmse, flicker, noise: of linear color, over the pixels
that show a surface.

Examples:
  afterglow experiment light-off --out out/light-off
  afterglow experiment all --size 320x180 --out out/suite
  afterglow experiment my.json --filter svgf,asvgf --set alpha=0.1 --out out/my
  afterglow experiment my.json --part 2/4 --out out/part2)");
    }

    void run(HiddenContextFactory hiddenContext) override {
        runExperiments(o_.chosen(), o_, hiddenContext);
    }

private:
    ExperimentOptions o_;
};

} // namespace

MadeCommand experimentCommand(Options& options) {
    return std::make_unique<ExperimentCommand>(options);
}

} // namespace afterglow
