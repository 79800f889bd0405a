// SPDX-License-Identifier: MIT
// glTF 2.0, section 5 and the rules of section 3, for what the importer reads. The parser behind it
// is given only what has passed here: it does not mind indices out of range, and we do.

#include "renderer/scene/gltf_check.h"

#include "renderer/base/error.h"
#include "renderer/base/json.h"
#include "renderer/scene/gltf_checker.h"
#include "renderer/scene/gltf_container.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::string_view kExtensions[] = {"KHR_materials_emissive_strength"};

} // namespace

GltfDocument GltfChecker::check() {
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
    result_.json = jsonText(out_);
    return std::move(result_);
}

void GltfChecker::checkAsset() {
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

GltfDocument readGltfDocument(const fs::path& path) {
    try {
        const GltfContainer container = readGltfContainer(path);
        const json document = parseSortedJson(container.json);
        return GltfChecker(path, document, container.binary).check();
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
