// SPDX-License-Identifier: MIT
// The only file that sees tinygltf. It is given a document that has been checked (gltf_check.h) and
// the bytes of its buffers; it opens no file by itself.

#include "renderer/scene/gltf_import.h"

#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/scene/gltf_check.h"
#include "renderer/scene/gltf_container.h"
#include "renderer/scene/gltf_geometry.h"
#include "renderer/scene/gltf_json.h"

#include <cmath>
#include <new>
#include <set>
#include <tuple>

#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace afterglow {

namespace {

tinygltf::Model parse(GltfDocument& document) {
    tinygltf::TinyGLTF loader;
    tinygltf::FsCallbacks files;
    files.FileExists = [](const std::string&, void*) { return true; };
    files.ExpandFilePath = [](const std::string& name, void*) { return name; };
    files.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string*,
                             const std::string& name, void* user) {
        *bytes = std::move(static_cast<GltfDocument*>(user)->buffers.at(std::stoul(name)));
        return true;
    };
    files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                              void*) { return false; };
    files.user_data = &document;
    loader.SetFsCallbacks(files);

    tinygltf::Model model;
    std::string error, warning;
    if (!loader.LoadASCIIFromString(&model, &error, &warning, document.json.c_str(),
                                    unsigned(document.json.size()), "")) {
        throw GltfFault("cannot be parsed: " + error);
    }
    return model;
}

class Importer {
public:
    Importer(const tinygltf::Model& model, const GltfDocument& document)
        : model_(model), document_(document) {}

    Scene run(std::vector<std::string>& warnings);

private:
    struct Part {
        std::uint32_t mesh, material;
    };

    GltfArray arrayOf(int accessor) const;
    void importMaterials();
    void importMeshes(std::vector<std::string>& warnings);
    void importNodes();
    Node nodeOf(const tinygltf::Node& source) const;
    void importTracks(std::vector<std::string>& warnings);
    Track trackOf(const tinygltf::AnimationSampler& sampler, Track track,
                  const std::string& where) const;
    std::uint32_t defaultMaterial();

    const tinygltf::Model& model_;
    const GltfDocument& document_;
    Scene scene_;
    std::vector<std::vector<Part>> parts_; // of each mesh of the file
    std::vector<std::int64_t> nodeOf_;     // our node of each node of the file, or -1
    std::optional<std::uint32_t> defaultMaterial_;
};

GltfArray Importer::arrayOf(int index) const {
    const tinygltf::Accessor& accessor = model_.accessors[std::size_t(index)];
    const tinygltf::BufferView& view = model_.bufferViews[std::size_t(accessor.bufferView)];
    const int components = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
    const auto size = std::size_t(
        components * tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)));
    return {model_.buffers[std::size_t(view.buffer)].data.data() + view.byteOffset +
                accessor.byteOffset,
            view.byteStride > 0 ? view.byteStride : size, accessor.count, accessor.componentType,
            components};
}

void Importer::importMaterials() {
    for (const std::string& name : document_.textures) {
        scene_.textures.push_back({name, {}});
    }
    for (const tinygltf::Material& source : model_.materials) {
        const tinygltf::PbrMetallicRoughness& factors = source.pbrMetallicRoughness;
        Material material;
        material.name = source.name;
        material.baseColor = {factors.baseColorFactor[0], factors.baseColorFactor[1],
                              factors.baseColorFactor[2]};
        material.metallic = float(factors.metallicFactor);
        material.roughness = float(factors.roughnessFactor);
        double strength = 1.0;
        const auto extension = source.extensions.find("KHR_materials_emissive_strength");
        if (extension != source.extensions.end()) {
            strength = extension->second.Get("emissiveStrength").GetNumberAsDouble();
        }
        material.emission = {source.emissiveFactor[0] * strength,
                             source.emissiveFactor[1] * strength,
                             source.emissiveFactor[2] * strength};
        material.doubleSided = source.doubleSided;
        if (factors.baseColorTexture.index >= 0) {
            material.baseColorTexture = std::uint32_t(factors.baseColorTexture.index);
        }
        scene_.materials.push_back(std::move(material));
    }
}

std::uint32_t Importer::defaultMaterial() {
    if (!defaultMaterial_) {
        defaultMaterial_ = std::uint32_t(scene_.materials.size());
        scene_.materials.emplace_back().name = "default";
    }
    return *defaultMaterial_;
}

