// SPDX-License-Identifier: MIT
#include "app/base/machine.h"
#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/bench/bvh_bench.h"
#include "app/bench/compare_figures.h"
#include "app/bench/embree_scene.h"
#include "app/bench/memory_bench.h"
#include "app/bench/pass_bench.h"
#include "app/bench/ray_bench.h"
#include "app/bench/startup.h"
#include "app/commands/command.h"
#include "app/commands/shared_options.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

constexpr glm::ivec2 kCopied{2048, 2048}; ///< pixels: 64 MB, more than caches hold
constexpr int kMemoryFrames = 2;          ///< until all images of a filter are there

/// The command bench: measures passes, rays, trees, memory and start, and compares two results.
class Bench final : public Command {
public:
    explicit Bench(Options& options);
    void run(HiddenContextFactory hiddenContext) override;

private:
    bool wants(std::string_view measurement) const {
        return std::ranges::find(what_, measurement) != what_.end();
    }
    void check() const;
    void compare() const;
    void startOnce(HiddenContextFactory hiddenContext) const;
    std::string measure(Headless& headless, const std::string& subject, Figures& figures) const;
    Filter startupFilter() const;
    StartupFigures startup(const std::string& scene, glm::ivec2 size) const;
    Json facts(const Headless& headless, const Json& scenes) const;

    std::vector<std::string> scenes_{"hall"};
    std::vector<Filter> filters_{allFilters().begin(), allFilters().end()};
    std::vector<glm::ivec2> sizes_{{640, 360}};
    std::vector<std::string> what_{"passes", "rays", "bvh", "memory", "startup"};
    SettingsGroup picture_;
    BenchFrames frames_;
    int repeats_ = 9;
    ContextGroup context_;
    std::string json_;
    std::vector<std::string> compared_;
    double bound_ = 10.0;
    bool startOnce_ = false;
};

Bench::Bench(Options& options) {
    options.addPlaces("SCENE", scenes_, anyText(""),
                      "Names (afterglow list scenes), or .gltf or .glb files [hall]");
    options.add("--what", what_, listOf(oneOf("measurement", what_)),
                "Which of passes, rays, bvh, memory, startup [all]");
    options.add("--filter", filters_, listOf(Kind<Filter>{"NAME", filterFromName}),
                "Which filters [all]");
    options.add("--size", sizes_, listOf(imageSize(), "WxH,..."), "At which sizes [640x360]");
    picture_.addTo(options);
    options.add("--frames,-n", frames_.frames, wholeNumber(kLeastFrames, kMostFrames),
                "Of each filter at each size; the first three of each round are not counted");
    options.add("--repeat", repeats_, wholeNumber(1, 1000),
                "How often rays, trees and copies are measured; starts a third as often");
    options.add("--seed", frames_.seed, seedNumber(), "Of all random numbers, 0 to 4294967295 [0]");
    context_.addTo(options);
    options.add("--json", json_, anyText("FILE"), "Also writes all figures into FILE");
    options.addPair("--compare", compared_, anyText("FILE"),
                    "Measures nothing, and compares two such files, before and after");
    options.add("--bound", bound_, number(0.0, 1e6, "PCT"),
                "With --compare, how many percent worse a time may be [10]");
    options.addFlag("--start-once", startOnce_,
                    "Measures nothing but its own start, and prints the moments");
    options.need("--bound", "--compare");
    options.exclude("--compare",
                    {"SCENE", "--json", "--what", "--filter", "--size", "--start-once"});
    options.check([this] { check(); });
    options.setFooter(
        R"(Prints medians and quartiles. Times of passes are between two glFinish() on a software
renderer, and timestamps of the device elsewhere. With --compare, exit code 1 if any time
is worse by more than the bound.

Examples:
  afterglow bench
  afterglow bench cornell --filter svgf,asvgf --size 320x180,640x360 --json out/before.json
  afterglow bench hall --what rays,bvh
  afterglow bench --compare out/before.json out/after.json --bound 5)");
}

void Bench::check() const {
    const auto requireDistinct = [](const auto& values, const char* name) {
        for (auto value = values.begin(); value != values.end(); ++value)
            if (std::find(values.begin(), value, *value) != value)
                throw UsageError(std::string(name) + ": the same one twice");
    };
    requireDistinct(scenes_, "SCENE");
    requireDistinct(sizes_, "--size");
    requireDistinct(filters_, "--filter");
    if (startOnce_ && (scenes_.size() > 1 || sizes_.size() > 1 || filters_.size() > 1))
        throw UsageError("--start-once: one scene, size and filter");
}

