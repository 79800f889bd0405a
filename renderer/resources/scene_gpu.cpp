// SPDX-License-Identifier: MIT
#include "renderer/resources/scene_gpu.h"

#include "renderer/base/error.h"
#include "renderer/gl/embedded_shaders.h"
#include "renderer/image/color.h"
#include "renderer/image/pgm.h"

#include <chrono>

#include <glm/gtc/matrix_access.hpp>

namespace afterglow {

namespace {

/// Loads the tile as numbers in the middle of their steps, so that their mean is 1/2.
GpuTexture loadNoiseTile() {
    const auto bytes = embeddedFile("noise/blue_noise_128.pgm");
    if (!bytes)
        throw std::logic_error("the blue-noise tile is not in the executable");
    const Image<std::uint16_t> stored = readPgm16(*bytes, "noise/blue_noise_128.pgm");
    Image<float> numbers(stored.size());
    const float count = float(stored.pixels().size());
    for (std::size_t i = 0; i < stored.pixels().size(); ++i)
        numbers.pixels()[i] = float(stored.pixels()[i]) / 65536.0f + 0.5f / count;
    GpuTexture texture("blue noise", PixelFormat::R32F, stored.size());
    texture.write(numbers);
    return texture;
}

SceneBvh timedBuild(const Scene& scene, double& milliseconds) {
    const auto start = std::chrono::steady_clock::now();
    SceneBvh bvh(scene);
    milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

void setRows(glm::vec4 (&rows)[3], const glm::mat4& m) {
    for (int i = 0; i < 3; ++i)
        rows[i] = glm::row(m, i);
}

} // namespace

SceneGpu::SceneGpu(const Scene& scene)
    : noiseTile(loadNoiseTile()), bvh_(timedBuild(scene, bvhBuildMilliseconds_)) {
    const Pose rest = poseAt(scene, 0.0);
    extent_ = boundsOf(scene, rest).extent();
    lightCount_ = scene.lights.size();
    uploadMeshes(scene);
    uploadMaterials(scene);
    collectEmitters(scene, rest);
    bvhRecords = TexelBuffer("bvh records", bvh_.records().size_bytes());
    bvhRecords.write(bvh_.records());
    update(scene, rest, rest);
    setLightScales({});
}

void SceneGpu::uploadMeshes(const Scene& scene) {
    std::vector<gpu::Vertex> allVertices;
    std::vector<std::uint32_t> indices;
    std::vector<glm::uvec4> corners;
    for (const Mesh& mesh : scene.meshes) {
        const auto firstVertex = std::uint32_t(allVertices.size());
        firstTriangle_.push_back(std::uint32_t(corners.size()));
        firstIndexOfMesh_.push_back(std::uint32_t(indices.size()));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec2 uv = mesh.texCoords.empty() ? glm::vec2(0.0f) : mesh.texCoords[i];
            allVertices.push_back({mesh.positions[i], uv.x, mesh.normals[i], uv.y});
        }
        for (const glm::uvec3& triangle : mesh.triangles) {
            const glm::uvec3 v = triangle + firstVertex;
            indices.insert(indices.end(), {v.x, v.y, v.z});
            corners.push_back({v, 0u});
        }
    }
    vertexBuffer_ = GpuBuffer("vertices (raster)",
                              std::max<std::size_t>(allVertices.size(), 1) * sizeof(gpu::Vertex));
    vertexBuffer_.write(allVertices);
    indexBuffer_ =
        GpuBuffer("indices", std::max<std::size_t>(indices.size(), 1) * sizeof(std::uint32_t));
    indexBuffer_.write(indices);
    vertices = TexelBuffer("vertices", allVertices.size() * sizeof(gpu::Vertex));
    vertices.write(allVertices);
    triangles = TexelBuffer("triangles", corners.size() * sizeof(glm::uvec4));
    triangles.write(corners);
}

void SceneGpu::uploadMaterials(const Scene& scene) {
    std::vector<gpu::MaterialRecord> all;
    for (const Material& m : scene.materials)
        all.push_back({m.baseColor, m.metallic, m.emission, m.roughness});
    materials = TexelBuffer("materials", all.size() * sizeof(gpu::MaterialRecord));
    materials.write(all);

    std::vector<std::uint32_t> lightOfInstance(scene.instances.size(), gpu::kNoLight);
    for (std::size_t slot = 0; slot < scene.lights.size(); ++slot)
        for (const std::uint32_t instance : scene.lights[slot].instances)
            lightOfInstance[instance] = std::uint32_t(slot);

    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const auto count = scene.meshes[instance.mesh].triangles.size();
        gpu::InstanceRecord record{};
        record.firstTriangle = firstTriangle_[instance.mesh];
        record.material = instance.material;
        record.light = lightOfInstance[i];
        records_.push_back(record);
        draws_.push_back({std::uint32_t(i), GLsizei(3 * count), firstIndexOfMesh_[instance.mesh],
                          glm::mat4(1.0f), false, scene.materials[instance.material].doubleSided});
        triangleCount_ += count;
    }
    instances = TexelBuffer("instances", records_.size() * sizeof(gpu::InstanceRecord));
}

