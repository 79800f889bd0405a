// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/stage/path_judge.h"
#include "tests/support/sequence.h"
#include "tests/support/studio.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{61, 37};

void check(const std::string& what, const PathVerdict& v) {
    MESSAGE(what, ": ", v.surfaces, " surfaces, lit by light samples ", v.direct, ", shadowed ",
            v.shadowed, ", second surface lit ", v.indirect, ", specular ", v.specular,
            ", directions lost ", v.left, ", escaped ", v.escaped, ", met a lamp ", v.hitLight,
            ", carried ", v.carried, " (eye matters ", v.withOldEye, "), excused ", v.excused,
            ", by spread ", v.spread, ", largest ", v.largest, ", divisor ", v.divisor);
    CHECK(v.surfaces > 0);
    CHECK(v.wrong == 0);
    // Beside edges of triangles, and where a random number picks another lobe or light: none so
    // far.
    CHECK(v.excused <= v.surfaces / 1000);
    // Mirrors, which make of a rounding of the normal another place: at most 3 of 5,000.
    CHECK(v.spread <= v.surfaces / 500);
    CHECK(v.luminance < 1e-6);
    CHECK(v.divisor < 1e-5);
}

struct Case {
    std::string scene;
    Signal signal;
    SamplePlacement placement = SamplePlacement::Merged;
    float regularization = 0.25f;
    std::uint32_t frame = 0, runSeed = 5;
};

/// A-SVGF, which merges or adds gradient samples.
Settings settingsOf(const Case& c) {
    Settings settings = afterglow::test::settingsOf(Filter::Asvgf, c.signal);
    settings.lighting.regularization = c.regularization;
    settings.lighting.gradientSamples = int(c.placement);
    return settings;
}

/// Three frames in which camera, bodies and lamps differ; one lamp of many is off.
PathVerdict threeFrames(const Case& c) {
    SceneFrames frames(sceneNamed(c.scene), kSize, settingsOf(c));
    const Camera start = frames.camera;
    frames.runSeed = c.runSeed;
    frames.frame = c.frame;
    if (frames.lights.size() > 1)
        frames.lights.back().on = false;
    PathVerdict sum;
    for (int i = 0; i < 3; ++i) {
        shake(frames, start, i + 1, c.scene == "cornell" ? 0.02f : 0.05f);
        frames.seconds = 0.3 * i;
        frames.lights[0].tint = i == 2 ? glm::vec3(0.5f, 2.0f, 1.0f) : glm::vec3(1.0f);
        const SceneFrame frame = frames.next();
        sum += judgePaths(momentOf(frames, frame), pictureOf(frames.targets()));
        if (c.placement == SamplePlacement::Extra && i > 0)
            sum += judgePaths(momentOf(frames, frame), samplesBesideOf(frames.targets()));
    }
    return sum;
}

/// Returns the surfaces of `seen` that a pair of references places among those of `world`.
PathImages placedOf(const RenderTargets& targets) {
    PathImages images = pictureOf(targets);
    images.surface = targets.placed.surface.read<glm::uvec4>();
    images.guides = targets.placed.guides.read<glm::vec4>();
    images.divisors.clear(); // they stay those of `seen`
    return images;
}

/// The moment of sample k of a reference.
PathMoment sampleOf(const Studio& studio, const reference::SceneView& rest,
                    const reference::SceneView& world, const std::vector<LightState>& lights,
                    std::uint32_t k) {
    const LightingSettings& lighting = studio.settings.lighting;
    PathMoment moment{studio.renderer.scene(),
                      rest,
                      world,
                      {},
                      glm::dvec3(studio.camera.position),
                      glm::dvec3(1e3), // nobody's
                      k,
                      5,
                      lighting,
                      reference::regularizationOf(lighting.regularization, k)};
    for (const LightState& light : lights)
        moment.lightScales.push_back(glm::dvec3(light.scale()));
    return moment;
}

/// Seeds of sample k: those that the images hold are already of the next one.
PathImages withSeedsOf(PathImages images, std::uint32_t k) {
    for (int y = 0; y < images.seeds.size().y; ++y)
        for (int x = 0; x < images.seeds.size().x; ++x)
            images.seeds({x, y}) = reference::packSeed({x, y}, k);
    return images;
}

} // namespace

