// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"

#include <string>

namespace afterglow {

// Makes a context for context.cpp; one function a back end. Each opens its library at run time and
// throws ContextError when that is missing or has no OpenGL 4.5.
std::unique_ptr<GlContext> createOsMesaContext(const ContextOptions& options);
std::unique_ptr<GlContext> createEglContext(const ContextOptions& options);

/// A library opened at run time. It stays open until the process ends: drivers do not survive being
/// unloaded while a thread of theirs is running.
class RuntimeLibrary {
public:
    explicit RuntimeLibrary(const char* name); ///< throws ContextError

    template <class Function>
    Function* function(const char* symbol) const {
        return reinterpret_cast<Function*>(address(symbol));
    }

private:
    void* address(const char* symbol) const; ///< throws ContextError

    std::string name_;
    void* handle_;
};

} // namespace afterglow
