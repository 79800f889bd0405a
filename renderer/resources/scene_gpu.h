// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/scene_bvh.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/scene.h"
#include "shared/scene.h"

#include <span>
#include <vector>

namespace afterglow {

/// The scene as the shaders see it: buffers that are written once, and those few that follow the
/// pose and the lights.
class SceneGpu {
public:
    explicit SceneGpu(const Scene& scene);

    /// Moves everything to a pose. `previous` is the pose of the frame before.
    void update(const Scene& scene, const Pose& pose, const Pose& previous);
    /// Scales each light, by slot: 1 is nominal, 0 is off. Missing slots are 1.
    void setLightScales(std::span<const glm::vec3> scales);

    /// One draw of the raster pass.
    struct Draw {
        std::uint32_t instance;
        GLsizei indexCount;
        std::size_t firstIndex;
        glm::mat4 worldFromObject;
        bool mirrored;    ///< the front of its triangles is clockwise
        bool doubleSided; ///< both sides are seen
    };
    std::span<const Draw> draws() const { return draws_; }
    const GpuBuffer& vertexBuffer() const { return vertexBuffer_; }
    const GpuBuffer& indexBuffer() const { return indexBuffer_; }

    const SceneBvh& bvh() const { return bvh_; }
    double bvhBuildMilliseconds() const { return bvhBuildMilliseconds_; }
    std::size_t triangleCount() const { return triangleCount_; } ///< over all instances
    /// Returns the number of emissive triangles; 0 if none has power.
    std::uint32_t lightTriangleCount() const {
        return shinesAtAll_ ? std::uint32_t(lights_.size()) : 0u;
    }
    float extent() const { return extent_; } ///< diagonal of the scene's box at rest, meters

    TexelBuffer vertices, triangles, instances, materials; ///< shared/scene.h
    TexelBuffer lightTriangles, lightScales;
    TexelBuffer bvhRecords; ///< shared/bvh.h
    GpuTexture noiseTile;   ///< R32F, 128x128, [0, 1): the blue-noise tile

private:
    /// An emissive triangle in its object's space, and its share of the nominal power of all
    /// lights.
    struct Emitter {
        std::uint32_t node, light, material;
        glm::vec3 corners[3];
        float cumulative, probability;
    };

    void uploadMeshes(const Scene& scene);
    void uploadMaterials(const Scene& scene);
    void collectEmitters(const Scene& scene, const Pose& rest);
    void placeEmitters(const Scene& scene, const Pose& pose);

    double bvhBuildMilliseconds_ = 0.0; // before bvh_, whose making sets it
    SceneBvh bvh_;
    float extent_ = 1.0f;
    std::size_t triangleCount_ = 0;
    std::size_t lightCount_ = 0;
    bool shinesAtAll_ = false;
    GpuBuffer vertexBuffer_, indexBuffer_;
    std::vector<std::uint32_t> firstTriangle_, firstIndexOfMesh_; ///< by mesh
    std::vector<gpu::InstanceRecord> records_;
    std::vector<Draw> draws_;
    std::vector<Emitter> emitters_;
    std::vector<gpu::LightTriangle> lights_;
};

} // namespace afterglow
