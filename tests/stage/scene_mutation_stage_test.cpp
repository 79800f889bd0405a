// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/stage/scene_judges.h"
#include "tests/stage/scene_mutants.h"
#include "tests/support/sequence.h"

// Would the tests of the stages that know the scene notice? Each case plants one error in the text
// of a shader, renders a few frames with it, and demands that the comparison with the reference
// fails by a clear margin.

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{31, 19};

/// Two frames of the scene of oddities, in which camera, bodies and lamps differ.
struct Pair {
    SceneFrames frames;
    SceneFrame first, second;

    Pair(ShaderLibrary& shaders, Settings settings)
        : frames(sceneOfOddities(), kSize, settings, shaders) {
        const Camera start = frames.camera;
        first = frames.next();
        shake(frames, start, 1, 0.05f);
        frames.seconds = 0.2;
        frames.light("plain").tint = {0.5f, 2.0f, 1.0f};
        second = frames.next();
    }
};

double measureVisibility(ShaderLibrary& shaders) {
    Settings settings = settingsOf(Filter::None);
    settings.display.antiAliasing = int(AntiAliasing::Taa); // places that are no centers
    const Pair pair(shaders, settings);
    const VisibilityVerdict verdict = judgeVisibility(pair.second);
    return std::max(
        {double(verdict.wrong), verdict.largestShift / 5e-4, verdict.largestWeight / 3e-5});
}

double measureSurface(ShaderLibrary& shaders) {
    Pair pair(shaders, settingsOf(Filter::None));
    // With a lamp in the picture.
    pair.frames.camera = lookAt({1.5f, 0.2f, 2.2f}, {-0.3f, 1.7f, 0.2f}, {.verticalFov = 1.3f});
    const SceneFrame third = pair.frames.next();
    double most = 0.0;
    for (const SceneFrame& frame : {pair.second, third}) {
        const SurfaceVerdict v = judgeSurface(pair.frames, frame);
        most = std::max({most, double(v.wrong), v.position / 5e-7, v.geometric / 7e-5,
                         v.shading / 1e-6, v.depth / 2e-6, v.slope / 2e-6, v.motion / 5e-4,
                         v.motionDepth / 2e-6, v.material / 1e-6});
    }
    return most;
}

/// Walls that meet, and bodies one before the other.
double measureForward(ShaderLibrary& shaders) {
    struct Way {
        const char* scene;
        float meters;
    };
    ForwardVerdict sum;
    for (const Way& way : {Way{"cornell", 0.03f}, Way{"oddities", 0.08f}}) {
        SceneFrames merging(sceneNamed(way.scene), {61, 37},
                            settingsOf(Filter::Asvgf, Signal::Shadows), shaders);
        SceneFrames plain(sceneNamed(way.scene), {61, 37},
                          settingsOf(Filter::None, Signal::Shadows));
        const Camera start = merging.camera;
        for (int i = 0; i < 6; ++i) {
            for (SceneFrames* each : {&merging, &plain}) {
                shake(*each, start, i, way.meters);
                each->seconds = 0.15 * i;
            }
            const SceneFrame merged = merging.next(), unmerged = plain.next();
            if (i > 0)
                sum += judgeForward(merged, unmerged);
        }
    }
    return sum.wrong;
}

double measureLighting(ShaderLibrary& shaders) {
    Settings settings = settingsOf(Filter::None);
    settings.lighting.aoRadius = 0.3f; // so that many a ray hits something
    const Pair pair(shaders, settings);
    const LightingVerdict verdict = judgeLighting(pair.frames, pair.second);
    return std::max(double(verdict.wrong), verdict.luminance / 1e-6);
}

double measurePicture(ShaderLibrary& shaders) {
    Settings settings = settingsOf(Filter::None);
    settings.display.exposure = -1.0f;
    const Pair pair(shaders, settings);
    const PictureVerdict verdict = judgePicture(pair.frames, pair.second);
    return std::max({double(verdict.wrong), verdict.composed / 1e-6, verdict.display / 0.51});
}

} // namespace

TEST_CASE("errors planted in the visibility stage do not pass") {
    const std::string file = "scene/resolve.comp";
    checkMutants(measureVisibility,
                 {{"the pixel's corner for its center", file, "vec2(p) + 0.5", "vec2(p)"},
                  {"barycentrics of the center", file, "0.5 + frame.jitter", "0.5"},
                  {"jitter with the wrong sign", file, "0.5 + frame.jitter", "0.5 - frame.jitter"},
                  {"jitter of the raster upwards", "scene/visibility.vert", "vec2(-2.0, 2.0)",
                   "vec2(-2.0, -2.0)"},
                  {"jitter of twice the pixel", "scene/visibility.vert", "vec2(-2.0, 2.0)",
                   "vec2(-4.0, 4.0)"},
                  {"x and y exchanged in the seed", file, "newSeed(p,", "newSeed(p.yx,"},
                  {"barycentrics exchanged", file, "floatBitsToUint(b)", "floatBitsToUint(b.yx)"},
                  {"seed with too few bits", "lib/seed.glsl", "kTileBits = 7", "kTileBits = 4"}});
}

