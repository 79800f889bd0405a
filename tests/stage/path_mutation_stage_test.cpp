// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "tests/stage/path_judge.h"
#include "tests/stage/scene_mutants.h"
#include "tests/support/sequence.h"

// Would the stage test of paths notice? Each row plants one error in the text of a shader.

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{61, 37};

/// Measures the stage test's difference for one division: two frames of the glossy scene, in
/// which camera, bodies and a lamp differ, and the gradient samples of the second one.
double measure(ShaderLibrary& shaders, Signal signal) {
    Settings settings = settingsOf(Filter::Asvgf, signal);
    SceneFrames frames(sceneNamed("glossy"), kSize, settings, shaders);
    frames.frame = 4321;
    const Camera start = frames.camera;
    PathVerdict sum;
    for (int i = 0; i < 2; ++i) {
        shake(frames, start, i, 0.05f);
        frames.seconds = 0.4 * i;
        frames.light("key").tint = i == 1 ? glm::vec3(0.5f, 2.0f, 1.0f) : glm::vec3(1.0f);
        frames.light("spare").on = i == 0;
        const SceneFrame frame = frames.next();
        sum += judgePaths(momentOf(frames, frame), pictureOf(frames.targets()));
    }
    return std::max({double(sum.wrong), sum.luminance / 1e-6, sum.divisor / 1e-5});
}

double measureLobes(ShaderLibrary& shaders) {
    return measure(shaders, Signal::Split);
}
double measureSegments(ShaderLibrary& shaders) {
    return measure(shaders, Signal::Bounce);
}

const std::string kBsdf = "lib/bsdf.glsl", kPaths = "lib/paths.glsl",
                  kPoint = "lib/visible_point.glsl", kRandom = "lib/random.glsl",
                  kScatter = "lighting/path_scatter.comp", kBounce = "lighting/path_bounce.comp",
                  kLight = "lighting/path_light.comp", kDivisor = "lighting/path_divisor.comp",
                  kTrace = "lighting/trace.comp", kClosest = "lighting/trace_closest.comp";

} // namespace

TEST_CASE("errors planted in the surfaces of paths do not pass") {
    checkMutants(
        measureLobes,
        {{"an exponent of 4 in Fresnel's term", kBsdf, "grazing2 * grazing2 * grazing)",
          "grazing2 * grazing2)"},
         {"Fresnel's term of the normal", kBsdf, "1.0 - clamp(dot(middle, light), 0.0, 1.0)",
          "1.0 - b.cosView"},
         {"masking of the viewer alone", kBsdf,
          "0.5 / (cosLight * rootView + b.cosView * rootLight)",
          "0.5 / (cosLight * (b.cosView + rootView))"},
         {"both maskings for themselves", kBsdf,
          "0.5 / (cosLight * rootView + b.cosView * rootLight)",
          "1.0 / ((cosLight + rootLight) * (b.cosView + rootView))"},
         {"alpha for its square", kBsdf, "float a2 = b.alpha * b.alpha", "float a2 = b.alpha"},
         {"roughness for alpha", kBsdf, "max(roughness * roughness, kLeastAlpha)",
          "max(roughness, kLeastAlpha)"},
         {"mirrors without a width", kBsdf, "max(roughness * roughness, kLeastAlpha)",
          "max(roughness * roughness, 0.1 * kLeastAlpha)"},
         {"a density of all normals", kBsdf, "density / (2.0 * (b.cosView + rootView))",
          "density * cosMiddle / (4.0 * dot(b.view, middle))"},
         {"a density of one lobe alone", kBsdf,
          "b.pSpecular * pdfSpecular + (1.0 - b.pSpecular) * cosLight / kPi", "pdfSpecular"},
         {"lobes exchanged in the density", kBsdf,
          "b.pSpecular * pdfSpecular + (1.0 - b.pSpecular) * cosLight / kPi",
          "(1.0 - b.pSpecular) * pdfSpecular + b.pSpecular * cosLight / kPi"},
         {"lobes exchanged where one is picked", kBsdf, "lobe < b.pSpecular",
          "lobe >= b.pSpecular"},
         {"a lobe without its least share", kBsdf, "max(diffuse + specular, 1e-20), 0.1, 0.9)",
          "max(diffuse + specular, 1e-20), 0.0, 1.0)"},
         {"diffuse light below the specular", kBsdf, "baseColor * (1.0 - b.specular)", "baseColor"},
         {"metals that are diffuse, too", kBsdf, "(1.0 - metallic) * baseColor", "baseColor"},
         {"metals without their color", kBsdf, "mix(vec3(kDielectricF0), baseColor, metallic)",
          "mix(vec3(kDielectricF0), vec3(1.0), metallic)"},
         {"the table's terms exchanged", kBsdf, "b.f0 * terms.x + terms.y",
          "b.f0 * terms.y + terms.x"},
         {"texels between those of the table", kBsdf, "(float(kAlbedoTableSize) - 1.0)",
          "float(kAlbedoTableSize) - 0.5"},
         {"light from below the geometric horizon", kBsdf, "|| dot(b.geometric, light) <= 0.0", ""},
         {"normals stretched by alpha's square", kBsdf, "vec3(b.alpha * view.xy, view.z)",
          "vec3(b.alpha * b.alpha * view.xy, view.z)"},
         {"a hemisphere that is not projected", kBsdf,
          "(1.0 - s) * sqrt(max(0.0, 1.0 - disk.x * disk.x)) + s * disk.y", "disk.y"},
         {"a view from below the horizon", kBsdf,
          "normalize(view + normal * max(0.0, kLeastCosine - dot(normal, view)))", "view"}});
}

