// SPDX-License-Identifier: MIT
#include "tests/support/source_dir.h"

namespace afterglow {

std::filesystem::path sourceDir() {
    return AFTERGLOW_SOURCE_DIR; // here alone, so that a compiler cache serves every checkout
}

} // namespace afterglow
