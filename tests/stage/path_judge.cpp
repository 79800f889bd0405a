// SPDX-License-Identifier: MIT
#include "tests/stage/path_judge.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/reference/surface.h"

namespace afterglow::test {

namespace {

using reference::DividedSignal;
using reference::Division;

/// Of a value, whatever the scene: roundings of some hundred operations of 32 bits.
constexpr double kTolerance = 1e-4, kLeastValue = 0.01;
/// The tolerance in multiples of the change by a rounding: reference::spreadOf().
constexpr double kSpreads = 4.0;

Division divisionOf(int signal) {
    return Signal(signal) == Signal::Path    ? Division::Path
           : Signal(signal) == Signal::Split ? Division::Split
                                             : Division::Bounce;
}

void raise(double& most, double value) {
    most = value >= 0.0 ? std::max(most, value) : INFINITY; // not a number is no small number
}

/// The largest difference of the signals, relative to max(0.01, value), beyond what `allowed` says
/// for each channel.
double difference(const std::vector<glm::dvec3>& actual, const std::vector<DividedSignal>& expected,
                  const std::vector<DividedSignal>* allowed = nullptr) {
    double largest = 0.0;
    for (std::size_t i = 0; i < actual.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double apart = std::abs(actual[i][k] - expected[i].value[k]) -
                                 (allowed ? kSpreads * (*allowed)[i].value[k] : 0.0);
            // max() would take one that is not a number for the other.
            raise(largest, apart < 0.0 ? 0.0 : apart / std::max(kLeastValue, expected[i].value[k]));
        }
    return largest;
}

std::vector<glm::dvec3> valuesOf(const std::vector<DividedSignal>& signals) {
    std::vector<glm::dvec3> values;
    for (const DividedSignal& signal : signals)
        values.push_back(signal.value);
    return values;
}

/// One visibility sample with its seed.
struct Start {
    reference::PathSurface surface;
    reference::Seed seed;
};

Start startOf(const PathMoment& moment, const PathImages& images, glm::ivec2 p) {
    const glm::uvec4 position = images.surface(p);
    const std::uint32_t instance = images.visibility(p).x - 1;
    Start start;
    start.surface.lit = {glm::dvec3(std::bit_cast<glm::vec3>(glm::uvec3(position))),
                         reference::decodeNormal(position.w), glm::dvec3(images.guides(p)),
                         moment.scene.linear[instance]};
    start.surface.material =
        reference::factorsOf(moment.source.materials[moment.source.instances[instance].material]);
    start.seed = reference::unpackSeed(images.seeds(p));
    start.surface.eye = reference::eyeOf(start.seed, moment.frame, moment.eye, moment.previousEye);
    return start;
}

/// Compares the paths of one moment.
class Judge {
public:
    Judge(const PathMoment& moment, const PathImages& images)
        : moment_(moment), images_(images),
          emitters_(
              reference::emittersOf(moment.source, moment.rest, moment.scene, moment.lightScales)),
          in_{moment.source,
              moment.scene,
              emitters_,
              moment.rest.extent(),
              glm::dvec3(moment.source.ambient),
              moment.regularization},
          division_(divisionOf(moment.lighting.signal)) {}

    PathVerdict verdict() {
        for (int y = 0; y < images_.visibility.size().y; ++y)
            for (int x = 0; x < images_.visibility.size().x; ++x) {
                if (images_.visibility({x, y}).x == 0)
                    judgeBackground({x, y});
                else
                    judgeSurface({x, y});
            }
        return verdict_;
    }

private:
    std::vector<DividedSignal> signalsOf(const reference::PathParts& parts) const {
        return reference::signalsOf(division_, parts, moment_.lighting.signalClamp);
    }

    void judgeBackground(glm::ivec2 p) {
        for (const Image<glm::vec4>& raw : images_.raw)
            verdict_.wrong += raw(p) != glm::vec4(0.0f);
        for (const Image<glm::vec4>& divisor : images_.divisors)
            verdict_.wrong += glm::vec3(divisor(p)) != glm::vec3(0.0f);
    }

    void judgeSurface(glm::ivec2 p) {
        const Start start = startOf(moment_, images_, p);
        const reference::PathNumbers numbers(randomOf(moment_.runSeed), start.seed);
        const reference::PathSample path = tracePath(in_, start.surface, numbers);
        const std::vector<DividedSignal> expected = signalsOf(path.parts);
        count(path);
        judgeDivisors(p, start);

        std::vector<glm::dvec3> actual;
        for (const Image<glm::vec4>& raw : images_.raw) {
            const glm::dvec4 pixel(raw(p));
            actual.push_back(glm::dvec3(pixel));
            const double l = reference::luminanceOf(glm::dvec3(pixel));
            raise(verdict_.luminance, std::abs(pixel.a - l) / std::max(kLeastValue, l));
        }
        judgeEye(start, numbers, expected);
        const double apart = difference(actual, expected);
        if (apart < kTolerance) {
            raise(verdict_.largest, apart);
            return;
        }
        in_.withDoubts = true;
        const reference::PathSample again = tracePath(in_, start.surface, numbers);
        in_.withDoubts = false;
        if (again.doubtful) {
            ++verdict_.excused;
            return;
        }
        const std::vector<DividedSignal> spread = signalsOf(again.spread);
        const bool close = difference(actual, expected, &spread) < kTolerance;
        ++(close ? verdict_.spread : verdict_.wrong);
    }

