// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/shader_library.h"

namespace afterglow {

/// Returns the back end that AFTERGLOW_CONTEXT names: "osmesa" (also when it is not set), "egl" or
/// "auto".
Backend testBackend();

/// Returns the one context of a test process, made when it is first asked for. Bindings are strict
/// from then on. Ask again in every test case: a test may have released it.
GlContext& testContext();

/// Returns the shaders as the program itself finds them, in testContext().
ShaderLibrary& testShaders();

/// Ends the context and the library, for a test that makes contexts of its own, and for main().
void releaseTestContext();

/// Returns the number of messages that glMessageCount() counts and that no ExpectGlMessages covers.
/// The process fails when there are any, and names the test case; a test need do nothing for it.
int unexpectedGlMessages();

/// Fails the test case, where it stands, when OpenGL complains between its construction and its
/// end.
class GlCheck {
public:
    GlCheck();
    GlCheck(const GlCheck&) = delete;
    GlCheck& operator=(const GlCheck&) = delete;
    ~GlCheck();

private:
    int before_;
};

/// Complaints of OpenGL while it lives are what the test is about: they are neither counted nor
/// logged.
class ExpectGlMessages {
public:
    ExpectGlMessages();
    ExpectGlMessages(const ExpectGlMessages&) = delete;
    ExpectGlMessages& operator=(const ExpectGlMessages&) = delete;
    ~ExpectGlMessages();
    int count() const; ///< so far

private:
    int before_;
};

} // namespace afterglow