TEST_CASE("errors planted in the light of the visible surface do not pass") {
    checkMutants(
        measureLobes,
        {{"light samples without their weight", kPaths, "mis ? misWeight(density, s.pdf) : 1.0",
          "1.0"},
         {"light samples with the weight of directions", kPaths, "misWeight(density, s.pdf)",
          "misWeight(s.pdf, density)"},
         {"the cosine at the surface dropped", kPaths, "dot(b.normal, direction) / density",
          "1.0 / density"},
         {"the cosine of the flat normal", kPaths, "dot(b.normal, direction) / density",
          "dot(b.geometric, direction) / density"},
         {"half the density of lights", kPaths, "2.0 * probability * distanceSquared",
          "probability * distanceSquared"},
         {"lamps of one side alone", kPaths, "doubleSided ? abs(facing) : max(facing, 0.0)",
          "max(facing, 0.0)"},
         {"lamps of two sides alone", kPaths, "doubleSided ? abs(facing) : max(facing, 0.0)",
          "abs(facing)"},
         {"shadows of the lamp itself", kPaths, "distance * kShadowEnd", "distance * 1.001"},
         {"shadow rays that end early", kPaths, "distance * kShadowEnd", "distance * 0.7"},
         {"a specular signal without its shadow", kTrace, "imageStore(raw1, p, vec4(0.0));",
          "imageStore(raw1, p, imageLoad(raw1, p));"},
         {"a diffuse signal without its shadow", kTrace, "imageStore(raw, p, vec4(0.0));",
          "imageStore(raw, p, imageLoad(raw, p));"},
         {"the divisor of the other lobe", kPaths, "signal1 = light.specular / second",
          "signal1 = light.specular / first"},
         {"a divisor that is not bounded", kPaths, "first = max(b.diffuse, vec3(kLeastDivisor))",
          "first = b.diffuse"},
         {"signals exchanged", kPaths, "signal0 = light.diffuse / first",
          "signal0 = light.specular / first"},
         {"this frame's eye for gradient samples", kPoint,
          "isCarried ? frame.previousCameraPosition", "isCarried ? frame.cameraPosition"},
         {"the old eye for all", kPoint, "isCarried ? frame.previousCameraPosition",
          "!isCarried ? frame.previousCameraPosition"},
         {"the eye of the light sample alone", kScatter, "visiblePoint(p, eyeOf(seed))",
          "visiblePoint(p, frame.cameraPosition)"},
         {"an old eye for what is multiplied", kDivisor, "visiblePoint(p, frame.cameraPosition)",
          "visiblePoint(p, frame.previousCameraPosition)"},
         {"numbers of the light exchanged", kLight, "randomNumber(seed, kDimensionLightU)",
          "randomNumber(seed, kDimensionLobe)"}});
}

