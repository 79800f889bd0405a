// SPDX-License-Identifier: MIT
#include "app/measure/reference_cache.h"

#include "app/base/json_reader.h"
#include "app/base/output.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/hash.h"
#include "renderer/base/json.h"
#include "renderer/base/log.h"
#include "renderer/gl/embedded_shaders.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/jitter.h"

#include <array>
#include <cstdlib>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// Rises with every change to C++ code that changes what a reference is: the scene on the GPU, the
/// order of the passes. Changes of shaders are seen by themselves.
constexpr int kFormat = 2;

// The folders of all shaders that a reference passes through, from triangles to the mean.
constexpr std::array<std::string_view, 2> kShaderFolders{"lighting/", "scene/"};

constexpr std::size_t kMaxDescription = 1 << 20; ///< bytes; ours have about a thousand

void addMaterial(Hash& hash, const Material& material) {
    hash.add(material.baseColor);
    hash.add(material.metallic);
    hash.add(material.roughness);
    hash.add(material.emission);
    hash.add(std::uint32_t(material.doubleSided));
    hash.add(material.baseColorTexture.value_or(~0u));
}

// All but names, and but what depends on time.
void addContent(Hash& hash, const Scene& scene) {
    hash.add(std::uint64_t(scene.meshes.size()));
    for (const Mesh& mesh : scene.meshes) {
        hash.addList(mesh.positions);
        hash.addList(mesh.normals);
        hash.addList(mesh.texCoords);
        hash.addList(mesh.triangles);
    }
    hash.add(std::uint64_t(scene.textures.size()));
    for (const Texture& texture : scene.textures) {
        hash.add(texture.pixels.size());
        hash.addList(texture.pixels.pixels());
    }
    hash.add(std::uint64_t(scene.materials.size()));
    for (const Material& material : scene.materials)
        addMaterial(hash, material);
    hash.add(std::uint64_t(scene.lights.size()));
    for (const Light& light : scene.lights)
        hash.addList(light.instances);
    hash.add(scene.ambient);
}

// Where everything is: at time 0, from which the scene's extent and the lights' shares of samples
// follow, where it is seen, and where it is lit. What can move is traced in its own space, with
// other rounding.
void addPoses(Hash& hash, const Scene& scene, double seen, double world) {
    const std::vector<bool> moves = movingNodes(scene);
    const Pose poses[] = {poseAt(scene, 0.0), poseAt(scene, seen), poseAt(scene, world)};
    hash.add(std::uint64_t(scene.instances.size()));
    for (const Instance& instance : scene.instances) {
        hash.add(instance.mesh);
        hash.add(instance.material);
        hash.add(std::uint32_t(moves[instance.node]));
        for (const Pose& pose : poses)
            hash.add(pose.worldFromNode[instance.node]);
    }
}

glm::vec3 scaleOf(const FrameInput& input, std::size_t slot) {
    return slot < input.lights.size() ? input.lights[slot].scale() : glm::vec3(1.0f);
}

void addCamera(Hash& hash, const Camera& camera) {
    hash.add(camera.position);
    hash.add(camera.orientation);
    hash.add(camera.lens.verticalFov);
    hash.add(camera.lens.near);
    hash.add(camera.lens.far);
}

/// Of all that an entry gives back.
std::string checksumOf(const Reference& reference) {
    Hash hash;
    for (const Image<glm::vec4>& signal : reference.signals) {
        hash.add(signal.size());
        hash.addList(signal.pixels());
    }
    hash.add(reference.residual);
    hash.add(reference.rays);
    hash.add(reference.milliseconds);
    hash.add(reference.samples);
    return hash.hex();
}

std::string pictureName(const std::string& key, std::size_t signal) {
    return key + (signal == 0 ? "" : "-" + std::to_string(signal)) + ".exr";
}

Json listOf(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

} // namespace

ReferenceMaker::ReferenceMaker(const ShaderLibrary& library, const GlInfo& gl)
    : ReferenceMaker(library.fingerprint(kShaderFolders), gl.vendor, gl.renderer, gl.version) {}

ReferenceMaker::ReferenceMaker(std::string shaderHash, std::string glVendor, std::string glRenderer,
                               std::string glVersion)
    : shaders(std::move(shaderHash)), vendor(std::move(glVendor)), renderer(std::move(glRenderer)),
      version(std::move(glVersion)) {}

