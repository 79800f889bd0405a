// SPDX-License-Identifier: MIT
#include "app/bench/pass_bench.h"

#include "app/base/output.h"
#include "app/bench/pass_bytes.h"
#include "app/bench/stopwatch.h"
#include "app/bench/text_table.h"
#include "renderer/filters/filter_table.h"

#include <algorithm>

#include <fmt/format.h>

namespace afterglow {

namespace {

constexpr int kFramesOfRound = 8, kMostRounds = 8;

/// The measurements of one filter so far.
struct Samples {
    std::vector<double> frame, rays;
    struct Pass {
        std::string name;
        std::vector<double> milliseconds;
    };
    std::vector<Pass> passes;

    void take(const FrameClock& clock) {
        const auto first = std::size_t(kWarmupFrames);
        frame.insert(frame.end(), clock.milliseconds().begin() + kWarmupFrames,
                     clock.milliseconds().end());
        for (std::size_t i = first; i < clock.stats().size(); ++i)
            rays.push_back(double(clock.stats()[i].rays));
        for (const FrameClock::Pass& pass : clock.passes()) {
            auto own = std::ranges::find(passes, pass.name, &Pass::name);
            if (own == passes.end())
                own = passes.insert(passes.end(), Pass{pass.name, {}});
            for (std::size_t i = first; i < pass.milliseconds.size(); ++i)
                if (pass.milliseconds[i])
                    own->milliseconds.push_back(*pass.milliseconds[i]);
        }
    }
};

std::string percent(double part) {
    return fmt::format("{:.1f} %", 100.0 * part);
}

std::string spreadText(const Spread& spread) {
    return digits(spread.lower) + " - " + digits(spread.upper);
}

std::string tableOf(const FilterFigures& filter, const Spread& copy) {
    TextTable table({std::string(nameOf(filter.filter)), "ms", "quartiles", "share", "bytes",
                     "GB/s", "of copy"});
    const double sum = filter.sumMilliseconds();
    double bytes = 0.0;
    const auto row = [&](const std::string& name, double ms, const std::string& quartiles,
                         double share, double moved) {
        const double rate = ms > 0.0 ? moved / ms * 1e-6 : 0.0;
        table.add({name, digits(ms), quartiles, percent(share), bytesText(moved), digits(rate),
                   percent(rate / copy.median)});
    };
    for (const PassFigure& pass : filter.passes) {
        row(pass.name, pass.milliseconds.median, spreadText(pass.milliseconds),
            pass.milliseconds.median / sum, pass.bytes);
        bytes += pass.bytes;
    }
    row("sum of passes", sum, "", 1.0, bytes);
    table.add({"frame", digits(filter.frame.median), spreadText(filter.frame), "", "", "", ""});
    return table.text() +
           fmt::format(
               "  passes are {} of the frame; {:.0f} rays a frame, {} over the whole frame\n\n",
               percent(sum / filter.frame.median), filter.rays.median,
               raysText(filter.rays.median / filter.frame.median * 1e3));
}

/// The filters whose difference is the price of adaptation; null where one was not measured.
struct Overhead {
    const FilterFigures *svgf = nullptr, *asvgf = nullptr;
    explicit Overhead(std::span<const FilterFigures> filters) {
        for (const FilterFigures& filter : filters) {
            svgf = filter.filter == Filter::Svgf ? &filter : svgf;
            asvgf = filter.filter == Filter::Asvgf ? &filter : asvgf;
        }
    }
    bool isKnown() const { return svgf && asvgf; }
    double milliseconds() const { return asvgf->frame.median - svgf->frame.median; }
};

} // namespace

FrameInput BenchFrames::inputOf(const Scene& scene, std::uint32_t frame, std::uint32_t seed) {
    return {.camera = cameraAt(scene, poseAt(scene, 0.0)),
            .seconds = 0.0,
            .frame = frame,
            .seed = seed,
            .lights = {}};
}

Settings BenchFrames::settingsOf(Filter filter) const {
    Settings own = settings;
    setFilter(own, filter);
    return own;
}

double FilterFigures::sumMilliseconds() const {
    double sum = 0.0;
    for (const PassFigure& pass : passes)
        sum += pass.milliseconds.median;
    return sum;
}

std::vector<FilterFigures> measurePasses(Renderer& renderer, const BenchFrames& frames,
                                         std::span<const Filter> filters, Progress& progress) {
    const int rounds = std::clamp(frames.frames / kFramesOfRound, 1, kMostRounds);
    const double pixels = double(renderer.size().x) * renderer.size().y;
    std::vector<Samples> samples(filters.size());
    std::vector<FilterFigures> figures;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < filters.size(); ++i) {
            const Settings settings = frames.settingsOf(filters[i]);
            const int count = frames.frames * (round + 1) / rounds - frames.frames * round / rounds;
            renderer.resetHistory();
            FrameClock clock;
            for (int frame = 0; frame < count; ++frame) {
                clock.render(
                    renderer,
                    BenchFrames::inputOf(renderer.scene(), std::uint32_t(frame), frames.seed),
                    settings);
                progress.advance(pixels, nameOf(filters[i]));
            }
            samples[i].take(clock);
            if (round + 1 < rounds)
                continue;
            // One frame more, whose time nobody takes.
            PassBytes bytes(renderer);
            renderer.render(
                BenchFrames::inputOf(renderer.scene(), std::uint32_t(count), frames.seed),
                settings);
            FilterFigures own{.filter = filters[i],
                              .frame = spreadOf(samples[i].frame),
                              .rays = spreadOf(samples[i].rays),
                              .passes = {}};
            for (Samples::Pass& pass : samples[i].passes) {
                const auto moved = bytes.bytes().find(pass.name);
                own.passes.push_back({.name = pass.name,
                                      .milliseconds = spreadOf(pass.milliseconds),
                                      .bytes = moved == bytes.bytes().end() ? 0.0 : moved->second});
            }
            figures.push_back(std::move(own));
        }
    return figures;
}

