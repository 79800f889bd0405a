// SPDX-License-Identifier: MIT
#include "app/commands/command_words.h"

#include "app/scenario/presets.h"

#include "app/commands/arguments.h"
#include "renderer/base/error.h"

namespace afterglow {

const std::string kExitCodes =
    "Exit codes: 0 done, 2 wrong usage, 3 bad input file, 4 no OpenGL 4.5 context to be had, "
    "130 interrupted, 1 anything else.";

namespace {

constexpr int kMostFrames = 100'000;
constexpr int kMostSamples = 1 << 20;

// Several of a kind: the option is given again for each.
CLI::Option* addOption(CLI::App& app, const std::string& name, Texts& texts, const char* type,
                       const std::string& help) {
    return app.add_option(name, texts, help)
        ->type_name(type)
        ->type_size(1)
        ->expected(1, 1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::string floatFormat(const Text& format) {
    if (!format)
        return "png";
    if (*format != "png" && *format != "exr" && *format != "pfm")
        throw UsageError("--format: " + unknownName("format", *format, {"png", "exr", "pfm"}));
    return *format;
}

} // namespace

CLI::Option* addOption(CLI::App& app, const std::string& name, Text& text, const char* type,
                       const std::string& help) {
    return app.add_option(name, text, help)->type_name(type);
}

void PictureWords::addSettings(CLI::App& app) {
    addOption(app, "--signal", signal, "NAME",
              "shadows, ao, both or separate: both, each filtered by itself [both]");
    addOption(app, "--set", settings, "KEY=VALUE",
              "One tunable of the renderer; again for more. See: afterglow list settings");
}

void PictureWords::addFilter(CLI::App& app) {
    addOption(app, "--filter", filter, "NAME",
              "A filter or a preset; afterglow list filters, presets [asvgf]");
}

void PictureWords::addSeed(CLI::App& app) {
    addOption(app, "--seed", seed, "S", "Of all random numbers, 0 to 4294967295 [0]");
}

void ContextWords::addTo(CLI::App& app) {
    addOption(app, "--context", name, "NAME", "auto, osmesa, egl or glfw [auto]");
    addOption(app, "--device", device, "N",
              "One of EGL's devices; afterglow list contexts [the first GPU that works]");
}

Settings PictureWords::toSettings() const {
    Settings result;
    if (filter)
        result = settingsOf(variantNamed(*filter), Signal::Both);
    if (signal)
        result.lighting.signal = int(signalFromName(*signal));
    for (const std::string& text : settings) {
        const auto [key, value] = parseAssignment("--set", text);
        setField(result, key, value);
    }
    return result;
}

std::vector<LightEvent> PictureWords::toLightEvents() const {
    std::vector<LightEvent> events;
    for (const std::string& text : lights)
        events.push_back(parseLightEvent("--light", text));
    return events;
}

std::uint32_t PictureWords::toSeed() const {
    return seed ? std::uint32_t(parseWhole("--seed", *seed, 0, 0xffffffffll)) : 0;
}

void RenderWords::addTo(CLI::App& app) {
    addOption(app, "SCENE", scene, "",
              "A name (afterglow list scenes), or a .gltf or .glb file; with --export also an "
              "experiment's name or .json file")
        ->required();
    addOption(app, "--out,-o", out, "DIR", "Folder of the results; made if it is missing")
        ->required();
    picture.addFilter(app);
    picture.addSettings(app);
    CLI::Option* frames =
        addOption(app, "--frames,-n", picture.frames, "N", "Frames to render [32]");
    addOption(app, "--size", picture.size, "WxH", "Of the picture in pixels [640x360]");
    picture.addSeed(app);
    picture.context.addTo(app);
    addOption(app, "--light", picture.lights, "NAME=STATE[@FRAME]",
              "Sets a light to on, off or a power (1 is the scene's own) from a frame on; again "
              "for more");
    addOption(app, "--camera", picture.camera, "NAME", "One of the scene's cameras [the first]");
    CLI::Option* animateFlag =
        app.add_flag("--animate", animate, "Plays the scene's animation; else nothing moves");
    addOption(app, "--rate", rate, "HZ", "Frames a second of scene time [60]")->needs(animateFlag);
    addOption(app, "--aov", aovs, "A,B,...",
              "Also writes these images as floats. See: afterglow list aovs");
    addOption(app, "--format", format, "NAME",
              "Of those images: exr or pfm. png [the default] is exr: the display picture is "
              "always PNG");
    CLI::Option* everyOption =
        addOption(app, "--every", every, "K", "Writes only the frames 0, K, 2K, ...");
    CLI::Option* lastFlag = app.add_flag("--last", last, "Writes only the last frame");
    lastFlag->excludes(everyOption);
    addOption(app, "--spp", samples, "N",
              "With --filter none: one converged image of N samples a pixel, instead of frames")
        ->excludes(frames)
        ->excludes(everyOption)
        ->excludes(lastFlag)
        ->excludes(animateFlag);
    CLI::Option* exportFlag = app.add_flag(
        "--export", exports,
        "For another denoiser: the noisy frames (--filter none) with all it needs, as floats");
    for (const char* other : {"--spp", "--every", "--last", "--set"})
        exportFlag->excludes(app.get_option(other));
    app.footer(
        "Writes DIR/color_0000.png, ..., DIR/<aov>_0000.exr, ... and, last, DIR/run.json.\n"
        "With --export: raw, albedo, emission, normal, depth, motion and previous_depth of every\n"
        "frame and, last, DIR/export.json, for afterglow import-frames.\n\n"
        "Examples:\n"
        "  afterglow render cornell --out out/cornell\n"
        "  afterglow render hall --frames 64 --light key=off@32 --aov lambda,history --out "
        "out/hall\n"
        "  afterglow render cornell --filter none --spp 1024 --out out/reference\n"
        "  afterglow render my.glb --size 1280x720 --animate --camera Front --last --out "
        "out/my\n"
        "  afterglow render light-off --export --out out/noise\n\n" +
        kExitCodes);
}

ExportOptions RenderWords::parseExport() const {
    if (picture.filter && filterFromName(*picture.filter) != Filter::None)
        throw UsageError("--filter " + *picture.filter + ": --export stands for --filter none");
    ExportOptions options;
    options.source = *scene;
    if (picture.size)
        options.size = parseSize("--size", *picture.size);
    if (picture.frames)
        options.frames = int(parseWhole("--frames", *picture.frames, 1, kMostFrames));
    if (picture.seed)
        options.seed = picture.toSeed();
    options.camera = picture.camera.value_or("");
    options.lights = picture.toLightEvents();
    if (picture.signal)
        options.signal = signalFromName(*picture.signal);
    if (rate)
        options.rate = parseNumber("--rate", *rate, 1e-3, 1e3); // what an experiment can have
    options.animate = animate;
    if (aovs)
        options.aovs = parseList("--aov", *aovs);
    options.format = floatFormat(format) == "pfm" ? "pfm" : "exr";
    options.context = picture.context.parse();
    options.out = *out;
    return options;
}

RenderOptions RenderWords::parse() const {
    RenderOptions options;
    options.settings = picture.toSettings();
    options.scene = *scene;
    options.camera = picture.camera.value_or("");
    if (picture.size)
        options.size = parseSize("--size", *picture.size);
    if (picture.frames)
        options.frames = int(parseWhole("--frames", *picture.frames, 1, kMostFrames));
    options.seed = picture.toSeed();
    options.context = picture.context.parse();
    options.lights = picture.toLightEvents();
    if (aovs)
        options.aovs = parseList("--aov", *aovs);
    options.format = floatFormat(format);
    if (samples)
        options.samples = int(parseWhole("--spp", *samples, 1, kMostSamples));
    if (every)
        options.every = int(parseWhole("--every", *every, 1, kMostFrames));
    if (rate)
        options.rate = parseNumber("--rate", *rate, 1e-3, 1e6);
    options.animate = animate;
    options.lastOnly = last;
    options.out = *out;
    return options;
}

void ViewWords::addTo(CLI::App& app) {
    addOption(app, "SCENE", scene, "",
              "A scene by its name (afterglow list scenes) or as a .gltf or .glb file, or an "
              "experiment by its name or as a .json file [the last one, or hall]");
    picture.addFilter(app);
    picture.addSettings(app);
    addOption(app, "--size", picture.size, "WxH", "Of the window [as it was last, or 1600x900]");
    picture.addSeed(app);
    addOption(app, "--camera", picture.camera, "NAME", "One of the scene's cameras [the first]");
    app.add_flag("--still", still, "The scene's animation stands still at first");
    addOption(app, "--frames,-n", picture.frames, "N", "Closes by itself after N frames");
    addOption(app, "--screenshot", screenshot, "FILE",
              "Writes the window as PNG after the last frame");
    addOption(
        app, "--shaders", shaders, "DIR",
        "Takes the shaders from a folder, as shaders/ of the source, and follows its changes");
    app.add_flag("--reset-settings", resetSettings,
                 "Forgets window, files and places that are remembered from earlier runs");
    addOption(app, "--ui-cost", uiCost, "N",
              "Prints what the interface costs: N frames without and with it, in turns");
    app.add_flag("--debug", debug, "Lets the driver check every call");
    app.footer("F1 in the window shows all keys.\n\n"
               "Examples:\n"
               "  afterglow view\n"
               "  afterglow view cornell --filter svgf\n"
               "  afterglow view my.glb --size 1280x720\n"
               "  afterglow view light-off\n\n" +
               kExitCodes);
}

ViewOptions ViewWords::parse() const {
    ViewOptions options;
    options.settings = picture.toSettings();
    if (scene)
        options.scene = *scene;
    options.camera = picture.camera.value_or("");
    if (picture.size)
        options.size = parseSize("--size", *picture.size);
    options.seed = picture.toSeed();
    if (picture.frames)
        options.frames = int(parseWhole("--frames", *picture.frames, 1, 1'000'000'000));
    options.animate = !still;
    if (screenshot && options.frames == 0)
        throw UsageError("--screenshot is written after the last frame; it needs --frames");
    options.screenshot = screenshot;
    options.resetSettings = resetSettings;
    options.shaders = shaders;
    if (uiCost)
        options.uiCost = int(parseWhole("--ui-cost", *uiCost, 1, 100'000));
    options.debugContext = debug;
    return options;
}

void BenchWords::addTo(CLI::App& app) {
    addOption(app, "SCENE", scene, "",
              "A name (afterglow list scenes), or a .gltf or .glb file [hall]");
    addOption(app, "--filter", filters, "A,B,...", "Which filters [all]");
    addOption(app, "--size", sizes, "WxH,...", "At which sizes [640x360]");
    picture.addSettings(app);
    addOption(app, "--frames,-n", picture.frames, "N",
              "Of each filter at each size; the first three are not counted [16]");
    picture.addSeed(app);
    picture.context.addTo(app);
    addOption(app, "--out,-o", out, "DIR", "Also writes DIR/bench.json");
    app.footer("Prints medians of every pass and of the frame, and rays a second.\n\n"
               "Examples:\n"
               "  afterglow bench\n"
               "  afterglow bench cornell --filter svgf,asvgf --size 320x180,640x360 --out "
               "out/bench\n\n" +
               kExitCodes);
}

BenchOptions BenchWords::parse() const {
    BenchOptions options;
    options.settings = picture.toSettings();
    if (scene)
        options.scene = *scene;
    if (filters)
        for (const std::string& name : parseList("--filter", *filters))
            options.filters.push_back(filterFromName(name));
    if (sizes) {
        options.sizes.clear();
        for (const std::string& size : parseList("--size", *sizes))
            options.sizes.push_back(parseSize("--size", size));
    }
    if (picture.frames)
        options.frames = int(parseWhole("--frames", *picture.frames, 4, kMostFrames));
    options.seed = picture.toSeed();
    options.context = picture.context.parse();
    options.out = out;
    return options;
}

} // namespace afterglow
