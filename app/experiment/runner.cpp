#include "app/experiment/runner.h"

#include "app/experiment/progress.h"
#include "app/experiment/reference.h"
#include "app/experiment/run_sheet.h"
#include "renderer/base/error.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <numeric>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

// A frame costs about as much as this many samples of a reference: for the progress line only.
constexpr double kFrameWork = 4.0;

// References draw other random numbers than the frames that are compared with them.
constexpr std::uint32_t kReferenceSeed = 0x9e3779b9u;

/// Frames that share one converged picture.
struct Moment {
    int first = 0, end = 0;
    double seconds = 0.0;
    std::vector<LightState> lights{};
    bool afterEvent = false;  ///< a light was set differently in the frame before
    Image<float> luminance{}; ///< of the reference
    Image<glm::u8vec4> display{};
};

class Run {
public:
    Run(const Experiment& experiment, Renderer& renderer, const OutputFolder& folder)
        : experiment_(experiment), renderer_(renderer), folder_(folder),
          moments_(momentsOf(experiment, renderer.scene())),
          progress_(double(moments_.size()) * experiment.referenceSamples +
                    double(experiment.variants.size()) * experiment.frames() * kFrameWork) {
        settings_.lighting.signal = int(experiment.signal);
    }

    ExperimentResult run(RunSheet& sheet);

private:
    static std::vector<Moment> momentsOf(const Experiment& experiment, const Scene& scene);
    FrameInput inputAt(int frame, const Moment& moment, std::uint32_t seed) const;
    ReferenceResult makeReference(Moment& moment);
    VariantResult runVariant(const std::string& name, RunSheet& sheet);
    void measureEvents(VariantResult& variant);
    void chooseSettledWindow(ExperimentResult& result) const;
    std::size_t momentAt(int frame) const;

    const Experiment& experiment_;
    Renderer& renderer_;
    const OutputFolder& folder_;
    std::vector<Moment> moments_;
    std::vector<std::optional<StepChange>> changes_; ///< from the moment before to each
    Mask foreground_;
    Settings settings_;
    int settledFirst_ = 0, settledEnd_ = 0;
    std::vector<double> noise_; ///< of the variant that runs, one a frame, where there is a change
    Progress progress_;
};

std::vector<Moment> Run::momentsOf(const Experiment& experiment, const Scene& scene) {
    const double playing = experiment.animated ? duration(scene) : 0.0;
    std::vector<Moment> moments;
    for (const Segment& segment : experiment.timeline.segments()) {
        std::vector<LightState> lights;
        for (const Light& light : scene.lights)
            lights.push_back(segment.lights.of(light.name));
        // What moves is another picture in every frame; tracks hold their last value after their
        // end.
        int first = segment.first;
        while (first < segment.end) {
            const double seconds = experiment.animated ? experiment.seconds(first) : 0.0;
            const int end = seconds < playing ? first + 1 : segment.end;
            moments.push_back(
                {.first = first,
                 .end = end,
                 .seconds = seconds,
                 .lights = lights,
                 .afterEvent = first == segment.first && first > 0 && playing == 0.0});
            first = end;
        }
    }
    return moments;
}

std::size_t Run::momentAt(int frame) const {
    std::size_t index = 0;
    while (frame >= moments_[index].end)
        ++index;
    return index;
}

FrameInput Run::inputAt(int frame, const Moment& moment, std::uint32_t seed) const {
    const double seconds = experiment_.animated ? experiment_.seconds(frame) : 0.0;
    const Scene& scene = renderer_.scene();
    return {.camera = cameraAt(scene, poseAt(scene, seconds)),
            .seconds = seconds,
            .frame = std::uint32_t(frame),
            .seed = seed,
            .lights = moment.lights};
}

