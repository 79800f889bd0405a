// SPDX-License-Identifier: MIT
#pragma once

#include "tests/driver/gl_override.h"

#include <string>
#include <string_view>
#include <vector>

namespace afterglow::test {

/// The resources that one linked program needs.
struct ProgramNeeds {
    std::string name;
    bool isCompute = false;
    int samplers = 0, images = 0, texelBuffers = 0; ///< texel buffers are samplers or images too
    int uniformBlocks = 0, largestBlock = 0;        ///< number, bytes
    int storageBlocks = 0;
    int looseUniforms = 0;            ///< components outside of blocks
    int threads = 0, longestEdge = 0; ///< of a workgroup
    int sharedBytes = 0;
};

/// While it lives, measures every program that is linked.
class LinkedPrograms {
public:
    LinkedPrograms();
    ~LinkedPrograms();
    const std::vector<ProgramNeeds>& all() const { return all_; }

private:
    static void GLAPIENTRY link(GLuint program);

    static LinkedPrograms* active;
    std::vector<ProgramNeeds> all_;
    GlOverride<PFNGLLINKPROGRAMPROC> link_;
};

/// Bytes of the shared variables that a shader declares.
int sharedBytes(std::string_view shaderText);

/// Returns the needs that exceed the minima of OpenGL 4.5; empty if there are none.
std::string beyondMinima(const ProgramNeeds& needs);

} // namespace afterglow::test
