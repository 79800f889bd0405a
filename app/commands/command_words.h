// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/bench.h"
#include "app/commands/exchange.h"
#include "app/commands/render.h"
#include "app/window/view.h"

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace afterglow {

// For command_line.cpp: the words of each command, as they stand on the command line. addTo() names
// them to the parser; parse() makes values of them, or throws UsageError.

/// The words of one option, as they stand on the command line. Every option of the program is read
/// as text, so that all of them complain alike.
using Text = std::optional<std::string>;
using Texts = std::vector<std::string>;

/// A line of every help text.
extern const std::string kExitCodes;

CLI::Option* addOption(CLI::App& app, const std::string& name, Text& text, const char* type,
                       const std::string& help);

/// The context and the device of EGL that a command without a window asks for.
struct ContextWords {
    Text name, device;

    void addTo(CLI::App& app);
    ContextWish parse() const { return contextFrom(name, device); }
};

/// What render, view and bench say about the picture.
struct PictureWords {
    Text filter, signal, camera, size, seed, frames;
    ContextWords context;
    Texts lights, settings;

    void addSettings(CLI::App& app);
    void addFilter(CLI::App& app);
    void addSeed(CLI::App& app);

    Settings toSettings() const;
    std::vector<LightEvent> toLightEvents() const;
    std::uint32_t toSeed() const;
};

struct RenderWords {
    PictureWords picture;
    Text scene, aovs, format, samples, every, rate, out;
    bool animate = false, last = false, exports = false;

    void addTo(CLI::App& app);
    RenderOptions parse() const;       ///< without --export
    ExportOptions parseExport() const; ///< with it
};

struct ViewWords {
    PictureWords picture;
    Text scene, screenshot;
    bool still = false, debug = false, resetSettings = false;
    Text uiCost, shaders;

    void addTo(CLI::App& app);
    ViewOptions parse() const;
};

struct BenchWords {
    PictureWords picture;
    Text scene, filters, sizes, out;

    void addTo(CLI::App& app);
    BenchOptions parse() const;
};

} // namespace afterglow