void Bench::compare() const {
    const auto read = [](const std::string& file) { return readBenchFile(readFile(file), file); };
    const BenchFile before = read(compared_[0]), after = read(compared_[1]);
    const FigureComparison comparison = compareFigures(before.figures, after.figures, bound_);
    if (comparison.rows.empty())
        throw InputError(compared_[1] + ": has no figure in common with " + compared_[0]);
    fmt::print("{}", tableOf(comparison));
    if (before.machine != after.machine)
        fmt::print("  not the same machine: {}\n                        {}\n", before.machine,
                   after.machine);
    const auto slower = comparison.slower();
    if (!slower.empty())
        throw Error(fmt::format("{} of {} figures {} worse by more than {:g} %, most of all {}",
                                slower.size(), comparison.rows.size(),
                                slower.size() == 1 ? "is a time that is" : "are times that are",
                                bound_, slower.front().key));
}

void Bench::startOnce(HiddenContextFactory hiddenContext) const {
    using Clock = std::chrono::steady_clock;
    StartupTimes times;
    times.command = Clock::now();
    Scene scene = loadScene(scenes_.front());
    times.scene = Clock::now();
    Headless headless(context_, hiddenContext);
    Renderer& renderer = headless.renderer;
    times.context = headless.contextMade;
    times.programs = Clock::now();
    renderer.setScene(std::move(scene));
    glFinish();
    times.upload = Clock::now();
    times.bvhMilliseconds = renderer.sceneStats().bvhBuildMilliseconds;
    headless.resize(sizes_.front());
    BenchFrames frames = frames_;
    frames.settings = picture_.changed(frames.settings);
    const auto render = [&](std::uint32_t frame) {
        renderer.render(BenchFrames::inputOf(renderer.scene(), frame, frames.seed),
                        frames.settingsOf(filters_.front()));
        glFinish();
        return Clock::now();
    };
    times.first = render(0);
    times.second = render(1);
    fmt::print("{}\n", lineOf(times));
}

Filter Bench::startupFilter() const {
    const bool asvgf = std::ranges::find(filters_, Filter::Asvgf) != filters_.end();
    return asvgf ? Filter::Asvgf : filters_.front();
}

StartupFigures Bench::startup(const std::string& scene, glm::ivec2 size) const {
    std::vector<std::string> words{"bench",
                                   scene,
                                   "--start-once",
                                   "--size",
                                   fmt::format("{}x{}", size.x, size.y),
                                   "--filter",
                                   std::string(nameOf(startupFilter())),
                                   "--context",
                                   std::string(nameOf(context_.choice)),
                                   "--seed",
                                   std::to_string(frames_.seed)};
    if (context_.device)
        words.insert(words.end(), {"--device", std::to_string(*context_.device)});
    if (picture_.signal)
        words.insert(words.end(), {"--signal", std::string(nameOf(*picture_.signal))});
    for (const auto& [key, value] : picture_.changes)
        words.insert(words.end(), {"--set", key + "=" + value});
    return measureStartup(words, std::max(1, repeats_ / 3));
}

std::string Bench::measure(Headless& headless, const std::string& subject, Figures& figures) const {
    Renderer& renderer = headless.renderer;
    const double pixels = double(renderer.size().x) * renderer.size().y;
    BenchFrames frames = frames_;
    frames.settings = picture_.changed(frames.settings);
    const auto renderFrames = [&](Filter filter) {
        renderer.resetHistory();
        for (int i = 0; i < kMemoryFrames; ++i)
            renderer.render(BenchFrames::inputOf(renderer.scene(), std::uint32_t(i), frames.seed),
                            frames.settingsOf(filter));
    };
    Progress progress(pixels * (wants("passes") ? frames.frames * double(filters_.size()) : 0.0) +
                      pixels * (wants("rays") ? repeats_ * double(kRayKinds.size()) : 0.0) + 1.0);
    std::string text;
    if (wants("passes")) {
        const auto passes = measurePasses(renderer, frames, filters_, progress);
        addTo(figures, subject, passes);
        text += tableOf(passes, figures.find("copy.gb_per_s")->value);
    }
    if (wants("memory")) {
        std::vector<MemoryFigures> memory;
        for (const Filter filter : filters_) {
            const glm::ivec2 size = renderer.size();
            renderer.resize({1, 1}); // what other filters have made is gone
            renderer.resize(size);
            renderFrames(filter);
            memory.push_back(countMemory(renderer, filter));
            addTo(figures, subject, memory.back());
        }
        text += tableOf(memory);
    }
    if (wants("rays")) {
        renderFrames(filters_.front());
        const auto rays = measureRays(renderer, headless.shaders, repeats_, progress);
        addTo(figures, subject, rays);
        text += tableOf(rays, headless.gl.softwareRasterizer);
    }
    return text;
}

