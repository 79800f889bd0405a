// SPDX-License-Identifier: MIT
#include "app/base/interrupt.h"

#include <csignal>

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

void throwIfInterrupted() {
    if (interrupted != 0)
        throw Interrupted();
}

} // namespace afterglow
