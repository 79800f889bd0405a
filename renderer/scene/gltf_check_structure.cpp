// SPDX-License-Identifier: MIT
// How a glTF document puts its parts together: cameras, meshes, nodes and their hierarchy, scenes
// and animations.

#include "renderer/scene/gltf_checker.h"
#include "renderer/scene/gltf_container.h"

#include <set>

#include <nlohmann/json.hpp>

namespace afterglow {

using nlohmann::json;

void GltfChecker::checkCameras() {
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

void GltfChecker::checkMeshes() {
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

json GltfChecker::checkPrimitive(const GltfView& primitive) {
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

void GltfChecker::checkNodes() {
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

void GltfChecker::checkScenes() {
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

void GltfChecker::checkAnimations() {
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

void GltfChecker::checkChannel(const GltfView& channel, const std::vector<GltfView>& samplers) {
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

} // namespace afterglow
