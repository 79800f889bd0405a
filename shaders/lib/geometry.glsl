// SPDX-License-Identifier: MIT
// The scene's triangles, now and one frame ago. Layouts: shared/scene.h.

#include "lib/fetch.glsl"
#include "shared/scene.h"

Uint4Buffer(vertices);
Uint4Buffer(triangles); // three vertex indices, 0
Uint4Buffer(instances);

struct Affine {
    vec4 rows[3];
};

struct Triangle {
    vec3 corner;
    vec3 edge1, edge2;
};

Affine instanceTransform(uint instance, bool previous) {
    int first = int(instance * kTexelsPerInstance) + (previous ? 3 : 0);
    return Affine(vec4[3](uintBitsToFloat(fetchBuffer(instances, first)),
                          uintBitsToFloat(fetchBuffer(instances, first + 1)),
                          uintBitsToFloat(fetchBuffer(instances, first + 2))));
}

// x: first triangle, y: material, z: light slot.
uvec4 instanceLinks(uint instance) {
    return fetchBuffer(instances, int(instance * kTexelsPerInstance) + 6);
}

// `precise`, here and in what follows from it: a point that does not move has the same position in
// both frames to the bit, although a compiler sees two computations, and may otherwise contract
// products and sums in one of them alone. Sums are written out, since that holds for operators and
// not for dot().
float transformCoordinate(vec4 row, vec3 p) {
    precise float sum = row.w + row.z * p.z + row.y * p.y + row.x * p.x;
    return sum;
}

vec3 transformPoint(Affine m, vec3 p) {
    return vec3(transformCoordinate(m.rows[0], p), transformCoordinate(m.rows[1], p),
                transformCoordinate(m.rows[2], p));
}

float determinant3(Affine m) {
    return dot(m.rows[0].xyz, cross(m.rows[1].xyz, m.rows[2].xyz));
}

// By the cofactors, so that mirrored and squeezed instances keep their normals outside.
vec3 transformNormal(Affine m, vec3 n) {
    vec3 c = vec3(dot(cross(m.rows[1].xyz, m.rows[2].xyz), n),
                  dot(cross(m.rows[2].xyz, m.rows[0].xyz), n),
                  dot(cross(m.rows[0].xyz, m.rows[1].xyz), n));
    return normalize(determinant3(m) < 0.0 ? -c : c);
}

uvec3 triangleVertices(uint instance, uint triangle) {
    return fetchBuffer(triangles, int(instanceLinks(instance).x + triangle)).xyz;
}

vec3 vertexPosition(uint vertex) {
    return uintBitsToFloat(fetchBuffer(vertices, int(vertex * kTexelsPerVertex))).xyz;
}

vec3 vertexNormal(uint vertex) {
    return uintBitsToFloat(fetchBuffer(vertices, int(vertex * kTexelsPerVertex) + 1)).xyz;
}

Triangle worldTriangle(uvec3 vertex, Affine m) {
    vec3 a = transformPoint(m, vertexPosition(vertex.x));
    vec3 b = transformPoint(m, vertexPosition(vertex.y));
    vec3 c = transformPoint(m, vertexPosition(vertex.z));
    precise vec3 edge1 = b - a, edge2 = c - a;
    return Triangle(a, edge1, edge2);
}

// The point of a visibility sample.
vec3 pointOn(Triangle t, vec2 barycentrics) {
    precise vec3 point = t.corner + barycentrics.x * t.edge1 + barycentrics.y * t.edge2;
    return point;
}

// The interpolated normal of a visibility sample, on the outer side of its triangle.
vec3 shadingNormal(uvec3 vertex, Affine m, vec2 barycentrics) {
    return transformNormal(m, (1.0 - barycentrics.x - barycentrics.y) * vertexNormal(vertex.x) +
                                  barycentrics.x * vertexNormal(vertex.y) +
                                  barycentrics.y * vertexNormal(vertex.z));
}