TEST_CASE("the signals of paths are what one path of two segments gives, pixel by pixel") {
    const GlCheck noGlMessages;
    for (const Case& c : {Case{"cornell", Signal::Path}, Case{"cornell", Signal::Bounce},
                          Case{"glossy", Signal::Path, SamplePlacement::Merged, 0.25f, 1000},
                          Case{"glossy", Signal::Path, SamplePlacement::Merged, 0.0f, 1000},
                          Case{"glossy", Signal::Split, SamplePlacement::Merged, 0.25f, 77, 9},
                          Case{"glossy", Signal::Split, SamplePlacement::Merged, 0.0f, 77, 9},
                          Case{"glossy", Signal::Bounce, SamplePlacement::Merged, 0.25f, 4321, 2},
                          Case{"glossy", Signal::Bounce, SamplePlacement::Merged, 0.0f, 4321, 2},
                          // The number of the frame in seeds begins anew.
                          Case{"glossy", Signal::Path, SamplePlacement::Merged, 0.25f, 262142},
                          Case{"oddities", Signal::Split, SamplePlacement::Merged, 0.25f, 131}}) {
        CAPTURE(c.scene);
        const PathVerdict verdict = threeFrames(c);
        check(c.scene + " " + std::string(nameOf(c.signal)) + ", frame " + std::to_string(c.frame) +
                  ", kappa " + std::to_string(c.regularization),
              verdict);
        for (const int seen : {verdict.direct, verdict.shadowed, verdict.indirect, verdict.specular,
                               verdict.escaped, 2 * verdict.hitLight})
            CHECK(seen > 40);
        CHECK(verdict.carried > 100);
    }
}

TEST_CASE("a gradient sample is shaded as it was seen, in the picture and beside it") {
    const GlCheck noGlMessages;
    for (const SamplePlacement placement : {SamplePlacement::Merged, SamplePlacement::Extra})
        for (const Signal signal : {Signal::Path, Signal::Split}) {
            const PathVerdict verdict = threeFrames({"glossy", signal, placement});
            check(std::string(nameOf(signal)) +
                      (placement == SamplePlacement::Extra ? ", beside" : ", merged"),
                  verdict);
            CHECK(verdict.carried > 300);
            CHECK(verdict.withOldEye > verdict.carried / 3);
        }
}

TEST_CASE("sample k of a reference has the seed of frame k and less regularization") {
    const GlCheck noGlMessages;
    for (const Signal signal : {Signal::Path, Signal::Split, Signal::Bounce}) {
        CAPTURE(nameOf(signal));
        Studio studio(sceneNamed("glossy"), kSize, signal);
        // A frame before it, seen from elsewhere, changes nothing.
        studio.camera.position += glm::vec3(0.3f, -0.2f, 0.1f);
        studio.renderer.render(studio.at(0.1), studio.settings);
        studio.camera.position -= glm::vec3(0.3f, -0.2f, 0.1f);

        const reference::SceneView rest(studio.renderer.scene(), 0.0),
            now(studio.renderer.scene(), 0.4);
        studio.renderer.beginReference(studio.at(0.4), studio.settings);
        PathVerdict sum;
        for (std::uint32_t k = 0; k < 12; ++k) {
            studio.renderer.addReferenceSamples(1);
            if (k > 1 && k < 11)
                continue;
            sum += judgePaths(sampleOf(studio, rest, now, studio.allOn, k),
                              withSeedsOf(pictureOf(studio.targets()), k));
        }
        check("reference " + std::string(nameOf(signal)), sum);
        CHECK(sum.indirect > 300);
    }
}

TEST_CASE("the surfaces of one moment are lit by paths of another, seen from where they are seen") {
    const GlCheck noGlMessages;
    for (const Signal signal : {Signal::Split, Signal::Bounce}) {
        CAPTURE(nameOf(signal));
        Studio studio(sceneNamed("glossy"), kSize, signal);
        std::vector<LightState> lights = studio.allOn;
        lights[0].on = false;
        lights[1].tint = {0.5f, 1.0f, 2.0f};
        const double seen = 0.5, world = 0.2;
        const reference::SceneView rest(studio.renderer.scene(), 0.0),
            then(studio.renderer.scene(), world);
        FrameInput before = studio.at(world, lights);
        before.camera.position += glm::vec3(0.2f, 0.1f, 0.0f); // not used
        studio.renderer.beginReference(studio.at(seen), before, studio.settings);
        PathVerdict sum;
        for (std::uint32_t k = 0; k < 2; ++k) {
            studio.renderer.addReferenceSamples(1);
            sum += judgePaths(sampleOf(studio, rest, then, lights, k),
                              withSeedsOf(placedOf(studio.targets()), k));
        }
        check("placed " + std::string(nameOf(signal)), sum);
        CHECK(sum.indirect > 200);
    }
}

TEST_CASE("no channel of a path's signals exceeds the clamp") {
    const GlCheck noGlMessages;
    Settings settings = afterglow::test::settingsOf(Filter::None, Signal::Split);
    settings.lighting.signalClamp = 0.5f;
    SceneFrames frames(sceneNamed("glossy"), kSize, settings);
    const SceneFrame frame = frames.next();
    const PathImages images = pictureOf(frames.targets());
    check("clamped", judgePaths(momentOf(frames, frame), images));
    int clamped = 0;
    for (const Image<glm::vec4>& raw : images.raw)
        for (const glm::vec4& pixel : raw.pixels())
            clamped += pixel.r == 0.5f;
    CHECK(clamped > 150);
}