Json Bench::facts(const Headless& headless, const Json& scenes) const {
    Json filters = Json::array(), sizes = Json::array(), changes = Json::object();
    for (const Filter filter : filters_)
        filters.push_back(nameOf(filter));
    for (const glm::ivec2 size : sizes_)
        sizes.push_back({size.x, size.y});
    for (const auto& [key, value] : picture_.changes)
        changes[key] = value;
    return {{"program", "afterglow"},
            {"command", "bench"},
            {"schema", kBenchSchema},
            {"version", version()},
            {"commit", commit()},
            {"machine", describeMachine()},
            {"gl", describe(headless.gl)},
            {"tracing_threads", tracingThreads()},
            {"embree", EmbreeScene::isThere()},
            {"what", what_},
            {"filters", filters},
            {"sizes", sizes},
            {"signal", nameOf(picture_.signal.value_or(Signal::Both))},
            {"settings", changes},
            {"frames", frames_.frames},
            {"repeats", repeats_},
            {"seed", frames_.seed},
            {"scenes", scenes}};
}

void Bench::run(HiddenContextFactory hiddenContext) {
    if (!compared_.empty())
        return compare();
    if (startOnce_)
        return startOnce(hiddenContext);
    std::vector<Scene> scenes;
    for (const std::string& scene : scenes_)
        scenes.push_back(loadScene(scene));
    std::optional<OutputFolder> folder;
    const std::filesystem::path file(json_);
    if (!json_.empty())
        folder.emplace(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));

    Headless headless(context_, hiddenContext);
    Renderer& renderer = headless.renderer;
    renderer.timer().setEnabled(true);
    fmt::print("{} ({}), {} of the CPU for Embree and trees\n", headless.gl.renderer,
               headless.gl.backend,
               tracingThreads() == 1 ? "1 thread" : fmt::format("{} threads", tracingThreads()));
    noteSoftwareRenderer(headless.gl);

    Figures figures;
    if (wants("passes")) {
        const Spread copy = measureCopy(headless.shaders, kCopied, repeats_);
        figures.add("", "copy.gb_per_s", "GB/s", Better::None, copy);
        fmt::print("a copy moves {:.1f} GB/s ({:.1f} - {:.1f}), read and written\n", copy.median,
                   copy.lower, copy.upper);
    }
    Json described = Json::array();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const std::string name = scenes[i].name;
        std::optional<BvhFigures> bvh;
        if (wants("bvh"))
            bvh = measureBvh(scenes[i], repeats_);
        renderer.setScene(std::move(scenes[i]));
        described.push_back(describe(renderer.scene(), renderer.sceneStats()));
        fmt::print("\n{}: {} triangles\n", name, renderer.sceneStats().triangles);
        if (bvh) {
            addTo(figures, name, *bvh);
            fmt::print("{}", tableOf(*bvh));
        }
        for (const glm::ivec2 size : sizes_) {
            const std::string subject = fmt::format("{}/{}x{}", name, size.x, size.y);
            headless.resize(size);
            std::string text = measure(headless, subject, figures);
            if (wants("startup")) {
                const StartupFigures start = startup(scenes_[i], size);
                addTo(figures, subject + "/" + std::string(nameOf(startupFilter())), start);
                text += tableOf(start);
            }
            fmt::print("{}\n{}", subject, text);
        }
    }
    if (!folder)
        return;
    Json json = facts(headless, described);
    json["figures"] = describe(figures);
    folder->writeJson(file.filename().string(), json);
    fmt::print("written: {}\n", file.string());
}

} // namespace

const CommandRow kBenchCommand{"bench", "Measures how long frames and passes take", make<Bench>};

} // namespace afterglow
