// SPDX-License-Identifier: MIT
#include "renderer/gl/runtime_library.h"

#include "renderer/base/error.h"

#include <dlfcn.h>

namespace afterglow {

RuntimeLibrary::RuntimeLibrary(const char* name)
    : name_(name), handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_)
        throw ContextError(name_ + " cannot be opened");
}

void* RuntimeLibrary::address(const char* symbol) const {
    void* found = dlsym(handle_, symbol);
    if (!found)
        throw ContextError(name_ + " has no function " + symbol);
    return found;
}

} // namespace afterglow
