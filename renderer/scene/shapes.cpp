// SPDX-License-Identifier: MIT
#include "renderer/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace afterglow {

namespace {

constexpr double kPi = std::numbers::pi;

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    // The poles of a sphere are points up to rounding; a square micrometre is no surface of ours.
    if (glm::length(glm::cross(q - p, r - p)) > 1e-12) {
        mesh.triangles.push_back({a, b, c});
    }
}

} // namespace

void addQuad(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const auto first = std::uint32_t(mesh.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(c - a, d - b));
    for (const glm::vec3 corner : {a, b, c, d}) {
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
    }
    addTriangle(mesh, first, first + 1, first + 2);
    addTriangle(mesh, first, first + 2, first + 3);
}

void addQuadFacing(Mesh& mesh, glm::vec3 front, glm::vec3 a, glm::vec3 b, glm::vec3 c,
                   glm::vec3 d) {
    if (glm::dot(glm::cross(c - a, d - b), front) >= 0.0f) {
        addQuad(mesh, a, b, c, d);
    } else {
        addQuad(mesh, d, c, b, a);
    }
}

void addBox(Mesh& mesh, glm::vec3 low, glm::vec3 high, Facing facing) {
    for (int axis = 0; axis < 3; ++axis) {
        const int s = (axis + 1) % 3, t = (axis + 2) % 3;
        for (const bool top : {false, true}) {
            glm::vec3 corners[4];
            for (int i = 0; i < 4; ++i) {
                corners[i][axis] = top ? high[axis] : low[axis];
                corners[i][s] = i == 1 || i == 2 ? high[s] : low[s];
                corners[i][t] = i >= 2 ? high[t] : low[t];
            }
            glm::vec3 front(0.0f);
            front[axis] = top == (facing == Facing::Outward) ? 1.0f : -1.0f;
            addQuadFacing(mesh, front, corners[0], corners[1], corners[2], corners[3]);
        }
    }
}

void addSurface(Mesh& mesh, const Surface& surface, Grid grid) {
    const auto first = std::uint32_t(mesh.positions.size());
    const int columns = grid.closedU ? grid.u : grid.u + 1;
    const int rows = grid.closedV ? grid.v : grid.v + 1;
    constexpr double kStep = 1e-5;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double u = double(i) / grid.u, v = double(j) / grid.v;
            mesh.positions.emplace_back(surface(u, v));
            // At the edges, and at poles where one direction has no length, look a little inside.
            const double nu = grid.closedU ? u : std::clamp(u, 2 * kStep, 1.0 - 2 * kStep);
            const double nv = grid.closedV ? v : std::clamp(v, 2 * kStep, 1.0 - 2 * kStep);
            const glm::dvec3 du = surface(nu + kStep, nv) - surface(nu - kStep, nv);
            const glm::dvec3 dv = surface(nu, nv + kStep) - surface(nu, nv - kStep);
            mesh.normals.emplace_back(glm::normalize(glm::cross(du, dv)));
        }
    }
    for (int j = 0; j < grid.v; ++j) {
        for (int i = 0; i < grid.u; ++i) {
            const auto at = [&](int x, int y) {
                return first + std::uint32_t((y % rows) * columns + x % columns);
            };
            addTriangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            addTriangle(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
}

void addSphere(Mesh& mesh, glm::vec3 center, float radius, int segments) {
    const glm::dvec3 c = center;
    const auto surface = [=](double u, double v) {
        const double turn = 2 * kPi * u, height = kPi * (v - 0.5);
        return c + double(radius) * glm::dvec3(std::sin(turn) * std::cos(height), std::sin(height),
                                               std::cos(turn) * std::cos(height));
    };
    addSurface(mesh, surface, {.u = segments, .v = segments / 2, .closedU = true});
}

void addTorus(Mesh& mesh, glm::vec3 center, float ring, float tube, int segments, int sides) {
    const glm::dvec3 c = center;
    const auto surface = [=](double u, double v) {
        const double turn = 2 * kPi * u, around = 2 * kPi * v;
        const double radius = ring + tube * std::cos(around);
        return c + glm::dvec3(radius * std::sin(turn), tube * std::sin(around),
                              radius * std::cos(turn));
    };
    addSurface(mesh, surface, {.u = segments, .v = sides, .closedU = true, .closedV = true});
}

void addTorusKnot(Mesh& mesh, glm::vec3 center, float size, float tube, int p, int q, int segments,
                  int sides) {
    const glm::dvec3 c = center;
    const auto line = [=](double u) {
        const double turn = 2 * kPi * p * u, around = 2 * kPi * q * u;
        const double radius = size * (1.0 + 0.45 * std::cos(around));
        return glm::dvec3(radius * std::sin(turn), radius * std::cos(turn),
                          -0.45 * size * std::sin(around));
    };
    const auto surface = [=](double u, double v) {
        // A frame that turns with the knot: the tangent and the direction away from the axis.
        const glm::dvec3 here = line(u);
        const glm::dvec3 tangent = glm::normalize(line(u + 1e-4) - line(u - 1e-4));
        const glm::dvec3 side = glm::normalize(glm::cross(tangent, here));
        const glm::dvec3 out = glm::cross(side, tangent);
        const double around = 2 * kPi * v;
        return c + here + double(tube) * (std::cos(around) * out - std::sin(around) * side);
    };
    addSurface(mesh, surface, {.u = segments, .v = sides, .closedU = true, .closedV = true});
}

} // namespace afterglow
