// SPDX-License-Identifier: MIT
#pragma once

#include <glad/gl.h>

namespace afterglow::test {

/// Stands in for one OpenGL function of the loader while it lives. Those of one function nest: the
/// youngest is called first, and before() is what it stands in for.
template <class Function>
class GlOverride {
public:
    GlOverride(Function& loaded, Function standIn) : loaded_(loaded), before_(loaded) {
        loaded_ = standIn;
    }
    GlOverride(const GlOverride&) = delete;
    GlOverride& operator=(const GlOverride&) = delete;
    ~GlOverride() { loaded_ = before_; }

    Function before() const { return before_; }

private:
    Function& loaded_;
    Function before_;
};

} // namespace afterglow::test
