// SPDX-License-Identifier: MIT
#include "app/base/machine.h"
#include "app/bench/bvh_bench.h"
#include "app/bench/memory_bench.h"
#include "app/bench/pass_bench.h"
#include "app/bench/pass_bytes.h"
#include "app/bench/ray_bench.h"
#include "app/bench/scene_triangles.h"
#include "program.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace afterglow::test {

namespace {

constexpr glm::ivec2 kSize{61, 37};

/// Two frames of a scene with A-SVGF.
struct Frames {
    explicit Frames(std::string_view scene)
        : sequence(makeProceduralScene(scene), kSize, settingsOf(Filter::Asvgf)) {
        sequence.run(2);
    }
    Sequence sequence;
    Renderer& renderer = sequence.renderer();
};

nlohmann::json figuresOf(const std::string& file) {
    return nlohmann::json::parse(bytesOf(file)).at("figures");
}

double medianOf(const nlohmann::json& figures, const std::string& key) {
    CAPTURE(key);
    REQUIRE(figures.contains(key));
    return figures.at(key).at("median").get<double>();
}

std::size_t longestLine(const std::string& text) {
    std::size_t longest = 0, begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        longest = std::max(longest, end - begin);
        begin = end + 1;
    }
    return longest;
}

} // namespace

TEST_CASE("bench measures passes, rays, trees and memory, and writes what it prints") {
    const TemporaryFolder folder;
    const std::string file = folder / "out/bench.json";
    const Run run = afterglow({"bench", "cornell", "--size", "61x37", "--frames", "4", "--repeat",
                               "3", "--filter", "svgf,asvgf", "--what", "passes,rays,bvh,memory",
                               "--context", "osmesa", "--json", file});
    CAPTURE(run.out);
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    CHECK(run.err.empty());
    CHECK(longestLine(run.out) <= 100);
    const auto json = nlohmann::json::parse(bytesOf(file));
    CHECK(json.at("schema") == 1);
    CHECK(json.at("commit") == commit());
    CHECK(json.at("gl").at("backend") == "OSMesa");
    CHECK(json.at("machine").at("threads") >= 1);
    CHECK(json.at("scenes").at(0).at("name") == "cornell");
    const auto& figures = json.at("figures");
    for (const auto& [key, figure] : figures.items()) {
        CAPTURE(key);
        CHECK(figure.at("lower_quartile") <= figure.at("median"));
        CHECK(figure.at("median") <= figure.at("upper_quartile"));
        CHECK(figure.at("n") >= 1);
    }
    for (const char* filter : {"svgf", "asvgf"}) {
        const std::string own = "cornell/61x37/" + std::string(filter) + "/";
        CHECK(medianOf(figures, own + "frame.ms") > 0.0);
        CHECK(medianOf(figures, own + "passes.lighting.ms") > 0.0);
        CHECK(medianOf(figures, own + "passes.lighting.bytes") > 0.0);
        CHECK(medianOf(figures, own + "frame.passes_share") > 0.3);
        CHECK(medianOf(figures, own + "frame.passes_share") < 1.5); // medians of single passes
        CHECK(medianOf(figures, own + "memory.frame.bytes") > 0.0);
    }
    CHECK(medianOf(figures, "cornell/61x37/asvgf_over_svgf.ms") ==
          doctest::Approx(medianOf(figures, "cornell/61x37/asvgf/frame.ms") -
                          medianOf(figures, "cornell/61x37/svgf/frame.ms")));
    CHECK(medianOf(figures, "copy.gb_per_s") > 0.0);
    CHECK(medianOf(figures, "cornell/bvh.build.ms") > 0.0);
    CHECK(medianOf(figures, "cornell/bvh.embree_sah_cost") > 1.0);
    for (const RayKind kind : kRayKinds) {
        const std::string own = "cornell/61x37/rays." + std::string(nameOf(kind)) + ".";
        CHECK(medianOf(figures, own + "count") > 100.0);
        CHECK(medianOf(figures, own + "mrays_per_s") > 0.0);
        CHECK(medianOf(figures, own + "embree_ratio") ==
              doctest::Approx(medianOf(figures, own + "embree_mrays_per_s") /
                              medianOf(figures, own + "mrays_per_s")));
        CHECK(medianOf(figures, own + "disagreements") == 0.0);
    }
    CHECK(run.out.find("A-SVGF takes ") != std::string::npos);
    CHECK(run.out.find("bounce_shadow") != std::string::npos);
}

TEST_CASE("bench measures several scenes and sizes, and only what it was asked for") {
    const TemporaryFolder folder;
    const std::string file = folder / "bench.json";
    const Run run = afterglow({"bench", "tiny", "cornell", "--size", "8x8,16x9", "--filter", "none",
                               "--what", "memory", "--context", "osmesa", "--json", file});
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    std::set<std::string> subjects;
    const auto figures = figuresOf(file);
    for (const auto& [key, figure] : figures.items()) {
        CHECK(key.find("/none/memory.") != std::string::npos);
        subjects.insert(key.substr(0, key.find("/none/")));
    }
    CHECK(subjects ==
          std::set<std::string>{"tiny/8x8", "tiny/16x9", "cornell/8x8", "cornell/16x9"});
}

