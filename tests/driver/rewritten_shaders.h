// SPDX-License-Identifier: MIT
#pragma once

#include "tests/driver/gl_override.h"

#include <functional>
#include <string>
#include <string_view>

namespace afterglow::test {

/// While it lives, what is compiled is not the text that was handed over but what `rewrite` makes
/// of it. `name` is that of the shader's file.
class RewrittenShaders {
public:
    using Rewrite = std::function<std::string(std::string_view name, std::string text)>;
    explicit RewrittenShaders(Rewrite rewrite);
    ~RewrittenShaders();

    int changed() const { return changed_; } ///< texts that are not as they were

private:
    static void GLAPIENTRY source(GLuint shader, GLsizei count, const GLchar* const* texts,
                                  const GLint* lengths);

    static RewrittenShaders* active;
    Rewrite rewrite_;
    int changed_ = 0;
    GlOverride<PFNGLSHADERSOURCEPROC> source_;
};

/// `from` stands in the text, at least once, or this is std::logic_error.
std::string replaced(std::string text, std::string_view from, std::string_view to);

/// Workgroups take each other's places: the first one does what the last one did. OpenGL promises
/// no order between them.
std::string withReversedGroups(std::string text);

/// Every product of floats that is not exact may be rounded up or down: another way at each
/// evaluation, but the same ways in the next run of the program. That is what a compiler does to
/// products when it contracts them with a sum, or not, as it likes. Statements that declare a
/// `precise` variable are left alone, as GLSL 4.50, section 4.9 demands; so are constants.
std::string withRoughProducts(std::string text);

} // namespace afterglow::test