ReferenceResult Run::makeReference(Moment& moment) {
    const Convergence converged =
        converge(renderer_, inputAt(moment.first, moment, experiment_.seed ^ kReferenceSeed),
                 settings_, experiment_.referenceSamples, [&](int count) {
                     progress_.advance(count, "reference of frame " + std::to_string(moment.first));
                 });
    moment.luminance = converged.lit;
    moment.display = converged.display->read<glm::u8vec4>();
    folder_.subfolder("reference")
        .writePng(frameStem("frame", moment.first) + ".png", moment.display);
    return {moment.first, moment.end, converged.residual, converged.milliseconds};
}

void Run::chooseSettledWindow(ExperimentResult& result) const {
    const Moment* settled = &moments_.back();
    for (const Moment& moment : moments_) {
        const bool lit =
            std::ranges::any_of(moment.luminance.pixels(), [](float l) { return l > 0; });
        if (lit && (moment.end - moment.first > 1 || moments_.size() == 1)) {
            settled = &moment;
            break;
        }
    }
    result.settledEnd = settled->end;
    result.settledFirst = std::max(settled->first, settled->end - experiment_.settledWindow);
}

ExperimentResult Run::run(RunSheet& sheet) {
    ExperimentResult result;
    for (Moment& moment : moments_) {
        result.references.push_back(makeReference(moment));
        if (foreground_.size().x == 0) // what is seen and what is background hardly moves
            foreground_ = foregroundOf(renderer_);
    }
    if (countOf(foreground_) == 0)
        throw InputError(experiment_.name + ": the camera of " + renderer_.scene().name +
                         " sees no surface, so there is nothing to measure");
    changes_.resize(moments_.size());
    for (std::size_t i = 1; i < moments_.size(); ++i)
        if (moments_[i].afterEvent)
            changes_[i] = StepChange::between(moments_[i - 1].luminance, moments_[i].luminance);
    chooseSettledWindow(result);
    settledFirst_ = result.settledFirst;
    settledEnd_ = result.settledEnd;

    for (const std::string& name : experiment_.variants)
        result.variants.push_back(runVariant(name, sheet));
    for (int frame : sheet.frames())
        sheet.addReference(frame, moments_[momentAt(frame)].display);
    return result;
}

VariantResult Run::runVariant(const std::string& name, RunSheet& sheet) {
    VariantResult variant{.name = name};
    const OutputFolder frames = folder_.subfolder(name);
    settings_.filter = filterFromName(name);
    renderer_.resetHistory();
    renderer_.timer().setEnabled(true);
    noise_.clear();
    std::vector<Image<float>> settled;
    for (int frame = 0; frame < experiment_.frames(); ++frame) {
        const std::size_t index = momentAt(frame);
        const Moment& moment = moments_[index];
        const GpuTexture& display =
            variant.clock.render(renderer_, inputAt(frame, moment, experiment_.seed), settings_);
        const auto shown = display.read<glm::u8vec4>();
        frames.writePng(frameStem("frame", frame) + ".png", shown);
        sheet.addFrame(name, frame, shown);

        Image<float> luminance = litLuminance(renderer_);
        variant.rmse.push_back(rmse(luminance, moment.luminance, &foreground_));
        variant.relMse.push_back(relMse(luminance, moment.luminance, &foreground_));
        const auto& change = changes_[index];
        variant.response.push_back(change ? std::optional(change->response(luminance))
                                          : std::nullopt);
        noise_.push_back(change ? change->noise(luminance) : 0.0);
        if (frame >= settledFirst_ && frame < settledEnd_)
            settled.push_back(std::move(luminance));
        progress_.advance(kFrameWork, name + ", frame " + std::to_string(frame + 1) + " of " +
                                          std::to_string(experiment_.frames()));
    }
    variant.rmseSettled = std::accumulate(variant.rmse.begin() + settledFirst_,
                                          variant.rmse.begin() + settledEnd_, 0.0) /
                          (settledEnd_ - settledFirst_);
    variant.flicker = flicker(settled, &foreground_);
    measureEvents(variant);
    return variant;
}

