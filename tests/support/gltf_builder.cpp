// SPDX-License-Identifier: MIT
#include "tests/support/gltf_builder.h"

#include <cstring>

namespace afterglow {

using nlohmann::json;

namespace {

std::string base64(const std::string& bytes) {
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
        }
    }
    return text;
}

std::string word(std::uint32_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i) {
        text += char(value >> (8 * i) & 255);
    }
    return text;
}

} // namespace

GltfBuilder::GltfBuilder() {
    document = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
                               "buffers": [{"byteLength": 0}]})");
}

int GltfBuilder::accessor(const void* data, std::size_t size, int component, std::size_t count,
                          const std::string& type) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json& views = document["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    bytes.append(static_cast<const char*>(data), size);
    document["buffers"][0]["byteLength"] = bytes.size();
    json& accessors = document["accessors"];
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}});
    return int(accessors.size()) - 1;
}

int GltfBuilder::floats(const std::vector<float>& values, const std::string& type) {
    const std::size_t components = type == "SCALAR" ? 1 : std::size_t(type[3] - '0');
    return accessor(values.data(), values.size() * 4, 5126, values.size() / components, type);
}

int GltfBuilder::indices8(const std::vector<std::uint8_t>& values) {
    return accessor(values.data(), values.size(), 5121, values.size(), "SCALAR");
}

int GltfBuilder::indices16(const std::vector<std::uint16_t>& values) {
    return accessor(values.data(), values.size() * 2, 5123, values.size(), "SCALAR");
}

int GltfBuilder::indices32(const std::vector<std::uint32_t>& values) {
    return accessor(values.data(), values.size() * 4, 5125, values.size(), "SCALAR");
}

int GltfBuilder::shape(const json& primitive) {
    document["meshes"].push_back({{"name", "shape"}, {"primitives", json::array({primitive})}});
    document["nodes"].push_back({{"mesh", document["meshes"].size() - 1}});
    const int node = int(document["nodes"].size()) - 1;
    document["scenes"][0]["nodes"].push_back(node);
    return node;
}

std::string GltfBuilder::gltf() const {
    return gltf("data:application/octet-stream;base64," + base64(bytes));
}

std::string GltfBuilder::gltf(const std::string& uri) const {
    json copy = document;
    json& buffers = copy["buffers"];
    if (buffers.is_array() && !buffers.empty() && buffers[0].is_object()) {
        buffers[0]["uri"] = uri; // unless a test has broken just that
    }
    return copy.dump();
}

std::string GltfBuilder::glb() const {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string data = bytes;
    data.resize((data.size() + 3) / 4 * 4);
    const std::string chunks = word(std::uint32_t(text.size())) + "JSON" + text +
                               word(std::uint32_t(data.size())) + std::string("BIN\0", 4) + data;
    return "glTF" + word(2) + word(std::uint32_t(12 + chunks.size())) + chunks;
}

GltfBuilder completeGltf() {
    GltfBuilder builder;
    const int positions =
        builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 4, 0, 0, 2, 2, 0}, "VEC3");
    const int normals =
        builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int indices = builder.indices16({0, 1, 2, 3, 4, 5});
    const int times = builder.floats({0, 1, 2}, "SCALAR");
    const int places = builder.floats({0, 0, 0, 2, 0, 0, 2, 4, 0}, "VEC3");
    const int turns =
        builder.floats({0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f, 0, 1, 0, 0}, "VEC4");
    builder.shape({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                   {"indices", indices},
                   {"material", 0}});
    json& document = builder.document;
    document["materials"] = json::parse(R"([{
        "name": "glow", "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0.4,
                                 "roughnessFactor": 0.5, "baseColorTexture": {"index": 0}},
        "emissiveFactor": [0.5, 0.25, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}}])");
    document["textures"] = json::parse(R"([{"source": 0}])");
    document["images"] = json::parse(R"([{"uri": "wood.png"}])");
    document["cameras"] = json::parse(
        R"([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.25, "zfar": 90}}])");
    document["nodes"][0]["name"] = "parent";
    document["nodes"][0]["children"] = {1};
    document["nodes"].push_back({{"name", "eye"}, {"camera", 0}, {"translation", {0, 0, 5}}});
    document["animations"].push_back(
        {{"samplers",
          {{{"input", times}, {"output", places}},
           {{"input", times}, {"output", turns}, {"interpolation", "STEP"}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}});
    return builder;
}

} // namespace afterglow
