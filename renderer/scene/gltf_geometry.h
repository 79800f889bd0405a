// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace afterglow {

/// An array of numbers in a buffer. Whoever makes one has made sure that it lies in the buffer.
struct GltfArray {
    const unsigned char* data = nullptr;
    std::size_t stride = 0; ///< bytes from element to element
    std::size_t count = 0;
    int componentType = 0; ///< 5120..5126, glTF 2.0, section 3.6.2.2
    int components = 0;    ///< 1 to 4

    /// Returns the components as numbers; whole ones as the fractions that they stand for (section
    /// 3.11).
    glm::vec4 fraction(std::size_t i) const;
    /// Returns the first component, a whole number without sign.
    std::uint32_t whole(std::size_t i) const;
};

/// One primitive of a mesh, as it is in the file. POSITION, NORMAL and TEXCOORD_0 are of one
/// length.
struct GltfPrimitive {
    int mode = 4; ///< 4: triangles, 5: a strip, 6: a fan
    GltfArray positions;
    std::optional<GltfArray> normals, texCoords, indices;
};

/// Makes meshes of primitives. Throws GltfFault for an index out of range and for a number that is
/// not finite.
class GltfGeometry {
public:
    /// Makes a mesh with the vertices that its triangles use, and no others; with flat normals if
    /// it had none; and without the triangles that have no area: all of them may be gone.
    Mesh mesh(const GltfPrimitive& primitive);

    std::size_t withoutArea() const { return withoutArea_; } ///< triangles left out so far

private:
    std::vector<glm::uvec3> triangles(const GltfPrimitive& primitive) const;
    std::uint32_t vertex(Mesh& mesh, const GltfPrimitive& primitive, std::uint32_t source);

    std::size_t withoutArea_ = 0;
    std::size_t corners_ = 0;            // of all primitives so far
    std::vector<std::uint32_t> placeOf_; // of a source vertex in the mesh being made, or kNone
    std::vector<std::uint32_t> placed_;  // the source vertices that have a place
};

} // namespace afterglow
