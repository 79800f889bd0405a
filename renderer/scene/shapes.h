// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <functional>

#include <glm/glm.hpp>

namespace afterglow {

// Each function adds triangles to a mesh, which may already have some. Meters. Flat faces have
// vertices of their own, curved ones smooth normals. Triangles without area are left out.

/// Adds the flat quadrilateral a b c d, counter-clockwise seen from its front.
void addQuad(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);

/// Adds the same four corners, turned so that the front faces along `front`.
void addQuadFacing(Mesh& mesh, glm::vec3 front, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);

enum class Facing { Outward, Inward };

/// Adds a box along the axes: a solid seen from outside, or a room seen from inside.
void addBox(Mesh& mesh, glm::vec3 low, glm::vec3 high, Facing facing = Facing::Outward);

/// A point for u and v in [0, 1]. Its front is on the side of dP/du x dP/dv.
using Surface = std::function<glm::dvec3(double u, double v)>;

struct Grid {
    int u = 1, v = 1;                      ///< cells in each direction
    bool closedU = false, closedV = false; ///< whether 1 is the same place as 0
};

void addSurface(Mesh& mesh, const Surface& surface, Grid grid);

/// Adds a sphere of `segments` cells around, half as many from pole to pole.
void addSphere(Mesh& mesh, glm::vec3 center, float radius, int segments);

/// Adds a ring around a vertical axis: `ring` is the radius of its middle line, `tube` its
/// thickness.
void addTorus(Mesh& mesh, glm::vec3 center, float ring, float tube, int segments, int sides);

/// Adds a (p, q) torus knot around an axis along Z: it stands upright. `size` is the radius of its
/// torus.
void addTorusKnot(Mesh& mesh, glm::vec3 center, float size, float tube, int p, int q, int segments,
                  int sides);

} // namespace afterglow
