// SPDX-License-Identifier: MIT
#include "app/experiment/import_frames.h"

#include "app/base/progress.h"
#include "app/commands/command.h"
#include "app/commands/shared_options.h"
#include "app/experiment/export_frames.h"
#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/experiment/runner.h"
#include "app/measure/summary.h"
#include "app/scenario/presets.h"
#include "renderer/base/error.h"
#include "renderer/base/log.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void requireFreeName(const std::string& name) {
    if (!isPlainName(name))
        throw UsageError(fmt::format("--name: expected letters, digits, \"-\", \"_\" and \".\", "
                                     "which is not the first, found '{}'",
                                     name));
    const auto isFilter = [&](Filter filter) { return nameOf(filter) == name; };
    if (name == "reference" || std::ranges::any_of(allFilters(), isFilter) ||
        std::ranges::find(presets(), name, &Preset::name) != presets().end())
        throw UsageError(fmt::format("--name {}: this is a name of our own; choose another", name));
}

/// The command import-frames: measures the frames of another denoiser beside our filters. Frames
/// that were imported into the same run before stay in it.
class ImportFrames final : public Command {
public:
    explicit ImportFrames(Options& options);
    void run(HiddenContextFactory hiddenContext) override;

private:
    Experiment experiment() const;
    std::vector<Variant> externalVariants(const Experiment& experiment, const StagedRun& run,
                                          const ReferenceMaker& maker) const;

    std::string exported_, frames_, name_, out_;
    std::optional<Quantity> quantity_;
    std::vector<Variant> variants_; ///< instead of the experiment's own
    bool only_ = false;             ///< without variants of ours
    bool fresh_ = false;
    std::optional<int> samples_;
    CacheGroup cache_;
    ContextGroup context_;
};

ImportFrames::ImportFrames(Options& options) {
    options.require("EXPORT", exported_, anyText("DIR"),
                    "What afterglow render --export has written");
    options.require("FRAMES", frames_, anyText("DIR"),
                    "What a denoiser has made of it: NAME0000.exr, .pfm or .png, one a frame");
    options.require("--name", name_, anyText(), "Of the denoiser, as a variant beside ours");
    options.require("--out,-o", out_, anyText("DIR"),
                    "Folder of the results; made if it is missing");
    options.add("--quantity", quantity_, Kind<Quantity>{"NAME", quantityFromName},
                "What the frames hold: signal (denoised raw), lit (times albedo), color (and plus "
                "emission) or display (color as PNG shows it) [signal; display of PNG]");
    options.add("--filter", variants_, listOf(filterWithSettings()),
                "Filters and presets of ours, instead of the experiment's own variants");
    options.addFlag("--only", only_, "None of ours");
    options.addFlag("--fresh", fresh_, "Replace what DIR holds");
    options.add("--spp", samples_, wholeNumber(1, kMostSamples),
                "Samples a pixel of each reference, instead of the experiment's own");
    options.exclude("--only", {"--filter"});
    options.check([this] { requireFreeName(name_); });
    cache_.addTo(options);
    context_.addTo(options);
    options.setFooter(
        R"(Measures the frames of another denoiser as those of a filter: docs/denoisers.md.
Another one that is imported into the same DIR stands beside the first.

Examples:
  afterglow render light-off --export --out out/noise
  my-denoiser out/noise out/mine
  afterglow import-frames out/noise out/mine --name mine --out out/score)");
}

/// Returns the experiment of the export, with our own variants.
Experiment ImportFrames::experiment() const {
    Experiment experiment = readExport(exported_);
    experiment.referenceSamples = samples_.value_or(experiment.referenceSamples);
    if (only_ || !variants_.empty())
        experiment.variants = variants_;
    if (std::ranges::find(experiment.variants, name_, &Variant::name) != experiment.variants.end())
        throw UsageError(fmt::format(
            "--name {}: the experiment has a variant of this name; choose another", name_));
    return experiment;
}

/// Returns the external variants of the run: those that were imported into its folder before, as
/// far as their measures still hold, and the new one.
std::vector<Variant> ImportFrames::externalVariants(const Experiment& experiment,
                                                    const StagedRun& run,
                                                    const ReferenceMaker& maker) const {
    std::vector<Variant> variants;
    if (const auto before = fresh_ ? std::nullopt : experimentIn(out_))
        for (const Variant& variant : parseExperiment(before->dump(), out_).variants) {
            if (!variant.external || variant.name == name_)
                continue;
            if (isMeasured(variant, experiment, run, maker, out_))
                variants.push_back(variant);
            else
                log(LogLevel::Warning,
                    fmt::format("{} was measured by another program, and is left out; import it "
                                "again",
                                (fs::path(out_) / variant.name).string()));
        }
    variants.push_back({.name = name_, .filter = Filter::None, .external = true});
    return variants;
}

void ImportFrames::run(HiddenContextFactory hiddenContext) {
    Experiment experiment = this->experiment();
    const StagedRun run = stagedRun(experiment);
    const ImportedFrames frames(name_, frames_, quantity_, experiment.size, experiment.frames());
    if (!fresh_)
        requireFolderFor({.experiment = describe(experiment), .anyVariants = true}, out_);
    const OutputFolder out(out_);
    Headless headless(context_, hiddenContext);
    headless.resize(experiment.size);
    ReferenceStore store = cache_.store(headless);
    for (const Variant& variant : externalVariants(experiment, run, store.maker()))
        experiment.variants.push_back(variant);
    catchInterrupts();
    {
        Progress progress(workOf(experiment, run.plan, {}));
        runExperiment(experiment, run, headless.renderer, headless.gl, store, out,
                      {.fresh = fresh_, .imported = &frames}, progress);
    }
    Json summary = readJson(out.path() / "summary.json");
    for (const Variant& variant : experiment.variants)
        if (variant.external)
            summary["variants"][variant.name]["mean"] =
                readJson(out.path() / variant.name / "import.json").at("mean");
    fmt::print("{}: {}\n{}x{}, {} frames; {} is scored by its {}\n\n{}\nreport: {}\n",
               experiment.name, experiment.description, experiment.size.x, experiment.size.y,
               experiment.frames(), name_, nameOf(frames.quantity()),
               tableOf(summary, readJson(out.path() / "timing.json")),
               (out.path() / "report.html").string());
}

} // namespace

const CommandRow kImportFramesCommand{"import-frames",
                                      "Scores the frames of another denoiser beside our filters",
                                      make<ImportFrames>};

} // namespace afterglow
