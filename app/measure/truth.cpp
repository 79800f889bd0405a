#include "app/measure/truth.h"

#include "app/measure/oracle.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <set>

namespace afterglow {

Truths::Truths(const Experiment& experiment, const RunPlan& plan)
    : experiment_(experiment), plan_(plan), truths_(plan.moments.size()) {}

FrameInput Truths::input(int frame, const Moment& moment, std::uint32_t seed) const {
    const double seconds = experiment_.seconds(frame);
    return {.camera = cameraAt(plan_.scene, poseAt(plan_.scene, seconds)),
            .seconds = seconds,
            .frame = std::uint32_t(frame),
            .seed = seed,
            .lights = moment.lights};
}

FrameInput Truths::inputAt(int frame) const {
    return input(frame, plan_.moments[momentAt(plan_.moments, frame)], experiment_.seed);
}

FrameInput Truths::referenceInput(const Moment& moment) const {
    return input(moment.first, moment, referenceSeed(experiment_.seed));
}

std::vector<std::size_t> Truths::neededFor(FrameRange range) const {
    const std::vector<Moment>& moments = plan_.moments;
    std::set<std::size_t> needed;
    const std::size_t first = momentAt(moments, std::max(0, range.first - kTrailFrames));
    const std::size_t last = momentAt(moments, range.end - 1);
    for (std::size_t i = first; i <= last; ++i)
        needed.insert(i);
    // The change to come, of which the frames before it show nothing yet.
    if (last + 1 < moments.size() && moments[last + 1].isStep() &&
        moments[last + 1].first - experiment_.settledWindow < range.end)
        needed.insert(last + 1);
    // A step is from the moment before.
    if (moments[first].isStep() && first > 0)
        needed.insert(first - 1);
    return {needed.begin(), needed.end()};
}

int Truths::countFor(FrameRange range) const {
    int count = 0;
    for (const std::size_t i : neededFor(range)) {
        const Moment& moment = plan_.moments[i];
        count += 1 + int(i > 0 && moment.worldMoved && range.contains(moment.first));
    }
    return count;
}

void Truths::make(Renderer& renderer, ReferenceStore& store, FrameRange range,
                  const std::function<void(int)>& advanced) {
    Settings settings;
    settings.lighting.signal = int(experiment_.signal);
    const float floor = settings.denoiser.gradient.deltaFloor;
    for (const std::size_t i : neededFor(range)) {
        const Moment& moment = plan_.moments[i];
        if (!truths_[i]) {
            const FrameInput input = referenceInput(moment);
            const Reference reference =
                store.get(renderer, input, input, settings, experiment_.referenceSamples, advanced);
            Truth truth;
            truth.display = renderer.showReference(reference.signals, settings).read<glm::u8vec4>();
            truth.foreground = foregroundOf(renderer);
            truth.lit = litRadiance(renderer);
            truth.residual = reference.residual;
            truth.milliseconds = reference.milliseconds;
            for (const Image<glm::vec4>& signal : reference.signals) {
                SignalTruth& own = truth.signals.emplace_back();
                own.luminance = luminanceOf(signal);
                own.variance = channelOf(signal, 3);
                own.litLater = litStrata(own.luminance, own.luminance, truth.foreground, floor);
            }
            truths_[i] = std::move(truth);
        }
        Truth& truth = *truths_[i];
        if (truth.knowsChange || !range.contains(moment.first))
            continue;
        truth.knowsChange = true;
        // What these surfaces reflected one frame ago. Light and shadow on them do not depend on
        // the camera, so if it alone has moved they reflected just the same.
        std::vector<Image<float>> before;
        if (i > 0 && (moment.lightsChanged || moment.worldMoved)) {
            FrameInput world = referenceInput(plan_.moments[i - 1]);
            world.seconds = experiment_.seconds(moment.first - 1);
            for (const Image<glm::vec4>& signal :
                 store
                     .get(renderer, referenceInput(moment), world, settings,
                          experiment_.referenceSamples, advanced)
                     .signals)
                before.push_back(luminanceOf(signal));
        } else {
            for (const SignalTruth& signal : truth.signals)
                before.push_back(signal.luminance);
        }
        for (std::size_t s = 0; s < truth.signals.size(); ++s) {
            SignalTruth& own = truth.signals[s];
            own.idealLambda = idealLambda(own.luminance, before[s], truth.foreground, floor);
            own.litFirst = litStrata(own.luminance, before[s], truth.foreground, floor);
        }
    }
}

} // namespace afterglow
