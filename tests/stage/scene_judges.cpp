// SPDX-License-Identifier: MIT
#include "tests/stage/scene_judges.h"

#include <algorithm>
#include <cmath>

#include "tests/reference/composite.h"
#include "tests/reference/lighting.h"
#include "tests/reference/surface.h"

namespace afterglow::test {

namespace {

/// The rasterizer snaps corners to 1/256 pixel.
constexpr double kRasterMargin = 1.0 / 64.0;

template <class Function>
void forEachPixel(glm::ivec2 size, const Function& function) {
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            function(glm::ivec2(x, y));
}

void raise(double& most, double value) {
    most = value >= 0.0 ? std::max(most, value) : INFINITY; // not a number is no small number
}

double largestOf(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

glm::dvec3 positionOf(const glm::uvec4& surface) {
    return {std::bit_cast<float>(std::uint32_t(surface.x)),
            std::bit_cast<float>(std::uint32_t(surface.y)),
            std::bit_cast<float>(std::uint32_t(surface.z))};
}

/// Whether the picture of a triangle ends so near to the place that rounding may take it away.
bool endsNear(const reference::Triangle* triangle, const reference::View& view, glm::dvec2 place) {
    return triangle && reference::pixelsToOutline(*triangle, view, place) < kRasterMargin;
}

/// Whether two triangles are equally deep at a place, as far as 32 bits can tell.
bool isTie(const reference::Triangle* a, const reference::Triangle* b, const reference::View& view,
           glm::dvec2 place) {
    if (!a || !b)
        return false;
    const auto one = reference::meetPlane(*a, view.eye, view.ray(place));
    const auto other = reference::meetPlane(*b, view.eye, view.ray(place));
    return one && other && std::abs(one->t - other->t) < 1e-5 * one->t;
}

} // namespace

VisibilityVerdict judgeVisibility(const SceneFrame& frame) {
    VisibilityVerdict verdict;
    const reference::View& view = frame.view;
    forEachPixel(view.size, [&](glm::ivec2 p) {
        const glm::uvec4 sample = frame.visibility(p);
        const glm::dvec2 place = glm::dvec2(p) + 0.5 + frame.jitter;
        ++verdict.pixels;
        verdict.background += sample.x == 0;
        verdict.wrong += frame.seeds(p) != reference::packSeed(p, frame.frame);
        verdict.wrong += frame.ids(p) != glm::uvec2(sample);

        const reference::Triangle* expected = reference::look(frame.scene, view, place).triangle;
        const reference::Triangle* shown =
            sample.x == 0 ? nullptr : &frame.scene.at(sample.x - 1, sample.y);
        if (shown != expected) {
            const bool excused = endsNear(shown, view, place) || endsNear(expected, view, place) ||
                                 isTie(shown, expected, view, place);
            ++(excused ? verdict.excused : verdict.wrong);
        }
        if (!shown) {
            verdict.wrong += sample != glm::uvec4(0u);
            return;
        }
        const glm::dvec2 b = reference::barycentrics(sample);
        verdict.wrong += !(b.x >= 0.0 && b.y >= 0.0 && b.x + b.y <= 1.0 + 1e-7);
        const glm::dvec3 ray = view.ray(place);
        const auto hit = reference::meetPlane(*shown, view.eye, ray);
        if (!hit || hit->inside() < 1e-6)
            return; // clamped into the triangle: by less than the margin, or counted above
        raise(verdict.largestShift, glm::length(view.pixel(shown->at(b)) - place));
        if (std::abs(glm::dot(shown->front, glm::normalize(ray))) > 0.1)
            raise(verdict.largestWeight,
                  std::max(std::abs(b.x - hit->b.x), std::abs(b.y - hit->b.y)));
    });
    return verdict;
}

SurfaceVerdict judgeSurface(const SceneFrames& frames, const SceneFrame& frame) {
    SurfaceVerdict verdict;
    const reference::SurfaceInputs in{frames.scene(), frame.scene,        frame.previousScene,
                                      frame.view,     frame.previousView, frame.lightScales};
    forEachPixel(frame.view.size, [&](glm::ivec2 p) {
        const glm::uvec4 sample = frame.visibility(p);
        const glm::dvec4 motion(frame.motion(p));
        if (sample.x == 0) {
            verdict.wrong += frame.guides(p).w != 0.0f || frame.slope(p) != glm::vec2(0.0f) ||
                             motion != glm::dvec4(0.0) ||
                             glm::vec3(frame.emission(p)) != glm::vec3(0.0f);
            return;
        }
        const reference::SurfaceSample expected = reference::surfaceOf(in, sample);
        ++verdict.surfaces;
        raise(verdict.position, glm::length(positionOf(frame.surface(p)) - expected.position) /
                                    frames.rest().extent());
        // Seen edge-on, either side is the viewer's.
        if (expected.facing < 1e-5) {
            ++verdict.excused;
            return;
        }
        raise(verdict.geometric,
              largestOf(reference::decodeNormal(frame.surface(p).w) - expected.geometricNormal));
        if (expected.sideMargin < 1e-5)
            ++verdict.excused;
        else
            raise(verdict.shading, largestOf(glm::dvec3(frame.guides(p)) - expected.shadingNormal));
        verdict.turnedOver += glm::dot(frame.scene.at(sample.x - 1, sample.y).front,
                                       frame.view.eye - expected.position) < 0.0;

        raise(verdict.depth, std::abs(frame.guides(p).w - expected.depth) / expected.depth);
        raise(verdict.slope,
              largestOf(glm::dvec3(glm::dvec2(frame.slope(p)) - expected.slope, 0.0)) /
                  expected.depth * expected.facing * expected.facing);

        verdict.wrong += motion.w != expected.motion.w;
        raise(verdict.motion, glm::length(glm::dvec2(motion) - glm::dvec2(expected.motion)));
        raise(verdict.motionDepth, std::abs(motion.z - expected.motion.z) / expected.depth);
        verdict.moved += glm::length(glm::dvec2(expected.motion)) > 0.01;
        verdict.behind += expected.motion.w == 0.0;

        raise(verdict.material, largestOf(glm::dvec3(frame.albedo(p)) - expected.albedo));
        raise(verdict.material, largestOf(glm::dvec3(frame.emission(p)) - expected.emission) /
                                    std::max(1.0, largestOf(expected.emission)));
    });
    return verdict;
}

void ForwardVerdict::operator+=(const ForwardVerdict& other) {
    for (int i = 0; i < reference::kFates; ++i)
        fates[i] += other.fates[i];
    strata += other.strata;
    filled += other.filled;
    contested += other.contested;
    doubts += other.doubts;
    excused += other.excused;
    wrong += other.wrong;
    lost += other.lost;
}

ForwardVerdict judgeForward(const SceneFrame& merged, const SceneFrame& plain) {
    ForwardVerdict verdict;
    const auto expected = reference::forwardProject(
        {merged.scene, merged.view, merged.previousVisibility, merged.previousSeeds,
         plain.visibility, plain.seeds, merged.frame, merged.runSeed});
    std::copy_n(expected.fates, reference::kFates, verdict.fates);
    verdict.contested = expected.contested;
    verdict.doubts = expected.doubts;
    forEachPixel(expected.samples.size(), [&](glm::ivec2 s) {
        const glm::uvec4 sample = merged.samples(s), wanted = expected.samples(s);
        bool same = sample.y == wanted.y && sample.z == wanted.z;
        for (int k = 0; k < 9; ++k) {
            const glm::ivec2 p = 3 * s + glm::ivec2(k % 3, k / 3);
            if (merged.visibility.contains(p))
                same = same && merged.visibility(p) == expected.visibility(p) &&
                       merged.seeds(p) == expected.seeds(p);
        }
        ++verdict.strata;
        verdict.filled += merged.samples(s).y != 0;
        if (!same)
            ++(expected.doubtful(s) ? verdict.excused : verdict.wrong);
        if (sample.w != wanted.w || sample.x != wanted.x)
            ++(expected.doubtfulFate(s) ? verdict.excused : verdict.wrong);
        verdict.lost += sample.w == gpu::kFateLostRace;
    });
    return verdict;
}

LightingVerdict judgeLighting(const SceneFrames& frames, const SceneFrame& frame) {
    const auto emitters =
        reference::emittersOf(frames.scene(), frames.rest(), frame.scene, frame.lightScales);
    const auto& settings = frames.settings.lighting;
    reference::LightingInputs in{frame.scene,
                                 emitters,
                                 randomOf(frame.runSeed),
                                 frames.rest().extent(),
                                 settings.aoRadius,
                                 settings.signalClamp,
                                 glm::dvec3(frames.scene().ambient),
                                 Signal(settings.signal) != Signal::AmbientOcclusion,
                                 Signal(settings.signal) != Signal::Shadows};
    LightingVerdict verdict;
    verdict.picks.resize(emitters.size());
    forEachPixel(frame.view.size, [&](glm::ivec2 p) {
        const glm::dvec4 raw(frame.raw(p));
        if (frame.visibility(p).x == 0) {
            verdict.wrong += raw != glm::dvec4(0.0);
            return;
        }
        const glm::uvec4 surface = frame.surface(p);
        const reference::LitSurface lit{positionOf(surface), reference::decodeNormal(surface.w),
                                        glm::dvec3(frame.guides(p)),
                                        frame.scene.linear[frame.visibility(p).x - 1]};
        const reference::Seed seed = reference::unpackSeed(frame.seeds(p));
        const reference::LightSample expected = reference::lightAt(in, lit, seed);
        ++verdict.surfaces;
        verdict.lit += expected.value != glm::dvec3(0.0);
        verdict.shadowed += expected.shadowed;
        verdict.occluded += in.ambientOcclusion && expected.occluded;
        verdict.open += in.ambientOcclusion && !expected.occluded;
        ++verdict.picks[expected.emitter];

        double difference = 0.0;
        for (int k = 0; k < 3; ++k)
            raise(difference,
                  std::abs(raw[k] - expected.value[k]) / std::max(0.01, expected.value[k]));
        const bool close = difference < 1e-4;
        if (!close) {
            in.withDoubts = true;
            const bool excused = reference::lightAt(in, lit, seed).doubtful;
            in.withDoubts = false;
            if (excused) {
                ++verdict.excused;
                return;
            }
        }
        verdict.wrong += !close;
        raise(verdict.largest, difference);
        const double l = 0.2126 * raw.r + 0.7152 * raw.g + 0.0722 * raw.b;
        raise(verdict.luminance, std::abs(raw.a - l) / std::max(0.01, l));
    });
    return verdict;
}

PictureVerdict judgePicture(const SceneFrames& frames, const SceneFrame& frame) {
    PictureVerdict verdict;
    forEachPixel(frame.view.size, [&](glm::ivec2 p) {
        const bool isBackground = frame.guides(p).w == 0.0f;
        verdict.background += isBackground;
        const glm::dvec3 expected = reference::compose(
            glm::dvec3(frame.filtered(p)), glm::dvec3(frame.albedo(p)),
            glm::dvec3(frame.emission(p)), isBackground, glm::dvec3(frames.scene().ambient));
        const glm::dvec3 composed(frame.composed(p));
        const glm::dvec3 shown = reference::display(composed, frames.settings.display.exposure,
                                                    frames.settings.display.toneMapper);
        for (int k = 0; k < 3; ++k) {
            raise(verdict.composed,
                  std::abs(composed[k] - expected[k]) / std::max(1.0, expected[k]));
            const int level = frame.display(p)[k];
            raise(verdict.display, std::abs(level - shown[k]));
            verdict.clipped += level == 255;
            verdict.dark += level < 10;
        }
        verdict.wrong += frame.display(p).a != 255;
    });
    return verdict;
}

} // namespace afterglow::test
