// SPDX-License-Identifier: MIT
// What importGltf() refuses, and in which words.

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/log.h"
#include "renderer/scene/gltf_import.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

using namespace afterglow;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The fault that the importer names in these bytes, without the path; "" if they can be imported.
std::string faultOf(const std::string& bytes, const std::string& name = "scene.gltf") {
    const TemporaryFolder folder;
    const fs::path path = folder / name;
    writeFileAtomically(path, bytes);
    const std::string message = messageOf<InputError>([&] { importGltf(path); });
    const std::string prefix = path.string() + ": ";
    CHECK(message.find('\n') == std::string::npos);
    CHECK((message.empty() || message.starts_with(prefix)));
    return message.empty() ? "" : message.substr(prefix.size());
}

/// The complete file with one value replaced, or with none if it is the word "gone".
std::string faultWith(const std::string& pointer, const json& value) {
    GltfBuilder builder = completeGltf();
    const json::json_pointer place(pointer);
    if (value == "gone") {
        builder.document[place.parent_pointer()].erase(place.back());
    } else {
        builder.document[place] = value;
    }
    return faultOf(builder.gltf());
}

struct Quiet {
    LogSink before = setLogSink({});
    ~Quiet() { setLogSink(before); }
};

} // namespace

TEST_CASE("a file that is no glTF at all is named with its fault") {
    const TemporaryFolder folder;
    const auto fault = [&](const fs::path& path) {
        return messageOf<InputError>([&] { importGltf(path); });
    };
    CHECK(fault(folder / "none.gltf") ==
          (folder / "none.gltf").string() + ": there is no such file");
    CHECK(fault(folder.path()) == folder.path().string() + ": is a folder, not a file");
    CHECK(fault("/dev/zero") == "/dev/zero: is not a regular file");
    CHECK(faultOf("") == "is empty");
    CHECK(faultOf("solid cube\n").starts_with("is not glTF"));
    CHECK(faultOf("[1, 2]").starts_with("is not glTF"));
    CHECK(faultOf("{}").starts_with("is not glTF: it has no \"asset\""));
    CHECK(faultOf("{}", "a.glb").starts_with("is not a binary glTF"));
    CHECK(faultOf("{\"asset\": {\"version\": \"2.0\"}")
              .starts_with("has bad JSON: parse error at line 1"));
    CHECK(faultOf(std::string(100000, '{')).starts_with("has bad JSON"));
    CHECK(faultOf("{\"asset\": " + std::string(3000000, '[')).starts_with("has bad JSON"));
    CHECK(faultOf("{\"a\": 1e999}").starts_with("has bad JSON"));
    CHECK(faultOf("{\"a\": \"\xff\"}").starts_with("has bad JSON"));
}

TEST_CASE("a binary glTF that is cut off or of another version says so") {
    const std::string whole = completeGltf().glb();
    CHECK(faultOf(whole, "a.glb") == "");
    CHECK(faultOf(whole.substr(0, 7), "a.glb").starts_with("is cut off"));
    CHECK(faultOf(whole.substr(0, whole.size() / 2), "a.glb").starts_with("is cut off"));
    std::string other = whole;
    other[4] = 1;
    CHECK(faultOf(other, "a.glb") == "is glTF version 1; version 2 is needed");
    other = whole;
    other[15] = 0x7f; // the length of the first chunk
    CHECK(faultOf(other, "a.glb") == "chunk 0 reaches beyond the end of the file");
    CHECK(faultOf(whole.substr(0, 8) + std::string("\x0c\0\0\0", 4), "a.glb") ==
          "has no JSON in it");
}

