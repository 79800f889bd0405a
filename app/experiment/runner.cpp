// SPDX-License-Identifier: MIT
#include "app/experiment/runner.h"

#include "app/base/machine.h"
#include "app/experiment/import_frames.h"
#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/measure/meter.h"
#include "app/measure/metric.h"
#include "app/measure/run_outline.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/base/log.h"
#include "renderer/gl/errors.h"
#include "renderer/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <future>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

// A frame costs about as much as this many samples of a reference: for the progress line only.
constexpr double kFrameWork = 6.0;

// Beyond it the settled mean of imported frames is taken for a sign that they hold something else.
constexpr double kLargestBias = 0.1;

Image<glm::u8vec4> grayOf(const Image<float>& map) {
    Image<glm::u8vec4> gray(map.size());
    std::ranges::transform(map.pixels(), gray.pixels().begin(), [](float value) {
        const auto level = std::uint8_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
        return glm::u8vec4(level, level, level, 255);
    });
    return gray;
}

// Everything that the files of a variant depend on; of an external one, its frames apart.
std::string keyOf(const Variant& variant, const Experiment& experiment, const StagedRun& run,
                  const ReferenceMaker& maker, FrameRange own) {
    Experiment alone = experiment;
    alone.variants = {variant};
    Hash hash;
    hash.add(toJson(alone));
    hash.add(programFingerprint());
    // The scene, the shaders and the driver: all that a converged picture of it depends on.
    const FrameInput input = inputAt(experiment, run.plan, 0);
    const Settings settings = settingsOf(variant, experiment.signal);
    hash.add(referenceKey({.scene = run.scene,
                           .size = experiment.size,
                           .seen = input,
                           .world = input,
                           .settings = settings,
                           .samples = 1},
                          maker));
    hash.add(own.first);
    hash.add(own.end);
    return hash.hex();
}

class Run {
public:
    Run(const Experiment& experiment, const StagedRun& staged, Renderer& renderer, const GlInfo& gl,
        ReferenceStore& store, const OutputFolder& folder, const RunOptions& options,
        Progress& progress)
        : experiment_(experiment), staged_(staged), plan_(staged.plan), renderer_(renderer),
          gl_(gl), store_(store), folder_(folder), options_(options), progress_(progress),
          own_(framesOf(options.part, experiment.frames())), truths_(experiment, staged.plan) {}

    void run();

private:
    std::string key(const Variant& variant) const {
        return keyOf(variant, experiment_, staged_, store_.maker(), own_);
    }
    bool isImported(const Variant& variant) const {
        return variant.external && options_.imported &&
               options_.imported->variant() == variant.name;
    }
    bool isDone(const Variant& variant) const;
    void makeReferences();
    void runVariant(const Variant& variant);
    void importVariant(const Variant& variant);
    void finishVariant(const Variant& variant, const MetricsTable& table, const OutputFolder& out,
                       const Json& timing);
    void measure(Meter& meter, int frame, const Variant& variant, const FrameImages& images,
                 MetricsTable& table, const OutputFolder& out);
    Json describeRun() const;
    void sayProgress(double work, const std::string& doing) {
        progress_.advance(work, experiment_.name + ": " + doing);
    }

    const Experiment& experiment_;
    const StagedRun& staged_;
    const RunPlan& plan_;
    Renderer& renderer_;
    const GlInfo& gl_;
    ReferenceStore& store_;
    const OutputFolder& folder_;
    const RunOptions& options_;
    Progress& progress_;
    FrameRange own_;
    Truths truths_;
};

bool Run::isDone(const Variant& variant) const {
    if (isImported(variant))
        return false;
    const bool isThere = finishedKey(folder_.path() / variant.name) == key(variant);
    if (variant.external && !isThere)
        throw InputError(experiment_.name + ": the frames of " + variant.name +
                         " come from outside, and " + (folder_.path() / variant.name).string() +
                         " does not hold their measures; afterglow import-frames makes them");
    return isThere && (variant.external || !options_.fresh);
}

