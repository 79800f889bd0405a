// glTF 2.0, section 5 and the rules of section 3, for what the importer reads. The parser behind it
// is given only what has passed here: it does not mind indices out of range, and we do.

#include "renderer/scene/gltf_check.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/scene/gltf_container.h"
#include "renderer/scene/gltf_json.h"

#include <algorithm>
#include <array>
#include <set>

namespace afterglow {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::string_view kExtensions[] = {"KHR_materials_emissive_strength"};

enum Component { I8 = 5120, U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };

std::size_t bytesOf(std::uint64_t component) {
    return component == I8 || component == U8 ? 1 : component == I16 || component == U16 ? 2 : 4;
}

struct Accessor {
    std::size_t components = 0; ///< 0: a matrix, which the importer never reads
    int component = 0;
    bool normalized = false, hasView = false, sparse = false;
    std::uint64_t count = 0;
};

class Checker {
public:
    Checker(const fs::path& path, const json& document, const std::optional<std::string>& binary)
        : path_(path), root_(document, ""), binary_(binary) {}

    GltfDocument check();

private:
    void checkAsset();
    void checkBuffers();
    std::vector<unsigned char> bufferBytes(const GltfView& buffer, std::size_t index,
                                           std::size_t length) const;
    void checkViews();
    void checkAccessors();
    void checkTextures();
    void checkMaterials();
    void checkMeshes();
    json checkPrimitive(const GltfView& primitive);
    void checkCameras();
    void checkNodes();
    void checkScenes();
    void checkAnimations();
    void checkChannel(const GltfView& channel, const std::vector<GltfView>& samplers);

    const Accessor& accessorFor(const GltfView& reference, std::size_t components,
                                std::initializer_list<int> types) const;

