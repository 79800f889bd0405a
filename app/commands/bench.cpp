// SPDX-License-Identifier: MIT
#include "app/commands/bench.h"

#include "app/base/output.h"
#include "app/base/progress.h"
#include "renderer/scene/load_scene.h"

#include <cstdio>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

FrameClock measure(const BenchOptions& options, Renderer& renderer, Filter filter,
                   Progress& progress) {
    Settings settings = options.settings;
    settings.filter = filter;
    const Camera camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    renderer.resetHistory();
    FrameClock clock;
    for (int frame = 0; frame < options.frames; ++frame) {
        clock.render(renderer,
                     {.camera = camera,
                      .seconds = 0.0,
                      .frame = std::uint32_t(frame),
                      .seed = options.seed,
                      .lights = {}},
                     settings);
        progress.advance(double(renderer.size().x) * renderer.size().y, nameOf(filter));
    }
    return clock;
}

} // namespace

void runBench(const BenchOptions& options, HiddenContextFactory hiddenContext) {
    Scene scene = loadScene(options.scene);
    std::optional<OutputFolder> folder;
    if (options.out)
        folder.emplace(*options.out);
    const std::vector<Filter> filters =
        options.filters.empty() ? std::vector<Filter>(allFilters().begin(), allFilters().end())
                                : options.filters;

    Headless headless(options.context, hiddenContext);
    Renderer& renderer = headless.renderer;
    renderer.setScene(std::move(scene));
    renderer.timer().setEnabled(true);
    std::printf("%s on %s (%s)\n", renderer.scene().name.c_str(), headless.gl.renderer.c_str(),
                headless.gl.backend.c_str());
    tellSoftwareRenderer(headless.gl);

    double work = 0.0;
    for (glm::ivec2 size : options.sizes)
        work += double(size.x) * size.y * options.frames * double(filters.size());
    Json runs = Json::array();
    std::string table;
    {
        Progress progress(work);
        for (glm::ivec2 size : options.sizes) {
            headless.resize(size);
            for (Filter filter : filters) {
                const FrameClock clock = measure(options, renderer, filter, progress);
                char line[160];
                std::snprintf(line, sizeof line, "%5d x %-5d  %-6s  %9.3f ms a frame  %s\n", size.x,
                              size.y, std::string(nameOf(filter)).c_str(),
                              clock.medianMilliseconds(), raysText(clock.raysPerSecond()).c_str());
                table += line;
                table += passTable(clock);
                Json run{{"size", {size.x, size.y}}, {"filter", nameOf(filter)}};
                run.update(describe(clock));
                runs.push_back(run);
            }
        }
    }
    std::fputs(table.c_str(), stdout);
    if (folder) {
        folder->writeJson("bench.json",
                          {{"program", "afterglow"},
                           {"version", version()},
                           {"command", "bench"},
                           {"scene", describe(renderer.scene(), renderer.sceneStats())},
                           {"gl", describe(headless.gl)},
                           {"frames", options.frames},
                           {"seed", options.seed},
                           {"runs", runs}});
        std::printf("written: %s\n", (folder->path() / "bench.json").c_str());
    }
}

} // namespace afterglow
