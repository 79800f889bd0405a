// SPDX-License-Identifier: MIT
#include "renderer/scene/scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>

namespace afterglow {

namespace {

bool isLight(const Scene& scene, const Instance& instance) {
    const glm::vec3 emission = scene.materials[instance.material].emission;
    return emission.x > 0.0f || emission.y > 0.0f || emission.z > 0.0f;
}

std::string uniqueName(const std::string& wanted, std::set<std::string>& taken) {
    std::string name = wanted;
    for (int i = 2; !taken.insert(name).second; ++i) {
        name = wanted + " " + std::to_string(i);
    }
    return name;
}

void addDefaultLight(Scene& scene, const Bounds& bounds) {
    // An empty scene has no extent; a meter keeps the light a light.
    const float extent = bounds.extent() > 0.0f ? bounds.extent() : 1.0f;
    const float half = extent / 8.0f;

    Mesh square;
    square.name = "default light";
    square.positions = {
        {-half, 0.0f, -half}, {half, 0.0f, -half}, {half, 0.0f, half}, {-half, 0.0f, half}};
    square.normals.assign(4, glm::vec3(0.0f, -1.0f, 0.0f));
    square.triangles = {{0, 1, 2}, {0, 2, 3}};

    Material glow;
    glow.name = "default light";
    glow.baseColor = glm::vec3(0.0f);
    glow.emission = glm::vec3(20.0f);

    Node node;
    node.name = "default light";
    const glm::vec3 center = 0.5f * (bounds.min + bounds.max);
    node.translation = {center.x, bounds.max.y + extent / 4.0f, center.z};

    scene.instances.push_back({std::uint32_t(scene.meshes.size()),
                               std::uint32_t(scene.materials.size()),
                               std::uint32_t(scene.nodes.size())});
    scene.meshes.push_back(std::move(square));
    scene.materials.push_back(std::move(glow));
    scene.nodes.push_back(std::move(node));
}

void addDefaultCamera(Scene& scene, const Bounds& bounds) {
    const float extent = bounds.extent() > 0.0f ? bounds.extent() : 1.0f;
    SceneCamera camera;
    camera.name = "default camera";
    camera.node = std::uint32_t(scene.nodes.size());
    camera.lens.near = extent / 1000.0f;

    // The ball around the box just fits the height of the picture.
    const glm::vec3 center = 0.5f * (bounds.min + bounds.max);
    const float distance = 0.5f * extent / std::sin(0.5f * camera.lens.verticalFov);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.45f, 0.35f, 1.0f));
    const Camera view = lookAt(center + distance * direction, center, camera.lens);

    Node node;
    node.name = "default camera";
    node.translation = view.position;
    node.rotation = view.orientation;
    scene.nodes.push_back(std::move(node));
    scene.cameras.push_back(std::move(camera));
}

} // namespace

Camera cameraAt(const Scene& scene, const Pose& pose, std::size_t index) {
    assert(index < scene.cameras.size());
    const SceneCamera& camera = scene.cameras[index];
    const glm::mat4& worldFromNode = pose.worldFromNode[camera.node];

    Camera result;
    result.lens = camera.lens;
    result.position = glm::vec3(worldFromNode[3]);
    // Scale and shear of the node are none of a camera's business: keep where it looks, and make
    // the rest upright to that.
    const glm::vec3 back = glm::vec3(worldFromNode[2]);
    const glm::vec3 side = glm::cross(glm::vec3(worldFromNode[1]), back);
    if (glm::length(back) > 0.0f && glm::length(side) > 0.0f) {
        const glm::vec3 z = glm::normalize(back);
        const glm::vec3 x = glm::normalize(side);
        result.orientation = glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(z, x), z)));
    }
    return result;
}

Bounds boundsOf(const Scene& scene, const Pose& pose) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high(-std::numeric_limits<float>::infinity());
    bool any = false;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::mat4& worldFromNode = pose.worldFromNode[instance.node];
        for (const glm::uvec3& triangle : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 p =
                    worldFromNode * glm::vec4(mesh.positions[triangle[corner]], 1.0f);
                low = glm::min(low, p);
                high = glm::max(high, p);
                any = true;
            }
        }
    }
    return any ? Bounds{low, high} : Bounds{};
}

void completeScene(Scene& scene) {
    // Framed before a default light is added: that is not what one wants to see.
    const Bounds bounds = boundsOf(scene, poseAt(scene, 0.0));
    if (std::none_of(scene.instances.begin(), scene.instances.end(),
                     [&](const Instance& i) { return isLight(scene, i); })) {
        addDefaultLight(scene, bounds);
    }

    scene.lights.clear();
    std::set<std::string> taken;
    std::map<std::uint32_t, std::size_t> lightOfNode;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!isLight(scene, instance)) {
            continue;
        }
        const auto [place, isNew] = lightOfNode.emplace(instance.node, scene.lights.size());
        if (isNew) {
            const std::string& name = scene.nodes[instance.node].name;
            scene.lights.push_back({uniqueName(name.empty() ? "light" : name, taken), {}});
        }
        scene.lights[place->second].instances.push_back(i);
    }

    if (scene.cameras.empty()) {
        addDefaultCamera(scene, bounds);
    }
}

} // namespace afterglow
