#pragma once

#include "app/commands/command_words.h"

namespace afterglow {

struct ImportWords {
    Text exported, frames, name, quantity, filters, samples, cache, context, out;
    bool only = false, noCache = false;

    void addTo(CLI::App& app);
    ImportOptions parse() const;
};

} // namespace afterglow
