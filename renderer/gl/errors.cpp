// SPDX-License-Identifier: MIT
#include "renderer/gl/errors.h"

#include "renderer/base/error.h"

#include <cstdio>
#include <mutex>
#include <vector>

#include <glad/gl.h>

namespace afterglow {

namespace {

// A driver may report from a thread of its own.
struct Account {
    std::mutex mutex;
    int reported = 0, unreported = 0;
    int reportedAtSweep = 0;
    int beforeContext = 0; ///< those of earlier contexts
    std::string first;
};

Account& account() {
    static Account shared;
    return shared;
}

std::string nameOf(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST: return "GL_CONTEXT_LOST";
    default: return "error " + std::to_string(error);
    }
}

/// Takes every error that glGetError() holds: a flag for each kind. A context that is lost
/// (GL_CONTEXT_LOST) reports that without end.
std::vector<GLenum> takeErrors() {
    constexpr std::size_t kKinds = 8;
    std::vector<GLenum> errors;
    while (errors.size() < kKinds) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR)
            break;
        errors.push_back(error);
    }
    return errors;
}

/// Counts these errors unless the driver has reported since the last time: then they are the same.
void countTaken(const std::vector<GLenum>& errors) {
    Account& all = account();
    const std::lock_guard lock(all.mutex);
    if (all.reported == all.reportedAtSweep && !errors.empty()) {
        all.unreported += int(errors.size());
        if (all.first.empty())
            all.first = nameOf(errors.front());
    }
    all.reportedAtSweep = all.reported;
}

} // namespace

int glErrorCount() {
    const std::lock_guard lock(account().mutex);
    return account().reported + account().unreported;
}

std::string firstGlError() {
    const std::lock_guard lock(account().mutex);
    return account().first;
}

void sweepGlErrors() {
    countTaken(takeErrors());
}

void requireNoGlErrors(int before) {
    const int errors = glErrorCount() - before;
    if (errors > 0)
        throw Error("OpenGL failed " + std::to_string(errors) + (errors == 1 ? " time" : " times") +
                    ", first with \"" + firstGlError() +
                    "\": what was written may be wrong; delete it");
}

bool hasContextFailed() {
    sweepGlErrors();
    return glErrorCount() > account().beforeContext;
}

void requireSoundContext() {
    sweepGlErrors();
    requireNoGlErrors(account().beforeContext);
}

void beginGlErrors() {
    account().beforeContext = glErrorCount();
}

void noteReportedGlError(std::string_view message) {
    const std::lock_guard lock(account().mutex);
    ++account().reported;
    if (account().first.empty())
        account().first = message;
}

std::string mebibytes(std::size_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MiB", double(bytes) / (1024.0 * 1024.0));
    return text;
}

void requireAllocated(std::string_view object, std::string_view wanted, std::size_t bytes) {
    std::vector<GLenum> errors = takeErrors();
    const bool isFull = std::erase(errors, GLenum(GL_OUT_OF_MEMORY)) > 0;
    countTaken(errors);
    if (!isFull)
        return;
    throw Error(std::string(object) + ": the driver has no memory for " + std::string(wanted) +
                ", " + mebibytes(bytes));
}

} // namespace afterglow
