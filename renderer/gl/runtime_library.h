// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace afterglow {

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
