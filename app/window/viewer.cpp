// SPDX-License-Identifier: MIT
#include "app/window/viewer.h"

#include "app/base/output.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr double kIdleSeconds = 0.05;   // between two looks at a paused or minimized window
constexpr double kTitleSeconds = 0.5;   // between two titles
constexpr float kLookPerUnit = 0.0025f; // radians per screen coordinate of a drag
constexpr float kDividerReach = 6.0f;   // screen coordinates

double secondsSince(std::chrono::steady_clock::time_point before) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

WorkbenchFolders folders() {
    const auto config = configFolder();
    return {.output = std::filesystem::current_path(),
            .presets = config ? *config / "presets" : std::filesystem::path()};
}

} // namespace

Viewer::Viewer(const ViewOptions& options, Scene scene, ViewState state)
    : options_(options), window_({.title = "Afterglow: " + scene.name,
                                  .size = options.size.value_or(state.preferences.windowSize),
                                  .debugContext = options.debugContext}),
      gl_(glInfo(window_)), shaders_(makeShaderLibrary(gl_, options.shaders)),
      workbench_(shaders_, gl_, std::move(scene), std::move(state), folders()),
      ui_(window_.handle(), window_.contentScale()) {
    ViewState& s = workbench_.state;
    const glm::ivec2 view = layoutOf(window_.framebufferSize(), ui_.wishes(s)).view.size;
    s.resolution = startResolution(gl_.softwareRasterizer, view);
    if (!s.preferences.tourDone && s.preferences.recentFiles.empty() && options.frames == 0)
        notify(s, "F1 shows all keys, F6 begins a guided tour");
}

bool Viewer::isLastFrame() const {
    return options_.frames > 0 && rendered_ >= options_.frames;
}

void Viewer::run() {
    if (options_.uiCost > 0)
        return measureUiCost();
    Clock::time_point before = Clock::now();
    double rest = 0.0; // seconds before the next round, unless something happens
    ViewState& state = workbench_.state;
    while (!state.quit && !window_.closeWanted()) {
        const WindowInput input = rest > 0.0 ? window_.wait(rest) : window_.poll();
        const double seconds = secondsSince(before);
        before = Clock::now();
        takeInput(input, seconds);
        serveRequests();

        const glm::ivec2 framebuffer = window_.framebufferSize();
        const bool visible = !window_.isMinimized() && framebuffer.x > 0 && framebuffer.y > 0;
        const Layout layout = layoutOf(framebuffer, ui_.wishes(state));
        const bool done = isLastFrame();
        const bool rendered =
            workbench_.advance(seconds, visible && !done ? layout.view.size : glm::ivec2(0));
        rendered_ += rendered;
        rest = visible ? std::min(workbench_.secondsUntilFrame(), kIdleSeconds) : kIdleSeconds;
        if (!visible)
            continue;
        drawWindow(framebuffer, layout);
        if (isLastFrame()) {
            if (options_.screenshot)
                writePng(*options_.screenshot, presenter_.readWindow(framebuffer));
            break;
        }
        window_.swap();
        rememberWindow();
        updateTitle();
    }
}

void Viewer::takeInput(const WindowInput& input, double seconds) {
    takeStrokes(input);
    flyCamera(input, seconds);
    pointAt(input);
    if (!input.dropped.empty())
        workbench_.state.wanted.open = input.dropped.front();
    if (vsync_ != workbench_.state.preferences.vsync) {
        vsync_ = workbench_.state.preferences.vsync;
        window_.waitForScreen(vsync_);
    }
}

void Viewer::takeStrokes(const WindowInput& input) {
    if (ui_.wantsKeyboard())
        return;
    ViewState& state = workbench_.state;
    for (const KeyStroke& stroke : input.strokes) {
        // In the panel all keys are its own but those that lead out of it.
        const bool leaves = stroke == KeyStroke{Key::F10} || stroke == KeyStroke{Key::Escape};
        if (!state.keyboardInPanel || leaves)
            press(state, stroke);
    }
}

