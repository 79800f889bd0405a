// SPDX-License-Identifier: MIT
#include "app/base/output.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace afterglow {

using Json = nlohmann::ordered_json;

std::string_view version() {
    return AFTERGLOW_VERSION;
}

OutputFolder::OutputFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (!error && !std::filesystem::is_directory(path_, error) && !error)
        error = std::make_error_code(std::errc::not_a_directory);
    if (error)
        throw Error(path_.string() + ": cannot be created: " + error.message());
    if (access(path_.c_str(), W_OK | X_OK) != 0)
        throw Error(path_.string() + ": cannot be written to: " + std::strerror(errno));
}

void OutputFolder::writeJson(std::string_view file, const Json& json) const {
    writeText(file, jsonText(json, 2) + "\n");
}

void OutputFolder::writeText(std::string_view file, std::string_view text) const {
    writeFileAtomically(path_ / file, text);
}

void OutputFolder::writePng(std::string_view file, const Image<glm::u8vec4>& image) const {
    afterglow::writePng(path_ / file, image);
}

void OutputFolder::writeFloat(std::string_view stem, std::string_view format,
                              const Image<glm::vec4>& image, std::string_view channels) const {
    const auto file = path_ / (std::string(stem) + "." + std::string(format));
    if (format == "pfm") {
        writePfm(file, image, channels.size() == 1 ? 1 : 3);
        return;
    }
    std::vector<std::string> names;
    for (char name : channels)
        names.emplace_back(1, name);
    writeExr(file, image, names);
}

std::string frameStem(std::string_view name, int frame) {
    return fmt::format("{}_{:04}", name, frame);
}

int writeAov(const OutputFolder& folder, std::string_view format, const Renderer& renderer,
             const AovInfo& aov, std::optional<int> frame, std::size_t state) {
    const auto signals = renderer.signals();
    const std::size_t count = aov.perSignal ? signals.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string stem = fileStem(aov, signals[i], signals.size());
        folder.writeFloat(frame ? frameStem(stem, *frame) : stem, format,
                          readAov(renderer, aov, state, i), aov.channels);
    }
    return int(count);
}

const GpuTexture& FrameClock::render(Renderer& renderer, const FrameInput& input,
                                     const Settings& settings) {
    using Clock = std::chrono::steady_clock;
    glFinish();
    const auto start = Clock::now();
    const GpuTexture& display = renderer.render(input, settings);
    glFinish();
    milliseconds_.push_back(
        std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    stats_.push_back(renderer.readStats());
    passes_.push_back(renderer.timer().finish().scopes);
    return display;
}

int FrameClock::warmup() const {
    return std::min(3, int(milliseconds_.size()) - 1);
}

double FrameClock::medianMilliseconds() const {
    return milliseconds_.empty() ? 0.0
                                 : median({milliseconds_.begin() + warmup(), milliseconds_.end()});
}

double FrameClock::raysPerSecond() const {
    double counted = 0.0, spent = 0.0;
    for (std::size_t i = std::size_t(std::max(warmup(), 0)); i < stats_.size(); ++i) {
        counted += double(stats_[i].rays);
        spent += milliseconds_[i];
    }
    return spent > 0.0 ? counted / spent * 1000.0 : 0.0;
}

std::uint64_t FrameClock::rays() const {
    std::uint64_t sum = 0;
    for (const FrameStats& stats : stats_)
        sum += stats.rays;
    return sum;
}

std::uint64_t FrameClock::invalidValues() const {
    std::uint64_t sum = 0;
    for (const FrameStats& stats : stats_)
        sum += stats.invalidValues;
    return sum;
}

std::vector<FrameClock::Pass> FrameClock::passes() const {
    std::vector<Pass> passes;
    // From the last frame back: the first ones lack some passes, so the order is that of the last.
    for (std::size_t frame = passes_.size(); frame-- > 0;)
        for (const GpuTimer::Entry& entry : passes_[frame]) {
            auto pass = std::ranges::find(passes, entry.name, &Pass::name);
            if (pass == passes.end())
                pass = passes.insert(pass, Pass{.name = entry.name});
            pass->milliseconds.resize(passes_.size());
            pass->milliseconds[frame] = entry.milliseconds;
        }
    for (Pass& pass : passes) {
        std::vector<double> counted;
        for (std::size_t i = std::size_t(std::max(warmup(), 0)); i < passes_.size(); ++i)
            if (pass.milliseconds[i])
                counted.push_back(*pass.milliseconds[i]);
        if (!counted.empty())
            pass.median = median(std::move(counted));
    }
    return passes;
}

double median(std::vector<double> values) {
    if (values.empty())
        return 0.0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

Json describe(const GlInfo& gl) {
    return {{"backend", gl.backend},
            {"vendor", gl.vendor},
            {"renderer", gl.renderer},
            {"version", gl.version},
            {"software_rasterizer", gl.softwareRasterizer}};
}

Json describe(const Scene& scene, const SceneStats& stats) {
    Json lights = Json::array();
    for (const Light& light : scene.lights)
        lights.push_back(light.name);
    return {{"name", scene.name},
            {"triangles", stats.triangles},
            {"instances", stats.instances},
            {"lights", lights},
            {"light_triangles", stats.lightTriangles},
            {"bvh_records", stats.bvhRecords},
            {"bvh_build_ms", stats.bvhBuildMilliseconds}};
}

Json describe(const FrameClock& clock) {
    Json passMedians = Json::object(), passes = Json::object();
    for (const FrameClock::Pass& pass : clock.passes()) {
        if (pass.median)
            passMedians[pass.name] = *pass.median;
        for (const std::optional<double>& ms : pass.milliseconds)
            passes[pass.name].push_back(ms ? Json(*ms) : Json(nullptr));
    }
    Json rays = Json::array(), gradientSamples = Json::array();
    for (const FrameStats& stats : clock.stats()) {
        rays.push_back(stats.rays);
        gradientSamples.push_back(stats.gradientSamples);
    }
    return {{"warmup_frames", std::max(clock.warmup(), 0)},
            {"frame_ms_median", clock.medianMilliseconds()},
            {"pass_ms_median", passMedians},
            {"rays", clock.rays()},
            {"rays_per_second", clock.raysPerSecond()},
            {"invalid_values", clock.invalidValues()},
            {"frame_ms", clock.milliseconds()},
            {"pass_ms", passes},
            {"rays_per_frame", rays},
            {"gradient_samples_per_frame", gradientSamples}};
}

std::string passTable(const FrameClock& clock) {
    std::string table;
    for (const FrameClock::Pass& pass : clock.passes()) {
        if (pass.median)
            table += fmt::format("    {:<28} {:9.3f} ms\n", pass.name, *pass.median);
    }
    return table;
}

std::string raysText(double raysPerSecond) {
    if (raysPerSecond >= 1e9)
        return fmt::format("{:.2f} G rays/s", raysPerSecond * 1e-9);
    if (raysPerSecond >= 1e6)
        return fmt::format("{:.2f} M rays/s", raysPerSecond * 1e-6);
    return fmt::format("{:.0f} k rays/s", raysPerSecond * 1e-3);
}

} // namespace afterglow
