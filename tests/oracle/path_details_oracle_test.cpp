// SPDX-License-Identifier: MIT
#include <random>

#include <doctest/doctest.h>

#include "renderer/scene/procedural.h"
#include "tests/oracle/path_scenes.h"

using namespace afterglow;
using namespace afterglow::reference;
using namespace afterglow::test;

// Tests of the path reference itself: random numbers, parts, doubts.

TEST_CASE("the numbers of a path are Halton's in bases of their own, those of x2 shifted") {
    constexpr std::uint32_t kBases[] = {2, 3, 5, 7, 11, 13, 2, 3, 5};
    const auto tile = readTile(sourceDir() / "assets/noise/blue_noise_128.pgm");
    const Random random(tile, 9);
    const auto apart = [](double a, double b) { return std::abs(a - b - std::round(a - b)); };
    const glm::uvec2 pixel(17, 101);
    const PathNumbers first(random, {pixel, 0});
    for (std::uint32_t d = 0; d < 9; ++d) {
        CAPTURE(d);
        const double base = kBases[d];
        CHECK(apart(PathNumbers(random, {pixel, 1}).u[d], first.u[d] + 1.0 / base) < 1e-12);
        CHECK(apart(PathNumbers(random, {pixel, kBases[d]}).u[d],
                    first.u[d] + 1.0 / (base * base)) < 1e-12);
        for (std::uint32_t e = 0; e < d; ++e)
            CHECK(apart(first.u[d], first.u[e]) > 1e-6);
    }
}

TEST_CASE("a gradient sample is seen from where the camera was") {
    const glm::dvec3 now(1.0), before(2.0);
    CHECK(eyeOf({{3, 4}, 7}, 7, now, before) == now);
    CHECK(eyeOf({{3, 4}, 6}, 7, now, before) == before);
    CHECK(eyeOf({{3, 4}, 0}, 1u << 18, now, before) == now);
    CHECK(eyeOf({{3, 4}, (1u << 18) - 1}, 1u << 18, now, before) == before);
}

TEST_CASE("a ray that passes an edge nearly is in doubt, on either side of it") {
    const PathScene scene(underLamp(3.0)); // the lamp ends at x = 1, one meter above
    const double margin = 1e-4 * scene.extent;
    for (const auto& [beside, isDoubtful] :
         {std::pair(-3.0, false), {-0.5, true}, {0.5, true}, {3.0, false}}) {
        CAPTURE(beside);
        const glm::dvec3 o(1.0 + beside * margin, 0.5, 0.3);
        const RayHit hit = closestHit(scene.view, o, {0, 1, 0});
        CHECK((hit.triangle != nullptr) == (beside < 0.0));
        CHECK(nearlyAnotherHit(scene.view, o, {0, 1, 0}, hit, margin) == isDoubtful);
    }
    const glm::dvec3 alongFloor = glm::normalize(glm::dvec3(1.0, -5e-4, 0.2));
    const RayHit edgeOn = closestHit(scene.view, {0.1, 2e-4, 0.05}, alongFloor);
    REQUIRE(edgeOn.triangle);
    CHECK(nearlyAnotherHit(scene.view, {0.1, 2e-4, 0.05}, alongFloor, edgeOn, 1e-9));
}

TEST_CASE("the signals of every division add up to the same light") {
    const PathScene scene(underLamp(3.0));
    const PathSurface x1 = floorSurface({glm::dvec3(0.8, 0.5, 0.2), 0.4, 0.5}, {1.2, 0.9, 0.3});
    const PathInputs in = scene.inputs(glm::dvec3(0.3));
    forEachPath(8, 16, [&](const PathNumbers& numbers, int) {
        const PathParts parts = tracePath(in, x1, numbers).parts;
        glm::dvec3 sums[3] = {};
        for (const Division division : {Division::Path, Division::Split, Division::Bounce})
            for (const DividedSignal& signal : signalsOf(division, parts, 1e9))
                sums[int(division)] += signal.value * signal.divisor;
        for (const int k : {1, 2})
            CHECK(glm::length(sums[k] - sums[0]) <= 1e-12 * glm::length(sums[0]));
        for (const DividedSignal& signal : signalsOf(Division::Split, parts, 0.25))
            CHECK(std::max({signal.value.x, signal.value.y, signal.value.z}) <= 0.25);
    });
    PathParts odd;
    odd.direct.specular = {INFINITY, NAN, 1.0};
    const auto signals = signalsOf(Division::Split, odd, 50.0);
    CHECK(signals[1].value == glm::dvec3(0.0, 0.0, 50.0));
    CHECK(signals[1].divisor == glm::dvec3(1e-3));
}

