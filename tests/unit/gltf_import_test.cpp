// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/log.h"
#include "renderer/scene/gltf_import.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace afterglow;
using nlohmann::json;

namespace {

Scene import(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "scene.gltf", builder.gltf());
    return importGltf(folder / "scene.gltf");
}

/// A square in the plane z = 0 as four vertices.
const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

glm::vec3 frontOf(const Mesh& mesh, std::size_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    return glm::normalize(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                     mesh.positions[t.z] - mesh.positions[t.x]));
}

struct Messages {
    std::vector<std::string> all;
    LogSink before =
        setLogSink([this](LogLevel, std::string_view text) { all.emplace_back(text); });
    ~Messages() { setLogSink(before); }
};

} // namespace

TEST_CASE("a file with one of everything is imported, from .gltf and .glb alike") {
    const GltfBuilder builder = completeGltf();
    const TemporaryFolder folder;
    writeFileAtomically(folder / "a.gltf", builder.gltf());
    writeFileAtomically(folder / "b.glb", builder.glb());
    writeFileAtomically(folder / "c.gltf", builder.gltf("the%20data.bin"));
    writeFileAtomically(folder / "the data.bin", builder.bytes + "more than is asked for");
    for (const char* name : {"a.gltf", "b.glb", "c.gltf"}) {
        CAPTURE(name);
        const Scene scene = importGltf(folder / name);
        REQUIRE(scene.meshes.size() == 1);
        CHECK(scene.meshes[0].name == "shape");
        CHECK(scene.meshes[0].positions.size() == 6);
        CHECK(scene.meshes[0].positions[4] == glm::vec3(4, 0, 0));
        CHECK(scene.meshes[0].normals[5] == glm::vec3(0, 0, 1));
        CHECK(scene.meshes[0].triangles == std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}});
        REQUIRE(scene.materials.size() == 1);
        const Material& material = scene.materials[0];
        CHECK(material.name == "glow");
        CHECK(material.baseColor == glm::vec3(0.1f, 0.2f, 0.3f));
        CHECK(material.metallic == 0.4f);
        CHECK(material.roughness == 0.5f);
        CHECK(material.emission == glm::vec3(4, 2, 8));
        CHECK(material.doubleSided);
        REQUIRE(material.baseColorTexture);
        CHECK(scene.textures.at(*material.baseColorTexture).name == "wood.png");
        REQUIRE(scene.cameras.size() == 1);
        CHECK(scene.cameras[0].name == "eye");
        CHECK(scene.cameras[0].lens.verticalFov == 0.7f);
        CHECK(scene.cameras[0].lens.near == 0.25f);
        CHECK(scene.cameras[0].lens.far == 90.0f);
        REQUIRE(scene.lights.size() == 1);
        CHECK(scene.lights[0].name == "parent");
        // The camera is a child of the node that moves, and turns with it by steps.
        CHECK(duration(scene) == 2.0);
        CHECK(cameraAt(scene, poseAt(scene, 0.5)).position == glm::vec3(1, 0, 5));
        CHECK(glm::distance(cameraAt(scene, poseAt(scene, 1.5)).position, glm::vec3(7, 2, 0)) <
              1e-5f);
    }
}