void Run::measureEvents(VariantResult& variant) {
    for (std::size_t i = 0; i < moments_.size(); ++i) {
        if (!changes_[i])
            continue;
        const Moment& moment = moments_[i];
        std::vector<double> response;
        for (int frame = moment.first; frame < moment.end; ++frame)
            response.push_back(*variant.response[std::size_t(frame)]);
        const std::span<const double> noise(noise_.data() + moment.first,
                                            std::size_t(moment.end - moment.first));
        const auto first = noise.first(std::min<std::size_t>(kNoiseFrames, noise.size()));
        variant.events.push_back(
            {.frame = moment.first,
             .response = summarize(response),
             .noiseAfter = std::accumulate(first.begin(), first.end(), 0.0) / double(first.size()),
             .noiseSettles =
                 framesUntilSettled(noise, settledValue(noise, experiment_.settledWindow))});
    }
}

void requireLights(const Experiment& experiment, const Scene& scene) {
    for (const std::string& name : experiment.timeline.lightNames()) {
        std::vector<std::string_view> known;
        for (const Light& light : scene.lights)
            known.push_back(light.name);
        if (std::ranges::find(known, name) != known.end())
            continue;
        throw InputError(experiment.name + ": timeline: " +
                         unknownName("light of the scene " + scene.name, name, known));
    }
}

std::string metricsCsv(const ExperimentResult& result) {
    std::string csv = "variant,frame,metric,value\n";
    const auto add = [&](const std::string& variant, std::size_t frame, const char* metric,
                         double value) {
        char number[40];
        std::snprintf(number, sizeof number, "%.9g", value);
        csv += variant + "," + std::to_string(frame) + "," + metric + "," + number + "\n";
    };
    for (const VariantResult& v : result.variants)
        for (std::size_t frame = 0; frame < v.rmse.size(); ++frame) {
            if (v.response[frame])
                add(v.name, frame, "response", *v.response[frame]);
            add(v.name, frame, "rmse", v.rmse[frame]);
            add(v.name, frame, "relmse", v.relMse[frame]);
            add(v.name, frame, "ms", v.clock.milliseconds()[frame]);
        }
    return csv;
}

Json describeRun(const Experiment& experiment, const Renderer& renderer, const GlInfo& gl,
                 const ExperimentResult& result) {
    Json references = Json::array();
    for (const ReferenceResult& reference : result.references)
        references.push_back({{"first", reference.first},
                              {"end", reference.end},
                              {"samples", experiment.referenceSamples},
                              {"residual_rmse", reference.residual},
                              {"ms", reference.milliseconds}});
    Json timing = Json::object();
    for (const VariantResult& variant : result.variants)
        timing[variant.name] = describe(variant.clock);
    return {
        {"program", "afterglow"},
        {"version", version()},
        {"command", "experiment"},
        {"gl", describe(gl)},
        {"experiment", Json::parse(toJson(experiment))},
        {"scene", describe(renderer.scene(), renderer.sceneStats())},
        {"measured", "linear luminance of filtered times albedo, over pixels that show a surface"},
        {"settled_window", {result.settledFirst, result.settledEnd}},
        {"references", references},
        {"timing", timing}};
}

} // namespace

ExperimentResult runExperiment(const Experiment& experiment, Renderer& renderer, const GlInfo& gl,
                               const OutputFolder& folder) {
    Scene scene = loadScene(experiment.scene);
    requireLights(experiment, scene);
    renderer.setScene(std::move(scene));
    renderer.resize(experiment.size);

    RunSheet sheet(experiment);
    ExperimentResult result = Run(experiment, renderer, folder).run(sheet);
    folder.writePng("contact_sheet.png", sheet.draw(result));
    result.contactSheet = folder.path() / "contact_sheet.png";
    folder.writeText("metrics.csv", metricsCsv(result));
    folder.writeJson("experiment.json", describeRun(experiment, renderer, gl, result));
    folder.writeJson("summary.json", summaryOf(experiment, result));
    return result;
}

} // namespace afterglow