TEST_CASE("where rounding decides, a path says so") {
    // The same paths with inputs that differ by less than what 32 bits round away.
    Scene made = makeProceduralScene("cornell");
    for (std::size_t i = 0; i < made.materials.size(); ++i) {
        made.materials[i].metallic = i % 2 ? 0.7f : 0.0f;
        made.materials[i].roughness = 0.2f * float(i % 5);
    }
    const PathScene scene(std::move(made));
    const View view(cameraAt(scene.scene, poseAt(scene.scene, 0.0)), {61, 37});
    PathInputs in = scene.inputs(glm::dvec3(scene.scene.ambient));
    std::mt19937 bits(11);
    std::uniform_real_distribution<double> shift(-1e-7, 1e-7);
    const auto shifts = [&] { return glm::dvec3(shift(bits), shift(bits), shift(bits)); };
    int surfaces = 0, differing = 0, excused = 0, wrong = 0;
    double largest = 0.0;
    int next = 0;
    forEachPath(40, 61 * 37, [&](const PathNumbers& numbers, int) {
        const Seen seen = look(scene.view, view, glm::dvec2(next % 61 + 0.5, next / 61 % 37 + 0.5));
        ++next;
        if (!seen.triangle)
            return;
        ++surfaces;
        const PathSurface x1 =
            surfaceOn(scene.scene, scene.view, *seen.triangle, seen.hit.b, view.eye);
        PathSurface moved = x1;
        moved.lit.position += scene.extent * shifts();
        moved.lit.shading = glm::normalize(moved.lit.shading + shifts());
        PathNumbers others = numbers;
        for (double& u : others.u)
            u = std::clamp(u + 3.0 * shift(bits), 0.0, 1.0 - 1.0 / 16777216.0);
        in.withDoubts = false;
        const auto expected = signalsOf(Division::Split, tracePath(in, x1, numbers).parts, 50.0);
        const auto actual = signalsOf(Division::Split, tracePath(in, moved, others).parts, 50.0);
        const auto furthest = [&](const std::vector<DividedSignal>& tolerance, double factor) {
            double most = 0.0;
            for (int s : {0, 1})
                for (int k : {0, 1, 2}) {
                    const double value = expected[s].value[k];
                    const double allowed = 1e-4 * std::max(0.01, value) +
                                           (factor > 0.0 ? factor * tolerance[s].value[k] : 0.0);
                    most = std::max(most, std::abs(actual[s].value[k] - value) / allowed);
                }
            return most;
        };
        if (furthest({}, 0.0) <= 1.0)
            return;
        ++differing;
        in.withDoubts = true;
        const PathSample path = tracePath(in, x1, numbers);
        const double most = furthest(signalsOf(Division::Split, path.spread, 1e9), 4.0);
        if (path.doubtful)
            ++excused;
        else {
            largest = std::max(largest, most);
            wrong += most > 1.0;
        }
    });
    MESSAGE(surfaces, " surfaces, ", differing, " differ, ", excused, " excused, largest ",
            largest);
    CHECK(wrong == 0);
    CHECK(surfaces > 1000);
    CHECK(differing > 10);
    CHECK(excused > 0);
    CHECK(excused < differing); // the others are told by their spread
    CHECK(excused <= surfaces / 1000);
}
