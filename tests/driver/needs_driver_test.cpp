// SPDX-License-Identifier: MIT
// The resources that the shaders use, against the minima that OpenGL 4.5 promises.

#include "renderer/filters/svgf_filter.h"
#include "renderer/pipeline/renderer.h"
#include "renderer/scene/procedural.h"
#include "tests/driver/program_needs.h"
#include "tests/driver/workload.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("the driver is the one that Mesa was asked for") {
    const char* wanted = std::getenv("MESA_LOADER_DRIVER_OVERRIDE");
    const std::string renderer = glInfo(testContext()).renderer;
    MESSAGE(renderer);
    CHECK((!wanted || renderer.starts_with(wanted)));
}

// Beyond these minima the renderer needs one thing, which depends on the scene: buffers of texels
// longer than the 65,536 texels of MAX_TEXTURE_BUFFER_SIZE. TexelBuffer says so where a driver has
// less; those of GPUs have 2^27 or more.
TEST_CASE("no program needs more than the least that OpenGL 4.5 promises") {
    const GlCheck noGlMessages;
    ShaderLibrary shaders = freshShaders(); // those of a GPU
    const LinkedPrograms programs;
    renderEverything(shaders);
    CHECK(programs.all().size() > 25);
    ProgramNeeds most;
    for (const ProgramNeeds& needs : programs.all()) {
        CHECK(beyondMinima(needs) == "");
        most.samplers = std::max(most.samplers, needs.samplers);
        most.images = std::max(most.images, needs.images);
        most.largestBlock = std::max(most.largestBlock, needs.largestBlock);
        most.threads = std::max(most.threads, needs.threads);
        most.sharedBytes = std::max(most.sharedBytes, needs.sharedBytes);
    }
    MESSAGE("at most ", most.samplers, " samplers, ", most.images, " images, ", most.largestBlock,
            " bytes in a block, ", most.threads, " threads and ", most.sharedBytes,
            " shared bytes in a workgroup");
    // Nothing was overlooked: these are facts of the shaders.
    CHECK(most.samplers == 14);             // temporal, of the filter counted
    CHECK(most.images == 6);                // surface
    CHECK(most.sharedBytes == 3 * 64 * 16); // probe
}

TEST_CASE("what inspects a pass is compiled when a pixel is first inspected, and once") {
    const GlCheck noGlMessages;
    ShaderLibrary shaders = freshShaders();
    const Settings settings = settingsOf(Filter::Asvgf);
    renderFilter(shaders, settings);
    const LinkedPrograms programs;
    Renderer renderer(shaders, glInfo(testContext()));
    renderer.setScene(makeProceduralScene("tiny"));
    renderer.resize({19, 11});
    TemporalPass temporal(shaders);
    GradientPass gradient(shaders);
    FrameInput input;
    input.camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    renderer.render(input, settings);
    CHECK(programs.all().empty());
    auto [context, in, own] = renderer.filterCall(0, 0);
    for (int i = 0; i < 2; ++i) {
        PixelReadback readback;
        temporal.inspect(context, svgf::temporalInputs(in, own), {}, {3, 4}, readback);
        CHECK(programs.all().size() == 1);
    }
    PixelReadback readback;
    gradient.inspect(context, svgf::gradientInputs(in), {}, {1, 2}, readback);
    CHECK(programs.all().size() == 2);
}

TEST_CASE("a program that needs more than OpenGL 4.5 promises is found") {
    const GlCheck noGlMessages;
    testContext();
    std::string text = "#version 450 core\nlayout(local_size_x = 8) in;\n"
                       "layout(std140, binding = 1) uniform Params { vec4 rows[1025]; };\n";
    std::string sum = "rows[gl_LocalInvocationIndex]", stores;
    for (int i = 0; i < 17; ++i) {
        const std::string name = "s" + std::to_string(i);
        text += "uniform sampler2D " + name + ";\n";
        sum += " + texelFetch(" + name + ", ivec2(0), 0)";
    }
    for (int i = 0; i < 9; ++i) {
        const std::string name = "i" + std::to_string(i);
        text += "writeonly uniform image2D " + name + ";\n";
        stores += "imageStore(" + name + ", ivec2(0), sum);\n";
    }
    text += "void main() {\nvec4 sum = " + sum + ";\n" + stores + "}\n";
    const LinkedPrograms programs;
    const ComputeProgram program("greedy", samplerShaders().source().expandText("greedy", text));
    REQUIRE(programs.all().size() == 1);
    CHECK(beyondMinima(programs.all()[0]) ==
          "greedy needs 17 samplers in a stage; OpenGL 4.5 promises 16\n"
          "greedy needs 9 images; OpenGL 4.5 promises 8\n"
          "greedy needs 16400 bytes in a uniform block; OpenGL 4.5 promises 16384\n");
    CHECK(beyondMinima(
              {.name = "wide", .threads = 2048, .longestEdge = 2048, .sharedBytes = 1 << 16}) ==
          "wide needs 2048 threads in a workgroup; OpenGL 4.5 promises 1024\n"
          "wide needs 2048 threads along an edge of a workgroup; OpenGL 4.5 promises 1024\n"
          "wide needs 65536 bytes of shared memory; OpenGL 4.5 promises 32768\n");
}

TEST_CASE("shared memory is counted from the text of a shader") {
    CHECK(sharedBytes("\nconst uint kEdge = 8u;\nconst int kPlaces = int(kEdge * kEdge);\n"
                      "shared vec4 a[kPlaces];\nshared uint b;\nshared float c[3];\n") ==
          64 * 16 + 4 + 12);
    CHECK(sharedBytes("void main() {}\n") == 0);
}
