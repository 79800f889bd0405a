// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// The parts of a .gltf or .glb file.
struct GltfContainer {
    std::string json;                  ///< the JSON text
    std::optional<std::string> binary; ///< the binary chunk of a .glb
};

/// Reads a file after glTF 2.0, section 4. Throws InputError, naming the file, if it is not glTF 2
/// or is cut off.
GltfContainer readGltfContainer(const std::filesystem::path& path);

/// Returns the file that a URI of a scene file means. Throws std::invalid_argument, with the
/// reason, if that is not a relative path to something in the folder of the scene, symbolic links
/// followed.
std::filesystem::path resolveGltfUri(const std::filesystem::path& sceneFile, std::string_view uri);

/// Returns the bytes of a data URI in base64. Throws std::invalid_argument, with the reason, if it
/// is none.
std::vector<unsigned char> decodeDataUri(std::string_view uri);

/// Makes text fit for a message: one line, no control characters, not endless.
std::string forMessage(std::string_view text);

} // namespace afterglow
