// SPDX-License-Identifier: MIT
#include "app/bench/ray_bench.h"

#include "app/bench/embree_scene.h"
#include "app/bench/scene_triangles.h"
#include "app/bench/stopwatch.h"
#include "app/bench/text_table.h"
#include "renderer/base/parallel.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

namespace afterglow {

namespace {

RayFigures measure(RayKind kind, RayLists& lists, const EmbreeScene* embree, int repeats) {
    lists.list(kind);
    const std::vector<ListedRay> rays = lists.read();
    const std::vector<std::uint8_t> hits = lists.traceForHits();
    RayFigures figures{.kind = kind,
                       .rays = rays.size(),
                       .hits = std::size_t(std::ranges::count(hits, 1)),
                       .milliseconds = {},
                       .embree = {}};
    std::vector<std::uint8_t> embreeHits(rays.size());
    std::vector<double> ours, theirs;
    const auto traceOurs = [&] { lists.trace(); };
    const auto traceTheirs = [&] { embree->trace(rays, isAnyHit(kind), embreeHits); };
    traceOurs(); // compiled
    for (int i = 0; i < repeats; ++i) {
        ours.push_back(millisecondsOnDevice(traceOurs));
        if (embree)
            theirs.push_back(millisecondsOf(traceTheirs));
    }
    figures.milliseconds = spreadOf(ours);
    if (embree) {
        std::size_t disagreements = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            disagreements += hits[i] != embreeHits[i] ? 1 : 0;
        figures.embree = {.milliseconds = spreadOf(theirs), .disagreements = disagreements};
    }
    return figures;
}

} // namespace

Spread RayFigures::raysPerSecond() const {
    return rateOf(double(rays) * 1e-3, milliseconds);
}

std::optional<Spread> RayFigures::embreeRaysPerSecond() const {
    if (!embree)
        return {};
    return rateOf(double(rays) * 1e-3, embree->milliseconds);
}

unsigned tracingThreads() {
    unsigned threads = 0;
    if (const char* const asked = std::getenv("LP_NUM_THREADS")) {
        const std::string_view text(asked);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
        if (error == std::errc() && end == text.data() + text.size())
            return std::max(1u, threads);
    }
    return hardwareThreads();
}

std::vector<RayFigures> measureRays(Renderer& renderer, ShaderLibrary& shaders, int repeats,
                                    Progress& progress) {
    const auto triangles = trianglesOf(renderer.lightingCall(0).scene.bvh());
    std::optional<EmbreeScene> embree;
    if (EmbreeScene::isThere())
        embree.emplace(triangles, tracingThreads());
    RayLists lists(renderer, shaders);
    std::vector<RayFigures> figures;
    for (const RayKind kind : kRayKinds) {
        figures.push_back(measure(kind, lists, embree ? &*embree : nullptr, repeats));
        progress.advance(double(renderer.size().x) * renderer.size().y * repeats, "rays");
    }
    return figures;
}

void addTo(Figures& figures, const std::string& subject, std::span<const RayFigures> kinds) {
    for (const RayFigures& kind : kinds) {
        const std::string name = "rays." + std::string(nameOf(kind.kind)) + ".";
        figures.add(subject, name + "count", "rays", Better::None, exactly(double(kind.rays)));
        figures.add(subject, name + "hits", "rays", Better::None, exactly(double(kind.hits)));
        if (kind.rays == 0)
            continue;
        const Spread rate = kind.raysPerSecond();
        figures.add(subject, name + "mrays_per_s", "Mrays/s", Better::More, rate);
        if (const auto embree = kind.embreeRaysPerSecond()) {
            figures.add(subject, name + "embree_mrays_per_s", "Mrays/s", Better::None, *embree);
            figures.add(subject, name + "embree_ratio", "1", Better::Less,
                        exactly(embree->median / rate.median));
            figures.add(subject, name + "disagreements", "rays", Better::None,
                        exactly(double(kind.embree->disagreements)));
        }
    }
}

std::string tableOf(std::span<const RayFigures> kinds, bool onCpu) {
    TextTable table({"rays", "count", "hits", "ms", "Mrays/s", "quartiles", "Embree", "quartiles",
                     "ratio", "disagree"});
    for (const RayFigures& kind : kinds) {
        const double hits = kind.rays > 0 ? 100.0 * double(kind.hits) / double(kind.rays) : 0.0;
        const Spread rate = kind.raysPerSecond();
        const auto range = [](const Spread& spread) {
            return digits(spread.lower) + " - " + digits(spread.upper);
        };
        std::vector<std::string> row{std::string(nameOf(kind.kind)),
                                     std::to_string(kind.rays),
                                     fmt::format("{:.0f} %", hits),
                                     digits(kind.milliseconds.median),
                                     digits(rate.median),
                                     range(rate)};
        if (const auto embree = kind.embreeRaysPerSecond(); embree && kind.rays > 0)
            row.insert(row.end(), {digits(embree->median), range(*embree),
                                   digits(embree->median / rate.median),
                                   std::to_string(kind.embree->disagreements)});
        else
            row.insert(row.end(), {"-", "-", "-", "-"});
        table.add(std::move(row));
    }
    if (!EmbreeScene::isThere())
        return table.text() + "  without Embree: its library is not there\n\n";
    return table.text() +
           fmt::format("  Embree: {} CPU threads{}; ratio: its rate over ours\n\n",
                       tracingThreads(),
                       onCpu ? ", as many as the software renderer" : " against this GPU");
}

} // namespace afterglow
