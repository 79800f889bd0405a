// SPDX-License-Identifier: MIT
#pragma once

// Lets one header be both C++ and GLSL. Everything it needs is here.

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define SHARED_BEGIN                                                                               \
    namespace afterglow::gpu {                                                                     \
    using namespace glm;                                                                           \
    using uint = std::uint32_t;
#define SHARED_END }
#else
#define SHARED_BEGIN
#define SHARED_END
#endif
