// SPDX-License-Identifier: MIT
#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/commands/command.h"
#include "app/commands/shared_options.h"
#include "renderer/scene/load_scene.h"

#include <fmt/format.h>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

/// The command bench: measures every filter at every size, with medians per pass and frame.
class Bench final : public Command {
public:
    explicit Bench(Options& options);
    void run(HiddenContextFactory hiddenContext) override;

private:
    FrameClock measure(Renderer& renderer, Filter filter, Progress& progress) const;

    std::string scene_ = "hall";
    std::vector<Filter> filters_{allFilters().begin(), allFilters().end()};
    std::vector<glm::ivec2> sizes_{{640, 360}};
    SettingsGroup picture_;
    int frames_ = 16;
    std::uint32_t seed_ = 0;
    ContextGroup context_;
    std::string out_;
};

Bench::Bench(Options& options) {
    options.add("SCENE", scene_, anyText(""),
                "A name (afterglow list scenes), or a .gltf or .glb file");
    options.add("--filter", filters_, listOf(Kind<Filter>{"NAME", filterFromName}),
                "Which filters [all]");
    options.add("--size", sizes_, listOf(imageSize(), "WxH,..."), "At which sizes [640x360]");
    picture_.addTo(options);
    options.add("--frames,-n", frames_, wholeNumber(4, kMostFrames),
                "Of each filter at each size; the first three are not counted");
    options.add("--seed", seed_, seedNumber(), "Of all random numbers, 0 to 4294967295 [0]");
    context_.addTo(options);
    options.add("--out,-o", out_, anyText("DIR"), "Also writes DIR/bench.json");
    options.setFooter(R"(Prints medians of every pass and of the frame, and rays a second.

Examples:
  afterglow bench
  afterglow bench cornell --filter svgf,asvgf --size 320x180,640x360 --out out/bench)");
}

FrameClock Bench::measure(Renderer& renderer, Filter filter, Progress& progress) const {
    Settings settings = picture_.changed({});
    settings.filter = filter;
    const Camera camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    renderer.resetHistory();
    FrameClock clock;
    for (int frame = 0; frame < frames_; ++frame) {
        clock.render(renderer,
                     {.camera = camera,
                      .seconds = 0.0,
                      .frame = std::uint32_t(frame),
                      .seed = seed_,
                      .lights = {}},
                     settings);
        progress.advance(double(renderer.size().x) * renderer.size().y, nameOf(filter));
    }
    return clock;
}

void Bench::run(HiddenContextFactory hiddenContext) {
    Scene scene = loadScene(scene_);
    std::optional<OutputFolder> folder;
    if (!out_.empty())
        folder.emplace(out_);
    Headless headless(context_, hiddenContext);
    Renderer& renderer = headless.renderer;
    renderer.setScene(std::move(scene));
    renderer.timer().setEnabled(true);
    fmt::print("{} on {} ({})\n", renderer.scene().name, headless.gl.renderer, headless.gl.backend);
    noteSoftwareRenderer(headless.gl);

    double work = 0.0;
    for (glm::ivec2 size : sizes_)
        work += double(size.x) * size.y * frames_ * double(filters_.size());
    Json runs = Json::array();
    std::string table;
    {
        Progress progress(work);
        for (glm::ivec2 size : sizes_) {
            headless.resize(size);
            for (Filter filter : filters_) {
                const FrameClock clock = measure(renderer, filter, progress);
                table += fmt::format("{:5} x {:<5}  {:<6}  {:9.3f} ms a frame  {}\n", size.x,
                                     size.y, nameOf(filter), clock.medianMilliseconds(),
                                     raysText(clock.raysPerSecond()));
                table += passTable(clock);
                Json run{{"size", {size.x, size.y}}, {"filter", nameOf(filter)}};
                run.update(describe(clock));
                runs.push_back(run);
            }
        }
    }
    fmt::print("{}", table);
    if (!folder)
        return;
    folder->writeJson("bench.json", {{"program", "afterglow"},
                                     {"version", version()},
                                     {"command", "bench"},
                                     {"scene", describe(renderer.scene(), renderer.sceneStats())},
                                     {"gl", describe(headless.gl)},
                                     {"frames", frames_},
                                     {"seed", seed_},
                                     {"runs", runs}});
    fmt::print("written: {}\n", (folder->path() / "bench.json").string());
}

} // namespace

MadeCommand benchCommand(Options& options) {
    return std::make_unique<Bench>(options);
}

} // namespace afterglow
