// SPDX-License-Identifier: MIT
#include "app/base/progress.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace afterglow {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int) {
    interrupted = 1;
}

} // namespace

void catchInterrupts() {
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = int(SA_RESETHAND); // the next one is not for us
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

Progress::Progress(double total)
    : total_(std::max(total, 1e-9)), visible_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (visible_)
        std::fputs("\r\033[K", stderr);
}

void Progress::advance(double work, std::string_view doing) {
    if (interrupted != 0)
        throw Interrupted();
    done_ = std::min(done_ + work, total_);
    const auto now = Clock::now();
    if (!visible_ || (now - drawn_ < std::chrono::milliseconds(100) && done_ < total_))
        return;
    drawn_ = now;
    constexpr int kCells = 28;
    const double whole = std::max(total_ - skipped_, done_);
    const double part = whole > 0.0 ? done_ / whole : 1.0;
    const int filled = int(part * kCells);
    std::string bar(std::size_t(filled), '=');
    if (filled < kCells)
        bar += '>';
    bar.resize(kCells, ' ');
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const std::string left = clockText(elapsed * (1.0 - part) / std::max(part, 1e-6));
    fmt::print(stderr, "\r\033[K[{}] {:3} %  {} left  {}", bar, int(part * 100.0), left, doing);
    std::fflush(stderr);
}

void Progress::skip(double work) {
    skipped_ = std::min(skipped_ + work, total_);
}

std::string clockText(double seconds) {
    const auto whole = (long long)(std::clamp(seconds, 0.0, 359999.0) + 0.5);
    return whole >= 3600 ? fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
                         : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace afterglow