TEST_CASE("strips and fans keep the front of their first triangle, with indices of any size") {
    for (const int mode : {5, 6}) {
        for (const int size : {0, 8, 16, 32}) {
            CAPTURE(mode);
            CAPTURE(size);
            GltfBuilder builder;
            const int positions = builder.floats(kSquare, "VEC3");
            json primitive{{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
            // As a strip, the square wants its last two corners the other way round.
            const std::uint8_t c = mode == 5 ? 3 : 2, d = mode == 5 ? 2 : 3;
            if (size == 0 && mode == 5) {
                continue;
            }
            if (size == 8) {
                primitive["indices"] = builder.indices8({0, 1, c, d});
            } else if (size == 16) {
                primitive["indices"] = builder.indices16({0, 1, c, d});
            } else if (size == 32) {
                primitive["indices"] = builder.indices32({0, 1, c, d});
            }
            builder.shape(primitive);
            const Mesh mesh = import(builder).meshes.at(0);
            REQUIRE(mesh.triangles.size() == 2);
            CHECK(frontOf(mesh, 0) == glm::vec3(0, 0, 1));
            CHECK(frontOf(mesh, 1) == glm::vec3(0, 0, 1));
        }
    }
}

TEST_CASE("a mesh without normals gets flat ones") {
    GltfBuilder builder;
    // Two faces of a roof that share an edge by index.
    const int positions = builder.floats({0, 0, 0, 0, 0, 1, 1, 1, 0, 2, 0, 0}, "VEC3");
    builder.shape({{"attributes", {{"POSITION", positions}}},
                   {"indices", builder.indices16({0, 1, 2, 2, 1, 3})}});
    const Mesh mesh = import(builder).meshes.at(0);
    REQUIRE(mesh.positions.size() == 6);
    for (std::size_t t = 0; t < 2; ++t) {
        for (int c = 0; c < 3; ++c) {
            CHECK(glm::distance(mesh.normals[mesh.triangles[t][c]], frontOf(mesh, t)) < 1e-6f);
        }
    }
    CHECK(frontOf(mesh, 0) != frontOf(mesh, 1));
}

TEST_CASE("normals are made unit length, and one without length is that of its face") {
    GltfBuilder builder;
    const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int normals = builder.floats({0, 0, 9, 1e-30f, 0, 0, 0, 0, 0}, "VEC3");
    builder.shape({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const Mesh mesh = import(builder).meshes.at(0);
    CHECK(mesh.normals == std::vector<glm::vec3>{{0, 0, 1}, {1, 0, 0}, {0, 0, 1}});
}

TEST_CASE("triangles without area and unused vertices are left out, and the log says so") {
    GltfBuilder builder;
    std::vector<float> points = kSquare;
    points.insert(points.end(), {1000, 0, 0});
    const int positions = builder.floats(points, "VEC3");
    const json attributes = {{"POSITION", positions}, {"NORMAL", builder.floats(points, "VEC3")}};
    builder.shape({{"attributes", attributes},
                   {"indices", builder.indices16({0, 1, 2, 0, 1, 1, 0, 4, 1, 0, 2, 3})}});
    builder.shape({{"attributes", attributes}, {"indices", builder.indices16({0, 1, 4})}});
    Messages messages;
    const Scene scene = import(builder);
    CHECK(scene.meshes.at(0).triangles.size() == 2);
    CHECK(scene.meshes.at(0).positions.size() == 4);
    CHECK(scene.meshes.at(0).name == "shape");
    // The second mesh had nothing else. The other one is the default light.
    CHECK(scene.meshes.size() == 2);
    CHECK(scene.lights.at(0).name == "default light");
    REQUIRE(messages.all.size() == 1);
    CHECK(messages.all[0].find("3 triangles without area") != std::string::npos);
}

TEST_CASE("a primitive without a material is light gray and diffuse") {
    GltfBuilder builder;
    builder.shape({{"attributes", {{"POSITION", builder.floats(kSquare, "VEC3")}}}, {"mode", 6}});
    const Scene scene = import(builder);
    const Material& material = scene.materials.at(scene.instances.at(0).material);
    CHECK(material.baseColor == glm::vec3(0.8f));
    CHECK(material.metallic == 0.0f);
}

TEST_CASE("matrices, mirrored ones too, and chains of parents are as in the file") {
    GltfBuilder builder;
    const int node = builder.shape(
        {{"attributes", {{"POSITION", builder.floats(kSquare, "VEC3")}}}, {"mode", 6}});
    json& document = builder.document;
    document["nodes"][node]["matrix"] = {-2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    // The parent comes after its child in the file.
    document["nodes"].push_back(
        {{"children", {node}}, {"translation", {10, 0, 0}}, {"scale", {1, 1, -1}}});
    document["scenes"][0]["nodes"] = {1};
    const Scene scene = import(builder);
    const Instance& instance = scene.instances.at(0);
    CHECK(scene.nodes.at(instance.node).parent == 0);
    const glm::mat4 worldFromNode = poseAt(scene, 0.0).worldFromNode.at(instance.node);
    CHECK(glm::vec3(worldFromNode * glm::vec4(1, 1, 1, 1)) == glm::vec3(13, 9, -8));
    CHECK(glm::determinant(glm::mat3(worldFromNode)) > 0.0f); // mirrored twice
}

TEST_CASE("interleaved vertices with a stride are read") {
    GltfBuilder builder;
    // Position and normal in turn, 24 bytes a vertex.
    const int both = builder.floats({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}, "VEC3");
    json& document = builder.document;
    document["bufferViews"][0]["byteStride"] = 24;
    document["accessors"][0]["count"] = 3;
    document["accessors"].push_back(document["accessors"][0]);
    document["accessors"][1]["byteOffset"] = 12;
    builder.shape({{"attributes", {{"POSITION", both}, {"NORMAL", 1}}}});
    const Mesh mesh = import(builder).meshes.at(0);
    CHECK(mesh.positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.normals == std::vector<glm::vec3>(3, {0, 0, 1}));
    // One element more would reach beyond the view.
    document["accessors"][1]["count"] = 4;
    CHECK_THROWS_AS(import(builder), InputError);
}

TEST_CASE("only the scene that is shown is imported, and a library without scenes as a whole") {
    GltfBuilder builder;
    const json primitive = {{"attributes", {{"POSITION", builder.floats(kSquare, "VEC3")}}},
                            {"mode", 6}};
    builder.shape(primitive);
    builder.shape(primitive);
    builder.document["scenes"] = json::parse(R"([{"nodes": [0]}, {"nodes": [0, 1]}])");
    CHECK(import(builder).instances.size() == 1 + 1); // and the default light
    builder.document["scene"] = 1;
    CHECK(import(builder).instances.size() == 2 + 1);
    builder.document.erase("scene");
    builder.document.erase("scenes");
    CHECK(import(builder).instances.size() == 2 + 1);
}

TEST_CASE("the example scenes of the project can be imported") {
    const std::filesystem::path folder = sourceDir() / "assets/scenes";
    const Scene cornell = importGltf(folder / "cornell.gltf");
    REQUIRE(cornell.lights.size() == 2);
    CHECK(cornell.lights[0].name == "key");
    CHECK(cornell.lights[1].name == "fill");
    const Scene spinner = importGltf(folder / "spinner.glb");
    CHECK(duration(spinner) == 4.0);
    CHECK(spinner.lights.at(0).name == "key");
}
