// SPDX-License-Identifier: MIT
#pragma once

// Only gltf_check*.cpp include this.

#include "renderer/scene/gltf_check.h"
#include "renderer/scene/gltf_json.h"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace afterglow {

/// Checks a document against glTF 2.0, section 5 and the rules of section 3, and writes anew what
/// has passed. The parts are checked in such an order that what is referred to is known.
class GltfChecker {
public:
    /// All three must outlive the checker; `binary` is the binary chunk of a .glb.
    GltfChecker(const std::filesystem::path& path, const nlohmann::json& document,
                const std::optional<std::string>& binary)
        : path_(path), root_(document, ""), binary_(binary) {}

    /// Checks the whole document; to be called once. Throws GltfFault.
    GltfDocument check();

private:
    /// Section 3.6.2.2.
    enum Component { I8 = 5120, U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };

    struct View {
        std::uint64_t length = 0, stride = 0;
    };

    struct Accessor {
        std::size_t components = 0; ///< 0: a matrix, which the importer never reads
        int component = 0;
        bool normalized = false, hasView = false, sparse = false;
        std::uint64_t count = 0;
    };

    void checkAsset();

    // gltf_check_data.cpp
    void checkBuffers();
    std::vector<unsigned char> bufferBytes(const GltfView& buffer, std::size_t index,
                                           std::size_t length) const;
    void checkViews();
    void checkAccessors();
    const Accessor& accessorFor(const GltfView& reference, std::size_t components,
                                std::initializer_list<int> types) const;
    static std::size_t bytesOf(std::uint64_t component);
    void checkTextures();
    void checkMaterials();

    // gltf_check_structure.cpp
    void checkCameras();
    void checkMeshes();
    nlohmann::json checkPrimitive(const GltfView& primitive);
    void checkNodes();
    void checkScenes();
    void checkAnimations();
    void checkChannel(const GltfView& channel, const std::vector<GltfView>& samplers);

    const std::filesystem::path& path_;
    GltfView root_;
    const std::optional<std::string>& binary_;
    GltfDocument result_;
    nlohmann::json out_ = nlohmann::json::object();
    std::vector<std::uint64_t> bufferLengths_;
    std::vector<View> views_;
    std::vector<Accessor> accessors_;
    std::vector<int> parents_;
    std::vector<bool> hasMatrix_;
};

} // namespace afterglow
