// SPDX-License-Identifier: MIT
#include "app/scenario/take_experiment.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr double kRateOfStills = 60.0;  // frames per second, where time makes no difference
constexpr double kTimeTolerance = 1e-6; // seconds
constexpr float kViewTolerance = 1e-4f; // meters, and components of unit vectors
constexpr double kMostFrames = 100000;  // of an experiment

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

/// "take-1: frame 12: ", counted as the person at the window sees it.
std::string at(const Take& take, std::size_t frame) {
    return fmt::format("{}: frame {}: ", take.name, take.frames[frame].frame);
}

// --- marks ---------------------------------------------------------------------------------------

/// Moves of the camera that follow each other without a gap, as one.
std::vector<TimelineEvent> withJoinedMoves(const std::vector<TimelineEvent>& events) {
    std::vector<TimelineEvent> joined;
    std::size_t last = 0; // move, if there is one
    for (const TimelineEvent& event : events) {
        const auto* const move = std::get_if<CameraMove>(&event);
        auto* const before =
            last < joined.size() ? std::get_if<CameraMove>(&joined[last]) : nullptr;
        if (move && before && before->frame > 0 && before->until == move->frame) {
            before->until = move->until;
            continue;
        }
        if (move)
            last = joined.size();
        joined.push_back(event);
    }
    return joined;
}

// --- time ----------------------------------------------------------------------------------------

struct Pace {
    double rate = kRateOfStills;
    bool advances = false;
    std::optional<std::size_t> uneven = {}; ///< the first frame that is not in step
};

std::optional<std::size_t> firstOffBeat(const Take& take, double rate) {
    const double start = take.frames.front().seconds;
    for (std::size_t i = 0; i < take.frames.size(); ++i)
        if (std::abs(take.frames[i].seconds - start - double(i) / rate) > kTimeTolerance)
            return i;
    return {};
}

/// Returns the rate with the fewest decimals that agrees with every frame.
Pace paceOf(const Take& take) {
    const double first = take.frames.front().seconds;
    const double length = take.frames.back().seconds - first;
    if (take.frames.size() < 2)
        return {};
    const auto moved =
        std::ranges::find_if(take.frames, [&](const SceneFrame& m) { return m.seconds != first; });
    if (moved == take.frames.end())
        return {};
    Pace pace{.advances = true};
    if (length <= 0.0) {
        pace.uneven = std::size_t(moved - take.frames.begin());
        return pace;
    }
    const double rate = double(take.frames.size() - 1) / length;
    for (double scale = 1.0; scale <= 1e9; scale *= 10.0) {
        pace.rate = std::round(rate * scale) / scale;
        if (pace.rate > 0.0 && !firstOffBeat(take, pace.rate))
            return pace;
    }
    // With the step that it begins with, the first frame that is not in step is the one to name.
    const double step = take.frames[1].seconds - first;
    pace.uneven = step > 0.0 ? firstOffBeat(take, 1.0 / step).value_or(1) : 1;
    pace.rate = kRateOfStills;
    return pace;
}

/// Returns what poses and cameras need of a scene.
Scene skeletonOf(const Scene& scene, bool animated) {
    Scene skeleton;
    skeleton.nodes = scene.nodes;
    skeleton.cameras = scene.cameras;
    if (animated)
        skeleton.tracks = scene.tracks;
    return skeleton;
}

/// Returns the number of frames before the take, so that its times are those of the experiment.
int framesBefore(const Take& take, const Scene& scene, const Pace& pace, int leadIn) {
    if (duration(scene) == 0.0)
        return leadIn;
    if (pace.uneven)
        throw Error(at(take, *pace.uneven) +
                    "scene time does not go on evenly from frame to frame");
    const double start = take.frames.front().seconds;
    if (!pace.advances && take.frames.size() > 1) {
        if (poseAt(scene, start).worldFromNode !=
            poseAt(skeletonOf(scene, false), 0.0).worldFromNode)
            throw Error(take.name + ": the scene stands still at " + number(start) +
                        " s; an experiment can only show it at rest or moving");
        return leadIn;
    }
    const double before = std::round(start * pace.rate);
    if (before < 0.0 || before > kMostFrames ||
        std::abs(before / pace.rate - start) > kTimeTolerance)
        throw Error(take.name + ": it begins at " + number(start) +
                    " s of scene time, to which no whole number of frames leads at " +
                    number(pace.rate) + " a second");
    return int(before);
}

// --- camera --------------------------------------------------------------------------------------

bool near(glm::vec3 a, glm::vec3 b, float tolerance) {
    const glm::vec3 apart = glm::abs(a - b);
    return std::max({apart.x, apart.y, apart.z}) <= tolerance;
}

bool sameSight(const Camera& a, const Camera& b) {
    constexpr glm::vec3 right{1.0f, 0.0f, 0.0f}, up{0.0f, 1.0f, 0.0f};
    const float scale = std::max(1.0f, glm::length(a.position));
    return near(a.position, b.position, kViewTolerance * scale) &&
           near(a.orientation * right, b.orientation * right, kViewTolerance) &&
           near(a.orientation * up, b.orientation * up, kViewTolerance);
}

