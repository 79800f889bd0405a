// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/scene_bvh.h"

#include <vector>

namespace afterglow {

/// Returns the triangles that a tree holds, in the world, each as a leaf of its own.
std::vector<gpu::BvhTriangle> trianglesOf(const SceneBvh& bvh);

} // namespace afterglow
