// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <string_view>

namespace afterglow {

/// Loads a scene made in code, by its name, or else a .gltf or .glb file, by its path. Throws
/// UsageError, with the nearest known name, for a name that is neither; InputError for a path to no
/// good file.
Scene loadScene(std::string_view nameOrPath);

} // namespace afterglow