void Run::makeReferences() {
    truths_.make(renderer_, store_, own_, [&](int samples) {
        sayProgress(samples, "references, " + std::to_string(experiment_.referenceSamples) +
                                 " samples a pixel");
    });
    requireSoundContext(); // rather than after hours
    const OutputFolder out = folder_.subfolder("reference");
    Json spent = Json::array();
    for (std::size_t i = 0; i < plan_.intervals.size(); ++i) {
        const Interval& interval = plan_.intervals[i];
        if (!truths_.has(i) || !own_.contains(interval.first))
            continue;
        const Truth& truth = truths_.of(i);
        if (countOf(truth.foreground) == 0)
            throw InputError(experiment_.name + ": the camera of " + staged_.scene.name +
                             " sees no surface in frame " + std::to_string(interval.first) +
                             ", so there is nothing to measure");
        out.writePng(frameStem("frame", interval.first) + ".png", truth.display);
        spent.push_back({{"first", interval.first}, {"ms", truth.milliseconds}});
    }
    out.writeJson("timing.json", {{"references", spent}});
}

void Run::measure(Meter& meter, int frame, const Variant& variant, const FrameImages& images,
                  MetricsTable& table, const OutputFolder& out) {
    // On another thread: packing takes as long as some measures do.
    std::future<void> written = std::async(std::launch::async, [&] {
        out.writePng(frameStem("frame", frame) + ".png", images.display);
    });
    const bool isPicture = std::ranges::find(plan_.pictures, frame) != plan_.pictures.end();
    FrameMaps maps;
    meter.measure(frame, images, table, variant.name, isPicture ? &maps : nullptr);
    written.get();
    for (const auto& [name, map] : maps)
        out.subfolder("maps").writePng(frameStem(name, frame) + ".png", grayOf(map));
}

void Run::runVariant(const Variant& variant) {
    const OutputFolder out = folder_.subfolder(variant.name);
    forgetFinished(out.path());
    const Settings settings = settingsOf(variant, experiment_.signal);
    Meter meter(experiment_, plan_, truths_);
    MetricsTable table;
    FrameClock clock;
    renderer_.resetHistory();
    renderer_.timer().setEnabled(true);
    for (int frame = 0; frame < own_.end; ++frame) {
        if (own_.contains(frame)) {
            clock.render(renderer_, inputAt(experiment_, plan_, frame), settings);
            table.add(variant.name, frame, "rays", double(clock.stats().back().rays));
            table.add(variant.name, frame, "gradient_samples",
                      clock.stats().back().gradientSamples);
            table.add(variant.name, frame, "invalid_values", clock.stats().back().invalidValues);
            measure(meter, frame, variant, readFrame(renderer_, true), table, out);
        } else {
            renderer_.render(inputAt(experiment_, plan_, frame), settings);
            if (frame == own_.first - 1 || plan_.settled.contains(frame))
                meter.skip(frame, readFrame(renderer_, false));
        }
        sayProgress(own_.contains(frame) ? kFrameWork : kFrameWork / 3.0,
                    variant.name + ", frame " + std::to_string(frame + 1) + " of " +
                        std::to_string(own_.end));
    }
    Json timing = {{"first", own_.first}, {"end", own_.end}};
    timing.update(describe(clock));
    finishVariant(variant, table, out, Json::array({timing}));
}

// What another program has made takes the place of what a filter would have made of each frame.
void Run::importVariant(const Variant& variant) {
    const OutputFolder out = folder_.subfolder(variant.name);
    forgetFinished(out.path());
    const Settings settings = settingsOf(variant, experiment_.signal);
    Meter meter(experiment_, plan_, truths_);
    MetricsTable table;
    double settledMean = 0.0, referenceMean = 0.0; // both times the number of settled frames
    renderer_.resetHistory();
    for (int frame = own_.first; frame < own_.end; ++frame) {
        renderer_.render(inputAt(experiment_, plan_, frame), settings);
        const FrameImages images = options_.imported->show(frame, renderer_, settings);
        measure(meter, frame, variant, images, table, out);
        if (plan_.settled.contains(frame)) {
            const Truth& truth = truths_.at(frame);
            settledMean += meanOf(luminanceOf(images.lit), &truth.foreground);
            referenceMean += meanOf(luminanceOf(truth.lit), &truth.foreground);
        }
        sayProgress(kFrameWork, variant.name + ", frame " + std::to_string(frame + 1) + " of " +
                                    std::to_string(own_.end));
    }
    const auto ratio =
        referenceMean > 0.0 ? std::optional(settledMean / referenceMean) : std::nullopt;
    if (ratio && std::abs(*ratio - 1.0) > kLargestBias)
        log(LogLevel::Warning,
            fmt::format(
                "{}: its settled mean is {:.2f} of the reference's; is it right that its frames "
                "hold the quantity {}?",
                variant.name, *ratio, nameOf(options_.imported->quantity())));
    Json account = options_.imported->describe();
    account["mean"] = ratio ? Json(*ratio) : Json(nullptr);
    out.writeJson("import.json", account);
    finishVariant(variant, table, out, Json::array()); // nobody knows how long they took
}

