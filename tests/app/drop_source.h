// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow::test {

/// Drops files on a window as a file manager does: XDND version 5, one text/uri-list. `window` is
/// its X id, `at` a place inside in its own pixels. Comes back when the window has said that it is
/// done. std::runtime_error when it takes no files, refuses these, or is silent for so long.
void dropFiles(const std::string& display, const std::string& window,
               const std::vector<std::filesystem::path>& files, glm::ivec2 at,
               double seconds = 10.0);

} // namespace afterglow::test
