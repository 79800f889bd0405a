// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace afterglow {

/// Returns the number of errors of OpenGL so far, over all contexts of the process: those that
/// drivers reported, and those that sweepGlErrors() found.
int glErrorCount();

/// Returns the first of them in words; empty while there are none.
std::string firstGlError();

/// Counts the errors that glGetError() holds and that no driver reported: a context that was not
/// made for debugging may report nothing. For the end of a context's work.
void sweepGlErrors();

/// Throws Error if there have been errors since there were `before` of them: what was made in the
/// meantime may look whole and be wrong.
void requireNoGlErrors(int before);

/// Returns whether OpenGL has failed since the current context was initialized, reported or not.
bool hasContextFailed();
/// Throws Error if it has.
void requireSoundContext();

/// Starts to count errors anew for a context; initializeGl() calls it.
void beginGlErrors();
/// Counts an error that the driver has reported. The callback of initializeGl() calls it, on any
/// thread.
void noteReportedGlError(std::string_view message);

/// Returns a size as "348.0 MiB".
std::string mebibytes(std::size_t bytes);

/// Throws the Error of allocateGl() if the driver had no memory.
void requireAllocated(std::string_view object, std::string_view wanted, std::size_t bytes);

/// Calls `allocate`, which makes the storage of one object, and throws Error if the driver has no
/// memory for it: "texture raw: the driver has no memory for 61 x 37 pixels of RGBA32F, 0.1 MiB".
/// Errors that were there before stay counted and are not taken for its own.
template <class Allocate>
void allocateGl(std::string_view object, std::string_view wanted, std::size_t bytes,
                Allocate allocate) {
    sweepGlErrors();
    allocate();
    requireAllocated(object, wanted, bytes);
}

} // namespace afterglow
