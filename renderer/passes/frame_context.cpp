// SPDX-License-Identifier: MIT
#include "renderer/passes/frame_context.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {

PassScope::Report::Report(PassListener* to, std::string pass,
                          std::initializer_list<const GpuTexture*> from)
    : listener(to), name(std::move(pass)), count(from.size()) {
    if (count > made.size())
        throw std::logic_error("pass " + name + " makes more images than a pass may");
    std::ranges::copy(from, made.begin());
}

PassScope::Report::~Report() {
    if (listener)
        listener->passDone(name, {made.data(), count});
}

Binding FrameContext::block() const {
    if (!uniforms)
        throw std::logic_error("a pass of a frame runs without the frame's uniform block");
    return {"Frame", *uniforms};
}

Defines definesOf(Kernel kernel, float sigmaNormal) {
    Defines defines{{"KERNEL_RADIUS", kernel == Kernel::B3Spline5x5 ? "2" : "1"}};
    for (int squarings = 0; squarings <= 10; ++squarings)
        if (sigmaNormal == float(1 << squarings))
            defines.emplace_back("NORMAL_SQUARINGS", std::to_string(squarings));
    return defines;
}

} // namespace afterglow