void SceneGpu::collectEmitters(const Scene& scene, const Pose& rest) {
    double total = 0.0;
    std::vector<double> powers;
    for (std::size_t slot = 0; slot < scene.lights.size(); ++slot)
        for (const std::uint32_t index : scene.lights[slot].instances) {
            const Instance& instance = scene.instances[index];
            const Material& material = scene.materials[instance.material];
            const Mesh& mesh = scene.meshes[instance.mesh];
            const glm::mat4& m = rest.worldFromNode[instance.node];
            records_[index].firstLightTriangle = std::uint32_t(emitters_.size());
            // Triangles without power are kept: a hit finds its triangle by its number.
            for (const glm::uvec3& t : mesh.triangles) {
                Emitter emitter{instance.node,
                                std::uint32_t(slot),
                                instance.material,
                                {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]},
                                0.0f,
                                0.0f};
                const auto world = [&](int i) {
                    return glm::vec3(m * glm::vec4(emitter.corners[i], 1.0f));
                };
                const float area =
                    0.5f * glm::length(glm::cross(world(1) - world(0), world(2) - world(0)));
                const double power = double(luminance(material.emission)) * area *
                                     (material.doubleSided ? 2.0 : 1.0);
                emitters_.push_back(emitter);
                powers.push_back(power);
                total += power;
            }
        }
    shinesAtAll_ = total > 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; shinesAtAll_ && i < emitters_.size(); ++i) {
        const double before = sum / total;
        sum += powers[i]; // in the end it is the total, to the bit
        emitters_[i].cumulative = float(sum / total);
        emitters_[i].probability = float(sum / total - before);
    }
    lightTriangles = TexelBuffer("light triangles", emitters_.size() * sizeof(gpu::LightTriangle));
    lightScales =
        TexelBuffer("light scales", std::max<std::size_t>(lightCount_, 1) * sizeof(glm::vec4));
}

void SceneGpu::placeEmitters(const Scene& scene, const Pose& pose) {
    lights_.clear();
    for (const Emitter& e : emitters_) {
        const glm::mat4& m = pose.worldFromNode[e.node];
        glm::vec3 v[3];
        for (int i = 0; i < 3; ++i)
            v[i] = glm::vec3(m * glm::vec4(e.corners[i], 1.0f));
        if (glm::determinant(glm::mat3(m)) < 0.0f)
            std::swap(v[1], v[2]); // mirrored: keep the emitting side outside
        const Material& material = scene.materials[e.material];
        gpu::LightTriangle t{};
        t.corner = v[0];
        t.cumulative = e.cumulative;
        t.edge1 = v[1] - v[0];
        t.probability = e.probability;
        t.edge2 = v[2] - v[0];
        t.light = e.light;
        t.emission = material.emission;
        t.doubleSided = material.doubleSided ? 1u : 0u;
        lights_.push_back(t);
    }
    lightTriangles.write(lights_);
}

void SceneGpu::update(const Scene& scene, const Pose& pose, const Pose& previous) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t node = scene.instances[i].node;
        const glm::mat4& m = pose.worldFromNode[node];
        setRows(records_[i].worldFromObject, m);
        setRows(records_[i].previousWorldFromObject, previous.worldFromNode[node]);
        draws_[i].worldFromObject = m;
        draws_[i].mirrored = glm::determinant(glm::mat3(m)) < 0.0f;
    }
    instances.write(records_);
    placeEmitters(scene, pose);
    bvh_.refresh(pose);
    for (const SceneBvh::Span span : bvh_.changed())
        bvhRecords.writeAt(span.first, bvh_.records().subspan(span.first, span.count));
}

void SceneGpu::setLightScales(std::span<const glm::vec3> scales) {
    std::vector<glm::vec4> texels(std::max<std::size_t>(lightCount_, 1), glm::vec4(1.0f));
    for (std::size_t i = 0; i < std::min(scales.size(), lightCount_); ++i)
        texels[i] = glm::vec4(scales[i], 0.0f);
    lightScales.write(texels);
}

} // namespace afterglow