void Importer::importMeshes(std::vector<std::string>& warnings) {
    GltfGeometry geometry;
    bool others = false, any = false;
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
        const tinygltf::Mesh& source = model_.meshes[m];
        parts_.emplace_back();
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = source.primitives[p];
            if (primitive.mode < 4) {
                others = true;
                continue;
            }
            any = true;
            const auto attribute = [&](const char* name) -> std::optional<GltfArray> {
                const auto found = primitive.attributes.find(name);
                return found == primitive.attributes.end() ? std::nullopt
                                                           : std::optional(arrayOf(found->second));
            };
            GltfPrimitive input;
            input.mode = primitive.mode;
            input.positions = attribute("POSITION").value();
            input.normals = attribute("NORMAL");
            input.texCoords = attribute("TEXCOORD_0");
            if (primitive.indices >= 0) {
                input.indices = arrayOf(primitive.indices);
            }
            Mesh mesh;
            try {
                mesh = geometry.mesh(input);
            } catch (const GltfFault& fault) {
                throw GltfFault("meshes[" + std::to_string(m) + "].primitives[" +
                                std::to_string(p) + "] (\"" + source.name + "\") " + fault.what());
            }
            if (mesh.triangles.empty()) {
                continue;
            }
            mesh.name = source.name;
            parts_.back().push_back(
                {std::uint32_t(scene_.meshes.size()),
                 primitive.material >= 0 ? std::uint32_t(primitive.material) : defaultMaterial()});
            scene_.meshes.push_back(std::move(mesh));
        }
    }
    if (scene_.meshes.empty()) {
        throw GltfFault(any ? "has no triangle with an area" : "has no triangles");
    }
    if (others) {
        warnings.push_back("points and lines are left out");
    }
    if (geometry.withoutArea() > 0) {
        warnings.push_back(std::to_string(geometry.withoutArea()) +
                           " triangles without area are left out");
    }
}

Node Importer::nodeOf(const tinygltf::Node& source) const {
    Node node;
    node.name = source.name;
    if (source.matrix.size() == 16) {
        glm::mat4 matrix;
        for (int i = 0; i < 16; ++i) {
            matrix[i / 4][i % 4] = float(source.matrix[std::size_t(i)]);
        }
        node.matrix = matrix;
    }
    if (source.translation.size() == 3) {
        node.translation = {source.translation[0], source.translation[1], source.translation[2]};
    }
    if (source.rotation.size() == 4) {
        const std::vector<double>& q = source.rotation;
        node.rotation = glm::quat(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    }
    if (source.scale.size() == 3) {
        node.scale = {source.scale[0], source.scale[1], source.scale[2]};
    }
    return node;
}

void Importer::importNodes() {
    nodeOf_.assign(model_.nodes.size(), -1);
    // Down from the roots, so that parents come first; what the scene does not show stays out.
    struct Visit {
        int source, parent;
    };
    std::vector<Visit> open;
    const std::vector<int>& roots = model_.scenes[std::size_t(model_.defaultScene)].nodes;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        open.push_back({*root, -1});
    }
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const tinygltf::Node& source = model_.nodes[std::size_t(visit.source)];
        const auto index = std::uint32_t(scene_.nodes.size());
        nodeOf_[std::size_t(visit.source)] = index;
        scene_.nodes.push_back(nodeOf(source));
        scene_.nodes.back().parent = visit.parent;
        if (source.mesh >= 0) {
            for (const Part& part : parts_[std::size_t(source.mesh)]) {
                scene_.instances.push_back({part.mesh, part.material, index});
            }
        }
        if (source.camera >= 0) {
            const tinygltf::Camera& camera = model_.cameras[std::size_t(source.camera)];
            if (camera.type == "perspective") {
                Lens lens;
                lens.verticalFov = float(camera.perspective.yfov);
                lens.near = float(camera.perspective.znear);
                if (camera.perspective.zfar > 0.0) {
                    lens.far = float(camera.perspective.zfar);
                }
                scene_.cameras.push_back(
                    {source.name.empty() ? camera.name : source.name, index, lens});
            }
        }
        for (auto child = source.children.rbegin(); child != source.children.rend(); ++child) {
            open.push_back({*child, int(index)});
        }
    }
    if (scene_.instances.empty()) {
        throw GltfFault("has no node in its scene that shows a mesh");
    }
}

