// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_words.h"

namespace afterglow {

struct ImportWords {
    Text exported, frames, name, quantity, filters, samples, cache, out;
    ContextWords context;
    bool only = false, noCache = false, fresh = false;

    void addTo(CLI::App& app);
    ImportOptions parse() const;
};

} // namespace afterglow