    void count(const reference::PathSample& path) {
        const glm::dvec3 none(0.0);
        ++verdict_.surfaces;
        verdict_.direct += path.parts.direct.sum() != none;
        verdict_.shadowed += path.shadowed;
        verdict_.indirect += path.parts.indirect.sum() != none;
        verdict_.specular += path.specular;
        verdict_.left += path.left;
        verdict_.escaped += path.escaped;
        verdict_.hitLight += path.hitLight;
    }

    /// Judges the divisors, which have this frame's eye, also of a gradient sample.
    void judgeDivisors(glm::ivec2 p, const Start& start) {
        const reference::PathSurface& surface = start.surface;
        const reference::Bsdf bsdf(surface.material, surface.lit.shading, surface.lit.geometric,
                                   glm::normalize(moment_.eye - surface.lit.position));
        const std::vector<DividedSignal> expected = signalsOf({bsdf.albedo(), {}, {}, {}});
        for (std::size_t i = 0; i < images_.divisors.size(); ++i)
            for (int k = 0; k < 3; ++k)
                raise(verdict_.divisor,
                      std::abs(images_.divisors[i](p)[k] - expected[i].divisor[k]));
    }

    void judgeEye(const Start& start, const reference::PathNumbers& numbers,
                  const std::vector<DividedSignal>& expected) {
        if (start.seed.frame == moment_.frame % (1u << 18))
            return;
        ++verdict_.carried;
        Start moved = start;
        moved.surface.eye = moment_.eye;
        const auto other = signalsOf(tracePath(in_, moved.surface, numbers).parts);
        verdict_.withOldEye += difference(valuesOf(other), expected) > 10.0 * kTolerance;
    }

    const PathMoment& moment_;
    const PathImages& images_;
    std::vector<reference::Emitter> emitters_;
    reference::PathInputs in_;
    Division division_;
    PathVerdict verdict_;
};

} // namespace

PathImages pictureOf(const RenderTargets& targets) {
    PathImages images{targets.surfaces.visibility.read<glm::uvec4>(),
                      targets.surfaces.surface.read<glm::uvec4>(),
                      targets.surfaces.guides.read<glm::vec4>(),
                      targets.seeds.current().read<std::uint32_t>(),
                      {},
                      {}};
    for (const SignalTargets& signal : targets.signals) {
        images.raw.push_back(signal.raw.current().read<glm::vec4>());
        images.divisors.push_back(signal.divisor.read<glm::vec4>());
    }
    return images;
}

PathImages samplesBesideOf(const RenderTargets& targets) {
    PathImages images{targets.sampleSurfaces.visibility.read<glm::uvec4>(),
                      targets.sampleSurfaces.surface.read<glm::uvec4>(),
                      targets.sampleSurfaces.guides.read<glm::vec4>(),
                      targets.sampleSeeds.read<std::uint32_t>(),
                      {},
                      {}};
    for (const SignalTargets& signal : targets.signals)
        images.raw.push_back(signal.sampleRaw.read<glm::vec4>());
    return images;
}

PathMoment momentOf(const SceneFrames& frames, const SceneFrame& frame) {
    return {frames.scene(),
            frames.rest(),
            frame.scene,
            frame.lightScales,
            frame.view.eye,
            frame.previousView.eye,
            frame.frame,
            frame.runSeed,
            frames.settings.lighting,
            frames.settings.lighting.regularization};
}

void PathVerdict::operator+=(const PathVerdict& other) {
    for (int PathVerdict::*const number :
         {&PathVerdict::surfaces, &PathVerdict::direct, &PathVerdict::shadowed,
          &PathVerdict::indirect, &PathVerdict::specular, &PathVerdict::left, &PathVerdict::escaped,
          &PathVerdict::hitLight, &PathVerdict::carried, &PathVerdict::withOldEye,
          &PathVerdict::excused, &PathVerdict::wrong, &PathVerdict::spread})
        this->*number += other.*number;
    for (double PathVerdict::*const number :
         {&PathVerdict::largest, &PathVerdict::luminance, &PathVerdict::divisor})
        raise(this->*number, other.*number);
}

PathVerdict judgePaths(const PathMoment& moment, const PathImages& images) {
    return Judge(moment, images).verdict();
}

} // namespace afterglow::test