TEST_CASE("errors planted in the surface stage do not pass") {
    const std::string file = "scene/surface.comp";
    checkMutants(measureSurface,
                 {{"slope with y upwards", file, "vec2(1.0, -1.0)", "vec2(1.0, 1.0)"},
                  {"slope of half a pixel", file, "= 2.0 * frame.tanHalfFov", "= frame.tanHalfFov"},
                  {"motion with the wrong sign", file, "pixelOf(previousClip) - pixelOf(clip)",
                   "pixelOf(clip) - pixelOf(previousClip)"},
                  {"instances at rest", file, "instanceTransform(instance, true)", "now"},
                  {"camera at rest", file, "frame.previousClipFromWorld", "frame.clipFromWorld"},
                  {"depth of this frame in the motion", file, "vec4(moved, previousDepth",
                   "vec4(moved, depth"},
                  {"flat normals", file, "vec4(normal, depth)", "vec4(geometric, depth)"},
                  {"normals transformed like points", "lib/geometry.glsl",
                   "return normalize(determinant3(m) < 0.0 ? -c : c)",
                   "return normalize(transformPoint(m, n) - transformPoint(m, vec3(0.0)))"},
                  {"distance for depth", file, "float depth = -viewPosition.z",
                   "float depth = length(viewPosition)"},
                  {"lamps that cannot be tinted", file, "emitted.rgb * scale",
                   "emitted.rgb * (1.0 + 1e-30 * scale)"},
                  {"the neighbor's vertex", "lib/geometry.glsl",
                   "corner + barycentrics.x * t.edge1 + barycentrics.y * t.edge2",
                   "corner + barycentrics.y * t.edge1 + barycentrics.x * t.edge2"}});
}

TEST_CASE("errors planted in the forward projection do not pass") {
    const std::string claim = "denoise/forward_claim.comp", merge = "denoise/forward_merge.comp",
                      strata = "lib/strata.glsl";
    checkMutants(
        measureForward,
        {{"instances not compared", claim, "seen.x != sampled.x", "seen.x == 0u"},
         {"depths not compared", claim, "abs(seenDepth - depth) <= kDepthTolerance * depth",
          "true"},
         {"a sample carried on for a second time", claim, "!= (previousFrame & kFrameMask)",
          "> kFrameMask"},
         {"another order of keys", claim, "claimKey(s))", "claimKey(s) ^ 0u - claimKey(s))"},
         {"keys that are not mixed", strata, "mixBits(uint(s.y * frame.strata.x + s.x) ^",
          "(uint(s.y * frame.strata.x + s.x) ^"},
         {"the candidate of another frame", claim, "candidatePixel(s, previousFrame)",
          "candidatePixel(s, frame.frame)"},
         {"pixels of a stratum in columns", strata, "number % uint(size.x), number / uint(size.x)",
          "number / uint(size.y), number % uint(size.y)"},
         {"partial strata taken for whole ones", strata,
          "min(ivec2(kStratumSize), frame.size - s * int(kStratumSize))", "ivec2(kStratumSize)"},
         {"the landing pixel of another stratum", merge, "fetch(claims, winner).y",
          "fetch(claims, s).y"},
         {"the source for the landing pixel", merge, "place, packPixel(source), fate",
          "place, packPixel(q), fate"},
         {"a landing that is not kept", claim, "uvec4(fate, packPixel(landed), 0u, 0u)",
          "uvec4(fate, packPixel(s), 0u, 0u)"},
         {"this frame's seed", merge, "fetch(previousSeeds, source).x",
          "fetch(previousSeeds, q).x"},
         {"races without losers", merge, "lost ? kFateLostRace : claim.x", "claim.x"},
         {"fates of another stratum", merge, "uvec2 offered = fetch(claims, s).xy",
          "uvec2 offered = fetch(claims, ivec2(0)).xy"},
         {"hidden and off screen confused", claim, "return kFateOffScreen", "return kFateDepth"},
         {"place without the 1", merge, "1u + uint(inStratum.x)", "uint(inStratum.x)"},
         {"run without a seed", strata, "inFrame, frame.seed)", "inFrame, 0u)"}});
}

