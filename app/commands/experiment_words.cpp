// SPDX-License-Identifier: MIT
#include "app/commands/experiment_words.h"

#include "app/commands/arguments.h"
#include "renderer/base/error.h"

#include <algorithm>

namespace afterglow {

namespace {

constexpr int kMostFrames = 100'000, kMostSamples = 1 << 20, kMostParts = 100'000;

/// "3/8"
Part parsePart(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash == text.npos)
        throw UsageError("--part: '" + text + "' is not a part; the third of eight is 3/8");
    Part part;
    part.count = int(parseWhole("--part", text.substr(slash + 1), 1, kMostParts));
    part.index = int(parseWhole("--part", text.substr(0, slash), 1, part.count));
    return part;
}

void addCommon(CLI::App& app, ExperimentWords& words) {
    addOption(app, "--out,-o", words.out, "DIR", "Folder of the results; made if it is missing")
        ->required();
    addOption(app, "--filter", words.filters, "A,B,...",
              "Instead of the experiment's own variants: filters or presets, each also with "
              "settings of its own, A:KEY=VALUE");
    app.add_option("--set", words.settings, "Of every variant; afterglow list settings")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    addOption(app, "--size", words.size, "WxH", "Instead of the experiment's own");
    addOption(app, "--frames,-n", words.frames, "N",
              "Instead of the experiment's own; later events do not happen");
    addOption(app, "--signal", words.signal, "NAME",
              "shadows, ao, both or separate, instead of the experiment's own");
    addOption(app, "--spp", words.samples, "N", "Samples a pixel of each reference, likewise");
    app.add_flag("--quick", words.quick, "96x54 pixels and an eighth of the reference samples");
    app.add_flag("--fresh", words.fresh, "Do again, and replace, what DIR holds");
    addOption(app, "--part", words.part, "K/N",
              "Only the K-th of N shares of the frames; see afterglow merge");
    addOption(app, "--cache", words.cache, "DIR",
              "Where references are kept [$XDG_CACHE_HOME/afterglow/references]");
    app.add_flag("--no-cache", words.noCache, "Keep no references");
    words.context.addTo(app);
}

} // namespace

CacheOptions parseCache(const Text& folder, bool none) {
    if (folder && none)
        throw UsageError("--cache and --no-cache exclude each other");
    CacheOptions options{.use = !none};
    if (folder)
        options.folder = *folder;
    return options;
}

void ExperimentWords::addTo(CLI::App& app) {
    app.add_option("EXPERIMENT", experiments,
                   "Names (afterglow list experiments), .json files, or all")
        ->required()
        ->type_name("");
    addCommon(app, *this);
    app.footer(
        "Runs every variant over the same frames with the same seed, and compares each frame with\n"
        "a converged picture of the same moment. Writes DIR/report.html, DIR/contact_sheet.png,\n"
        "DIR/summary.json, DIR/metrics.csv, DIR/experiment.json and every frame; with more than "
        "one\n"
        "experiment, a folder for each. What an interrupted run has done is not done again.\n\n"
        "t50, t90, t99: frames from the event (its own is 0) until the response stays above that\n"
        "part of the change. ghost frames: the area above the response curve. lag: the same "
        "between\n"
        "the filter's own settled values. rmse, flicker, noise: of linear color, over the pixels\n"
        "that show a surface.\n\n"
        "Examples:\n"
        "  afterglow experiment light-off --out out/light-off\n"
        "  afterglow experiment all --size 320x180 --out out/suite\n"
        "  afterglow experiment my.json --filter svgf,asvgf --set alpha=0.1 --out out/my\n"
        "  afterglow experiment my.json --part 2/4 --out out/part2\n\n" +
        kExitCodes);
}

ExperimentOptions ExperimentWords::parse() const {
    ExperimentOptions options;
    options.experiments = experiments;
    if (size)
        options.size = parseSize("--size", *size);
    if (frames)
        options.frames = int(parseWhole("--frames", *frames, 1, kMostFrames));
    if (signal)
        options.signal = signalFromName(*signal);
    if (samples)
        options.samples = int(parseWhole("--spp", *samples, 1, kMostSamples));
    if (filters)
        options.filters = parseList("--filter", *filters);
    for (const std::string& setting : settings)
        options.settings.push_back(parseAssignment("--set", setting));
    options.quick = quick;
    options.run.fresh = fresh;
    if (part)
        options.run.part = parsePart(*part);
    options.cache = parseCache(cache, noCache);
    options.context = context.parse();
    options.out = *out;
    return options;
}

void SweepWords::addTo(CLI::App& app) {
    app.add_option("EXPERIMENT", experiment.experiments,
                   "Names (afterglow list experiments) or .json files")
        ->required()
        ->type_name("");
    addOption(app, "--over", sweep, "KEY=A,B,...", "The setting and its values")->required();
    addCommon(app, experiment);
    app.footer("Runs every variant with every value, and draws settled noise against lag in\n"
               "DIR/report.html, a curve for each variant.\n\n"
               "Examples:\n"
               "  afterglow sweep fill-light --over alpha=0.02,0.05,0.1,0.2,0.4 --out out/alpha\n"
               "  afterglow sweep fill-light --over gradientIterations=1,3,5 --filter asvgf "
               "--out out/iterations\n\n" +
               kExitCodes);
}

Sweep SweepWords::parseSweep() const {
    const auto [key, values] = parseAssignment("--over", *sweep);
    return {key, parseList("--over", values)};
}

void MergeWords::addTo(CLI::App& app) {
    app.add_option("PART", parts, "Folders that the parts were written into")
        ->required()
        ->type_name("DIR");
    addOption(app, "--out,-o", out, "DIR", "Folder of the whole run; made if it is missing")
        ->required();
    app.add_flag("--fresh", fresh, "Replace another run that DIR holds");
    app.footer("Examples:\n"
               "  parallel afterglow experiment my.json --part {}/4 --out out/part{} ::: 1 2 3 4\n"
               "  afterglow merge out/part1 out/part2 out/part3 out/part4 --out out/my\n\n" +
               kExitCodes);
}

void ReportWords::addTo(CLI::App& app) {
    addOption(app, "DIR", folder, "", "Folder of a run, or of several")->required();
    app.footer("Makes DIR/report.html anew from the files of the runs.\n\n" + kExitCodes);
}

} // namespace afterglow
