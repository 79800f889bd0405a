// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>

namespace afterglow {

/// Reads a glTF 2.0 scene, .gltf or .glb, completed (see completeScene). Its default scene, else
/// its first, else all nodes. It has triangles, strips and fans; normals (flat ones where the file
/// has none); the node hierarchy; the factors of metallic-roughness materials with
/// KHR_materials_emissive_strength, and the names of their textures; perspective cameras; animation
/// of nodes, step and linear.
///
/// Throws InputError for everything else that a file can be: "path: reason", one line. Refused on
/// purpose: other required extensions, sparse accessors, cubic spline animation, an orthographic
/// camera if there is no other, and files outside of the folder of the scene. Skins, morph targets,
/// points and lines are left out, which is logged, as are triangles without area.
///
/// Departs from glTF: a primitive without a material is a light gray diffuse one, not a white
/// metal.
Scene importGltf(const std::filesystem::path& path);

} // namespace afterglow
