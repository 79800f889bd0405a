// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace afterglow {

/// A glTF document that may be believed. All that the importer reads is there, of the right type,
/// in range and without loops; the rest (extras, skins, pictures, other extensions) has been taken
/// out.
///
/// Its JSON is parsed a second time, by tinygltf, which accepts text only. tinygltf drops an
/// optional member of the wrong type silently and keeps an index that is out of range; the check
/// refuses the file and names the place.
struct GltfDocument {
    std::string json;                                ///< buffer i has the uri "i"
    std::vector<std::vector<unsigned char>> buffers; ///< exactly as long as they say
    std::vector<std::string> textures;               ///< a name for each, perhaps empty
    std::vector<std::string> warnings;               ///< what is there but is left out
};

/// Reads a file. Throws InputError, "path: reason", for everything that importGltf() refuses, but
/// for the values in the buffers, which are not looked at here.
GltfDocument readGltfDocument(const std::filesystem::path& path);

} // namespace afterglow
