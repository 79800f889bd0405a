// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace afterglow {

/// A place to come back to.
struct CameraBookmark {
    std::string name;
    glm::vec3 position{0.0f};                      ///< meters, world
    glm::quat orientation{1.0f, 0.0f, 0.0f, 0.0f}; ///< as in Camera
    float verticalFov = 0.9f;                      ///< radians, in (0, pi)

    bool operator==(const CameraBookmark&) const = default;
};

/// What the window remembers from one run to the next.
struct Preferences {
    /// Screen coordinates, each in [kLeastWindow, kMostWindow].
    glm::ivec2 windowSize{1600, 900};
    bool showPanel = true;
    float uiScale = 0.0f; ///< in [0.5, 4]; 0: as the screen says
    bool vsync = true;
    bool smoothScaling = true;
    std::string lastScene; ///< a name or a path; empty: none
    /// Scenes and experiments, the newest first: absolute, all different, at most kRecentFiles.
    std::vector<std::filesystem::path> recentFiles;
    /// By scene, as in lastScene; at most kBookmarks for each.
    std::map<std::string, std::vector<CameraBookmark>> bookmarks;
    bool tourDone = false;

    bool operator==(const Preferences&) const = default;
};

constexpr std::size_t kRecentFiles = 10;
constexpr std::size_t kBookmarks = 9; ///< one a digit key
constexpr int kLeastWindow = 64, kMostWindow = 16384;

/// Puts a file in front of the recent ones; a relative path is taken from the current folder.
void rememberFile(Preferences& preferences, const std::filesystem::path& file);

/// Remembers a place in a scene, instead of one of the same name. UsageError if that would be one
/// too many.
void rememberPlace(Preferences& preferences, const std::string& scene, CameraBookmark bookmark);

/// What says where the files of a user are; see the XDG Base Directory Specification.
struct ConfigEnvironment {
    std::string xdgConfigHome, home; ///< empty: not set
};
ConfigEnvironment configEnvironment(); ///< of this process

/// "afterglow" in $XDG_CONFIG_HOME, or else in ~/.config. A path that is not absolute counts as not
/// set; empty if nothing is left.
std::optional<std::filesystem::path>
configFolder(const ConfigEnvironment& environment = configEnvironment());

struct LoadedPreferences {
    Preferences preferences; ///< what was broken is at its default
    std::string warning;     ///< one line: file, place and cause; empty: nothing was broken
};

/// A file that is not there is no fault.
LoadedPreferences loadPreferences(const std::filesystem::path& path);

/// Writes the file, whole or not at all, and the folders that it lies in. A broken one that was
/// there is kept beside it as NAME.broken. Error, naming the path, if that fails.
void savePreferences(const std::filesystem::path& path, const Preferences& preferences);

/// Removes this file and nothing else; it need not be there. Error if that fails.
void resetPreferences(const std::filesystem::path& path);

} // namespace afterglow
