// SPDX-License-Identifier: MIT
// The names of references and the folder that keeps them. Nothing here needs OpenGL.

#include "app/measure/reference.h"
#include "renderer/base/file.h"
#include "renderer/scene/procedural.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/warnings.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

using namespace afterglow;

namespace {

/// A request with all that it refers to.
struct Parts {
    Scene scene = makeMoving();
    glm::ivec2 size{64, 36};
    std::vector<LightState> seenLights{{}}, worldLights{{}};
    FrameInput seen{.camera = cameraAt(scene, poseAt(scene, 0.0)),
                    .seconds = 1.0,
                    .frame = 30,
                    .seed = 1,
                    .lights = {}};
    FrameInput world{.camera = seen.camera, .seconds = 0.9, .frame = 29, .seed = 1, .lights = {}};
    Settings settings;
    int samples = 256;
    ReferenceMaker maker{"shaders", "vendor", "renderer", "version"};

    std::string key() {
        seen.lights = seenLights;
        world.lights = worldLights;
        return referenceKey({scene, size, seen, world, settings, samples}, maker);
    }
};

struct Change {
    const char* what;
    std::function<void(Parts&)> make;
};

Reference exampleReference(glm::ivec2 size) {
    Reference reference;
    reference.signals = {Image<glm::vec4>(size)};
    float value = 0.1f;
    for (glm::vec4& pixel : reference.signals[0].pixels())
        for (int channel = 0; channel < 4; ++channel)
            pixel[channel] = value = value * 1.7f > 90.0f ? value * 0.0123f : value * 1.7f;
    reference.residual = 0.1 / 3.0;
    reference.rays = (1ull << 40) + 1;
    reference.milliseconds = 1234.5678901234567;
    reference.samples = 256;
    return reference;
}

bool equalBits(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
    return a.size() == b.size() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

/// An environment variable, put back at the end of the scope.
struct Variable {
    Variable(const char* itsName, std::optional<std::string> value) : name(itsName) {
        if (const char* was = std::getenv(name))
            before = was;
        set(value);
    }
    ~Variable() { set(before); }
    void set(const std::optional<std::string>& value) const {
        if (value)
            ::setenv(name, value->c_str(), 1);
        else
            ::unsetenv(name);
    }
    const char* name;
    std::optional<std::string> before;
};

} // namespace

TEST_CASE("all that a reference depends on is in its key") {
    const std::vector<Change> changes{
        {"a vertex", [](Parts& p) { p.scene.meshes[0].positions[1].y += 1e-6f; }},
        {"a normal", [](Parts& p) { p.scene.meshes[0].normals[0].x = 0.1f; }},
        {"a triangle",
         [](Parts& p) {
             std::swap(p.scene.meshes[0].triangles[0].x, p.scene.meshes[0].triangles[0].y);
         }},
        {"a mesh more", [](Parts& p) { p.scene.meshes.emplace_back(); }},
        {"a color", [](Parts& p) { p.scene.materials[0].baseColor.r = 0.123f; }},
        {"an emission", [](Parts& p) { p.scene.materials[0].emission.g = 1.0f; }},
        {"two sides", [](Parts& p) { p.scene.materials[0].doubleSided ^= true; }},
        {"another material", [](Parts& p) { p.scene.instances[0].material = 1; }},
        {"another mesh", [](Parts& p) { p.scene.instances[0].mesh = 1; }},
        {"an instance less", [](Parts& p) { p.scene.instances.erase(p.scene.instances.begin()); }},
        {"no light", [](Parts& p) { p.scene.lights[0].instances.clear(); }},
        {"surroundings", [](Parts& p) { p.scene.ambient.b = 0.3f; }},
        {"something moved", [](Parts& p) { p.scene.nodes[0].translation.x = 1e-3f; }},
        {"what could move",
         [](Parts& p) {
             p.scene.tracks.push_back({.node = p.scene.instances[0].node,
                                       .path = Track::Path::Translation,
                                       .interpolation = Track::Interpolation::Linear,
                                       .times = {0.0},
                                       .values = {glm::vec4(0.0f)}});
         }},
        {"the pose that is seen", [](Parts& p) { p.seen.seconds = 1.001; }},
        {"the pose of the light", [](Parts& p) { p.world.seconds = 0.901; }},
        {"poses exchanged", [](Parts& p) { std::swap(p.seen.seconds, p.world.seconds); }},
        {"one pose for both", [](Parts& p) { p.world.seconds = p.seen.seconds; }},
        {"a light off", [](Parts& p) { p.worldLights[0].on = false; }},
        {"a light's power", [](Parts& p) { p.worldLights[0].power = 2.0f; }},
        {"a light's tint", [](Parts& p) { p.worldLights[0].tint.g = 0.5f; }},
        {"the camera's place", [](Parts& p) { p.seen.camera.position.x += 1e-4f; }},
        {"the camera's direction", [](Parts& p) { p.seen.camera.orientation.x += 1e-4f; }},
        {"the lens", [](Parts& p) { p.seen.camera.lens.verticalFov = 1.0f; }},
        {"the near plane", [](Parts& p) { p.seen.camera.lens.near = 0.1f; }},
        {"the far plane", [](Parts& p) { p.seen.camera.lens.far = 100.0f; }},
        {"the seed", [](Parts& p) { p.seen.seed = 2; }},
        {"the size",
         [](Parts& p) {
             p.size = {36, 64};
         }},
        {"samples", [](Parts& p) { p.samples = 257; }},
        {"the signal", [](Parts& p) { p.settings.lighting.signal = int(Signal::Shadows); }},
        {"the radius", [](Parts& p) { p.settings.lighting.aoRadius = 0.05f; }},
        {"the clamp", [](Parts& p) { p.settings.lighting.signalClamp = 50.0f; }},
        {"the places in the pixels",
         [](Parts& p) { p.settings.display.antiAliasing = int(AntiAliasing::Taa); }},
        {"shaders", [](Parts& p) { p.maker.shaders = "shader"; }},
        {"vendor", [](Parts& p) { p.maker.vendor = "vendors"; }},
        {"renderer", [](Parts& p) { p.maker.renderer = "another"; }},
        {"version", [](Parts& p) { p.maker.version = "4.6"; }},
        {"texts that run together", [](Parts& p) {
             p.maker.vendor = "vendorr";
             p.maker.renderer = "enderer";
         }}};
    std::set<std::string> keys{Parts().key()};
    CHECK(keys.begin()->size() == 32);
    for (const Change& change : changes) {
        CAPTURE(std::string(change.what));
        Parts parts;
        change.make(parts);
        CHECK(keys.insert(parts.key()).second);
    }
}

TEST_CASE("what a reference does not depend on is not in its key") {
    const std::vector<Change> changes{
        {"nothing", [](Parts&) {}},
        {"names",
         [](Parts& p) {
             p.scene.name = p.scene.meshes[0].name = p.scene.nodes[0].name = "else";
             p.scene.materials[0].name = p.scene.lights[0].name = "else";
         }},
        {"frame numbers", [](Parts& p) { p.seen.frame = 7, p.world.frame = 1000; }},
        {"exposure", [](Parts& p) { p.settings.display.exposure = 2.0f; }},
        {"the filter",
         [](Parts& p) {
             p.settings.filter = Filter::None;
             p.settings.denoiser.temporal.alpha = 0.9f;
         }},
        {"lights of the moment that is seen", [](Parts& p) { p.seenLights[0].on = false; }},
        {"the other moment's camera", [](Parts& p) { p.world.camera.position.x = 9.0f; }},
        {"the other moment's seed", [](Parts& p) { p.world.seed = 9; }},
        {"lights that are as if not given", [](Parts& p) { p.worldLights.clear(); }},
        {"a light off, whatever its power", [](Parts&) {}},
        {"a light more than there is", [](Parts& p) { p.worldLights.emplace_back(); }},
        {"a camera more", [](Parts& p) { p.scene.cameras.emplace_back(); }}};
    for (const Change& change : changes) {
        CAPTURE(std::string(change.what));
        Parts parts;
        change.make(parts);
        CHECK(parts.key() == Parts().key());
    }
    Parts dim, dark;
    dim.worldLights[0] = {.on = false, .power = 0.1f, .tint = glm::vec3(1.0f)};
    dark.worldLights[0].on = false;
    CHECK(dim.key() == dark.key());
    // After its end a track holds its last value, which here is its first one.
    const auto at = [](double seen, double world) {
        Parts parts;
        parts.seen.seconds = seen;
        parts.world.seconds = world;
        return parts.key();
    };
    CHECK(at(4.0, 0.0) == at(0.0, 5.0));
    CHECK(at(4.0, 0.0) != at(4.0, 2.0));
}

TEST_CASE("what a cache gives back is what it was given, to the last bit") {
    const TemporaryFolder folder;
    const ReferenceCache cache(folder / "made/with/its/parents");
    const std::string key = Parts().key();
    CHECK_FALSE(cache.find(key));
    const Reference stored = exampleReference({19, 7});
    cache.store(key, stored, {{"scene", "an example"}});
    const auto found = ReferenceCache(cache.folder()).find(key);
    REQUIRE(found);
    CHECK(equalBits(found->signals.at(0), stored.signals.at(0)));
    CHECK(found->residual == stored.residual);
    CHECK(found->rays == stored.rays);
    CHECK(found->milliseconds == stored.milliseconds);
    CHECK(found->samples == stored.samples);
    CHECK(found->cached);
    const auto json = nlohmann::json::parse(readFile(cache.folder() / (key + ".json")));
    CHECK(json["scene"] == "an example");
    CHECK(json["key"] == key);
}

TEST_CASE("no damaged entry is taken for a reference") {
    const TemporaryFolder folder;
    const ReferenceCache cache(folder.path());
    const std::string key(32, 'a'), otherKey(32, 'b');
    const Reference stored = exampleReference({31, 20});
    cache.store(key, stored, {{"scene", "an example"}});
    const auto exr = folder / (key + ".exr"), json = folder / (key + ".json");
    const std::string picture = readFile(exr), description = readFile(json);
    REQUIRE(cache.find(key));

    const Warnings warnings;
    int missed = 0, tried = 0;
    const auto check = [&](std::string newPicture, std::string newDescription) {
        writeFileAtomically(exr, newPicture);
        writeFileAtomically(json, newDescription);
        const auto found = cache.find(key);
        ++tried;
        missed += !found;
        // A byte that means nothing may differ; what is given back may not.
        if (found)
            CHECK((equalBits(found->signals.at(0), stored.signals.at(0)) &&
                   found->rays == stored.rays && found->residual == stored.residual &&
                   found->milliseconds == stored.milliseconds && found->samples == stored.samples));
    };
    for (std::size_t part = 0; part < 8; ++part) {
        check(picture.substr(0, picture.size() * part / 8), description);
        check(picture, description.substr(0, description.size() * part / 8));
    }
    CHECK(missed == tried);
    missed = tried = 0;
    for (std::size_t i = picture.size() / 4; i < picture.size(); i += 61) {
        std::string flipped = picture;
        flipped[i] = char(flipped[i] ^ 0x10);
        check(flipped, description);
    }
    for (std::size_t i = 0; i < description.size(); i += 5) {
        std::string flipped = description;
        flipped[i] = char(flipped[i] ^ 0x01);
        check(picture, flipped);
    }
    MESSAGE(missed, " of ", tried, " flipped bytes are noticed");
    CHECK(missed > tried / 2);
    CHECK(warnings.texts.size() >= std::size_t(missed));

    check(picture, description);
    CHECK(cache.find(key));
    // Half an entry is none: the picture is written first.
    std::filesystem::remove(json);
    const std::size_t before = warnings.texts.size();
    CHECK_FALSE(cache.find(key));
    CHECK(warnings.texts.size() == before);
    // A picture under another's name.
    writeFileAtomically(folder / (otherKey + ".exr"), picture);
    writeFileAtomically(folder / (otherKey + ".json"), description);
    CHECK_FALSE(cache.find(otherKey));
    // And it can be stored again.
    cache.store(key, stored, {{"scene", "an example"}});
    CHECK(cache.find(key));
}

TEST_CASE("a folder that cannot be had is an error that names it; the default one a warning") {
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "not a folder");
    CHECK(messageOf<Error>([&] { ReferenceCache cache(file + "/cache"); }).find(file + "/cache") !=
          std::string::npos);

    const Variable xdg("XDG_CACHE_HOME", file), home("HOME", folder.path().string());
    const ReferenceMaker maker{"", "", "", ""};
    {
        const Warnings warnings;
        CHECK_FALSE(ReferenceStore::withDefaultCache(maker).cache());
        REQUIRE(warnings.texts.size() == 1);
        CHECK(warnings.texts[0].find(file + "/afterglow/references") != std::string::npos);
    }
    xdg.set((folder / "caches").string());
    CHECK(defaultCacheFolder() == folder / "caches/afterglow/references");
    const Warnings warnings;
    const ReferenceStore store = ReferenceStore::withDefaultCache(maker);
    REQUIRE(store.cache());
    CHECK(store.cache()->folder() == defaultCacheFolder());
    CHECK(std::filesystem::is_directory(defaultCacheFolder()));
    for (const auto& value : {std::optional<std::string>(), std::optional<std::string>(""),
                              std::optional<std::string>("relative/path")}) {
        xdg.set(value);
        CHECK(defaultCacheFolder() == folder / ".cache/afterglow/references");
    }
    home.set({});
    CHECK_THROWS_AS(defaultCacheFolder(), Error);
    CHECK(warnings.texts.empty());
}