    const fs::path& path_;
    GltfView root_;
    const std::optional<std::string>& binary_;
    GltfDocument result_;
    json out_ = json::object();
    std::vector<std::uint64_t> bufferLengths_;
    struct View {
        std::uint64_t length = 0, stride = 0;
    };
    std::vector<View> views_;
    std::vector<Accessor> accessors_;
    std::vector<int> parents_;
    std::vector<bool> hasMatrix_;
};

GltfDocument Checker::check() {
    checkAsset();
    checkBuffers();
    checkViews();
    checkAccessors();
    checkTextures();
    checkMaterials();
    checkCameras();
    checkMeshes();
    checkNodes();
    checkScenes();
    checkAnimations();
    result_.json = out_.dump();
    return std::move(result_);
}

void Checker::checkAsset() {
    const std::optional<GltfView> asset = root_.object("asset");
    if (!asset) {
        throw GltfFault("is not glTF: it has no \"asset\"");
    }
    const std::string version = asset->at("version").text();
    if (!version.starts_with("2.")) {
        throw GltfFault("is glTF version " + forMessage(version) + "; version 2 is needed");
    }
    out_["asset"] = {{"version", "2.0"}};
    for (const GltfView& extension : root_.array("extensionsRequired")) {
        const std::string name = extension.text();
        if (std::find(std::begin(kExtensions), std::end(kExtensions), name) ==
            std::end(kExtensions)) {
            throw GltfFault("requires the extension " + forMessage(name) +
                            ", which is not supported");
        }
    }
}

std::vector<unsigned char> Checker::bufferBytes(const GltfView& buffer, std::size_t index,
                                                std::size_t length) const {
    std::vector<unsigned char> bytes;
    if (buffer.has("uri")) {
        const std::string uri = buffer.at("uri").text();
        const std::string named = "uri \"" + forMessage(uri.substr(0, 80)) + "\" ";
        try {
            if (uri.starts_with("data:")) {
                bytes = decodeDataUri(uri);
            } else {
                const std::string file = readFile(resolveGltfUri(path_, uri));
                bytes.assign(file.begin(), file.end());
            }
        } catch (const std::invalid_argument& cause) {
            buffer.fault(named + cause.what());
        } catch (const InputError& cause) {
            buffer.fault(named + "cannot be had: " + cause.what());
        }
    } else if (index == 0 && binary_) {
        bytes.assign(binary_->begin(), binary_->end());
    } else {
        buffer.fault("has no uri, and there is no binary chunk for it");
    }
    if (bytes.size() < length) {
        buffer.fault("is " + std::to_string(length) + " bytes long, but " +
                     std::to_string(bytes.size()) + " are there");
    }
    bytes.resize(length);
    return bytes;
}

void Checker::checkBuffers() {
    json& out = out_["buffers"] = json::array();
    for (const GltfView& buffer : root_.objects("buffers")) {
        const std::uint64_t length = buffer.at("byteLength").whole(1);
        const std::size_t index = result_.buffers.size();
        result_.buffers.push_back(bufferBytes(buffer, index, length));
        bufferLengths_.push_back(length);
        out.push_back({{"byteLength", length}, {"uri", std::to_string(index)}});
    }
}

void Checker::checkViews() {
    json& out = out_["bufferViews"] = json::array();
    for (const GltfView& view : root_.objects("bufferViews")) {
        const std::uint32_t buffer = view.at("buffer").index(bufferLengths_.size(), "buffers");
        const std::uint64_t offset = view.whole("byteOffset", 0);
        const std::uint64_t length = view.at("byteLength").whole(1);
        if (offset > bufferLengths_[buffer] || length > bufferLengths_[buffer] - offset) {
            view.fault("reaches beyond buffer " + std::to_string(buffer) + " of " +
                       std::to_string(bufferLengths_[buffer]) + " bytes");
        }
        const std::uint64_t stride = view.whole("byteStride", 0, 4, 252);
        if (stride % 4 != 0) {
            view.at("byteStride").fault("is not a multiple of 4");
        }
        views_.push_back({length, stride});
        json entry{{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
        if (stride > 0) {
            entry["byteStride"] = stride;
        }
        out.push_back(std::move(entry));
    }
}

void Checker::checkAccessors() {
    json& out = out_["accessors"] = json::array();
    for (const GltfView& view : root_.objects("accessors")) {
        Accessor accessor;
        accessor.component = int(view.at("componentType").whole());
        if (!(accessor.component >= I8 && accessor.component <= F32) ||
            accessor.component == 5124) {
            view.at("componentType")
                .fault("is " + std::to_string(accessor.component) + ", which is no type of glTF 2");
        }
        const std::string type = view.at("type").text();
        if (type == "SCALAR") {
            accessor.components = 1;
        } else if (type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' &&
                   type[3] <= '4') {
            accessor.components = std::size_t(type[3] - '0');
        } else if (type != "MAT2" && type != "MAT3" && type != "MAT4") {
            view.at("type").fault("is \"" + forMessage(type) + "\", which is no type of glTF 2");
        }
        accessor.normalized = view.flag("normalized", false);
        accessor.count = view.at("count").whole(1);
        accessor.sparse = view.has("sparse");
        const std::uint64_t offset = view.whole("byteOffset", 0);
        json entry{{"componentType", accessor.component},
                   {"type", type},
                   {"normalized", accessor.normalized},
                   {"count", accessor.count},
                   {"byteOffset", offset}};
        if (const auto index = view.index("bufferView", views_.size(), "buffer views")) {
            const View& bytes = views_[*index];
            const std::uint64_t size = accessor.components * bytesOf(accessor.component);
            const std::uint64_t stride = bytes.stride > 0 ? bytes.stride : size;
            if (accessor.components > 0) {
                if (stride < size) {
                    view.fault("has elements of " + std::to_string(size) +
                               " bytes, a byteStride of " + std::to_string(stride) +
                               " between them");
                }
                if (offset > bytes.length || size > bytes.length - offset ||
                    (bytes.length - offset - size) / stride < accessor.count - 1) {
                    view.fault("reaches beyond buffer view " + std::to_string(*index) + " of " +
                               std::to_string(bytes.length) + " bytes");
                }
            }
            accessor.hasView = true;
            entry["bufferView"] = *index;
        }
        accessors_.push_back(accessor);
        out.push_back(std::move(entry));
    }
}

const Accessor& Checker::accessorFor(const GltfView& reference, std::size_t components,
                                     std::initializer_list<int> types) const {
    const std::uint32_t index = reference.index(accessors_.size(), "accessors");
    const Accessor& accessor = accessors_[index];
    const auto refuse = [&](const char* cause) {
        reference.fault("is accessor " + std::to_string(index) + ", which " + cause);
    };
    if (accessor.sparse) {
        refuse("is sparse; that is not supported");
    }
    if (!accessor.hasView) {
        refuse("has no buffer view");
    }
    if (accessor.components != components ||
        std::find(types.begin(), types.end(), accessor.component) == types.end()) {
        refuse("is not of a type that is allowed here");
    }
    // Whole numbers that stand for fractions must say so, and indices must not.
    if (accessor.component != F32 && (components > 1) != accessor.normalized) {
        refuse(components > 1 ? "holds whole numbers that are not normalized"
                              : "is normalized and cannot be used to count");
    }
    return accessor;
}

void Checker::checkTextures() {
    std::vector<std::string> images;
    for (const GltfView& image : root_.objects("images")) {
        std::string name = image.text("name", "");
        if (image.has("uri")) {
            const std::string uri = image.at("uri").text();
            if (!uri.starts_with("data:")) {
                try {
                    resolveGltfUri(path_, uri);
                } catch (const std::invalid_argument& cause) {
                    image.fault("uri \"" + forMessage(uri) + "\" " + cause.what());
                }
                name = name.empty() ? uri : name;
            }
        } else {
            image.index("bufferView", views_.size(), "buffer views");
        }
        images.push_back(std::move(name));
    }
    for (const GltfView& texture : root_.objects("textures")) {
        std::string name = texture.text("name", "");
        if (const auto source = texture.index("source", images.size(), "images")) {
            name = name.empty() ? images[*source] : name;
        }
        result_.textures.push_back(std::move(name));
    }
}

void Checker::checkMaterials() {
    json& out = out_["materials"] = json::array();
    for (const GltfView& material : root_.objects("materials")) {
        json entry{{"name", material.text("name", "")},
                   {"doubleSided", material.flag("doubleSided", false)}};
        json surface = json::object();
        if (const auto factors = material.object("pbrMetallicRoughness")) {
            if (const auto color = factors->numbers("baseColorFactor", 4, 0.0, 1.0)) {
                surface["baseColorFactor"] = *color;
            }
            surface["metallicFactor"] = factors->number("metallicFactor", 1.0, 0.0, 1.0);
            surface["roughnessFactor"] = factors->number("roughnessFactor", 1.0, 0.0, 1.0);
            if (const auto texture = factors->object("baseColorTexture")) {
                const std::uint32_t index =
                    texture->at("index").index(result_.textures.size(), "textures");
                surface["baseColorTexture"] = {{"index", index}};
            }
        }
        entry["pbrMetallicRoughness"] = std::move(surface);
        // The product of the two is a radiance; a million of each is enough for a sun.
        constexpr double kBrightest = 1e6;
        if (const auto factor = material.numbers("emissiveFactor", 3, 0.0, kBrightest)) {
            entry["emissiveFactor"] = *factor;
        }
        if (const auto extensions = material.object("extensions")) {
            if (const auto strength = extensions->object("KHR_materials_emissive_strength")) {
                entry["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
                    strength->number("emissiveStrength", 1.0, 0.0, kBrightest);
            }
        }
        out.push_back(std::move(entry));
    }
}

void Checker::checkCameras() {
    json& out = out_["cameras"] = json::array();
    std::size_t orthographic = 0;
    for (const GltfView& camera : root_.objects("cameras")) {
        const std::string type = camera.at("type").text();
        json entry{{"name", camera.text("name", "")}, {"type", type}};
        if (type == "orthographic") {
            ++orthographic;
            entry["orthographic"] = {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 1}};
        } else if (type == "perspective") {
            const std::optional<GltfView> lens = camera.object("perspective");
            if (!lens) {
                camera.fault("has no \"perspective\"");
            }
            const double fov = lens->at("yfov").number(1e-4, 3.1415);
            const double near = lens->at("znear").number(1e-6, 1e18);
            entry["perspective"] = {{"yfov", fov}, {"znear", near}};
            if (lens->has("zfar")) {
                const double far = lens->number("zfar", 0.0, 0.0, GltfView::kLargestFloat);
                if (!(float(far) > float(near))) {
                    lens->fault("has a zfar that is not beyond its znear");
                }
                entry["perspective"]["zfar"] = far;
            }
        } else {
            camera.at("type").fault("is \"" + forMessage(type) +
                                    "\", neither perspective nor orthographic");
        }
        out.push_back(std::move(entry));
    }
    if (orthographic > 0 && orthographic == out.size()) {
        throw GltfFault("has an orthographic camera only; a perspective one is needed");
    }
    if (orthographic > 0) {
        result_.warnings.push_back("an orthographic camera is left out");
    }
}

void Checker::checkMeshes() {
    json& out = out_["meshes"] = json::array();
    bool morphs = false;
    for (const GltfView& mesh : root_.objects("meshes")) {
        json primitives = json::array();
        for (const GltfView& primitive : mesh.objects("primitives")) {
            primitives.push_back(checkPrimitive(primitive));
            morphs = morphs || primitive.has("targets");
        }
        if (primitives.empty()) {
            mesh.fault("has no primitives");
        }
        out.push_back({{"name", mesh.text("name", "")}, {"primitives", std::move(primitives)}});
    }
    if (out.empty()) {
        throw GltfFault("has no meshes");
    }
    if (morphs) {
        result_.warnings.push_back("morph targets are left out");
    }
}

json Checker::checkPrimitive(const GltfView& primitive) {
    const std::uint64_t mode = primitive.whole("mode", 4, 0, 6);
    json out{{"mode", mode}, {"attributes", json::object()}};
    const std::optional<GltfView> attributes = primitive.object("attributes");
    if (!attributes) {
        primitive.fault("has no \"attributes\"");
    }
    for (const auto& [name, value] : attributes->json().items()) {
        const GltfView reference(value, attributes->where() + "." + forMessage(name));
        reference.index(accessors_.size(), "accessors");
    }
    if (const auto material = primitive.index("material", out_["materials"].size(), "materials")) {
        out["material"] = *material;
    }
    const auto indices = primitive.index("indices", accessors_.size(), "accessors");
    if (mode < 4) {
        return out; // points and lines: nothing of them is read
    }
    const struct {
        const char* name;
        std::size_t components;
        std::initializer_list<int> types;
    } known[] = {{"POSITION", 3, {F32}}, {"NORMAL", 3, {F32}}, {"TEXCOORD_0", 2, {F32, U8, U16}}};
    std::uint64_t vertices = 0;
    for (const auto& attribute : known) {
        if (!attributes->has(attribute.name)) {
            if (vertices == 0) {
                attributes->fault("has no \"POSITION\"");
            }
            continue;
        }
        const GltfView reference = attributes->at(attribute.name);
        const Accessor& accessor = accessorFor(reference, attribute.components, attribute.types);
        if (vertices > 0 && accessor.count != vertices) {
            reference.fault("has " + std::to_string(accessor.count) + " elements for " +
                            std::to_string(vertices) + " vertices");
        }
        vertices = accessor.count;
        out["attributes"][attribute.name] = reference.index(accessors_.size(), "accessors");
    }
    std::uint64_t corners = vertices;
    if (indices) {
        corners = accessorFor(primitive.at("indices"), 1, {U8, U16, U32}).count;
        out["indices"] = *indices;
    }
    if (mode == 4 ? corners % 3 != 0 : corners < 3) {
        primitive.fault("has " + std::to_string(corners) + (indices ? " indices" : " vertices") +
                        ", which is not a number of triangles");
    }
    return out;
}

void Checker::checkNodes() {
    json& out = out_["nodes"] = json::array();
    const std::vector<GltfView> nodes = root_.objects("nodes");
    const std::size_t meshes = out_["meshes"].size(), cameras = out_["cameras"].size();
    parents_.assign(nodes.size(), -1);
    bool skins = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const GltfView& node = nodes[i];
        json entry{{"name", node.text("name", "")}};
        if (const auto mesh = node.index("mesh", meshes, "meshes")) {
            entry["mesh"] = *mesh;
        }
        if (const auto camera = node.index("camera", cameras, "cameras")) {
            entry["camera"] = *camera;
        }
        for (const GltfView& child : node.array("children")) {
            const std::uint32_t index = child.index(nodes.size(), "nodes");
            if (parents_[index] >= 0) {
                child.fault("is " + std::to_string(index) + ", which is already a child of node " +
                            std::to_string(parents_[index]));
            }
            parents_[index] = int(i);
            entry["children"].push_back(index);
        }
        const bool apart = node.has("translation") || node.has("rotation") || node.has("scale");
        hasMatrix_.push_back(node.has("matrix"));
        if (const auto matrix = node.numbers("matrix", 16)) {
            if (apart) {
                node.fault("has a matrix and also a translation, rotation or scale");
            }
            if ((*matrix)[3] != 0 || (*matrix)[7] != 0 || (*matrix)[11] != 0 ||
                (*matrix)[15] != 1) {
                node.fault("has a matrix whose last row is not 0 0 0 1");
            }
            entry["matrix"] = *matrix;
        }
        if (const auto translation = node.numbers("translation", 3)) {
            entry["translation"] = *translation;
        }
        if (const auto scale = node.numbers("scale", 3)) {
            entry["scale"] = *scale;
        }
        if (const auto q = node.numbers("rotation", 4, -1.001, 1.001)) {
            if ((*q)[0] * (*q)[0] + (*q)[1] * (*q)[1] + (*q)[2] * (*q)[2] + (*q)[3] * (*q)[3] <
                0.5) {
                node.fault("has a rotation that is not of unit length");
            }
            entry["rotation"] = *q;
        }
        skins = skins || node.has("skin");
        out.push_back(std::move(entry));
    }
    if (skins) {
        result_.warnings.push_back("skins are left out: meshes stay as they are modelled");
    }
    // A node that is its own ancestor: every walk up must end. Each node is walked once.
    std::vector<char> state(nodes.size(), 0); // 1: on the present walk, 2: known to end
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        int at = int(i);
        for (; at >= 0 && state[std::size_t(at)] == 0; at = parents_[std::size_t(at)]) {
            state[std::size_t(at)] = 1;
        }
        if (at >= 0 && state[std::size_t(at)] == 1) {
            nodes[std::size_t(at)].fault("is its own ancestor");
        }
        for (at = int(i); at >= 0 && state[std::size_t(at)] == 1; at = parents_[std::size_t(at)]) {
            state[std::size_t(at)] = 2;
        }
    }
}

void Checker::checkScenes() {
    json& out = out_["scenes"] = json::array();
    const std::vector<GltfView> scenes = root_.objects("scenes");
    for (const GltfView& scene : scenes) {
        json roots = json::array();
        std::set<std::uint32_t> seen;
        for (const GltfView& reference : scene.array("nodes")) {
            const std::uint32_t index = reference.index(parents_.size(), "nodes");
            if (parents_[index] >= 0) {
                reference.fault("is node " + std::to_string(index) + ", which has a parent");
            }
            if (!seen.insert(index).second) {
                reference.fault("is node " + std::to_string(index) + ", a second time");
            }
            roots.push_back(index);
        }
        out.push_back({{"name", scene.text("name", "")}, {"nodes", std::move(roots)}});
    }
    if (out.empty()) {
        // No scenes: a library, of which all is shown.
        json roots = json::array();
        for (std::size_t i = 0; i < parents_.size(); ++i) {
            if (parents_[i] < 0) {
                roots.push_back(i);
            }
        }
        out.push_back({{"nodes", std::move(roots)}});
    }
    out_["scene"] = root_.index("scene", out.size(), "scenes").value_or(0);
}

void Checker::checkAnimations() {
    json& out = out_["animations"] = json::array();
    for (const GltfView& animation : root_.objects("animations")) {
        const std::vector<GltfView> samplers = animation.objects("samplers");
        json entry{{"samplers", json::array()}, {"channels", json::array()}};
        for (const GltfView& sampler : samplers) {
            const std::string interpolation = sampler.text("interpolation", "LINEAR");
            if (interpolation != "LINEAR" && interpolation != "STEP" &&
                interpolation != "CUBICSPLINE") {
                sampler.at("interpolation").fault("is \"" + forMessage(interpolation) + "\"");
            }
            entry["samplers"].push_back(
                {{"input", sampler.at("input").index(accessors_.size(), "accessors")},
                 {"output", sampler.at("output").index(accessors_.size(), "accessors")},
                 {"interpolation", interpolation}});
        }
        for (const GltfView& channel : animation.objects("channels")) {
            const std::uint32_t sampler = channel.at("sampler").index(samplers.size(), "samplers");
            const std::optional<GltfView> target = channel.object("target");
            if (!target) {
                channel.fault("has no \"target\"");
            }
            const std::string path = target->at("path").text();
            const auto node = target->index("node", parents_.size(), "nodes");
            if (!node || path == "weights") {
                continue; // nothing of ours moves
            }
            if (path != "translation" && path != "rotation" && path != "scale") {
                target->at("path").fault("is \"" + forMessage(path) + "\"");
            }
            checkChannel(channel, samplers);
            entry["channels"].push_back(
                {{"sampler", sampler}, {"target", {{"node", *node}, {"path", path}}}});
        }
        out.push_back(std::move(entry));
    }
}

void Checker::checkChannel(const GltfView& channel, const std::vector<GltfView>& samplers) {
    const GltfView& sampler = samplers[channel.at("sampler").index(samplers.size(), "samplers")];
    const GltfView target = channel.at("target");
    if (hasMatrix_[target.at("node").index(parents_.size(), "nodes")]) {
        target.fault("is a node with a matrix, which cannot be animated");
    }
    if (sampler.text("interpolation", "LINEAR") == "CUBICSPLINE") {
        sampler.fault("is a cubic spline; only STEP and LINEAR animation is supported");
    }
    const Accessor& times = accessorFor(sampler.at("input"), 1, {F32});
    const GltfView output = sampler.at("output");
    const Accessor& values = target.at("path").text() == "rotation"
                                 ? accessorFor(output, 4, {F32, I8, U8, I16, U16})
                                 : accessorFor(output, 3, {F32});
    if (times.count != values.count) {
        output.fault("has " + std::to_string(values.count) + " values for " +
                     std::to_string(times.count) + " times");
    }
}

} // namespace

GltfDocument readGltfDocument(const fs::path& path) {
    try {
        const GltfContainer container = readGltfContainer(path);
        const json document = json::parse(container.json);
        return Checker(path, document, container.binary).check();
    } catch (const GltfFault& fault) {
        throw InputError(path.string() + ": " + forMessage(fault.what()));
    } catch (const json::exception& fault) {
        // "[json.exception.parse_error.101] parse error at line 1, column 9: ..."
        const std::string_view text = fault.what();
        const std::size_t start = text.find("] ");
        throw InputError(path.string() + ": has bad JSON: " +
                         forMessage(start == text.npos ? text : text.substr(start + 2)));
    }
}

} // namespace afterglow
