// SPDX-License-Identifier: MIT
#include "app/commands/shared_options.h"

#include "app/scenario/presets.h"
#include "renderer/base/error.h"

#include <fmt/format.h>

namespace afterglow {

namespace {

constexpr int kMostDevices = 1000;

} // namespace

void ContextGroup::addTo(Options& options) {
    options.add("--context", choice, Kind<ContextChoice>{"NAME", contextFromName},
                "auto, osmesa, egl or glfw [auto]");
    options.add("--device", device, wholeNumber(0, kMostDevices),
                "One of EGL's devices; afterglow list contexts [the first GPU that works]");
    options.check([this] {
        if (!device)
            return;
        if (choice != ContextChoice::Auto && choice != ContextChoice::Egl)
            throw UsageError(fmt::format("--device {}: only EGL has devices to choose from, so "
                                         "--context {} excludes it",
                                         *device, nameOf(choice)));
        const std::size_t count = eglDevices().size();
        if (std::size_t(*device) >= count)
            throw UsageError(fmt::format(
                "--device {}: EGL has {} device{}, counted from 0; see afterglow list contexts",
                *device, count, count == 1 ? "" : "s"));
    });
}

void SettingsGroup::addTo(Options& options) {
    options.add("--signal", signal, signalName(),
                "Which light is traced, and as how many signals: shadows, ao, both, separate; "
                "path, split, bounce [both]");
    options.addEach("--set", changes, setting(),
                    "One tunable of the renderer; again for more. See: afterglow list settings");
}

Settings SettingsGroup::changed(Settings settings) const {
    if (signal)
        settings.lighting.signal = int(*signal);
    for (const auto& [key, value] : changes)
        setField(settings, key, value);
    return settings;
}

void CacheGroup::addTo(Options& options) {
    options.add("--cache", folder, anyText("DIR"),
                "Where references are kept [$XDG_CACHE_HOME/afterglow/references]");
    options.addFlag("--no-cache", none, "Keep no references");
    options.exclude("--cache", {"--no-cache"});
}

ReferenceStore CacheGroup::store(const Headless& headless) const {
    ReferenceMaker maker(headless.shaders, headless.gl);
    if (none)
        return ReferenceStore(std::move(maker));
    if (!folder.empty())
        return ReferenceStore(std::move(maker), ReferenceCache(folder));
    return ReferenceStore::withDefaultCache(std::move(maker));
}

Kind<Signal> signalName() {
    return {"NAME", signalFromName};
}

Kind<Variant> filterName() {
    return {"NAME", variantNamed};
}

Kind<Variant> filterWithSettings() {
    return {"NAME", [](const std::string& text) {
                std::size_t end = std::min(text.find(':'), text.size());
                Variant variant = variantNamed(text.substr(0, end));
                while (end < text.size()) {
                    const std::size_t start = end + 1;
                    end = std::min(text.find(':', start), text.size());
                    const auto [key, value] = setting().read(text.substr(start, end - start));
                    variant.changes.emplace_back(key, value);
                    variant.name += "-" + key + "-" + value;
                }
                return variant;
            }};
}

Kind<Assignment> setting() {
    return {"KEY=VALUE", [](const std::string& text) {
                Assignment change = assignment().read(text);
                Settings scratch;
                setField(scratch, change.first, change.second);
                return change;
            }};
}

} // namespace afterglow