CameraMove moveTo(const Take& take, std::size_t frame, int when) {
    const Camera& camera = take.frames[frame].camera;
    // Far enough not to be lost in the digits of a place far from the origin.
    const float distance = std::max(1.0f, glm::length(camera.position));
    const CameraMove move{.frame = when,
                          .until = when + 1,
                          .eye = camera.position,
                          .target = camera.position + distance * camera.forward()};
    if (!sameSight(camera, lookAt(move.eye, move.target)))
        throw Error(at(take, frame) + "the camera is rolled; an experiment's is always upright");
    return move;
}

/// Throws if an experiment could not move the scene's first camera.
void expectFreeCamera(const Take& take, const Scene& scene, bool animated) {
    const std::uint32_t node = scene.cameras.at(0).node;
    if (scene.nodes[node].parent >= 0)
        throw Error(take.name + ": the camera moves, but the first camera of the scene " +
                    scene.name + " hangs on another node and cannot be moved");
    if (animated && std::ranges::any_of(scene.tracks, [&](const Track& track) {
            return track.node == node && track.path != Track::Path::Scale;
        }))
        throw Error(take.name + ": the camera moves, but the first camera of the scene " +
                    scene.name + " is animated by the scene itself");
}

void expectSameLens(const Take& take, const Scene& scene) {
    for (std::size_t i = 0; i < take.frames.size(); ++i)
        if (take.frames[i].camera.lens != scene.cameras.at(0).lens)
            throw Error(at(take, i) + "the lens is not that of the first camera of the scene " +
                        scene.name);
}

} // namespace

Take takeOf(const Experiment& experiment, const StagedRun& run) {
    Take take{.name = experiment.name};
    for (int frame = 0; frame < experiment.frames(); ++frame)
        take.frames.push_back(experiment.timeline.frameAt(run.scene, experiment.rate, frame));
    for (const Interval& interval : run.plan.intervals)
        take.frames[std::size_t(interval.first)].step = interval.isStep();
    for (const TimelineEvent& event : withJoinedMoves(experiment.timeline.events()))
        if (const int frame = frameOf(event); frame > 0)
            take.frames[std::size_t(frame)].marks.push_back(describe(event));
    return take;
}

Experiment experimentOf(const Take& take, const Scene& scene, Experiment base, int leadIn) {
    if (take.frames.empty() || leadIn < 0)
        throw std::logic_error("an experiment needs frames");
    if (take.frames.front().step)
        throw Error(at(take, 0) + "the take begins with a change of light, before which an " +
                    "experiment has nothing to compare; set the in point a frame earlier");
    const Pace pace = paceOf(take);
    const int before = framesBefore(take, scene, pace, leadIn);
    const double frames = double(before) + double(take.frames.size());
    if (frames > kMostFrames)
        throw Error(take.name + ": " + number(frames) + " frames from time 0 on; an experiment " +
                    "has at most " + number(kMostFrames));
    base.rate = pace.uneven ? kRateOfStills : pace.rate;
    base.animated = pace.advances || (duration(scene) > 0.0 && take.frames.size() == 1);
    expectSameLens(take, scene);

    const Scene skeleton = skeletonOf(scene, base.animated);
    const auto ownView = [&](int frame) { // as the scene's first camera moves by itself, if at all
        return cameraAt(skeleton, poseAt(skeleton, base.seconds(frame)));
    };
    bool own = true;
    for (std::size_t i = 0; i < take.frames.size() && own; ++i)
        own = sameSight(take.frames[i].camera, ownView(before + int(i)));
    if (!own)
        expectFreeCamera(take, scene, base.animated);

    std::vector<std::string> lightNames;
    for (const Light& light : scene.lights)
        lightNames.push_back(light.name);
    std::vector<TimelineEvent> events;
    for (std::size_t i = 0; i < take.frames.size(); ++i) {
        const SceneFrame& now = take.frames[i];
        const int when = i == 0 ? 0 : before + int(i); // in the experiment
        const auto lightsBefore =
            i == 0 ? std::span<const LightState>() : take.frames[i - 1].lights;
        for (LightEvent& change : lightChanges(when, lightNames, lightsBefore, now.lights))
            events.emplace_back(std::move(change));
        const bool moves =
            i == 0 ? now.camera != ownView(0) : now.camera != take.frames[i - 1].camera;
        if (!own && moves)
            events.push_back(moveTo(take, i, when));
    }
    base.timeline = Timeline(int(frames), std::move(events));
    return base;
}

std::string experimentText(const Take& take, const Scene& scene, Experiment base, int leadIn) {
    const std::string source = base.name + ".json";
    std::string text = toJson(experimentOf(take, scene, std::move(base), leadIn));
    parseExperiment(text, source);
    return text;
}

} // namespace afterglow