// Marks a variant as finished, unless OpenGL has failed: its files may look whole and be wrong.
void Run::finishVariant(const Variant& variant, const MetricsTable& table, const OutputFolder& out,
                        const Json& timing) {
    out.writeText("metrics.csv", table.csv({variant.name}));
    requireSoundContext();
    markFinished(out, key(variant), timing);
}

Json Run::describeRun() const {
    Json scene = describe(staged_.scene, renderer_.sceneStats());
    scene.erase("bvh_build_ms"); // a time: the same run gives the same text
    Json json = {{"program", "afterglow"},
                 {"version", version()},
                 {"commit", commit()},
                 {"command", "experiment"},
                 {"gl", describe(gl_)},
                 {"machine", describeMachine()},
                 {"experiment", describe(experiment_)},
                 {"scene", scene},
                 {"measured", "linear rgb of filtered signal times albedo, over pixels that show a "
                              "surface; psnr, ssim and flip of the display image"}};
    writeOutline(outlineOf(plan_), json);
    json["references"] = Json::array();
    for (std::size_t i = 0; i < plan_.intervals.size(); ++i)
        if (truths_.has(i) && own_.contains(plan_.intervals[i].first))
            json["references"].push_back({{"first", plan_.intervals[i].first},
                                          {"end", plan_.intervals[i].end},
                                          {"samples", experiment_.referenceSamples},
                                          {"residual_rmse", truths_.of(i).residual}});
    json["settings"] = Json::object();
    for (const Variant& variant : experiment_.variants)
        if (!variant.external)
            json["settings"][variant.name] = toJson(settingsOf(variant, experiment_.signal));
    json["metrics"] = metricsJson();
    if (!options_.part.isWhole())
        json["part"] = {options_.part.index, options_.part.count};
    return json;
}

void Run::run() {
    std::vector<const Variant*> missing;
    for (const Variant& variant : experiment_.variants)
        if (!isDone(variant))
            missing.push_back(&variant);
    takeFolder({describe(experiment_), options_.part, options_.imported || options_.fresh}, folder_,
               options_.fresh);
    const bool isWritten = std::filesystem::exists(folder_.path() / "experiment.json");
    const double perVariant = workOf(experiment_, plan_, options_.part) -
                              double(truths_.countFor(own_)) * experiment_.referenceSamples;
    const auto done = experiment_.variants.size() - missing.size();
    progress_.skip(perVariant * double(done) / double(experiment_.variants.size()));

    if (own_.frames() > 0 && (!missing.empty() || !isWritten)) {
        renderer_.setScene(staged_.scene);
        renderer_.resize(experiment_.size);
        makeReferences();
        for (const Variant* variant : missing)
            isImported(*variant) ? importVariant(*variant) : runVariant(*variant);
    } else {
        progress_.skip(double(truths_.countFor(own_)) * experiment_.referenceSamples);
    }
    if (!missing.empty() || !isWritten)
        writeAccount(folder_, describeRun());
    if (options_.part.isWhole())
        finishRun(folder_);
}

} // namespace

FrameRange framesOf(Part part, int frames) {
    const auto start = [&](int index) { return int(std::int64_t(frames) * index / part.count); };
    return {start(part.index - 1), start(part.index)};
}

bool isMeasured(const Variant& variant, const Experiment& experiment, const StagedRun& run,
                const ReferenceMaker& maker, const std::filesystem::path& folder) {
    return finishedKey(folder / variant.name) ==
           keyOf(variant, experiment, run, maker, {0, experiment.frames()});
}

double workOf(const Experiment& experiment, const RunPlan& plan, Part part) {
    const FrameRange own = framesOf(part, experiment.frames());
    const double frames = own.frames() + own.first / 3.0;
    return double(Truths(experiment, plan).countFor(own)) * experiment.referenceSamples +
           double(experiment.variants.size()) * frames * kFrameWork;
}

void runExperiment(const Experiment& experiment, const StagedRun& run, Renderer& renderer,
                   const GlInfo& gl, ReferenceStore& store, const OutputFolder& folder,
                   const RunOptions& options, Progress& progress) {
    Run(experiment, run, renderer, gl, store, folder, options, progress).run();
}

} // namespace afterglow