TEST_CASE("errors planted in the second segment of paths do not pass") {
    checkMutants(
        measureSegments,
        {{"directions without their density", kScatter, "direction) / s.pdf", "direction)"},
         {"directions without their cosine", kScatter, "dot(x1.bsdf.normal, direction) / s.pdf",
          "1.0 / s.pdf"},
         {"numbers of a direction exchanged", kScatter,
          "vec2(randomNumber(seed, kDimensionBounceU), randomNumber(seed, kDimensionBounceV))",
          "vec2(randomNumber(seed, kDimensionBounceV), randomNumber(seed, kDimensionBounceU))"},
         {"any hit for the first one", kClosest,
          "closestHit(from.xyz, uintBitsToFloat(to.xyz), from.w, hit)",
          "closestHit(from.xyz + 0.1 * uintBitsToFloat(to.xyz), uintBitsToFloat(to.xyz), "
          "from.w, hit)"},
         {"lamps that are met without their weight", kBounce, "misWeight(pdf, density)", "1.0"},
         {"the wrong side of the weight", kBounce, "misWeight(pdf, density)",
          "misWeight(density, pdf)"},
         {"every lamp as bright as it is made", kBounce, "light.emission * misWeight",
          "uintBitsToFloat(fetchBuffer(materials, int(links.y * kTexelsPerMaterial) + 1)).rgb * "
          "misWeight"},
         {"the light of a lamp's back", kBounce,
          "!light.doubleSided && dot(direction, light.areaNormal) >= 0.0", "false"},
         {"no light of lamps of two sides from behind", kBounce,
          "!light.doubleSided && dot(direction, light.areaNormal) >= 0.0",
          "dot(direction, light.areaNormal) >= 0.0"},
         {"the triangle beside", kBounce, "int(links.w + hit.triangle)", "int(links.w)"},
         {"no surroundings", kBounce, "vec3 arriving = frame.ambient",
          "vec3 arriving = 0.0 * frame.ambient"},
         {"kappa not applied", kBounce, "frame.regularization);", "0.0 * frame.regularization);"},
         {"kappa in the lobe and not in its albedo", kBsdf,
          "b.alpha == least ? sqrt(least) : roughness", "roughness"},
         {"kappa for alpha in the albedo", kBsdf, "b.alpha == least ? sqrt(least) : roughness",
          "b.alpha == least ? least : roughness"},
         {"kappa at the visible surface, too", kPoint, "normalize(eye - position), 0.0)",
          "normalize(eye - position), frame.regularization)"},
         {"the second light sample weighted", kBounce, "u, false, ray)", "u, true, ray)"},
         {"the visible surface's numbers again", kBounce,
          "randomNumber(seed, kDimensionBounceLight),", "randomNumber(seed, kDimensionLight),"},
         {"bases of their own for the second light", kRandom, "dimension -= kDimensionBounceLight",
          "dimension -= kDimensionBounceLight - 1u"},
         {"the specular lobe alone on the second surface", kBounce,
          "lobes.diffuse + lobes.specular", "lobes.specular"},
         {"the second surface seen by the camera", kBounce, "hit.geometric, -direction,",
          "hit.geometric, normalize(frame.cameraPosition - hit.position),"},
         {"normals not turned to the ray", kBounce,
          "dot(geometric, direction) > 0.0 ? -geometric : geometric", "geometric"},
         {"flat normals on the second surface", kBounce, "hit.instance, hit.normal",
          "hit.instance, hit.geometric"},
         {"light that waits in spite of its shadow", kTrace, "#ifdef PENDING\n    if (!hidden) {",
          "#ifdef PENDING\n    {"},
         {"light of the second surface in the first signal", kBounce,
          "imageStore(pending0, p, vec4(w0.rgb * sent, 0.0))",
          "imageStore(pending0, p, vec4(0.0)); imageStore(raw0, p, imageLoad(raw0, p) + "
          "vec4(w0.rgb * sent, 0.0))"}});
}
