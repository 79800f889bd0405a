// SPDX-License-Identifier: MIT
#include "app/commands/exchange_words.h"

#include "app/commands/experiment_words.h"

#include "app/commands/arguments.h"
#include "renderer/base/error.h"

namespace afterglow {

namespace {

constexpr int kMostSamples = 1 << 20;

} // namespace

void ImportWords::addTo(CLI::App& app) {
    addOption(app, "EXPORT", exported, "DIR", "What afterglow render --export has written")
        ->required();
    addOption(app, "FRAMES", frames, "DIR",
              "What a denoiser has made of it: NAME0000.exr, .pfm or .png, one a frame")
        ->required();
    addOption(app, "--name", name, "NAME", "Of the denoiser, as a variant beside ours")->required();
    addOption(app, "--out,-o", out, "DIR", "Folder of the results; made if it is missing")
        ->required();
    addOption(app, "--quantity", quantity, "NAME",
              "What the frames hold: signal (denoised raw), lit (times albedo), color (and plus "
              "emission) or display (color as PNG shows it) [signal; display of PNG]");
    CLI::Option* filterOption =
        addOption(app, "--filter", filters, "A,B,...",
                  "Filters and presets of ours, instead of the experiment's own variants");
    app.add_flag("--only", only, "None of ours")->excludes(filterOption);
    app.add_flag("--fresh", fresh, "Replace what DIR holds");
    addOption(app, "--spp", samples, "N",
              "Samples a pixel of each reference, instead of the experiment's own");
    addOption(app, "--cache", cache, "DIR",
              "Where references are kept [$XDG_CACHE_HOME/afterglow/references]");
    app.add_flag("--no-cache", noCache, "Keep no references");
    context.addTo(app);
    app.footer("Measures the frames of another denoiser as those of a filter: docs/denoisers.md.\n"
               "Another one that is imported into the same DIR stands beside the first.\n\n"
               "Examples:\n"
               "  afterglow render light-off --export --out out/noise\n"
               "  my-denoiser out/noise out/mine\n"
               "  afterglow import-frames out/noise out/mine --name mine --out out/score\n\n" +
               kExitCodes);
}

ImportOptions ImportWords::parse() const {
    ImportOptions options;
    options.exported = *exported;
    options.frames = *frames;
    options.name = *name;
    if (quantity)
        options.quantity = quantityFromName(*quantity);
    if (filters)
        options.filters = parseList("--filter", *filters);
    options.only = only;
    options.fresh = fresh;
    if (samples)
        options.samples = int(parseWhole("--spp", *samples, 1, kMostSamples));
    options.cache = parseCache(cache, noCache);
    options.context = context.parse();
    options.out = *out;
    return options;
}

} // namespace afterglow