std::string referenceKey(const ReferenceRequest& request, const ReferenceMaker& maker) {
    Hash hash;
    hash.add(kFormat);
    for (const std::string& text : {maker.shaders, maker.vendor, maker.renderer, maker.version})
        hash.addList(text);
    hash.addList(embeddedFile("noise/blue_noise_128.pgm").value_or(""));
    addContent(hash, request.scene);
    addPoses(hash, request.scene, request.seen.seconds, request.world.seconds);
    for (std::size_t slot = 0; slot < request.scene.lights.size(); ++slot)
        hash.add(scaleOf(request.world, slot));
    addCamera(hash, request.seen.camera);
    hash.add(request.seen.seed);
    hash.add(request.size);
    hash.add(request.samples);
    const LightingSettings& lighting = request.settings.lighting;
    hash.add(lighting.signal);
    hash.add(lighting.aoRadius);
    hash.add(lighting.signalClamp);
    if (pathsOf(Signal(lighting.signal)))
        hash.add(lighting.regularization);
    hash.add(jitterOf(request.settings.display, request.seen.frame));
    return hash.hex();
}

Json describe(const ReferenceRequest& request, const ReferenceMaker& maker) {
    const Camera& camera = request.seen.camera;
    const LightingSettings& lighting = request.settings.lighting;
    Json lights = Json::object();
    for (std::size_t slot = 0; slot < request.scene.lights.size(); ++slot)
        lights[request.scene.lights[slot].name] = listOf(scaleOf(request.world, slot));
    return {{"program", "afterglow"},
            {"version", version()},
            {"scene", request.scene.name},
            {"size", {request.size.x, request.size.y}},
            {"seconds_of_surfaces", request.seen.seconds},
            {"seconds_of_light", request.world.seconds},
            {"light_scales", lights},
            {"camera",
             {{"position", listOf(camera.position)},
              {"forward", listOf(camera.forward())},
              {"vertical_fov", camera.lens.verticalFov}}},
            {"seed", request.seen.seed},
            {"signal", nameOf(Signal(lighting.signal))},
            {"ao_radius", lighting.aoRadius},
            {"signal_clamp", lighting.signalClamp},
            {"regularization", lighting.regularization},
            {"gl",
             {{"vendor", maker.vendor}, {"renderer", maker.renderer}, {"version", maker.version}}},
            {"shaders", maker.shaders}};
}

ReferenceCache::ReferenceCache(fs::path folder) : folder_(OutputFolder(std::move(folder)).path()) {}

std::optional<Reference> ReferenceCache::find(const std::string& key) const {
    const fs::path json = folder_ / (key + ".json");
    std::error_code unreadable;
    if (!fs::exists(json, unreadable))
        return std::nullopt;
    try {
        const JsonDocument document(readFile(json, kMaxDescription), json.string());
        const JsonReader root = document.root();
        // What was written first, in JSON, is a number that JSON can hold: no infinity.
        constexpr double kMost = std::numeric_limits<double>::max();
        Reference reference;
        reference.residual = root.at("residual").number(0.0, kMost);
        reference.rays = std::uint64_t(root.at("rays").wholeNumber(0, 1ll << 53));
        reference.milliseconds = root.at("ms").number(0.0, kMost);
        reference.samples = int(root.at("samples").wholeNumber(1, 1 << 30));
        reference.cached = true;
        const fs::path exr = folder_ / pictureName(key, 0);
        const auto signals = std::size_t(root.at("signals").wholeNumber(1, kMaxSignals));
        for (std::size_t i = 0; i < signals; ++i)
            reference.signals.push_back(
                readExr(folder_ / pictureName(key, i), {"R", "G", "B", "A"}));
        if (root.at("key").text() != key || root.at("checksum").text() != checksumOf(reference))
            throw InputError(exr.string() + ": is not the picture that " +
                             json.filename().string() + " describes");
        return reference;
    } catch (const InputError& error) {
        log(LogLevel::Warning, std::string("a damaged reference is made again: ") + error.what());
        return std::nullopt;
    }
}

void ReferenceCache::store(const std::string& key, const Reference& reference,
                           const Json& description) const {
    for (std::size_t i = 0; i < reference.signals.size(); ++i)
        writeExr(folder_ / pictureName(key, i), reference.signals[i], {"R", "G", "B", "A"});
    Json json = {{"key", key}};
    json.update(description);
    json["signals"] = reference.signals.size();
    json["samples"] = reference.samples;
    json["residual"] = reference.residual;
    json["rays"] = reference.rays;
    json["ms"] = reference.milliseconds;
    json["checksum"] = checksumOf(reference);
    writeFileAtomically(folder_ / (key + ".json"), jsonText(json, 2) + "\n");
}

fs::path defaultCacheFolder() {
    const auto fromEnvironment = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    // XDG Base Directory Specification 0.8: a path that is not absolute is to be ignored.
    fs::path caches = fromEnvironment("XDG_CACHE_HOME");
    if (!caches.is_absolute()) {
        const fs::path home = fromEnvironment("HOME");
        if (home.empty())
            throw Error("there is no folder for references: neither XDG_CACHE_HOME nor HOME is "
                        "set");
        caches = home / ".cache";
    }
    return caches / "afterglow" / "references";
}

} // namespace afterglow