TEST_CASE("errors planted in the lighting do not pass") {
    const std::string file = "lighting/rays.comp", trace = "lighting/trace.comp",
                      lights = "lib/lights.glsl", random = "lib/random.glsl",
                      listing = "lib/ray_listing.glsl";
    checkMutants(
        measureLighting,
        {{"cosine at the surface dropped", file, "max(dot(normal, direction), 0.0)", "1.0"},
         {"cosine of the flat normal", file, "max(dot(normal, direction), 0.0)",
          "max(dot(geometricNormal, direction), 0.0)"},
         {"cosine at the lamp dropped", file, "-dot(direction, light.areaNormal)",
          "length(light.areaNormal)"},
         {"one-sided lamps only", file, "light.doubleSided ? abs(facing) :", ""},
         {"distance not squared", file, "max(distanceSquared, 1e-20)", "distance"},
         {"a whole parallelogram's area", file, "cosine * 0.5 * facing", "cosine * facing"},
         {"pi forgotten", file, "(kPi * max", "(max"},
         {"probability forgotten", file, " * light.probability)", ")"},
         {"no shadows", trace, "= occluded(", "= from.w < 0.0 && occluded("},
         {"shadows of what is behind the lamp", file, "distance * kShadowEnd", "1e9"},
         {"the two numbers on the lamp exchanged", file,
          "randomNumber(seed, kDimensionLightU),\n                  "
          "randomNumber(seed, kDimensionLightV)",
          "randomNumber(seed, kDimensionLightV),\n                  "
          "randomNumber(seed, kDimensionLightU)"},
         {"points crowded at a corner", lights, "root = sqrt(u.y)", "root = u.y"},
         {"every lamp as bright as it is made", lights,
          "uintBitsToFloat(emitted).rgb * uintBitsToFloat(fetchBuffer(lightScales, "
          "int(edge2.w))).rgb",
          "uintBitsToFloat(emitted).rgb * (1.0 + 1e-30 * "
          "uintBitsToFloat(fetchBuffer(lightScales, int(edge2.w))).rgb)"},
         {"a lamp passed over", lights, "low = middle + 1", "low = middle + 2"},
         {"uniform instead of cosine-weighted", file,
          "radius = sqrt(randomNumber(seed, kDimensionAoU))",
          "radius = randomNumber(seed, kDimensionAoU)"},
         {"ambient rays without an end", file, "above ? frame.aoRadius : -1.0",
          "above ? 1e9 : -1.0"},
         {"tangent that does not turn", "lib/tangent.glsl", "vec3 world = vec3(",
          "vec3 world = t; world += 0.0 * vec3("},
         {"origin on the surface's other side", listing, "position + geometricNormal *",
          "position - geometricNormal *"},
         {"the last ray of a segment not traced", trace, "if (place >=", "if (place + 1u >="},
         {"half of a list not traced", trace, "if (place >=", "if (place >= 32u || place >="},
         {"a ray too early in its list", listing, "bits & (bit - 1u)", "bits & (bit >> 1u)"},
         {"light of the pixel beside", trace, "unpackPixel(to.w)", "unpackPixel(to.w ^ 1u)"},
         {"surroundings instead of light", trace, "imageLoad(raw, p) + vec4(frame.ambient",
          "vec4(frame.ambient"},
         {"light that shadows leave", trace, "imageStore(raw, p, vec4(0.0))",
          "imageStore(raw, p, imageLoad(raw, p))"},
         {"one tile for all runs", random, "hash2(frame.seed, dimension)", "hash2(0u, dimension)"},
         {"tile not shifted", random, "+ uvec2(shift, shift >> kTileBits)", ""},
         {"base of the Halton sequence", random, "radicalInverse(index, 7.0, 7)",
          "radicalInverse(index, 5.0, 8)"}});
}

TEST_CASE("errors planted in composite and tone map do not pass") {
    checkMutants(measurePicture,
                 {{"albedo forgotten", "post/composite.comp", "fetch(demodulation0, p).rgb *",
                   "(1.0 + 1e-30 * fetch(demodulation0, p).rgb) *"},
                  {"emission under the albedo", "post/composite.comp",
                   "fetch(signal0, p).rgb + fetch(emission, p).rgb",
                   "(fetch(signal0, p).rgb + fetch(emission, p).rgb)"},
                  {"black background", "post/composite.comp", "radiance = frame.ambient",
                   "radiance = vec3(0.0)"},
                  {"another curve", "lib/tone_map.glsl", "2.43", "2.34"},
                  {"plain gamma", "lib/color.glsl", "1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055",
                   "pow(linear, vec3(1.0 / 2.2))"},
                  {"no straight part of the curve", "lib/color.glsl", "0.0031308", "-1.0"}});
}
