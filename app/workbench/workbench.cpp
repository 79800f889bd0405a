// SPDX-License-Identifier: MIT
#include "app/workbench/workbench.h"

#include <limits>

namespace afterglow {
namespace {

constexpr double kStatsSeconds = 0.5;        // between two readings of counters
constexpr double kReloadSeconds = 0.5;       // between two looks at the shader files
constexpr double kOracleMilliseconds = 30.0; // of every round in which the truth converges

} // namespace

Workbench::Workbench(ShaderLibrary& shaders, const GlInfo& gl, Scene scene, ViewState initial,
                     WorkbenchFolders folders)
    : state(std::move(initial)), shaders_(shaders), gl_(gl), folders_(std::move(folders)),
      renderer_(shaders, gl), pictures_(shaders), instruments_(shaders), oracle_(shaders, gl),
      presets_(folders_.presets) {
    renderer_.setScene(std::move(scene));
}

bool Workbench::advance(double wallSeconds, glm::ivec2 view) {
    passTime(state, wallSeconds);
    sinceFrame_ += wallSeconds;
    sinceStats_ += wallSeconds;
    sinceReload_ += wallSeconds;
    serveRequests();
    followFreeze();
    const bool renders =
        view.x > 0 && view.y > 0 && !state.frozen && wantsFrame(state.time, sinceFrame_);
    if (renders)
        renderFrame(wallSeconds, view);
    else
        collect();
    inspectPixel(renders);
    instruments_.submit();
    // The measurements of a frame arrive with the next one, if there is one.
    if (!renders || !wantsFrame(state.time, std::numeric_limits<double>::infinity()))
        collect();
    if (const auto message = recorder_.poll())
        notify(state, message->text, message->isError);
    if (std::exchange(state.wanted.reloadShaders, false) || sinceReload_ > kReloadSeconds) {
        sinceReload_ = 0.0;
        ShaderLibrary::ReloadReport report = shaders_.reload();
        if (report.reloaded > 0)
            compiledFor_.clear();
        shaderErrors_ = std::move(report.errors);
    }
    return renders;
}

double Workbench::secondsUntilFrame() const {
    if (state.frozen)
        return oracle_.isDone() ? std::numeric_limits<double>::infinity() : 0.0;
    return afterglow::secondsUntilFrame(state.time, sinceFrame_);
}

// Everything of a frame that is settled before it is rendered.
SceneFrame Workbench::prepareFrame(glm::ivec2 view) {
    const glm::ivec2 size = renderSize(state.resolution, view);
    if (size != renderer_.size()) {
        renderer_.resize(size);
        checkpoint_.reset();
        checkpointLost(state.time);
        now_.reset();
    }
    Transport& time = state.time;
    if (now_ && nowSeed_ != state.seed) // other noise is another run
        forgetMeasured();
    if (std::exchange(time.resetWanted, false)) {
        renderer_.resetHistory();
        now_.reset();
        if (!time.playing && time.last)
            state.marks.push_back("histories forgotten");
    }
    if (std::exchange(time.restoreWanted, false)) {
        if (checkpoint_)
            renderer_.restore(*checkpoint_);
        else
            renderer_.resetHistory();
        now_ = checkpoint_ ? checkpointFrame_ : std::nullopt;
    }
    if (std::exchange(time.checkpointWanted, false)) {
        checkpoint_ = renderer_.checkpoint();
        checkpointFrame_ = now_;
    }

    if (!time.playing)
        return nextFrame(time, liveFrame(state));
    SceneFrame frame = nextFrame(time, {});
    follow(state, frame);
    return frame;
}

void Workbench::render(const SceneFrame& frame) {
    const bool shows = state.shown.kind == Shown::Kind::Pass;
    const bool listens = shows || state.showPasses || capturesAll_;
    renderer_.timer().setEnabled(state.showPasses);
    renderer_.setListener(listens ? &capture_ : nullptr);
    if (listens) {
        using enum PassCapture::Keep;
        capture_.begin(std::exchange(capturesAll_, false) ? All : (shows ? One : Nothing),
                       state.shown.index);
    } else {
        capture_.clear();
    }
    ++renderedFrames_;
    std::vector<FilterRun> runs;
    for (const std::size_t pane : shownPanes(state.panes)) {
        runs.push_back({pane, state.panes.all[pane].settings});
        if (compiledFor_.insert(settingsText(settingsOf(state.panes, pane))).second)
            lastCompiling_ = renderedFrames_;
    }
    renderer_.render(frame.input(state.seed), state.panes.frame, runs);
    if (listens)
        capture_.end();
    renderer_.setListener(nullptr);
    pictures_.changed();
}

void Workbench::renderFrame(double wallSeconds, glm::ivec2 view) {
    const SceneFrame frame = prepareFrame(view);
    render(frame);
    noteTimes();
    collect(); // of the frame before, while the device has this one to work on
    sinceFrame_ = 0.0;
    measure(frame);
    before_ = std::move(now_);
    now_ = frame;
    nowSeed_ = state.seed;
    nowSettings_ = state.panes.frame;
    frameRendered(state.time, wallSeconds);
}

// Of the newest frame whose times are known: on a GPU not the last one, and not one in every round.
// The first frames with settings of their own are left out: drivers compile programs in them.
void Workbench::noteTimes() {
    const GpuTimer::FrameTimes& times = renderer_.timer().newest();
    if (times.frame == timedFrame_)
        return;
    timedFrame_ = times.frame;
    if (timedFrame_ <= lastCompiling_)
        return;
    timings_.addFrame(times.milliseconds);
    if (times.scopes.empty())
        return;
    std::vector<PassTimings::Row> rows;
    for (const GpuTimer::Entry& entry : times.scopes)
        rows.push_back({entry.name, entry.milliseconds});
    timings_.addPasses(rows);
}

void Workbench::measure(const SceneFrame& frame) {
    instruments_.measure(renderer_, state, state.time.frame, frame);
    if (sinceStats_ >= kStatsSeconds) {
        sinceStats_ = 0.0;
        instruments_.count(renderer_);
    }
    if (recorder_.isRecording())
        recorder_.add(composedView());
}

// Waits for what was measured, if anything was.
void Workbench::collect() {
    Instruments::Measured measured = instruments_.collect(renderer_.scene());
    if (measured.frame) {
        log_.add(*std::move(measured.frame));
        reasons_ = measured.reasons;
    }
    if (measured.stats) {
        stats_ = *measured.stats;
        raysPerSecond_ =
            timings_.frame() > 0.0 ? 1000.0 * double(stats_.rays) / timings_.frame() : 0.0;
    }
    if (measured.inspection)
        inspection_ = std::move(measured.inspection);
}

void Workbench::followFreeze() {
    if (!state.frozen) {
        if (oracle_.isActive()) {
            oracle_.end();
            pictures_.changed();
        }
        return;
    }
    if (!now_) // nothing has been rendered that could be held
        return toggleFreeze(state);
    if (!oracle_.isActive() || oracle_.samples() != state.oracleSamples) {
        pictures_.changed();
        oracle_.begin(renderer_, {*now_, nowSeed_, before_}, nowSettings_, state.oracleSamples);
    }
    if (oracle_.advance(kOracleMilliseconds))
        pictures_.changed();
}

// To what another pass of the frame has made; past the last one, to the first of the next frame.
void Workbench::stepPass(int step) {
    const std::size_t count = capture_.made().size();
    const bool stands = state.shown.kind == Shown::Kind::Pass && state.time.paused && count > 0;
    const auto next = std::int64_t(state.shown.index) + step;
    const bool kept = stands && next >= 0 && next < std::int64_t(count) &&
                      capture_.image(std::size_t(next)) != nullptr;
    if (kept)
        return show(state, Shown::Kind::Pass, std::size_t(next));
    if (stands && next < 0)
        return;
    capturesAll_ = true;
    state.showPasses = true;
    show(state, Shown::Kind::Pass, 0);
    press(state, plain('N'));
}

void Workbench::inspectPixel(bool rendered) {
    const auto& wanted = state.inspected ? state.inspected : state.hovered;
    if (!state.showInspector || !wanted || !now_ || !renderer_.ran(wanted->pane) ||
        glm::any(glm::greaterThanEqual(wanted->pixel, renderer_.size()))) {
        if (!state.showInspector)
            inspection_.reset();
        return;
    }
    const std::size_t signal = shownSignal(state, renderer_.signals().size());
    const bool same = inspection_ && inspection_->pixel == wanted->pixel &&
                      inspection_->state == wanted->pane && inspection_->signal == signal;
    if (rendered || !same)
        instruments_.inspect(renderer_, wanted->pane, wanted->pixel, signal);
}

const GpuTexture* Workbench::picture(std::size_t pane) {
    return now_ ? pictures_.of(sources(), pane) : nullptr;
}

glm::ivec2 Workbench::imageSize() const {
    return now_ ? renderer_.size() : glm::ivec2(0);
}

PictureLegend Workbench::legend(std::size_t pane) {
    if (!renderer_.ran(pane))
        return {.name = {}, .meaning = {}, .note = "It runs with the next frame.", .display = {}};
    return pictures_.legendOf(sources(), pane);
}

std::size_t Workbench::imageBytes() const {
    return renderer_.targets().bytes() + capture_.bytes() + pictures_.bytes() +
           (checkpoint_ ? checkpoint_->bytes() : 0);
}

} // namespace afterglow
