#include "app/workbench/take.h"

namespace afterglow {

bool sameView(const Camera& a, const Camera& b) {
    return a.position == b.position && a.orientation == b.orientation &&
           a.lens.verticalFov == b.lens.verticalFov && a.lens.near == b.lens.near &&
           a.lens.far == b.lens.far;
}

bool FrameMoment::operator==(const FrameMoment& other) const {
    return seconds == other.seconds && sameView(camera, other.camera) && lights == other.lights &&
           marks == other.marks && step == other.step;
}

} // namespace afterglow
