// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/base/embedded_file.h"

#include <span>

namespace afterglow {

// Files that are linked into the program, so that it finds them wherever it runs.

std::span<const EmbeddedFile> embeddedExperiments(); ///< assets/experiments, by name
std::span<const EmbeddedFile> embeddedPresets();     ///< assets/presets, by name
std::span<const EmbeddedFile> embeddedTour();        ///< assets/tour, by name
/// assets/report: the page, its style, and its scripts in the order in which they run.
std::span<const EmbeddedFile> embeddedReport();
std::span<const EmbeddedFile> embeddedFonts(); ///< Roboto: regular, then medium; TrueType

} // namespace afterglow
