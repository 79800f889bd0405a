#include "app/commands/view.h"

#include "app/ui/ui.h"
#include "app/window/presenter.h"
#include "app/window/window.h"
#include "app/workbench/pass_timings.h"
#include "app/workbench/view_state.h"
#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/image/image_io.h"
#include "renderer/passes/debug_view_pass.h"
#include "renderer/pipeline/renderer.h"
#include "renderer/scene/load_scene.h"

#include <chrono>
#include <filesystem>

namespace afterglow {
namespace {

constexpr double kIdleSeconds = 0.05;   // between two looks at a paused or minimized window
constexpr double kReloadSeconds = 0.5;  // between two looks at the shader files
constexpr double kStatsSeconds = 0.5;   // between two readings of counters, which wait for the GPU
constexpr float kLookPerUnit = 0.0025f; // radians per screen coordinate of a drag

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point before) {
    return std::chrono::duration<double>(Clock::now() - before).count();
}

/// Something that is due again and again.
class Interval {
public:
    explicit Interval(double seconds) : seconds_(seconds) {}
    bool isDue() {
        if (secondsSince(last_) < seconds_)
            return false;
        last_ = Clock::now();
        return true;
    }

private:
    double seconds_;
    Clock::time_point last_{};
};

/// The frame loop: hands on, to the state, renderer, window and interface, what each has for the
/// others.
class Viewer {
public:
    Viewer(const ViewOptions& options, Scene scene, ViewState state);
    void run();

private:
    void takeInput(const WindowInput& input, double seconds);
    void renderFrame(double seconds);
    const GpuTexture* shownTexture();
    void fitRange();
    void drawWindow(glm::ivec2 framebuffer, const Layout& layout);
    void readCounters();
    void savePicture();
    void saveWindow(glm::ivec2 framebuffer);
    void saveTo(const std::filesystem::path& path, const Image<glm::u8vec4>& image);
    bool isLastFrame() const;

    const ViewOptions& options_;
    Window window_;
    GlInfo gl_;
    ShaderLibrary shaders_;
    Renderer renderer_;
    DebugViewPass debugView_;
    Presenter presenter_;
    Ui ui_;
    ViewState state_;

