// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace afterglow {

/// Writes small glTF files, right ones and, after changes to `document`, wrong ones.
struct GltfBuilder {
    nlohmann::json document;
    std::string bytes; ///< of buffer 0

    GltfBuilder();

    /// Appends numbers to the buffer, with a view and an accessor; returns the accessor's index.
    int floats(const std::vector<float>& values, const std::string& type);
    int indices8(const std::vector<std::uint8_t>& values);
    int indices16(const std::vector<std::uint16_t>& values);
    int indices32(const std::vector<std::uint32_t>& values);

    /// Adds a mesh of one primitive, and a node with it in the scene. Returns the index of the
    /// node.
    int shape(const nlohmann::json& primitive);

    std::string gltf() const; ///< with the buffer as a data URI
    std::string gltf(const std::string& uri) const;
    std::string glb() const;

private:
    int accessor(const void* data, std::size_t size, int component, std::size_t count,
                 const std::string& type);
};

/// Builds two triangles of different size with normals and indices, a shining material, a camera, a
/// child node, and an animation of translation and rotation: one of everything that is imported.
GltfBuilder completeGltf();

} // namespace afterglow
