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
        for (int frame = 0; frame < 6; ++frame)
            runFrame(timer, {"trace", "filter", "trace", "filter", "show"});
        glFinish();
        runFrame(timer, {"last"});
        glFinish();
        runFrame(timer, {"last"});
        CHECK((namesOf(timer.lastFrame()) == std::vector<std::string>{"trace", "filter", "show"} ||
               namesOf(timer.lastFrame()) == std::vector<std::string>{"last"}));
        for (int frame = 0; frame < 5; ++frame)
            runFrame(timer, {"last"});
        CHECK(namesOf(timer.lastFrame()) == std::vector<std::string>{"last"});
        for (const auto& entry : timer.lastFrame())
            CHECK(entry.milliseconds >= 0.0);
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
    for (int frame = 0; frame < 4 && timer.lastFrame().empty(); ++frame) {
        timer.beginFrame();
        timer.endFrame();
    }
    REQUIRE(namesOf(timer.lastFrame()) == std::vector<std::string>{"work", "nothing"});
    const double worked = timer.lastFrame()[0].milliseconds;
    CHECK(worked > 0.0);
    CHECK(worked <= wall.count());
    CHECK(timer.lastFrame()[1].milliseconds < 0.5 * worked);
    MESSAGE("work ", worked, " ms of ", wall.count(), " ms");
}

TEST_CASE("a timer that is off, or outside a frame, records nothing") {
    testContext();
    const GlCheck check;
    for (const bool software : {true, false}) {
        GpuTimer timer(software);
        runFrame(timer, {"trace"});
        CHECK(timer.lastFrame().empty());
        timer.setEnabled(true);
        { const auto scope = timer.scope("no frame"); }
        CHECK(timer.lastFrame().empty());
        for (int frame = 0; frame < 6; ++frame)
            runFrame(timer, {"trace"});
        CHECK(namesOf(timer.lastFrame()) == std::vector<std::string>{"trace"});
        timer.setEnabled(false);
        CHECK(timer.lastFrame().empty());
    }
}

TEST_CASE("scopes do not nest") {
    testContext();
    GpuTimer timer(true);
    const auto outer = timer.scope("outer");
    CHECK_THROWS_WITH_AS(timer.scope("inner"), "a timer's scopes do not nest: inner inside outer",
                         std::logic_error);
}
