// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"
#include "renderer/scene/camera.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace afterglow {

/// Triangles in their own space. One glTF primitive.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< meters
    std::vector<glm::vec3> normals;    ///< unit length, one per position
    std::vector<glm::vec2> texCoords;  ///< one per position, or empty
    std::vector<glm::uvec3> triangles; ///< counter-clockwise seen from the front
};

/// A picture that materials may refer to by index. Not sampled yet; importers fill in the name.
struct Texture {
    std::string name;
    Image<glm::u8vec4> pixels; ///< sRGB-encoded color; empty until textures are loaded
};

/// The metallic-roughness material of glTF, factors only.
struct Material {
    std::string name;
    glm::vec3 baseColor{0.8f}; ///< linear, [0, 1]
    float metallic = 0.0f;     ///< [0, 1]
    float roughness = 1.0f;    ///< [0, 1]
    glm::vec3 emission{0.0f};  ///< radiance, linear, >= 0: emissive factor times strength
    bool doubleSided = false;  ///< seen, and emitting, from both sides
    std::optional<std::uint32_t> baseColorTexture; ///< index into Scene::textures
};

/// A place in the hierarchy. Its transform is `matrix` if that is set, else T * R * S.
struct Node {
    std::string name;
    int parent = -1; ///< index into Scene::nodes, or -1; always less than the node's own index
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    std::optional<glm::mat4> matrix; ///< parentFromNode; a node with a matrix is not animated
};

/// A mesh with a material at a node.
struct Instance {
    std::uint32_t mesh = 0, material = 0, node = 0;
};

/// An area light: the emissive instances of one node. Its slot (its index) never changes, so random
/// numbers pick the same light whether or not others are switched on.
struct Light {
    std::string name; ///< unique in the scene
    std::vector<std::uint32_t> instances;
};

/// Keyframes of one property of one node. glTF 2.0, section 3.11.
struct Track {
    enum class Path { Translation, Rotation, Scale };
    enum class Interpolation { Step, Linear };
    std::uint32_t node = 0;
    Path path = Path::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<double> times;     ///< seconds, strictly rising, at least one
    std::vector<glm::vec4> values; ///< xyz, or a quaternion as xyzw; one per time
};

struct SceneCamera {
    std::string name;
    std::uint32_t node = 0;
    Lens lens;
};

/// A scene as plain values: copyable, with no OpenGL in it. Meters, seconds, right-handed, Y up.
struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Node> nodes; ///< parents come before their children
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Track> tracks;
    std::vector<SceneCamera> cameras; ///< at least one, once a scene has been completed
    glm::vec3 ambient{0.25f};         ///< radiance of the uniform surroundings that AO rays see
};

/// Everything that depends on time, for one moment.
struct Pose {
    std::vector<glm::mat4> worldFromNode; ///< one per Scene::nodes
};

/// Returns the pose at a time in seconds, from the time alone. Tracks hold their last value after
/// their end.
Pose poseAt(const Scene& scene, double seconds);

/// Returns the length of the longest track in seconds; 0 if nothing moves.
double duration(const Scene& scene);

/// Returns for each node whether a track moves it or one of its ancestors.
std::vector<bool> movingNodes(const Scene& scene);

Camera cameraAt(const Scene& scene, const Pose& pose, std::size_t index = 0);

struct Bounds {
    glm::vec3 min{0.0f}, max{0.0f};
    float extent() const { return glm::length(max - min); }
};

/// Returns the world-space box around all instances. A scene without triangles has an empty box at
/// the origin.
Bounds boundsOf(const Scene& scene, const Pose& pose);

/// Makes a scene complete: names area lights from emissive instances (one light per node, names
/// made unique), adds the documented default light if there is none, and a default camera that
/// frames the scene if there is none. Importers and procedural scenes end with it.
///
/// The default light is a downward-facing square of side extent/4, centered above the scene's box
/// by extent/4, at a node called "default light", of radiance 20.
void completeScene(Scene& scene);

} // namespace afterglow
