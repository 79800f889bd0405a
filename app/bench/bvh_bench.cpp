// SPDX-License-Identifier: MIT
#include "app/bench/bvh_bench.h"

#include "app/bench/embree_scene.h"
#include "app/bench/ray_bench.h"
#include "app/bench/scene_triangles.h"
#include "app/bench/stopwatch.h"
#include "app/bench/text_table.h"

#include <fmt/format.h>

namespace afterglow {

BvhFigures measureBvh(const Scene& scene, int repeats) {
    BvhFigures figures;
    figures.threads = tracingThreads();
    std::vector<gpu::BvhTriangle> triangles;
    std::vector<double> sceneTimes, buildTimes, refitTimes, embreeTimes;
    LargeArray<BvhRecord> leaves;
    LargeArray<Aabb> boxes;
    for (int i = 0; i < repeats; ++i) {
        std::optional<SceneBvh> whole;
        sceneTimes.push_back(millisecondsOf([&] { whole.emplace(scene); }));
        if (i == 0) {
            figures.bytes = whole->records().size_bytes();
            triangles = trianglesOf(*whole);
            leaves.assign(triangles.begin(), triangles.end());
            for (const gpu::BvhTriangle& triangle : triangles)
                boxes.push_back(boundsOf(triangle));
        }
        whole.reset();
        LargeArray<BvhRecord> records;
        BvhRoot root;
        buildTimes.push_back(millisecondsOf(
            [&] { root = buildBvh(records, boxes, leaves, {.threads = figures.threads}); }));
        if (i == 0) {
            figures.sahCost = sahCost(root.record, records);
            figures.depth = depthOf(root.record, records);
        }
        refitTimes.push_back(millisecondsOf([&] { refitBvh(root, records); }));
        if (EmbreeScene::isThere())
            embreeTimes.push_back(EmbreeScene(triangles, figures.threads).buildMilliseconds());
    }
    figures.triangles = triangles.size();
    figures.scene = spreadOf(sceneTimes);
    figures.build = spreadOf(buildTimes);
    figures.refit = spreadOf(refitTimes);
    if (EmbreeScene::isThere())
        figures.embree = {.build = spreadOf(embreeTimes),
                          .sahCost = EmbreeScene::sahCost(boxes, figures.threads)};
    return figures;
}

void addTo(Figures& figures, const std::string& subject, const BvhFigures& bvh) {
    figures.add(subject, "bvh.triangles", "triangles", Better::None,
                exactly(double(bvh.triangles)));
    figures.add(subject, "bvh.bytes", "bytes", Better::Less, exactly(double(bvh.bytes)));
    figures.add(subject, "bvh.depth", "nodes", Better::Less, exactly(bvh.depth));
    figures.add(subject, "bvh.scene.ms", "ms", Better::Less, bvh.scene);
    figures.add(subject, "bvh.build.ms", "ms", Better::Less, bvh.build);
    figures.add(subject, "bvh.refit.ms", "ms", Better::Less, bvh.refit);
    figures.add(subject, "bvh.sah_cost", "records", Better::Less, exactly(bvh.sahCost));
    if (!bvh.embree)
        return;
    figures.add(subject, "bvh.embree_build.ms", "ms", Better::None, bvh.embree->build);
    figures.add(subject, "bvh.embree_sah_cost", "records", Better::None,
                exactly(bvh.embree->sahCost));
}

std::string tableOf(const BvhFigures& bvh) {
    TextTable table({"tree", "ours", "quartiles", "Embree", "quartiles", "ours / Embree"});
    const auto range = [](const Spread& spread) {
        return digits(spread.lower) + " - " + digits(spread.upper);
    };
    const auto against = [](double ours, double theirs) {
        return theirs > 0.0 ? fmt::format("{:.2f}", ours / theirs) : std::string("-");
    };
    table.add({"whole scene, ms", digits(bvh.scene.median), range(bvh.scene), "", "", ""});
    const auto& embree = bvh.embree;
    table.add({"build, ms", digits(bvh.build.median), range(bvh.build),
               embree ? digits(embree->build.median) : "-", embree ? range(embree->build) : "-",
               embree ? against(bvh.build.median, embree->build.median) : "-"});
    table.add({"refit, ms", digits(bvh.refit.median), range(bvh.refit), "", "", ""});
    table.add({"SAH cost, records", digits(bvh.sahCost), "", embree ? digits(embree->sahCost) : "-",
               "", embree ? against(bvh.sahCost, embree->sahCost) : "-"});
    const double triangles = std::max(1.0, double(bvh.triangles));
    return table.text() +
           fmt::format("  {} triangles, {} ({:.1f} bytes each), depth {}; {} threads{}\n\n",
                       bvh.triangles, bytesText(double(bvh.bytes)), double(bvh.bytes) / triangles,
                       bvh.depth, bvh.threads, embree ? "" : "; without Embree");
}

} // namespace afterglow