TEST_CASE("references out of range are named, whichever they are") {
    Quiet quiet;
    REQUIRE(faultOf(completeGltf().gltf()) == "");
    const struct {
        const char* pointer;
        const char* fault;
    } references[] = {
        {"/scene", "scene is 7, but there are 1 scenes"},
        {"/scenes/0/nodes/0", "scenes[0].nodes[0] is 7, but there are 2 nodes"},
        {"/nodes/0/mesh", "nodes[0].mesh is 7, but there are 1 meshes"},
        {"/nodes/0/children/0", "nodes[0].children[0] is 7, but there are 2 nodes"},
        {"/nodes/1/camera", "nodes[1].camera is 7, but there are 1 cameras"},
        {"/meshes/0/primitives/0/indices",
         "meshes[0].primitives[0].indices is 7, but there are 6 accessors"},
        {"/meshes/0/primitives/0/attributes/POSITION",
         "meshes[0].primitives[0].attributes.POSITION is 7, but there are 6 accessors"},
        {"/meshes/0/primitives/0/attributes/COLOR_0",
         "meshes[0].primitives[0].attributes.COLOR_0 is 7, but there are 6 accessors"},
        {"/meshes/0/primitives/0/material",
         "meshes[0].primitives[0].material is 7, but there are 1 materials"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/index",
         "materials[0].pbrMetallicRoughness.baseColorTexture.index is 7, but there are 1 textures"},
        {"/textures/0/source", "textures[0].source is 7, but there are 1 images"},
        {"/accessors/0/bufferView", "accessors[0].bufferView is 7, but there are 6 buffer views"},
        {"/bufferViews/0/buffer", "bufferViews[0].buffer is 7, but there are 1 buffers"},
        {"/animations/0/channels/0/sampler",
         "animations[0].channels[0].sampler is 7, but there are 2 samplers"},
        {"/animations/0/channels/0/target/node",
         "animations[0].channels[0].target.node is 7, but there are 2 nodes"},
        {"/animations/0/samplers/0/input",
         "animations[0].samplers[0].input is 7, but there are 6 accessors"},
        {"/animations/0/samplers/1/output",
         "animations[0].samplers[1].output is 7, but there are 6 accessors"},
    };
    for (const auto& reference : references) {
        CAPTURE(reference.pointer);
        CHECK(faultWith(reference.pointer, 7) == reference.fault);
        // 2^32 is 0 to whoever keeps 32 bits of it.
        for (const json& wrong : {json(-1), json(0.5), json("0"), json(4294967296), json(1e300)}) {
            CAPTURE(wrong);
            CHECK(faultWith(reference.pointer, wrong) != "");
        }
    }
}

TEST_CASE("data that is not where it is said to be is named, without overflow") {
    const json huge = 9223372036854775807;
    for (const char* pointer :
         {"/buffers/0/byteLength", "/bufferViews/0/byteLength", "/bufferViews/0/byteOffset",
          "/accessors/0/count", "/accessors/0/byteOffset"}) {
        CAPTURE(pointer);
        CHECK(faultWith(pointer, huge) != "");
        CHECK(faultWith(pointer, 18446744073709551615u) != "");
        CHECK(faultWith(pointer, 1099511627776) != ""); // 2^40
        CHECK(faultWith(pointer, 100000) != "");
        CHECK(faultWith(pointer, -4) != "");
    }
    CHECK(faultWith("/accessors/0/count", 0) != "");
    CHECK(faultWith("/accessors/0/count", 7) ==
          "accessors[0] reaches beyond buffer view 0 of 72 bytes");
    CHECK(faultWith("/bufferViews/0/byteStride", 8).starts_with("accessors[0] has elements of 12"));
    CHECK(faultWith("/bufferViews/0/byteStride", 14) ==
          "bufferViews[0].byteStride is not a multiple of 4");
    CHECK(faultWith("/bufferViews/0/byteStride", 256) != "");
    CHECK(faultWith("/accessors/0/componentType", 5124) ==
          "accessors[0].componentType is 5124, which is no type of glTF 2");
    CHECK(faultWith("/accessors/0/type", "VEC9") != "");
    CHECK(faultWith("/accessors/0/type", "VEC2") != "");
    CHECK(faultWith("/accessors/2/componentType", 5126) != "");
    CHECK(faultWith("/accessors/0/sparse", json::object()) ==
          "meshes[0].primitives[0].attributes.POSITION is accessor 0, which is sparse; that is not "
          "supported");
    CHECK(faultWith("/accessors/0/bufferView", "gone") ==
          "meshes[0].primitives[0].attributes.POSITION is accessor 0, which has no buffer view");
    CHECK(faultWith("/accessors/1/count", 5) ==
          "meshes[0].primitives[0].attributes.NORMAL has 5 elements for 6 vertices");
    CHECK(faultWith("/accessors/2/count", 5) ==
          "meshes[0].primitives[0] has 5 indices, which is not a number of triangles");
}

