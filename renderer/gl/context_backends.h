// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/runtime_library.h"

namespace afterglow {

// Makes a context for context.cpp; one function a back end. Each opens its library at run time and
// throws ContextError when that is missing or has no OpenGL 4.5.
std::unique_ptr<GlContext> createOsMesaContext(const ContextOptions& options);
std::unique_ptr<GlContext> createEglContext(const ContextOptions& options);

} // namespace afterglow
