// SPDX-License-Identifier: MIT
#include "renderer/scene/gltf_geometry.h"

#include "renderer/scene/gltf_json.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace afterglow {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
/// More is no scene that this renderer could show, but a file that names its data again and again.
constexpr std::size_t kMostCorners = std::size_t(3) << 25;

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

template <class Vec>
void requireFinite(const Vec& value, const char* what, std::uint32_t i) {
    if (glm::any(glm::isnan(value)) || glm::any(glm::isinf(value))) {
        throw GltfFault(std::string(what) + " " + std::to_string(i) + " is not finite");
    }
}

/// Returns the direction of a triangle's front, as long as twice its area.
glm::dvec3 areaVector(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

} // namespace

glm::vec4 GltfArray::fraction(std::size_t i) const {
    const unsigned char* element = data + i * stride;
    glm::vec4 value(0.0f);
    for (int c = 0; c < components; ++c) {
        switch (componentType) {
        case 5120: value[c] = std::max(load<std::int8_t>(element + c) / 127.0f, -1.0f); break;
        case 5121: value[c] = load<std::uint8_t>(element + c) / 255.0f; break;
        case 5122:
            value[c] = std::max(load<std::int16_t>(element + 2 * c) / 32767.0f, -1.0f);
            break;
        case 5123: value[c] = load<std::uint16_t>(element + 2 * c) / 65535.0f; break;
        default: value[c] = load<float>(element + 4 * c); break;
        }
    }
    return value;
}

std::uint32_t GltfArray::whole(std::size_t i) const {
    const unsigned char* element = data + i * stride;
    switch (componentType) {
    case 5121: return load<std::uint8_t>(element);
    case 5123: return load<std::uint16_t>(element);
    default: return load<std::uint32_t>(element);
    }
}

std::vector<glm::uvec3> GltfGeometry::triangles(const GltfPrimitive& primitive) const {
    const std::size_t vertices = primitive.positions.count;
    const std::size_t corners = primitive.indices ? primitive.indices->count : vertices;
    const auto corner = [&](std::size_t i) {
        const std::uint32_t index =
            primitive.indices ? primitive.indices->whole(i) : std::uint32_t(i);
        if (index >= vertices) {
            throw GltfFault("index " + std::to_string(i) + " is " + std::to_string(index) +
                            ", but there are " + std::to_string(vertices) + " vertices");
        }
        return index;
    };
    std::vector<glm::uvec3> result;
    if (primitive.mode == 4) {
        for (std::size_t i = 0; i + 2 < corners; i += 3) {
            result.push_back({corner(i), corner(i + 1), corner(i + 2)});
        }
        return result;
    }
    // Section 3.7.2.1: strips turn every second triangle round; a fan's first corner is its last.
    for (std::size_t i = 0; i + 2 < corners; ++i) {
        result.push_back(primitive.mode == 5
                             ? glm::uvec3(corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2))
                             : glm::uvec3(corner(i + 1), corner(i + 2), corner(0)));
    }
    return result;
}

std::uint32_t GltfGeometry::vertex(Mesh& mesh, const GltfPrimitive& primitive,
                                   std::uint32_t source) {
    if (placeOf_[source] != kNone) {
        return placeOf_[source];
    }
    const auto place = std::uint32_t(mesh.positions.size());
    const glm::vec3 position = primitive.positions.fraction(source);
    requireFinite(position, "vertex", source);
    mesh.positions.push_back(position);
    if (primitive.normals) {
        const glm::vec3 normal = primitive.normals->fraction(source);
        requireFinite(normal, "normal", source);
        const double length = glm::length(glm::dvec3(normal));
        mesh.normals.push_back(length > 0.0 ? glm::vec3(glm::dvec3(normal) / length)
                                            : glm::vec3(0));
    }
    if (primitive.texCoords) {
        const glm::vec2 texCoord = primitive.texCoords->fraction(source);
        requireFinite(texCoord, "texture coordinate", source);
        mesh.texCoords.push_back(texCoord);
    }
    placeOf_[source] = place;
    placed_.push_back(source);
    return place;
}

Mesh GltfGeometry::mesh(const GltfPrimitive& primitive) {
    corners_ += primitive.indices ? primitive.indices->count : primitive.positions.count;
    if (corners_ > kMostCorners) {
        throw GltfFault("takes the scene beyond " + std::to_string(kMostCorners / 3) +
                        " triangles");
    }
    const auto forget = [&] {
        for (const std::uint32_t source : placed_) {
            placeOf_[source] = kNone;
        }
        placed_.clear();
    };
    // Grows to the largest array of vertices, once; what a primitive has used it clears by itself.
    if (placeOf_.size() < primitive.positions.count) {
        placeOf_.resize(primitive.positions.count, kNone);
    }
    forget();
    Mesh result;
    for (const glm::uvec3& source : triangles(primitive)) {
        if (!primitive.normals) {
            forget(); // flat: every triangle has vertices of its own
        }
        // Looked at before they get a place, so that a vertex of nothing but such is not kept.
        glm::vec3 corners[3];
        for (int c = 0; c < 3; ++c) {
            corners[c] = primitive.positions.fraction(source[c]);
            requireFinite(corners[c], "vertex", source[c]);
        }
        const glm::dvec3 area = areaVector(corners[0], corners[1], corners[2]);
        if (glm::length(area) == 0.0) {
            ++withoutArea_;
            continue;
        }
        glm::uvec3 triangle;
        for (int c = 0; c < 3; ++c) {
            triangle[c] = vertex(result, primitive, source[c]);
        }
        const glm::vec3 face(glm::normalize(area));
        if (!primitive.normals) {
            result.normals.resize(result.positions.size(), face);
        }
        for (int c = 0; c < 3; ++c) {
            // A normal without length says nothing; the face does.
            if (result.normals[triangle[c]] == glm::vec3(0.0f)) {
                result.normals[triangle[c]] = face;
            }
        }
        result.triangles.push_back(triangle);
    }
    return result;
}

} // namespace afterglow
