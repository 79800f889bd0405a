#include "renderer/scene/load_scene.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_import.h"
#include "renderer/scene/procedural.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace afterglow {

namespace {

/// The letters to insert, delete or replace to make one word of the other (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

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
    const auto nearest =
        std::min_element(known.begin(), known.end(), [&](const SceneInfo& a, const SceneInfo& b) {
            return distance(a.name, nameOrPath) < distance(b.name, nameOrPath);
        });
    throw UsageError("there is no scene and no file named \"" + std::string(nameOrPath) +
                     "\"; did you mean \"" + std::string(nearest->name) + "\"?");
}

} // namespace afterglow
