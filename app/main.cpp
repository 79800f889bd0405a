// SPDX-License-Identifier: MIT
#include "app/commands/command_line.h"
#include "app/window/window.h"

int main(int argc, char** argv) {
    return afterglow::runCommandLine(argc, argv, afterglow::createHiddenWindowContext);
}
