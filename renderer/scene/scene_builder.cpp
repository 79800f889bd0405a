// SPDX-License-Identifier: MIT
#include "renderer/scene/scene_builder.h"

namespace afterglow {

std::uint32_t SceneBuilder::material(std::string name, glm::vec3 baseColor) {
    Material material;
    material.name = std::move(name);
    material.baseColor = baseColor;
    scene_.materials.push_back(std::move(material));
    return std::uint32_t(scene_.materials.size() - 1);
}

std::uint32_t SceneBuilder::material(std::string name, glm::vec3 baseColor, float roughness,
                                     float metallic) {
    const std::uint32_t index = material(std::move(name), baseColor);
    scene_.materials[index].roughness = roughness;
    scene_.materials[index].metallic = metallic;
    return index;
}

std::uint32_t SceneBuilder::glow(std::string name, glm::vec3 radiance) {
    const std::uint32_t index = material(std::move(name), glm::vec3(0.0f));
    scene_.materials[index].emission = radiance;
    return index;
}

std::uint32_t SceneBuilder::node(std::string name, glm::vec3 translation, int parent) {
    Node node;
    node.name = std::move(name);
    node.translation = translation;
    node.parent = parent;
    scene_.nodes.push_back(std::move(node));
    return std::uint32_t(scene_.nodes.size() - 1);
}

void SceneBuilder::add(Mesh mesh, std::uint32_t material, std::uint32_t node) {
    if (mesh.name.empty()) {
        mesh.name = scene_.materials[material].name;
    }
    scene_.instances.push_back({std::uint32_t(scene_.meshes.size()), material, node});
    scene_.meshes.push_back(std::move(mesh));
}

void SceneBuilder::light(const std::string& name, Mesh mesh, glm::vec3 radiance) {
    add(std::move(mesh), glow(name, radiance), node(name));
}

void SceneBuilder::camera(const Camera& camera) {
    SceneCamera entry;
    entry.name = "camera";
    entry.node = node("camera", camera.position);
    entry.lens = camera.lens;
    scene_.nodes.back().rotation = camera.orientation;
    scene_.cameras.push_back(std::move(entry));
}

Scene SceneBuilder::finish() && {
    completeScene(scene_);
    return std::move(scene_);
}

} // namespace afterglow
