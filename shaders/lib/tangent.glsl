// SPDX-License-Identifier: MIT
// A tangent that turns with the instance, so that a reused random number means the same direction
// on a body that has moved.

#include "lib/geometry.glsl"

// Where the tangent jumps: between no normals that are common, since rounding would then turn it
// over from one frame to the next on a body that moves.
const float kBasisTurns = -0.7;

// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", in object space.
vec3 tangentOf(vec3 normal, uint instance) {
    Affine m = instanceTransform(instance, false);
    vec3 n =
        normalize(normal.x * m.rows[0].xyz + normal.y * m.rows[1].xyz + normal.z * m.rows[2].xyz);
    float side = n.z >= kBasisTurns ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    vec3 t = vec3(1.0 + side * n.x * n.x * a, side * n.x * n.y * a, -side * n.x);
    vec3 world = vec3(dot(m.rows[0].xyz, t), dot(m.rows[1].xyz, t), dot(m.rows[2].xyz, t));
    return normalize(world - dot(world, normal) * normal);
}
