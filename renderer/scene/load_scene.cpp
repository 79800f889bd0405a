// SPDX-License-Identifier: MIT
#include "renderer/scene/load_scene.h"

#include "renderer/base/names.h"
#include "renderer/scene/gltf_import.h"
#include "renderer/scene/procedural.h"

#include <filesystem>
#include <string>
#include <vector>

namespace afterglow {

namespace {

bool looksLikePath(std::string_view text) {
    return text.find_first_of("/.\\") != std::string_view::npos;
}

} // namespace

Scene loadScene(std::string_view nameOrPath) {
    const std::vector<SceneInfo> known = proceduralScenes();
    for (const SceneInfo& info : known) {
        if (info.name == nameOrPath) {
            return makeProceduralScene(nameOrPath);
        }
    }
    std::error_code ignored;
    const std::filesystem::path path(nameOrPath);
    if (!nameOrPath.empty() &&
        (looksLikePath(nameOrPath) || std::filesystem::exists(path, ignored))) {
        return importGltf(path);
    }
    std::vector<std::string_view> names;
    for (const SceneInfo& info : known)
        names.push_back(info.name);
    throwUnknownName("scene or file", nameOrPath, names);
}

} // namespace afterglow
