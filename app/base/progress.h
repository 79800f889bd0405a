// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <exception>
#include <string>
#include <string_view>

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

/// A line on standard error that tells how far the work is and how long it will still take. It
/// shows itself only on a terminal, and is gone when the object is.
class Progress {
public:
    explicit Progress(double total); ///< work in any unit
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Throws Interrupted if the program has been asked to end.
    void advance(double work, std::string_view doing);
    /// That much of the work was done before.
    void skip(double work);

private:
    using Clock = std::chrono::steady_clock;
    double total_, done_ = 0.0, skipped_ = 0.0;
    bool visible_;
    Clock::time_point start_ = Clock::now(), drawn_{};
};

/// "0:07", "12:30", "1:02:03".
std::string clockText(double seconds);

} // namespace afterglow
