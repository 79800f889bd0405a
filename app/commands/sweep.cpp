// SPDX-License-Identifier: MIT
#include "app/commands/experiment_run.h"

namespace afterglow {

namespace {

/// Parses "alpha=0.1,0.2" into the setting and its values.
std::vector<Assignment> pointsFrom(const std::string& text) {
    const auto [key, values] = assignment().read(text);
    std::vector<Assignment> points;
    for (const std::string& value : partsOf(values))
        points.push_back(setting().read(key + "=" + value));
    return points;
}

/// The command sweep: measures every variant at each value of a setting.
class Sweep final : public Command {
public:
    explicit Sweep(Options& options) {
        options.require("--over", over_, Kind<std::vector<Assignment>>{"KEY=A,B,...", pointsFrom},
                        "The setting and its values");
        o_.addTo(options, "Names (afterglow list experiments) or .json files");
        options.setFooter(
            R"(Runs every variant with every value, and draws settled noise against lag in
DIR/report.html, a curve for each variant.

Examples:
  afterglow sweep fill-light --over alpha=0.02,0.05,0.1,0.2,0.4 --out out/alpha
  afterglow sweep fill-light --over gradientIterations=1,3,5 --filter asvgf --out out/iterations)");
    }

    void run(HiddenContextFactory hiddenContext) override {
        std::vector<Experiment> experiments = o_.chosen();
        for (Experiment& experiment : experiments)
            spread(experiment);
        runExperiments(experiments, o_, hiddenContext);
    }

private:
    void spread(Experiment& experiment) const {
        std::vector<Variant> points;
        for (const Variant& variant : experiment.variants)
            for (const Assignment& change : over_) {
                const auto& [key, value] = change;
                Variant point = variant;
                point.name += "-" + key + "-" + value;
                point.changes.push_back(change);
                point.sweep = SweepPoint{variant.name, key, value};
                settingsOf(point, experiment.signal); // says what is wrong before anything is made
                points.push_back(std::move(point));
            }
        experiment.variants = std::move(points);
        experiment.name += "-" + over_[0].first;
        experiment.description += ". With " + over_[0].first + " swept";
    }

    ExperimentOptions o_;
    std::vector<Assignment> over_; ///< the setting with each of its values
};

} // namespace

MadeCommand sweepCommand(Options& options) {
    return std::make_unique<Sweep>(options);
}

} // namespace afterglow
