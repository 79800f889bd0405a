// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/output.h"
#include "renderer/pipeline/aov.h"

#include <optional>

namespace afterglow {

/// Writes an image of the last frame, or one of each signal where it has several: "raw", or
/// "raw_shadows" and "raw_ao", with the frame's number behind it where one is given. Returns how
/// many files that were.
int writeAov(const OutputFolder& folder, std::string_view format, const Renderer& renderer,
             const AovInfo& aov, std::optional<int> frame = {}, std::size_t state = 0);

} // namespace afterglow
