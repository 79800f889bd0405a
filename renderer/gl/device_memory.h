// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"

#include <cstddef>
#include <optional>

namespace afterglow {

/// Returns the bytes that textures can still take, as far as the driver or the system reports them:
/// of a GPU by NVX_gpu_memory_info or ATI_meminfo, of a software rasterizer what the system has
/// available. Empty where neither does.
std::optional<std::size_t> availableMemory(bool softwareRasterizer);

/// Throws Error, with both numbers, if `bytes` for `purpose` ("images of 1920x1080") are more than
/// that.
void requireMemory(std::size_t bytes, const std::string& purpose, bool softwareRasterizer);

} // namespace afterglow
