// SPDX-License-Identifier: MIT
#include "app/window/view.h"

#include "app/commands/command.h"
#include "app/commands/shared_options.h"
#include "renderer/base/error.h"

namespace afterglow {

namespace {

/// The command view: opens the window.
class View final : public Command {
public:
    explicit View(Options& options);
    void run(HiddenContextFactory) override;

private:
    ViewOptions o_;
    Variant filter_ = variantOf(Filter::Asvgf);
    SettingsGroup picture_;
    bool still_ = false;
};

View::View(Options& options) {
    options.add("SCENE", o_.scene, anyText(""),
                "A scene by its name (afterglow list scenes) or as a .gltf or .glb file, or an "
                "experiment by its name or as a .json file [the last one, or hall]");
    options.add("--filter", filter_, filterName(),
                "A filter or a preset; afterglow list filters, presets [asvgf]");
    picture_.addTo(options);
    options.add("--size", o_.size, imageSize(), "Of the window [as it was last, or 1600x900]");
    options.add("--seed", o_.seed, seedNumber(), "Of all random numbers, 0 to 4294967295 [0]");
    options.add("--camera", o_.camera, anyText(), "One of the scene's cameras [the first]");
    options.addFlag("--still", still_, "The scene's animation stands still at first");
    options.add("--frames,-n", o_.frames, wholeNumber(1, 1'000'000'000),
                "Closes by itself after N frames");
    options.add("--screenshot", o_.screenshot, anyText("FILE"),
                "Writes the window as PNG after the last frame");
    options.add("--shaders", o_.shaders, anyText("DIR"),
                "Takes the shaders from a folder, as shaders/ of the source, and follows its "
                "changes");
    options.addFlag("--reset-settings", o_.resetSettings,
                    "Forgets window, files and places that are remembered from earlier runs");
    options.add("--ui-cost", o_.uiCost, wholeNumber(1, 100'000),
                "Prints what the interface costs: N frames without and with it, in turns");
    options.addFlag("--debug", o_.debugContext, "Lets the driver check every call");
    options.check([this] {
        if (o_.screenshot && o_.frames == 0)
            throw UsageError("--screenshot is written after the last frame; it needs --frames");
    });
    options.setFooter(R"(F1 in the window shows all keys.

Examples:
  afterglow view
  afterglow view cornell --filter svgf
  afterglow view my.glb --size 1280x720
  afterglow view light-off)");
}

void View::run(HiddenContextFactory) {
    o_.settings = picture_.changed(settingsOf(filter_, Signal::Both));
    o_.animate = !still_;
    runView(o_);
}

} // namespace

const CommandRow kViewCommand{"view", "Opens a window on a scene", make<View>};

} // namespace afterglow
