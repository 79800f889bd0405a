// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <utility>

namespace afterglow {

/// Puts a scene together from parts. Used by the scenes that are made in code.
class SceneBuilder {
public:
    explicit SceneBuilder(std::string name) { scene_.name = std::move(name); }

    /// Adds a rough dielectric.
    std::uint32_t material(std::string name, glm::vec3 baseColor);
    /// Adds a material of this roughness, and in part or all of metal.
    std::uint32_t material(std::string name, glm::vec3 baseColor, float roughness,
                           float metallic = 0.0f);
    /// Adds a material that only shines, from its front.
    std::uint32_t glow(std::string name, glm::vec3 radiance);
    std::uint32_t node(std::string name, glm::vec3 translation = glm::vec3(0.0f), int parent = -1);
    void add(Mesh mesh, std::uint32_t material, std::uint32_t node);
    /// Adds a node of this name with one shining mesh: one light of this name.
    void light(const std::string& name, Mesh mesh, glm::vec3 radiance);
    void camera(const Camera& camera);
    void track(Track track) { scene_.tracks.push_back(std::move(track)); }
    void ambient(glm::vec3 radiance) { scene_.ambient = radiance; }
    void makeDoubleSided(std::uint32_t material) { scene_.materials[material].doubleSided = true; }

    Scene finish() &&;

private:
    Scene scene_;
};

} // namespace afterglow
