// SPDX-License-Identifier: MIT
#include "app/bench/scene_triangles.h"

namespace afterglow {

std::vector<gpu::BvhTriangle> trianglesOf(const SceneBvh& bvh) {
    std::vector<gpu::BvhTriangle> triangles;
    for (const BvhRecord& record : bvh.records()) {
        if (!record.isTriangle())
            continue;
        gpu::BvhTriangle triangle = record.triangle();
        triangle.next = 0;
        if ((triangle.instance & gpu::kBvhInstanceMask) != gpu::kBvhInstanceMask) // a null record
            triangles.push_back(triangle);
    }
    return triangles;
}

} // namespace afterglow