Spread measureCopy(ShaderLibrary& shaders, glm::ivec2 size, int repeats) {
    GpuTexture source("copy source", PixelFormat::RGBA32F, size);
    const GpuTexture target("copy target", PixelFormat::RGBA32F, size);
    source.clear();
    ComputeProgram& copy = shaders.compute("bench/copy.comp");
    const auto run = [&] { copy.dispatch(size, {{"source", source}}, {{"target", target}}); };
    run(); // compiled, and every page touched
    std::vector<double> milliseconds;
    for (int i = 0; i < repeats; ++i)
        milliseconds.push_back(millisecondsOnDevice(run));
    return rateOf(double(source.bytes() + target.bytes()) * 1e-6, spreadOf(milliseconds));
}

void addTo(Figures& figures, const std::string& subject, std::span<const FilterFigures> filters) {
    for (const FilterFigures& filter : filters) {
        const std::string own = subject + "/" + std::string(nameOf(filter.filter));
        figures.add(own, "frame.ms", "ms", Better::Less, filter.frame);
        figures.add(own, "frame.rays", "rays", Better::None, filter.rays);
        figures.add(own, "frame.passes_share", "1", Better::None,
                    exactly(filter.sumMilliseconds() / filter.frame.median));
        for (const PassFigure& pass : filter.passes) {
            figures.add(own, "passes." + pass.name + ".ms", "ms", Better::Less, pass.milliseconds);
            figures.add(own, "passes." + pass.name + ".bytes", "bytes", Better::Less,
                        exactly(pass.bytes));
        }
    }
    if (const Overhead overhead(filters); overhead.isKnown())
        figures.add(subject, "asvgf_over_svgf.ms", "ms", Better::None,
                    exactly(overhead.milliseconds()));
}

std::string tableOf(std::span<const FilterFigures> filters, const Spread& copy) {
    std::string text;
    for (const FilterFigures& filter : filters)
        text += tableOf(filter, copy);
    if (const Overhead overhead(filters); overhead.isKnown())
        text += fmt::format("  A-SVGF takes {} ms a frame more than SVGF: {:+.1f} %\n\n",
                            digits(overhead.milliseconds()),
                            100.0 * overhead.milliseconds() / overhead.svgf->frame.median);
    return text;
}

} // namespace afterglow