TEST_CASE("bench starts the program again, with an empty cache of shaders and with a full one") {
    const TemporaryFolder folder;
    const std::string file = folder / "bench.json";
    const Run run = afterglow({"bench", "tiny", "--size", "16x9", "--filter", "svgf", "--what",
                               "startup", "--repeat", "1", "--context", "osmesa", "--json", file});
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    const auto figures = figuresOf(file);
    for (const char* cache : {"cold", "warm"}) {
        const std::string own = "tiny/16x9/svgf/startup." + std::string(cache) + ".";
        double sum = 0.0;
        for (const char* phase :
             {"process", "scene", "context", "shaders", "bvh", "upload", "first frame"}) {
            CHECK(medianOf(figures, own + phase + ".ms") >= 0.0);
            sum += medianOf(figures, own + phase + ".ms");
        }
        CHECK(medianOf(figures, own + "total.ms") == doctest::Approx(sum));
    }
}

TEST_CASE("a comparison is exit code 1 if a time is worse by more than the bound, and names it") {
    const TemporaryFolder folder;
    const std::string before = folder / "before.json", after = folder / "after.json";
    REQUIRE(
        afterglow({"bench", "tiny", "--size", "16x9", "--frames", "4", "--filter", "none", "--what",
                   "passes", "--repeat", "1", "--context", "osmesa", "--json", before})
            .exitCode == 0);
    CHECK(afterglow({"bench", "--compare", before, before}).exitCode == 0);

    auto json = nlohmann::ordered_json::parse(bytesOf(before));
    auto& median = json.at("figures").at("tiny/16x9/none/passes.lighting.ms").at("median");
    median = median.get<double>() * 1.5;
    folder.write("after.json", json.dump());
    const Run run = afterglow({"bench", "--compare", before, after});
    CAPTURE(run.out);
    CHECK(run.exitCode == 1);
    CHECK(isOneErrorLine(run.err));
    CHECK(run.err.find("tiny/16x9/none/passes.lighting.ms") != std::string::npos);
    CHECK(run.out.find("1.500  worse") != std::string::npos);
    CHECK(longestLine(run.out) <= 100);
    CHECK(afterglow({"bench", "--compare", before, after, "--bound", "60"}).exitCode == 0);
    CHECK(afterglow({"bench", "--compare", after, before}).exitCode == 0); // it is faster
}

TEST_CASE("a comparison with a bad file is exit code 3 and one line that names it") {
    const TemporaryFolder folder;
    const std::string text = folder.write("text.json", "no JSON");
    const std::string other = folder.write("other.json", R"({"schema": 1})");
    const std::string missing = folder / "missing.json";
    for (const std::string& file : {text, other, missing}) {
        const Run run = afterglow({"bench", "--compare", file, file});
        CAPTURE(run.err);
        CHECK(run.exitCode == 3);
        CHECK(isOneErrorLine(run.err));
        CHECK(run.err.find(file) != std::string::npos);
    }
}

TEST_CASE("wrong usage of bench is exit code 2 and one line") {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--compare", "a.json"},
                                               {"--compare", "a.json", "b.json", "c.json"},
                                               {"--compare", "a.json", "b.json", "--bound", "-1"},
                                               {"--compare", "a.json", "b.json", "--what", "rays"},
                                               {"tiny", "--bound", "5"},
                                               {"tiny", "--what", "ray"},
                                               {"tiny", "tiny"},
                                               {"tiny", "--size", "8x8,8x8"},
                                               {"tiny", "--filter", "svgf,svgf"},
                                               {"tiny", "--frames", "3"},
                                               {"tiny", "--repeat", "0"},
                                               {"tiny", "cornell", "--start-once"}}) {
        std::vector<std::string> all{"bench"};
        all.insert(all.end(), words.begin(), words.end());
        CAPTURE(words);
        const Run run = afterglow(all);
        CAPTURE(run.err);
        CHECK(run.exitCode == 2);
        CHECK(isOneErrorLine(run.err));
    }
}

