// SPDX-License-Identifier: MIT
// What a glTF document is made of: buffers, views, accessors, textures and materials. Whether the
// bytes are there is checked here; the values in them are not looked at.

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/scene/gltf_checker.h"
#include "renderer/scene/gltf_container.h"

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace afterglow {

using nlohmann::json;

std::size_t GltfChecker::bytesOf(std::uint64_t component) {
    return component == I8 || component == U8 ? 1 : component == I16 || component == U16 ? 2 : 4;
}

std::vector<unsigned char> GltfChecker::bufferBytes(const GltfView& buffer, std::size_t index,
                                                    std::size_t length) const {
    std::vector<unsigned char> bytes;
    if (buffer.has("uri")) {
        const std::string uri = buffer.at("uri").text();
        const std::string named = "uri \"" + forMessage(uri.substr(0, 80)) + "\" ";
        try {
            if (uri.starts_with("data:")) {
                bytes = decodeDataUri(uri);
            } else {
                const std::string file = readFile(resolveGltfUri(path_, uri));
                bytes.assign(file.begin(), file.end());
            }
        } catch (const std::invalid_argument& cause) {
            buffer.fault(named + cause.what());
        } catch (const InputError& cause) {
            buffer.fault(named + "cannot be had: " + cause.what());
        }
    } else if (index == 0 && binary_) {
        bytes.assign(binary_->begin(), binary_->end());
    } else {
        buffer.fault("has no uri, and there is no binary chunk for it");
    }
    if (bytes.size() < length) {
        buffer.fault("is " + std::to_string(length) + " bytes long, but " +
                     std::to_string(bytes.size()) + " are there");
    }
    bytes.resize(length);
    return bytes;
}

void GltfChecker::checkBuffers() {
    json& out = out_["buffers"] = json::array();
    for (const GltfView& buffer : root_.objects("buffers")) {
        const std::uint64_t length = buffer.at("byteLength").whole(1);
        const std::size_t index = result_.buffers.size();
        result_.buffers.push_back(bufferBytes(buffer, index, length));
        bufferLengths_.push_back(length);
        out.push_back({{"byteLength", length}, {"uri", std::to_string(index)}});
    }
}

void GltfChecker::checkViews() {
    json& out = out_["bufferViews"] = json::array();
    for (const GltfView& view : root_.objects("bufferViews")) {
        const std::uint32_t buffer = view.at("buffer").index(bufferLengths_.size(), "buffers");
        const std::uint64_t offset = view.whole("byteOffset", 0);
        const std::uint64_t length = view.at("byteLength").whole(1);
        if (offset > bufferLengths_[buffer] || length > bufferLengths_[buffer] - offset) {
            view.fault("reaches beyond buffer " + std::to_string(buffer) + " of " +
                       std::to_string(bufferLengths_[buffer]) + " bytes");
        }
        const std::uint64_t stride = view.whole("byteStride", 0, 4, 252);
        if (stride % 4 != 0) {
            view.at("byteStride").fault("is not a multiple of 4");
        }
        views_.push_back({length, stride});
        json entry{{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
        if (stride > 0) {
            entry["byteStride"] = stride;
        }
        out.push_back(std::move(entry));
    }
}

void GltfChecker::checkAccessors() {
    json& out = out_["accessors"] = json::array();
    for (const GltfView& view : root_.objects("accessors")) {
        Accessor accessor;
        accessor.component = int(view.at("componentType").whole());
        if (!(accessor.component >= I8 && accessor.component <= F32) ||
            accessor.component == 5124) {
            view.at("componentType")
                .fault("is " + std::to_string(accessor.component) + ", which is no type of glTF 2");
        }
        const std::string type = view.at("type").text();
        if (type == "SCALAR") {
            accessor.components = 1;
        } else if (type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' &&
                   type[3] <= '4') {
            accessor.components = std::size_t(type[3] - '0');
        } else if (type != "MAT2" && type != "MAT3" && type != "MAT4") {
            view.at("type").fault("is \"" + forMessage(type) + "\", which is no type of glTF 2");
        }
        accessor.normalized = view.flag("normalized", false);
        accessor.count = view.at("count").whole(1);
        accessor.sparse = view.has("sparse");
        const std::uint64_t offset = view.whole("byteOffset", 0);
        json entry{{"componentType", accessor.component},
                   {"type", type},
                   {"normalized", accessor.normalized},
                   {"count", accessor.count},
                   {"byteOffset", offset}};
        if (const auto index = view.index("bufferView", views_.size(), "buffer views")) {
            const View& bytes = views_[*index];
            const std::uint64_t size = accessor.components * bytesOf(accessor.component);
            const std::uint64_t stride = bytes.stride > 0 ? bytes.stride : size;
            if (accessor.components > 0) {
                if (stride < size) {
                    view.fault("has elements of " + std::to_string(size) +
                               " bytes, a byteStride of " + std::to_string(stride) +
                               " between them");
                }
                if (offset > bytes.length || size > bytes.length - offset ||
                    (bytes.length - offset - size) / stride < accessor.count - 1) {
                    view.fault("reaches beyond buffer view " + std::to_string(*index) + " of " +
                               std::to_string(bytes.length) + " bytes");
                }
            }
            accessor.hasView = true;
            entry["bufferView"] = *index;
        }
        accessors_.push_back(accessor);
        out.push_back(std::move(entry));
    }
}

const GltfChecker::Accessor& GltfChecker::accessorFor(const GltfView& reference,
                                                      std::size_t components,
                                                      std::initializer_list<int> types) const {
    const std::uint32_t index = reference.index(accessors_.size(), "accessors");
    const Accessor& accessor = accessors_[index];
    const auto refuse = [&](const char* cause) {
        reference.fault("is accessor " + std::to_string(index) + ", which " + cause);
    };
    if (accessor.sparse) {
        refuse("is sparse; that is not supported");
    }
    if (!accessor.hasView) {
        refuse("has no buffer view");
    }
    if (accessor.components != components ||
        std::find(types.begin(), types.end(), accessor.component) == types.end()) {
        refuse("is not of a type that is allowed here");
    }
    // Whole numbers that stand for fractions must say so, and indices must not.
    if (accessor.component != F32 && (components > 1) != accessor.normalized) {
        refuse(components > 1 ? "holds whole numbers that are not normalized"
                              : "is normalized and cannot be used to count");
    }
    return accessor;
}

void GltfChecker::checkTextures() {
    std::vector<std::string> images;
    for (const GltfView& image : root_.objects("images")) {
        std::string name = image.text("name", "");
        if (image.has("uri")) {
            const std::string uri = image.at("uri").text();
            if (!uri.starts_with("data:")) {
                try {
                    resolveGltfUri(path_, uri);
                } catch (const std::invalid_argument& cause) {
                    image.fault("uri \"" + forMessage(uri) + "\" " + cause.what());
                }
                name = name.empty() ? uri : name;
            }
        } else {
            image.index("bufferView", views_.size(), "buffer views");
        }
        images.push_back(std::move(name));
    }
    for (const GltfView& texture : root_.objects("textures")) {
        std::string name = texture.text("name", "");
        if (const auto source = texture.index("source", images.size(), "images")) {
            name = name.empty() ? images[*source] : name;
        }
        result_.textures.push_back(std::move(name));
    }
}

void GltfChecker::checkMaterials() {
    json& out = out_["materials"] = json::array();
    for (const GltfView& material : root_.objects("materials")) {
        json entry{{"name", material.text("name", "")},
                   {"doubleSided", material.flag("doubleSided", false)}};
        json surface = json::object();
        if (const auto factors = material.object("pbrMetallicRoughness")) {
            if (const auto color = factors->numbers("baseColorFactor", 4, 0.0, 1.0)) {
                surface["baseColorFactor"] = *color;
            }
            surface["metallicFactor"] = factors->number("metallicFactor", 1.0, 0.0, 1.0);
            surface["roughnessFactor"] = factors->number("roughnessFactor", 1.0, 0.0, 1.0);
            if (const auto texture = factors->object("baseColorTexture")) {
                const std::uint32_t index =
                    texture->at("index").index(result_.textures.size(), "textures");
                surface["baseColorTexture"] = {{"index", index}};
            }
        }
        entry["pbrMetallicRoughness"] = std::move(surface);
        // The product of the two is a radiance; a million of each is enough for a sun.
        constexpr double kBrightest = 1e6;
        if (const auto factor = material.numbers("emissiveFactor", 3, 0.0, kBrightest)) {
            entry["emissiveFactor"] = *factor;
        }
        if (const auto extensions = material.object("extensions")) {
            if (const auto strength = extensions->object("KHR_materials_emissive_strength")) {
                entry["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
                    strength->number("emissiveStrength", 1.0, 0.0, kBrightest);
            }
        }
        out.push_back(std::move(entry));
    }
}

} // namespace afterglow
