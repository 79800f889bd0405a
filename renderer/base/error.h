// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace afterglow {

/// Something outside this program is not as it must be. The message names what was wanted, what was
/// found and where; it is one line and is shown to the user as it stands.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The command line is wrong: exit code 2.
class UsageError : public Error {
public:
    using Error::Error;
};

/// A file that was given is missing, malformed or asks for something that cannot be had: exit
/// code 3.
class InputError : public Error {
public:
    using Error::Error;
};

/// No OpenGL 4.5 context can be had: exit code 4.
class ContextError : public Error {
public:
    using Error::Error;
};

} // namespace afterglow
