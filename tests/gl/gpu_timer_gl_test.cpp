// SPDX-License-Identifier: MIT
#include "renderer/gl/gpu_timer.h"
#include "tests/support/gl_fixture.h"

#include <chrono>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

std::vector<std::string> namesOf(const std::vector<GpuTimer::Entry>& entries) {
    std::vector<std::string> names;
    for (const auto& entry : entries)
        names.push_back(entry.name);
    return names;
}

void runFrame(GpuTimer& timer, std::initializer_list<const char*> names) {
    timer.beginFrame();
    for (const char* name : names)
        const GpuTimer::Scope scope = timer.scope(name);
    timer.endFrame();
}

/// Keeps the device busy for some milliseconds.
void work(ComputeProgram& program, GpuTexture& texture) {
    program.dispatch(texture.size(), glm::ivec4(400, 0, 0, 0), {}, {{"values", texture}});
}

} // namespace

TEST_CASE("a timer lists the scopes of a frame in order and sums those of one name") {
    testContext();
    const GlCheck check;
    for (const bool software : {true, false}) {
        CAPTURE(software);
        GpuTimer timer(software);
        timer.setEnabled(true);
        runFrame(timer, {"trace", "filter", "trace", "filter", "show"});
        const GpuTimer::FrameTimes& times = timer.finish();
        CHECK(namesOf(times.scopes) == std::vector<std::string>{"trace", "filter", "show"});
        for (const auto& entry : times.scopes)
            CHECK(entry.milliseconds >= 0.0);
    }
}

TEST_CASE("the times of the frame that ended last can be waited for, and no frame has another's") {
    testContext();
    const GlCheck check;
    const std::vector<std::vector<const char*>> frames{
        {"a", "b"}, {"a"}, {}, {"b", "c", "d"}, {"e"}, {"a", "b"}, {"f"}};
    for (const bool software : {true, false}) {
        CAPTURE(software);
        GpuTimer timer(software);
        CHECK(timer.finish().frame == 0);
        timer.setEnabled(true);
        std::uint64_t number = 0;
        const auto run = [&] {
            const auto& names = frames[number % frames.size()];
            timer.beginFrame();
            for (const char* name : names)
                const GpuTimer::Scope scope = timer.scope(name);
            timer.endFrame();
            ++number;
        };
        const auto isWhole = [&](const GpuTimer::FrameTimes& times) {
            const auto& names = frames[(times.frame - 1) % frames.size()];
            return namesOf(times.scopes) == std::vector<std::string>(names.begin(), names.end());
        };
        for (int i = 0; i < 9; ++i) { // one after the other
            run();
            CHECK(timer.finish().frame == number);
            CHECK(isWhole(timer.newest()));
        }
        std::uint64_t known = number;
        for (int i = 0; i < 17; ++i) { // nobody waits
            run();
            CHECK(timer.newest().frame >= known);
            known = timer.newest().frame;
            CHECK(known <= number);
            CHECK(known + 4 >= number);
            CHECK(isWhole(timer.newest()));
        }
        CHECK(timer.finish().frame == number);
        CHECK(isWhole(timer.newest()));
        CHECK(timer.finish().frame == number); // as often as wanted
    }
}

TEST_CASE("a scope takes as long as the work in it, on this device") {
    const GlCheck check;
    const GlInfo info = glInfo(testContext());
    ComputeProgram program("busy.comp",
                           testShaders().source().expandText("busy.comp", R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 1) uniform Params { ivec4 rounds; };
uniform writeonly image2D values;
void main() {
    vec4 v = vec4(gl_GlobalInvocationID.xyxy);
    for (int i = 0; i < rounds.x; ++i)
        v = v * 0.999 + sin(v.yzwx);
    imageStore(values, ivec2(gl_GlobalInvocationID.xy), v);
}
)"));
    GpuTexture values("values", PixelFormat::RGBA32F, {256, 256});
    work(program, values); // compiled for good at the first dispatch
    glFinish();

    GpuTimer timer(info.softwareRasterizer);
    timer.setEnabled(true);
    const auto start = std::chrono::steady_clock::now();
    timer.beginFrame();
    {
        const auto scope = timer.scope("work");
        work(program, values);
    }
    { const auto scope = timer.scope("nothing"); }
    timer.endFrame();
    glFinish();
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    const GpuTimer::FrameTimes& times = timer.finish();
    REQUIRE(namesOf(times.scopes) == std::vector<std::string>{"work", "nothing"});
    const double worked = times.scopes[0].milliseconds;
    CHECK(worked > 0.0);
    CHECK(times.scopes[1].milliseconds < 0.5 * worked);
    CHECK(worked <= times.milliseconds);
    CHECK(times.milliseconds <= wall.count());
    MESSAGE("work ", worked, " ms of ", wall.count(), " ms");
}

TEST_CASE("a timer that is off times whole frames, and outside a frame it records nothing") {
    testContext();
    const GlCheck check;
    for (const bool software : {true, false}) {
        CAPTURE(software);
        GpuTimer timer(software);
        runFrame(timer, {"trace"});
        CHECK(timer.finish().frame == 1);
        CHECK(timer.newest().scopes.empty());
        timer.setEnabled(true);
        { const auto scope = timer.scope("no frame"); }
        CHECK(timer.finish().frame == 1);
        CHECK(timer.newest().scopes.empty());
        runFrame(timer, {"trace"});
        CHECK(namesOf(timer.finish().scopes) == std::vector<std::string>{"trace"});
        runFrame(timer, {"trace"});
        timer.setEnabled(false);
        CHECK(timer.newest().scopes.empty());
        CHECK(timer.finish().frame == 3); // also what was on its way
        CHECK(timer.newest().scopes.empty());
    }
}

TEST_CASE("scopes do not nest") {
    testContext();
    GpuTimer timer(true);
    const auto outer = timer.scope("outer");
    CHECK_THROWS_WITH_AS(timer.scope("inner"), "a timer's scopes do not nest: inner inside outer",
                         std::logic_error);
}
