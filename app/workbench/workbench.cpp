// SPDX-License-Identifier: MIT
#include "app/workbench/workbench_impl.h"

#include <algorithm>
#include <limits>

namespace afterglow {
namespace {

constexpr double kStatsSeconds = 0.5;        // between two readings of counters
constexpr double kReloadSeconds = 0.5;       // between two looks at the shader files
constexpr double kOracleMilliseconds = 30.0; // of every round in which the truth converges

} // namespace

Workbench::Impl::Impl(Workbench& bench, ShaderLibrary& library, const GlInfo& info,
                      WorkbenchFolders places)
    : owner(bench), state(bench.state), shaders(library), gl(info), folders(std::move(places)),
      renderer(shaders, gl), pictures(shaders), instruments(shaders), oracle(shaders, gl),
      presets(folders.presets) {}

Workbench::Workbench(ShaderLibrary& shaders, const GlInfo& gl, Scene scene, ViewState initial,
                     WorkbenchFolders folders)
    : state(std::move(initial)),
      impl_(std::make_unique<Impl>(*this, shaders, gl, std::move(folders))) {
    impl_->renderer.setScene(std::move(scene));
}

Workbench::~Workbench() = default;

bool Workbench::advance(double wallSeconds, glm::ivec2 view) {
    Impl& self = *impl_;
    passTime(state, wallSeconds);
    self.sinceFrame += wallSeconds;
    self.sinceStats += wallSeconds;
    self.sinceReload += wallSeconds;
    self.serveRequests();
    self.followFreeze();
    const bool renders =
        view.x > 0 && view.y > 0 && !state.frozen && wantsFrame(state.time, self.sinceFrame);
    if (renders)
        self.renderFrame(wallSeconds, view);
    else
        self.collect();
    self.inspectPixel(renders);
    self.instruments.submit();
    // The measurements of a frame arrive with the next one, if there is one.
    if (!renders || !wantsFrame(state.time, std::numeric_limits<double>::infinity()))
        self.collect();
    if (const auto message = self.recorder.poll())
        notify(state, message->text, message->isError);
    if (std::exchange(state.wanted.reloadShaders, false) || self.sinceReload > kReloadSeconds) {
        self.sinceReload = 0.0;
        ShaderLibrary::ReloadReport report = self.shaders.reload();
        if (report.reloaded > 0)
            self.compiledFor.clear();
        self.shaderErrors = std::move(report.errors);
    }
    return renders;
}

void Workbench::finishMeasuring() {
    impl_->collect();
}

double Workbench::secondsUntilFrame() const {
    if (state.frozen)
        return impl_->oracle.isDone() ? std::numeric_limits<double>::infinity() : 0.0;
    return afterglow::secondsUntilFrame(state.time, impl_->sinceFrame);
}

// Everything of a frame that is settled before it is rendered.
SceneFrame Workbench::Impl::prepareFrame(glm::ivec2 view) {
    const glm::ivec2 size = renderSize(state.resolution, view);
    if (size != renderer.size()) {
        renderer.resize(size);
        checkpoint.reset();
        checkpointLost(state.time);
        now.reset();
    }
    Transport& time = state.time;
    if (now && nowSeed != state.seed) // other noise is another run
        forgetMeasured();
    if (std::exchange(time.resetWanted, false)) {
        renderer.resetHistory();
        now.reset();
        if (!time.playing && time.last)
            state.marks.push_back("histories forgotten");
    }
    if (std::exchange(time.restoreWanted, false)) {
        if (checkpoint)
            renderer.restore(*checkpoint);
        else
            renderer.resetHistory();
        now = checkpoint ? checkpointFrame : std::nullopt;
    }
    if (std::exchange(time.checkpointWanted, false)) {
        checkpoint = renderer.checkpoint();
        checkpointFrame = now;
    }

    if (!time.playing)
        return nextFrame(time, liveFrame(state));
    SceneFrame frame = nextFrame(time, {});
    follow(state, frame);
    return frame;
}

void Workbench::Impl::render(const SceneFrame& frame) {
    const bool shows = state.shown.kind == Shown::Kind::Pass;
    const bool listens = shows || state.showPasses || capturesAll;
    renderer.timer().setEnabled(state.showPasses);
    renderer.setListener(listens ? &capture : nullptr);
    if (listens) {
        using enum PassCapture::Keep;
        capture.begin(std::exchange(capturesAll, false) ? All : (shows ? One : Nothing),
                      state.shown.index);
    } else {
        capture.clear();
    }
    ++renderedFrames;
    std::vector<FilterRun> runs;
    for (const std::size_t pane : shownPanes(state.panes)) {
        runs.push_back({pane, state.panes.all[pane].settings});
        if (compiledFor.insert(settingsText(settingsOf(state.panes, pane))).second)
            lastCompiling = renderedFrames;
    }
    renderer.render(frame.input(state.seed), state.panes.frame, runs);
    if (listens)
        capture.end();
    renderer.setListener(nullptr);
    pictures.changed();
}

void Workbench::Impl::renderFrame(double wallSeconds, glm::ivec2 view) {
    const SceneFrame frame = prepareFrame(view);
    render(frame);
    noteTimes();
    collect(); // of the frame before, while the device has this one to work on
    sinceFrame = 0.0;
    measure(frame);
    before = std::move(now);
    now = frame;
    nowSeed = state.seed;
    nowSettings = state.panes.frame;
    frameRendered(state.time, wallSeconds);
}

// Of the newest frame whose times are known: on a GPU not the last one, and not one in every round.
// The first frames with settings of their own are left out: drivers compile programs in them.
void Workbench::Impl::noteTimes() {
    const GpuTimer::FrameTimes& times = renderer.timer().newest();
    if (times.frame == timedFrame)
        return;
    timedFrame = times.frame;
    if (timedFrame <= lastCompiling)
        return;
    timings.addFrame(times.milliseconds);
    if (times.scopes.empty())
        return;
    std::vector<PassTimings::Row> rows;
    for (const GpuTimer::Entry& entry : times.scopes)
        rows.push_back({entry.name, entry.milliseconds});
    timings.addPasses(rows);
}

void Workbench::Impl::measure(const SceneFrame& frame) {
    instruments.measure(renderer, state, state.time.frame, frame);
    if (sinceStats >= kStatsSeconds) {
        sinceStats = 0.0;
        instruments.count(renderer);
    }
    if (recorder.isRecording())
        recorder.add(composedView());
}

// Waits for what was measured, if anything was.
void Workbench::Impl::collect() {
    Instruments::Measured measured = instruments.collect(renderer.scene());
    if (measured.frame) {
        log.add(*std::move(measured.frame));
        reasons = measured.reasons;
    }
    if (measured.stats) {
        stats = *measured.stats;
        raysPerSecond = timings.frame() > 0.0 ? 1000.0 * double(stats.rays) / timings.frame() : 0.0;
    }
    if (measured.inspection)
        inspection = std::move(measured.inspection);
}

void Workbench::Impl::followFreeze() {
    if (!state.frozen) {
        if (oracle.isActive()) {
            oracle.end();
            pictures.changed();
        }
        return;
    }
    if (!now) // nothing has been rendered that could be held
        return toggleFreeze(state);
    if (!oracle.isActive() || oracle.samples() != state.oracleSamples) {
        pictures.changed();
        oracle.begin(renderer, {*now, nowSeed, before}, nowSettings, state.oracleSamples);
    }
    if (oracle.advance(kOracleMilliseconds))
        pictures.changed();
}

// To what another pass of the frame has made; past the last one, to the first of the next frame.
void Workbench::Impl::stepPass(int step) {
    const std::size_t count = capture.made().size();
    const bool stands = state.shown.kind == Shown::Kind::Pass && state.time.paused && count > 0;
    const auto next = std::int64_t(state.shown.index) + step;
    const bool kept = stands && next >= 0 && next < std::int64_t(count) &&
                      capture.image(std::size_t(next)) != nullptr;
    if (kept)
        return show(state, Shown::Kind::Pass, std::size_t(next));
    if (stands && next < 0)
        return;
    capturesAll = true;
    state.showPasses = true;
    show(state, Shown::Kind::Pass, 0);
    perform(state, {Action::StepOnce});
}

void Workbench::Impl::inspectPixel(bool rendered) {
    const auto& wanted = state.inspected ? state.inspected : state.hovered;
    if (!state.showInspector || !wanted || !now || !renderer.ran(wanted->pane) ||
        glm::any(glm::greaterThanEqual(wanted->pixel, renderer.size()))) {
        if (!state.showInspector)
            inspection.reset();
        return;
    }
    const std::size_t signal = shownSignal(state, renderer.signals().size());
    const bool same = inspection && inspection->pixel == wanted->pixel &&
                      inspection->state == wanted->pane && inspection->signal == signal;
    if (rendered || !same)
        instruments.inspect(renderer, wanted->pane, wanted->pixel, signal);
}

const GpuTexture* Workbench::picture(std::size_t pane) {
    return impl_->now ? impl_->pictures.of(impl_->sources(), pane) : nullptr;
}

glm::ivec2 Workbench::imageSize() const {
    return impl_->now ? impl_->renderer.size() : glm::ivec2(0);
}

PictureLegend Workbench::legend(std::size_t pane) {
    if (!impl_->renderer.ran(pane))
        return {.name = {}, .meaning = {}, .note = "It runs with the next frame.", .display = {}};
    return impl_->pictures.legendOf(impl_->sources(), pane);
}

const Renderer& Workbench::renderer() const {
    return impl_->renderer;
}
const Scene& Workbench::scene() const {
    return impl_->renderer.scene();
}
const GlInfo& Workbench::gl() const {
    return impl_->gl;
}
const PassTimings& Workbench::timings() const {
    return impl_->timings;
}
const FrameStats& Workbench::stats() const {
    return impl_->stats;
}
double Workbench::raysPerSecond() const {
    return impl_->raysPerSecond;
}
const ProbeLog& Workbench::probeLog() const {
    return impl_->log;
}
std::optional<ReasonCounts> Workbench::reasons(std::size_t pane) const {
    return impl_->reasons.at(pane);
}
const PassCapture& Workbench::passes() const {
    return impl_->capture;
}
const OracleView& Workbench::oracle() const {
    return impl_->oracle;
}
std::optional<double> Workbench::oracleRmse(std::size_t pane) {
    return impl_->oracle.rmse(pane);
}
const std::optional<Inspection>& Workbench::inspection() const {
    return impl_->inspection;
}
const PresetStore& Workbench::presets() const {
    return impl_->presets;
}
const FrameRecorder& Workbench::recorder() const {
    return impl_->recorder;
}
std::span<const std::string> Workbench::shaderErrors() const {
    return impl_->shaderErrors;
}

std::size_t Workbench::imageBytes() const {
    return impl_->renderer.targets().bytes() + impl_->capture.bytes() + impl_->pictures.bytes() +
           (impl_->checkpoint ? impl_->checkpoint->bytes() : 0);
}

std::optional<std::string> Workbench::takeCopied() {
    return std::exchange(impl_->copied, {});
}

} // namespace afterglow
