// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/headless.h"
#include "app/commands/options.h"
#include "app/measure/reference.h"
#include "app/scenario/variant.h"

namespace afterglow {

// Groups of options that several commands have.

/// --context and --device
struct ContextGroup : ContextWish {
    void addTo(Options& options);
};

/// --signal, and --set with any number of settings
struct SettingsGroup {
    std::optional<Signal> signal;
    std::vector<Assignment> changes;

    void addTo(Options& options);
    /// The settings with these changed.
    Settings changed(Settings settings) const;
};

/// --cache and --no-cache
struct CacheGroup {
    std::string folder; ///< empty: the user's
    bool none = false;

    void addTo(Options& options);
    ReferenceStore store(const Headless& headless) const;
};

Kind<Signal> signalName();
Kind<Variant> filterName(); ///< of a filter or a preset
/// A filter or preset by name, with settings of its own: "asvgf:alpha=0.1:lambdaFetch=nearest".
Kind<Variant> filterWithSettings();
Kind<Assignment> setting(); ///< KEY=VALUE of a setting that there is

} // namespace afterglow