TEST_CASE("the rays that are measured are those of the frame, and each kind is what it says") {
    testContext();
    const GlCheck noGlMessages;
    Frames frames("cornell");
    const std::uint64_t traced = frames.renderer.readStats().rays;
    const auto visibility = frames.renderer.targets().surfaces.visibility.read<glm::uvec4>();
    RayLists lists(frames.renderer, testShaders());
    lists.list(RayKind::Shadow);
    const std::size_t shadows = lists.read().size();
    lists.list(RayKind::AmbientOcclusion);
    CHECK(shadows + lists.read().size() == traced);

    lists.list(RayKind::Closest);
    const auto rays = lists.read();
    const auto hits = lists.traceForHits();
    REQUIRE(rays.size() == std::size_t(kSize.x * kSize.y));
    std::set<std::uint32_t> pixels;
    std::size_t missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::ivec2 p(rays[i].pixel & 0xffffu, rays[i].pixel >> 16u);
        pixels.insert(rays[i].pixel);
        missed += visibility(p).x != 0u && hits[i] == 0 ? 1 : 0;
        CHECK(glm::length(rays[i].direction) == doctest::Approx(1.0f));
    }
    CHECK(pixels.size() == rays.size());
    // Back faces are culled and hit, so the reverse is not so.
    CHECK(missed <= 4); // the rasterizer snaps corners to a fraction of a pixel

    lists.list(RayKind::Bounce);
    const auto bounces = lists.read();
    const auto bounced = lists.traceForHits();
    const auto landed = std::size_t(std::ranges::count(bounced, 1));
    CHECK(bounces.size() > rays.size() / 2);
    lists.list(RayKind::BounceShadow);
    const auto shadowRays = lists.read();
    CHECK(shadowRays.size() > 100);
    CHECK(shadowRays.size() <= landed);
    for (const ListedRay& ray : shadowRays) {
        CHECK(ray.tMax > 0.0f);
        CHECK(ray.tMax < 1e4f);
    }
}

TEST_CASE(
    "Embree answers as the program does for its own rays, in a box and among many triangles") {
    testContext();
    for (const char* scene : {"cornell", "rooms"}) {
        Frames frames(scene);
        Progress progress(1.0);
        const auto kinds = measureRays(frames.renderer, testShaders(), 1, progress);
        REQUIRE(kinds.size() == kRayKinds.size());
        for (const RayFigures& kind : kinds) {
            CAPTURE(scene);
            CAPTURE(nameOf(kind.kind));
            REQUIRE(kind.embree);
            CHECK(kind.rays > 0);
            // Rays that graze an edge may hit for one and miss for the other.
            CHECK(kind.embree->disagreements <= (std::string_view(scene) == "cornell" ? 0 : 2));
        }
    }
}

TEST_CASE("a tree has the triangles of its scene once each") {
    for (const char* name : {"cornell", "moving"}) {
        const Scene scene = makeProceduralScene(name);
        std::size_t expected = 0;
        for (const Instance& instance : scene.instances)
            expected += scene.meshes[instance.mesh].triangles.size();
        std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
        for (const gpu::BvhTriangle& triangle : trianglesOf(SceneBvh(scene)))
            seen.insert({triangle.instance, triangle.triangle});
        CHECK(seen.size() == expected);
        const BvhFigures bvh = measureBvh(scene, 1);
        CHECK(bvh.triangles == expected);
        REQUIRE(bvh.embree);
        // Two builders with one rule: the costs are of one size.
        CHECK(bvh.sahCost / bvh.embree->sahCost > 0.5);
        CHECK(bvh.sahCost / bvh.embree->sahCost < 2.0);
    }
}

TEST_CASE("the bytes of a pass are those of the images that it reads and writes") {
    testContext();
    Frames frames("cornell");
    PassBytes bytes(frames.renderer);
    frames.sequence.next();
    const RenderTargets& t = frames.renderer.targets();
    const auto of = [](std::initializer_list<const GpuTexture*> images) {
        double sum = double(sizeof(gpu::FrameUniforms));
        for (const GpuTexture* image : images)
            sum += double(image->bytes());
        return sum;
    };
    const FilterTargets& shown = t.filters[0];
    REQUIRE(bytes.bytes().contains("tone map"));
    CHECK(bytes.bytes().at("tone map") == of({&shown.composed, &shown.display}));
    CHECK(bytes.bytes().at("composite") ==
          of({&t.surfaces.emission, &t.surfaces.guides, &frames.renderer.filteredSignal(),
              &t.surfaces.albedo, &shown.composed}));
    CHECK(bytes.bytes().at("visibility") == double(t.ids.bytes()));
    // Of the list of rays, those that are listed.
    RayLists lists(frames.renderer, testShaders());
    lists.list(RayKind::Shadow);
    const RayList& list = frames.renderer.lightingCall(0).out.rays;
    const Binding bound[] = {{"rays", list.rays}, {"rayCounts", list.counts}};
    CHECK(bytesOf(bound) == double(lists.read().size() * 32 + list.counts.bytes()));
}

TEST_CASE("memory by owner adds up to what there is") {
    testContext();
    Frames frames("cornell");
    const MemoryFigures memory = countMemory(frames.renderer, Filter::Asvgf);
    std::size_t images = 0;
    for (const auto& [owner, bytes] : memory.owners) {
        CAPTURE(owner);
        CHECK(bytes > 0);
        images += owner == "scene" || owner == "bvh" ? 0 : bytes;
    }
    CHECK(images == frames.renderer.targets().bytes());
    CHECK(memory.total() > images);
}

} // namespace afterglow::test