TEST_CASE("values that are not numbers of the world are named") {
    const auto faultOfPositions = [](std::vector<float> values) {
        GltfBuilder builder;
        builder.shape({{"attributes", {{"POSITION", builder.floats(values, "VEC3")}}}});
        return faultOf(builder.gltf());
    };
    CHECK(faultOfPositions({0, 0, 0, 1, 0, 0, 0, kNan, 0}) ==
          "meshes[0].primitives[0] (\"shape\") vertex 2 is not finite");
    CHECK(faultOfPositions({0, 0, 0, kInfinity, 0, 0, 0, 1, 0}) ==
          "meshes[0].primitives[0] (\"shape\") vertex 1 is not finite");
    CHECK(
        faultOfPositions({0, 0, 0, 3e38f, 0, 0, 0, 3e38f, 0}).starts_with("reaches farther than"));
    CHECK(faultOfPositions({0, 0, 0, 1, 0, 0, 2, 0, 0}) == "has no triangle with an area");
    CHECK(faultWith("/nodes/0/matrix", json::parse("[1e38,0,0,0,0,1e38,0,0,0,0,1e38,0,0,0,0,1]")) !=
          "");

    GltfBuilder builder;
    const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    builder.shape(
        {{"attributes", {{"POSITION", positions}}}, {"indices", builder.indices16({0, 1, 3})}});
    CHECK(faultOf(builder.gltf()) ==
          "meshes[0].primitives[0] (\"shape\") index 2 is 3, but there are 3 vertices");

    GltfBuilder bent;
    bent.shape({{"attributes",
                 {{"POSITION", bent.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")},
                  {"NORMAL", bent.floats({0, 0, 1, 0, kNan, 1, 0, 0, 1}, "VEC3")}}}});
    CHECK(faultOf(bent.gltf()) == "meshes[0].primitives[0] (\"shape\") normal 1 is not finite");
}

TEST_CASE("a hierarchy that is no forest is refused") {
    CHECK(faultWith("/nodes/1/children", {0}) == "nodes[0] is its own ancestor");
    CHECK(faultWith("/nodes/1/children", {1}) ==
          "nodes[1].children[0] is 1, which is already a child of node 0");
    CHECK(faultWith("/nodes/0/children", {0}) == "nodes[0] is its own ancestor");
    CHECK(faultWith("/nodes/0/children", {1, 1}) ==
          "nodes[0].children[1] is 1, which is already a child of node 0");
    CHECK(faultWith("/scenes/0/nodes", {0, 1}) ==
          "scenes[0].nodes[1] is node 1, which has a parent");
    CHECK(faultWith("/scenes/0/nodes", {0, 0}) == "scenes[0].nodes[1] is node 0, a second time");
}

TEST_CASE("a chain of a hundred thousand nodes is no trouble") {
    GltfBuilder builder = completeGltf();
    json& nodes = builder.document["nodes"];
    for (int i = 2; i < 100000; ++i) {
        nodes[std::size_t(i - 1)]["children"] = {i};
        nodes.push_back({{"name", ""}});
    }
    CHECK(faultOf(builder.gltf()) == "");
    nodes.back()["children"] = {0};
    CHECK(faultOf(builder.gltf()).find("is its own ancestor") != std::string::npos);
}

TEST_CASE("what is missing or not supported is named") {
    Quiet quiet;
    CHECK(faultWith("/asset/version", "1.0") == "is glTF version 1.0; version 2 is needed");
    CHECK(faultWith("/asset/version", "gone") == "asset has no \"version\"");
    CHECK(faultWith("/extensionsRequired", {"KHR_draco_mesh_compression"}) ==
          "requires the extension KHR_draco_mesh_compression, which is not supported");
    CHECK(faultWith("/extensionsRequired", {"KHR_materials_emissive_strength"}) == "");
    CHECK(faultWith("/extensionsUsed", {"KHR_draco_mesh_compression"}) == "");
    CHECK(faultWith("/meshes", json::array()) != "");
    CHECK(faultWith("/meshes/0/primitives", json::array()) == "meshes[0] has no primitives");
    CHECK(faultWith("/meshes/0/primitives/0/mode", 1) == "has no triangles");
    CHECK(faultWith("/meshes/0/primitives/0/mode", 7) != "");
    CHECK(faultWith("/meshes/0/primitives/0/attributes", json::object()) ==
          "meshes[0].primitives[0].attributes has no \"POSITION\"");
    CHECK(faultWith("/scenes/0/nodes", json::array()) ==
          "has no node in its scene that shows a mesh");
    CHECK(faultWith("/cameras/0", json::parse(R"({"type": "orthographic", "orthographic": {}})")) ==
          "has an orthographic camera only; a perspective one is needed");
    CHECK(faultWith("/cameras/1", json::parse(R"({"type": "orthographic", "orthographic": {}})")) ==
          "");
    CHECK(faultWith("/cameras/0/perspective/zfar", 0.1) ==
          "cameras[0].perspective has a zfar that is not beyond its znear");
    CHECK(faultWith("/cameras/0/perspective/yfov", 4) != "");
    CHECK(faultWith("/cameras/0/perspective/znear", 0) != "");
    CHECK(
        faultWith("/animations/0/samplers/0/interpolation", "CUBICSPLINE") ==
        "animations[0].samplers[0] is a cubic spline; only STEP and LINEAR animation is supported");
    CHECK(faultWith("/accessors/4/count", 2) ==
          "animations[0].samplers[0].output has 2 values for 3 times");
    CHECK(faultWith("/animations/0/samplers/0/input", 4) != "");
    CHECK(faultWith("/nodes/0/matrix", json::parse("[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]")) ==
          "animations[0].channels[0].target is a node with a matrix, which cannot be animated");
    CHECK(faultWith("/nodes/1/matrix", json::parse("[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]")) ==
          "nodes[1] has a matrix and also a translation, rotation or scale");
    CHECK(faultWith("/nodes/0/matrix", json::parse("[1,0,0,2,0,1,0,0,0,0,1,0,0,0,0,1]")) ==
          "nodes[0] has a matrix whose last row is not 0 0 0 1");
    CHECK(faultWith("/nodes/1/rotation", {0, 0, 0, 0}) ==
          "nodes[1] has a rotation that is not of unit length");
    CHECK(faultWith("/nodes/1/translation", {1, 2}) ==
          "nodes[1].translation must be 3 numbers, found 2");
    CHECK(faultWith("/materials/0/pbrMetallicRoughness/baseColorFactor/0", 1.5) ==
          "materials[0].pbrMetallicRoughness.baseColorFactor[0] is 1.5, which is not in [0, 1]");
    CHECK(faultWith("/materials/0/emissiveFactor/0", -1) != "");
}

TEST_CASE("keys of an animation that go back in time or are no numbers are named") {
    const auto faultOfTimes = [](std::vector<float> times, std::vector<float> turns) {
        GltfBuilder builder = completeGltf();
        const int input = builder.floats(times, "SCALAR"), output = builder.floats(turns, "VEC4");
        builder.document["animations"][0]["samplers"][1] = {{"input", input}, {"output", output}};
        return faultOf(builder.gltf());
    };
    CHECK(faultOfTimes({0, 1}, {0, 0, 0, 1, 0, 0, 0, 1}) == "");
    const std::string late =
        "animations[0].samplers[1] key 1 is not at a time >= 0 after the one before it";
    CHECK(faultOfTimes({1, 1}, {0, 0, 0, 1, 0, 0, 0, 1}) == late);
    CHECK(faultOfTimes({1, kNan}, {0, 0, 0, 1, 0, 0, 0, 1}) == late);
    CHECK(faultOfTimes({-1, 0}, {0, 0, 0, 1, 0, 0, 0, 1}) != "");
    CHECK(faultOfTimes({0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}) ==
          "animations[0].samplers[1] key 1 has no usable value");
    CHECK(faultOfTimes({0, 1}, {0, 0, 0, 1, 0, 0, 0, kInfinity}) != "");
}

TEST_CASE("a scene reads no file outside of its folder") {
    const TemporaryFolder folder;
    const GltfBuilder builder = completeGltf();
    fs::create_directories(folder / "inside/deeper");
    writeFileAtomically(folder / "secret.bin", builder.bytes);
    writeFileAtomically(folder / "inside/deeper/good.bin", builder.bytes);
    fs::create_symlink(folder / "secret.bin", folder / "inside/link.bin");
    fs::create_symlink(folder.path(), folder / "inside/up");
    fs::create_symlink("deeper/good.bin", folder / "inside/good link.bin");
    const fs::path path = folder / "inside/scene.gltf";
    const auto fault = [&](const std::string& uri) {
        writeFileAtomically(path, builder.gltf(uri));
        return messageOf<InputError>([&] { importGltf(path); });
    };
    CHECK(fault("deeper/good.bin") == "");
    CHECK(fault("./deeper/good.bin") == "");
    CHECK(fault("good%20link.bin") == "");
    const std::string start = path.string() + ": buffers[0] uri \"";
    CHECK(fault("../secret.bin") == start + "../secret.bin\" leaves the folder of the scene");
    CHECK(fault("%2e%2e/secret.bin") ==
          start + "%2e%2e/secret.bin\" leaves the folder of the scene");
    CHECK(fault("deeper/../../secret.bin") ==
          start + "deeper/../../secret.bin\" leaves the folder of the scene");
    const std::string absolute = (folder / "secret.bin").string();
    CHECK(fault(absolute) ==
          start + absolute + "\" is an absolute path; only files beside the scene are read");
    CHECK(fault("link.bin") ==
          start + "link.bin\" leaves the folder of the scene by a symbolic link");
    CHECK(fault("up/secret.bin") ==
          start + "up/secret.bin\" leaves the folder of the scene by a symbolic link");
    for (const char* scheme : {"http:", "https:", "file:", "FTP:"}) {
        const std::string uri = std::string(scheme) + "//host/a.bin";
        CHECK(fault(uri) == start + uri + "\" has the scheme " + scheme +
                                " but only files beside the scene are read");
    }
    CHECK(fault("none.bin").find("\"none.bin\" cannot be had: ") != std::string::npos);
    CHECK(fault("none.bin").find("there is no such file") != std::string::npos);
    CHECK(fault("deeper").find("is a folder") != std::string::npos);
    CHECK(fault("a%zz").find("hexadecimal") != std::string::npos);
    CHECK(fault("a%00b").find("does not name a file") != std::string::npos);
    CHECK(fault("") != "");
    CHECK(fault("data:text/plain,hello").find("not in base64") != std::string::npos);
    CHECK(fault("data:application/octet-stream;base64,AB*D").find("damaged") != std::string::npos);
    CHECK(fault("data:application/octet-stream;base64,AAAA").find("but 3 are there") !=
          std::string::npos);
    CHECK(faultWith("/images/0/uri", "http://host/a.png").starts_with("images[0] uri"));
    CHECK(faultWith("/images/0/uri", "../a.png").starts_with("images[0] uri"));
}

TEST_CASE("a buffer without a place is refused") {
    const GltfBuilder builder = completeGltf();
    CHECK(faultOf(builder.document.dump()) ==
          "buffers[0] has no uri, and there is no binary chunk for it");
}

TEST_CASE("every part of a file replaced by nonsense gives an error or a scene, nothing else") {
    Quiet quiet;
    const json flat = completeGltf().document.flatten();
    int refused = 0;
    for (const auto& [pointer, value] : flat.items()) {
        for (const json& nonsense : {json(nullptr), json(true), json(-3), json(1e30), json("x"),
                                     json::array(), json::object(), json::array({nullptr})}) {
            CAPTURE(pointer);
            refused += faultWith(pointer, nonsense) != "";
        }
        // And all that contains it.
        json::json_pointer parent = json::json_pointer(pointer).parent_pointer();
        for (; !parent.empty(); parent.pop_back()) {
            CAPTURE(parent.to_string());
            refused += faultWith(parent.to_string(), nullptr) != "";
            refused += faultWith(parent.to_string(), json::array({1})) != "";
        }
    }
    CHECK(refused > 500);
}

TEST_CASE("a binary glTF cut off anywhere, or with bytes changed, is imported or refused") {
    Quiet quiet;
    const std::string whole = completeGltf().glb();
    REQUIRE(faultOf(whole, "a.glb") == "");
    for (std::size_t i = 0; i < 50; ++i) {
        CAPTURE(i);
        CHECK(faultOf(whole.substr(0, whole.size() * i / 50), "a.glb") != "");
    }
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
        std::string changed = whole;
        for (int flips = 1 + i % 3; flips > 0; --flips) {
            changed[random() % changed.size()] ^= char(1u << (random() % 8));
        }
        refused += faultOf(changed, "a.glb") != "";
    }
    CHECK(refused > 100);
    CHECK(refused < 600);
}
