#include "renderer/passes/frame_context.h"

namespace afterglow {

Defines definesOf(Kernel kernel) {
    return {{"KERNEL_RADIUS", kernel == Kernel::B3Spline5x5 ? "2" : "1"}};
}

} // namespace afterglow
