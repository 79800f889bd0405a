#pragma once

#include "renderer/gl/gpu_timer.h"
#include "renderer/gl/shader_source.h"

namespace afterglow {

/// What every pass may use.
struct FrameContext {
    GpuTimer& timer;
};

/// The taps of an a-trous iteration.
enum class Kernel {
    B3Spline5x5, ///< Schied et al. 2017
    Box3x3       ///< the faster one of Schied et al. 2018
};

/// What selects it in a shader; see shaders/lib/kernel.glsl.
Defines definesOf(Kernel kernel);

} // namespace afterglow
