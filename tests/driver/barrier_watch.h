// SPDX-License-Identifier: MIT
#pragma once

#include "tests/driver/gl_override.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace afterglow::test {

/// While it lives, follows every write of a shader, through an image or into a storage block, until
/// a barrier of the right kind. OpenGL 4.5, section 7.12.2: later commands may see it only after
/// glMemoryBarrier with the bit of the way in which they look. llvmpipe needs no barriers, so
/// nothing else notices one that is missing. The commands that it knows are those of the renderer;
/// framebuffers count from their attachments on, if those are made while it lives.
class BarrierWatch {
public:
    BarrierWatch();
    ~BarrierWatch();

    /// Returns each fault once: program, texture, way of access.
    const std::set<std::string>& faults() const { return faults_; }
    std::string text() const;
    int dispatches() const { return dispatches_; }

private:
    enum class Kind { Sampler, Image, Storage };
    struct Slot {
        std::string name;
        Kind kind;
        GLint unit;
    };
    struct Image {
        GLuint texture = 0;
        GLenum access = GL_READ_ONLY;
    };

    const std::vector<Slot>& slotsOf(GLuint program);
    void useProgram(); ///< a dispatch or a draw is about to run
    void use(GLuint texture, GLbitfield bit, const std::string& how);
    void useAttachments(const char* how);
    void useStorage(const Slot& slot);
    void useBuffer(GLuint buffer, GLbitfield bit, const std::string& how);
    void fault(const std::string& text) { faults_.insert(text); }
    std::string programName() const;

    static BarrierWatch* active;

    std::set<std::string> faults_;
    int dispatches_ = 0;
    GLuint program_ = 0, framebuffer_ = 0;
    std::map<GLuint, GLbitfield>
        missing_;                      ///< by texture: the bits without which it may not be used
    std::map<GLuint, GLuint> sampled_; ///< textures by sampler unit
    std::map<GLuint, Image> images_;   ///< by image unit
    std::map<GLuint, GLuint> storage_; ///< buffers by binding point
    std::map<GLuint, GLbitfield> missingOfBuffer_;   ///< as missing_, of what storage blocks wrote
    std::map<GLuint, std::vector<Slot>> slots_;      ///< by program
    std::map<GLuint, std::set<GLuint>> attachments_; ///< by framebuffer
    std::map<GLuint, GLuint> viewOfBuffer_; ///< the texture by which a shader wrote a buffer

    struct Overrides;
    Overrides* overrides_;
};

} // namespace afterglow::test