Track Importer::trackOf(const tinygltf::AnimationSampler& sampler, Track track,
                        const std::string& where) const {
    track.interpolation =
        sampler.interpolation == "STEP" ? Track::Interpolation::Step : Track::Interpolation::Linear;
    const GltfArray times = arrayOf(sampler.input), values = arrayOf(sampler.output);
    for (std::size_t i = 0; i < times.count; ++i) {
        const double time = times.fraction(i).x;
        if (!std::isfinite(time) || time < 0.0 ||
            (!track.times.empty() && time <= track.times.back())) {
            throw GltfFault(where + " key " + std::to_string(i) +
                            " is not at a time >= 0 after the one before it");
        }
        const glm::vec4 value = values.fraction(i);
        const bool finite = !glm::any(glm::isnan(value)) && !glm::any(glm::isinf(value));
        if (!finite || (track.path == Track::Path::Rotation && glm::length(value) < 0.5f)) {
            throw GltfFault(where + " key " + std::to_string(i) + " has no usable value");
        }
        track.times.push_back(time);
        track.values.push_back(track.path == Track::Path::Rotation ? glm::normalize(value) : value);
    }
    return track;
}

void Importer::importTracks(std::vector<std::string>& warnings) {
    std::set<std::tuple<std::uint32_t, Track::Path>> taken;
    bool twice = false;
    for (std::size_t a = 0; a < model_.animations.size(); ++a) {
        const tinygltf::Animation& animation = model_.animations[a];
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            const std::int64_t node = nodeOf_[std::size_t(channel.target_node)];
            if (node < 0) {
                continue;
            }
            const Track::Path path = channel.target_path == "translation" ? Track::Path::Translation
                                     : channel.target_path == "rotation"  ? Track::Path::Rotation
                                                                          : Track::Path::Scale;
            if (!taken.emplace(std::uint32_t(node), path).second) {
                twice = true;
                continue;
            }
            const std::string where = "animations[" + std::to_string(a) + "].samplers[" +
                                      std::to_string(channel.sampler) + "]";
            scene_.tracks.push_back(trackOf(
                animation.samplers[std::size_t(channel.sampler)],
                Track{std::uint32_t(node), path, Track::Interpolation::Linear, {}, {}}, where));
        }
    }
    if (twice) {
        warnings.push_back("several animations move one node: the first is played");
    }
}

/// Throws GltfFault if a vertex is so far away that the square of a distance is no float any more.
void requireNear(const Scene& scene) {
    constexpr double kFarthest = 1e18;
    const Pose pose = poseAt(scene, 0.0);
    for (const Instance& instance : scene.instances) {
        const glm::dmat4 worldFromNode(pose.worldFromNode[instance.node]);
        for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
            const glm::dvec3 p(worldFromNode * glm::dvec4(position, 1.0));
            // Not written as "> kFarthest": that would let what is not a number pass.
            if (!(std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest &&
                  std::abs(p.z) <= kFarthest)) {
                throw GltfFault("reaches farther than 1e18 m at node \"" +
                                scene.nodes[instance.node].name + "\"");
            }
        }
    }
}

Scene Importer::run(std::vector<std::string>& warnings) {
    importMaterials();
    importMeshes(warnings);
    importNodes();
    importTracks(warnings);
    requireNear(scene_);
    return std::move(scene_);
}

} // namespace

Scene importGltf(const std::filesystem::path& path) {
    try {
        GltfDocument document = readGltfDocument(path);
        const tinygltf::Model model = parse(document);
        std::vector<std::string> warnings = document.warnings;
        Scene scene = Importer(model, document).run(warnings);
        scene.name = path.stem().string();
        completeScene(scene);
        for (const std::string& warning : warnings) {
            log(LogLevel::Warning, path.string() + ": " + warning);
        }
        return scene;
    } catch (const GltfFault& fault) {
        throw InputError(path.string() + ": " + forMessage(fault.what()));
    } catch (const std::bad_alloc&) {
        throw InputError(path.string() + ": needs more memory than there is");
    }
}

} // namespace afterglow