    PassTimings timings_;
    FrameStats stats_;
    double raysPerSecond_ = 0.0;
    std::vector<std::string> shaderErrors_;
    const GpuTexture* picture_ = nullptr; ///< of the last frame; empty before the first
    GpuTexture debugPicture_;
    glm::ivec2 view_{0}; ///< framebuffer pixels
    bool looking_ = false;
    Interval reload_{kReloadSeconds}, counters_{kStatsSeconds};
};

Viewer::Viewer(const ViewOptions& options, Scene scene, ViewState state)
    : options_(options), window_({.title = "Afterglow: " + scene.name,
                                  .size = options.size,
                                  .debugContext = options.debugContext}),
      gl_(glInfo(window_)), shaders_(makeShaderLibrary(gl_)), renderer_(shaders_, gl_),
      debugView_(shaders_), ui_(window_), state_(std::move(state)) {
    const glm::ivec2 view =
        layoutOf(window_.framebufferSize(), ui_.panelWidth(), state_.showPanel).view.size;
    state_.resolution = startResolution(gl_.softwareRasterizer, view);
    renderer_.setScene(std::move(scene));
}

bool Viewer::isLastFrame() const {
    return options_.frames > 0 && state_.frame >= std::uint32_t(options_.frames);
}

void Viewer::run() {
    Clock::time_point before = Clock::now();
    bool idle = false;
    while (!state_.quit && !window_.closeWanted()) {
        const WindowInput input = idle ? window_.wait(kIdleSeconds) : window_.poll();
        const double seconds = secondsSince(before);
        before = Clock::now();
        passTime(state_, seconds);
        takeInput(input, seconds);

        const glm::ivec2 framebuffer = window_.framebufferSize();
        const bool visible = !window_.isMinimized() && framebuffer.x > 0 && framebuffer.y > 0;
        const Layout layout = layoutOf(framebuffer, ui_.panelWidth(), state_.showPanel);
        view_ = layout.view.size;
        const bool renders = visible && wantsFrame(state_) && !isLastFrame();
        if (renders)
            renderFrame(seconds);
        idle = !renders;
        if (!visible)
            continue;

        if (reload_.isDue())
            shaderErrors_ = shaders_.reload().errors;
        drawWindow(framebuffer, layout);
        if (isLastFrame()) {
            if (options_.screenshot)
                writePng(*options_.screenshot, presenter_.readWindow(framebuffer));
            return;
        }
        window_.swap();
    }
}

void Viewer::takeInput(const WindowInput& input, double seconds) {
    const bool typing = ui_.wantsKeyboard();
    if (!typing)
        for (const KeyStroke& stroke : input.strokes)
            if (const auto command = commandFor(stroke))
                perform(state_, *command);

    if (input.rightPressed && !ui_.wantsMouse())
        looking_ = true;
    const bool looks = looking_; // also where the button goes up within this same round
    if (input.rightReleased)
        looking_ = false;
    if (input.rightPressed || input.rightReleased)
        window_.captureCursor(looking_);
    if (input.wheel != 0.0f && (looking_ || !ui_.wantsMouse()))
        state_.speed = changedSpeed(state_.speed, input.wheel, state_.extent);

    FlyInput hands;
    if (looks)
        hands.look = kLookPerUnit * glm::vec2(input.cursorMoved.x, -input.cursorMoved.y);
    if (!typing && !window_.isDown(Key::Control)) {
        const auto axis = [this](char more, char less) {
            return float(window_.isDown(keyOf(more))) - float(window_.isDown(keyOf(less)));
        };
        hands.move = {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
        hands.fast = window_.isDown(Key::Shift);
    }
    fly(state_.camera, hands, state_.speed, std::min(seconds, 0.25));
}

void Viewer::renderFrame(double seconds) {
    const glm::ivec2 size = renderSize(state_.resolution, view_);
    if (size != renderer_.size())
        renderer_.resize(size);
    if (std::exchange(state_.resetWanted, false))
        renderer_.resetHistory();
    renderer_.timer().setEnabled(state_.showTimings);

    const Clock::time_point before = Clock::now();
    picture_ = &renderer_.render({.camera = state_.camera,
                                  .seconds = state_.seconds,
                                  .frame = state_.frame,
                                  .seed = state_.seed,
                                  .lights = state_.lights},
                                 state_.settings);
    if (gl_.softwareRasterizer)
        glFinish(); // on a GPU the pace of whole rounds says more
    timings_.addFrame(1000.0 * (gl_.softwareRasterizer ? secondsSince(before) : seconds));
    if (state_.showTimings) {
        std::vector<PassTimings::Row> rows;
        for (const GpuTimer::Entry& entry : renderer_.timer().lastFrame())
            rows.push_back({entry.name, entry.milliseconds});
        timings_.addPasses(rows);
    }
    frameRendered(state_, seconds);
    if (counters_.isDue())
        readCounters();
}

void Viewer::readCounters() {
    stats_ = renderer_.readStats();
    raysPerSecond_ = timings_.frame() > 0.0 ? 1000.0 * double(stats_.rays) / timings_.frame() : 0.0;
}

// The picture or, as colors, one of the images behind it. What was rendered last is shown, paused
// or not.
const GpuTexture* Viewer::shownTexture() {
    const auto shown = shownImage(state_);
    if (!picture_ || !shown)
        return picture_;
    if (debugPicture_.size() != picture_->size())
        debugPicture_ = GpuTexture("debug view", PixelFormat::RGBA8, picture_->size());
    const ImageDisplay& display = state_.displays[*shown];
    const AovSource source = sourceOf(renderer_, aovByName(display.name));
    FrameContext context{renderer_.timer()};
    debugView_.run(context, source.texture, debugPicture_, debugViewParams(display, source));
    return &debugPicture_;
}

void Viewer::fitRange() {
    if (!std::exchange(state_.fitRangeWanted, false) || !picture_)
        return;
    if (const auto shown = shownImage(state_))
        state_.displays[*shown] =
            fittedTo(readAov(renderer_, aovs()[*shown]), state_.displays[*shown]);
}

void Viewer::drawWindow(glm::ivec2 framebuffer, const Layout& layout) {
    fitRange();
    const GpuTexture* const texture = shownTexture();
    const Rect picture = fitAspect(layout.view, texture ? texture->size() : glm::ivec2(0));
    presenter_.draw(texture, picture, framebuffer, state_.smoothScaling);
    ui_.draw(state_, {.scene = renderer_.scene(),
                      .sceneStats = renderer_.sceneStats(),
                      .gl = gl_,
                      .timings = timings_,
                      .layout = layout,
                      .imageSize = texture ? texture->size() : glm::ivec2(0),
                      .stats = stats_,
                      .raysPerSecond = raysPerSecond_,
                      .imageBytes = renderer_.targets().bytes(),
                      .shaderErrors = shaderErrors_});
    if (std::exchange(state_.pictureWanted, false))
        savePicture();
    if (std::exchange(state_.windowPictureWanted, false))
        saveWindow(framebuffer);
}

void Viewer::savePicture() {
    if (const GpuTexture* const texture = shownTexture()) {
        Image<glm::u8vec4> image = texture->read<glm::u8vec4>();
        saveTo(freePicturePath(std::filesystem::current_path()), image);
    }
}

void Viewer::saveWindow(glm::ivec2 framebuffer) {
    saveTo(freePicturePath(std::filesystem::current_path()), presenter_.readWindow(framebuffer));
}

// A picture that cannot be written is no reason to end: the window says why.
void Viewer::saveTo(const std::filesystem::path& path, const Image<glm::u8vec4>& image) {
    try {
        writePng(path, image);
        notify(state_, "Saved " + path.string());
        log(LogLevel::Info, "saved " + path.string());
    } catch (const Error& error) {
        notify(state_, error.what(), true);
        log(LogLevel::Error, error.what());
    }
}

} // namespace

int runView(const ViewOptions& options) {
    // What was asked for is looked at before there is a window.
    Scene scene = loadScene(options.scene);
    ViewState state = startState(scene, options.settings, options.camera);
    state.seed = options.seed;
    state.animate = options.animate;
    Viewer(options, std::move(scene), std::move(state)).run();
    return 0;
}

} // namespace afterglow