void Viewer::flyCamera(const WindowInput& input, double seconds) {
    ViewState& state = workbench_.state;
    if (input.rightPressed && !ui_.wantsMouse())
        looking_ = true;
    const bool looks = looking_; // also where the button goes up within this same round
    if (input.rightReleased)
        looking_ = false;
    if (input.rightPressed || input.rightReleased)
        window_.captureCursor(looking_);
    if (input.wheel != 0.0f && (looking_ || !ui_.wantsMouse()))
        state.speed = changedSpeed(state.speed, input.wheel, state.extent);

    FlyInput hands;
    if (looks)
        hands.look = kLookPerUnit * glm::vec2(input.cursorMoved.x, -input.cursorMoved.y);
    if (!ui_.wantsKeyboard() && !state.keyboardInPanel && !window_.isDown(Key::Control)) {
        const auto axis = [this](char more, char less) {
            return float(window_.isDown(keyOf(more))) - float(window_.isDown(keyOf(less)));
        };
        hands.move = {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
        hands.fast = window_.isDown(Key::Shift);
    }
    fly(state.camera, hands, state.speed, std::min(seconds, 0.25));
}

// A frame may take so long that a whole drag lies within it: each part of it counts where it was.
void Viewer::pointAt(const WindowInput& input) {
    PointerInput hand{.position = window_.cursor(),
                      .adds = window_.isDown(Key::Shift),
                      .exact = window_.isDown(Key::Control),
                      .onPicture = !ui_.coversPictures(workbench_.state) && !looking_,
                      .reach = kDividerReach * window_.contentScale()};
    const auto move = [&](glm::vec2 position, bool pressed, bool released) {
        hand.position = position;
        hand.pressed = pressed;
        hand.released = released;
        movePointer(pointer_, workbench_.state, hand, places_, workbench_.imageSize());
    };
    if (input.leftPressed)
        move(input.leftPressedAt, true, false);
    if (input.leftReleased)
        move(input.leftReleasedAt, false, true);
    move(window_.cursor(), false, false);
}

// What only the window can do.
void Viewer::serveRequests() {
    ViewState& state = workbench_.state;
    if (std::exchange(state.wanted.probeAtMouse, false))
        probeAtMouse(state, workbench_.imageSize());
    if (std::exchange(state.wanted.pastePreset, false))
        workbench_.paste(window_.clipboard());
    if (const auto copied = workbench_.takeCopied())
        window_.setClipboard(*copied);
    if (const auto stop = std::exchange(state.wanted.tourStop, {}))
        workbench_.enterTourStop(*stop,
                                 layoutOf(window_.framebufferSize(), ui_.wishes(state)).view.size);
}

void Viewer::drawWindow(glm::ivec2 framebuffer, const Layout& layout) {
    ViewState& state = workbench_.state;
    presenter_.clear(framebuffer);
    places_ = placesOf(state.panes, layout.view, workbench_.imageSize());
    for (const PanePlace& place : places_)
        if (const GpuTexture* const picture = workbench_.picture(place.pane))
            presenter_.draw(*picture, place.picture, place.shown, framebuffer,
                            state.preferences.smoothScaling);
    ui_.draw(workbench_, {layout, places_, pointer_, window_.contentScale()});
    if (std::exchange(state.wanted.window, false))
        workbench_.save(presenter_.readWindow(framebuffer));
}

void Viewer::rememberWindow() {
    if (!window_.isMinimized())
        workbench_.state.preferences.windowSize =
            glm::clamp(window_.sizeInUnits(), glm::ivec2(kLeastWindow), glm::ivec2(kMostWindow));
}

void Viewer::updateTitle() {
    if (secondsSince(titled_) < kTitleSeconds)
        return;
    titled_ = Clock::now();
    const glm::ivec2 size = workbench_.imageSize();
    const std::string title = fmt::format("Afterglow: {}  {} x {}  {}", workbench_.scene().name,
                                          size.x, size.y, timeText(workbench_.timings()));
    if (title != title_)
        window_.setTitle(title_ = title);
}

// Frames alone, as headless, and frames in the window with all panels and a probe, in turns, on the
// same scene and size.
void Viewer::measureUiCost() {
    ViewState& state = workbench_.state;
    window_.waitForScreen(false);
    const glm::ivec2 framebuffer = window_.framebufferSize();
    const auto open = [&](bool all) {
        state.preferences.showPanel = state.showStrip = state.showCurves = state.showInspector =
            state.showPasses = all;
        clearProbes(state);
        if (all && workbench_.imageSize().x > 0) {
            const glm::ivec2 image = workbench_.imageSize();
            setProbe(state, 0, probeBetween(image / 4, image / 2, image), image);
            state.inspected = PanePixel{state.panes.active, image / 2};
        }
    };
    open(true);
    const Layout layout = layoutOf(framebuffer, ui_.wishes(state));
    std::vector<double> alone, shown;
    constexpr int kWarmUp = 3;
    for (int i = 0; i < options_.uiCost + kWarmUp; ++i) {
        for (const bool withWindow : {false, true}) {
            open(withWindow);
            const Clock::time_point start = Clock::now();
            workbench_.advance(0.02, layout.view.size);
            if (withWindow) {
                takeInput(window_.poll(), 0.02);
                drawWindow(framebuffer, layout);
                window_.swap();
            }
            glFinish();
            if (i >= kWarmUp)
                (withWindow ? shown : alone).push_back(1000.0 * secondsSince(start));
        }
    }
    const double without = median(alone), with = median(shown);
    const glm::ivec2 size = workbench_.imageSize();
    std::printf("%s at %d x %d in a window of %d x %d: %.2f ms a frame alone, %.2f ms with the "
                "interface, ratio %.3f\n",
                workbench_.scene().name.c_str(), size.x, size.y, framebuffer.x, framebuffer.y,
                without, with, with / without);
}

} // namespace afterglow
