// SPDX-License-Identifier: MIT
#pragma once

#include <exception>

namespace afterglow {

/// Someone asked the program to end (Ctrl-C, or a plain kill). Thrown between two pieces of work,
/// so that every file is whole.
class Interrupted : public std::exception {
public:
    const char* what() const noexcept override {
        return "interrupted; the same command goes on from here";
    }
};

/// From now on SIGINT and SIGTERM are remembered instead of ending the program; the second one ends
/// it at once.
void catchInterrupts();

/// Throws Interrupted if one came.
void throwIfInterrupted();

} // namespace afterglow
