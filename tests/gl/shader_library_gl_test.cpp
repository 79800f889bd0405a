// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

const std::string kFill = R"(#version 450 core
#include "lib/value.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D filled;
void main() { imageStore(filled, ivec2(gl_GlobalInvocationID.xy), vec4(value() + EXTRA)); }
)";

float valueOf(ComputeProgram& program) {
    GpuTexture filled("filled", PixelFormat::R32F, {8, 8});
    program.dispatch({8, 8}, {}, {{"filled", filled}});
    return filled.read<float>()({3, 4});
}

using Errors = std::vector<std::string>;

} // namespace

TEST_CASE("a program is compiled once for each set of defines") {
    testContext();
    const GlCheck check;
    const TemporaryFolder folder;
    folder.write("fill.comp", kFill);
    folder.write("lib/value.glsl", "float value() { return 1.0 + COMMON; }\n");
    ShaderLibrary library(ShaderSource::fromDirectory(folder.path()), {{"COMMON", "10.0"}});
    ComputeProgram& plain = library.compute("fill.comp", {{"EXTRA", "0.0"}});
    ComputeProgram& more = library.compute("fill.comp", {{"EXTRA", "100.0"}});
    CHECK(&plain != &more);
    CHECK(&plain == &library.compute("fill.comp", {{"EXTRA", "0.0"}}));
    CHECK(valueOf(plain) == 11.0f);
    CHECK(valueOf(more) == 111.0f);
}

TEST_CASE("a changed file changes the programs made from it, and no others") {
    testContext();
    const GlCheck check;
    const TemporaryFolder folder;
    folder.write("fill.comp", kFill);
    folder.write("lib/value.glsl", "float value() { return 1.0; }\n");
    folder.write("other.comp", "#version 450 core\nlayout(local_size_x = 8) in;\nvoid main() {}\n");
    ShaderLibrary library(ShaderSource::fromDirectory(folder.path()), {{"EXTRA", "0.0"}});
    ComputeProgram& program = library.compute("fill.comp");
    const GLuint other = library.compute("other.comp").id();
    CHECK(library.reload().reloaded == 0);

    folder.write("lib/value.glsl", "float value() { return 2.0; }\n");
    const auto report = library.reload();
    CHECK(report.reloaded == 1);
    CHECK(report.errors.empty());
    CHECK(valueOf(program) == 2.0f);
    CHECK(library.compute("other.comp").id() == other);
    CHECK(library.reload().reloaded == 0);
}

TEST_CASE("an edit that does not compile leaves the program of before in use, until it is mended") {
    testContext();
    const GlCheck check;
    const TemporaryFolder folder;
    folder.write("fill.comp", kFill);
    folder.write("lib/value.glsl", "float value() { return 1.0; }\n");
    ShaderLibrary library(ShaderSource::fromDirectory(folder.path()), {{"EXTRA", "0.0"}});
    ComputeProgram& program = library.compute("fill.comp");

    folder.write("lib/value.glsl", "// broken\n\nfloat value() { return dott(1.0); }\n");
    for (int i = 0; i < 2; ++i) {
        const auto report = library.reload();
        CHECK(report.reloaded == 0);
        REQUIRE(report.errors.size() == 1);
        CHECK(report.errors.front().starts_with("lib/value.glsl:3: "));
        CHECK(report.errors.front().find("dott") != std::string::npos);
        CHECK(valueOf(program) == 1.0f);
    }

    std::filesystem::remove(folder / "lib/value.glsl");
    CHECK(library.reload().errors == Errors{"fill.comp:2: there is no shader file lib/value.glsl"});
    CHECK(valueOf(program) == 1.0f);

    folder.write("lib/value.glsl", "float value() { return 3.0; }\n");
    const auto mended = library.reload();
    CHECK(mended.reloaded == 1);
    CHECK(mended.errors.empty());
    CHECK(valueOf(program) == 3.0f);
}

TEST_CASE("a file that comes back as it was is no longer reported as missing") {
    testContext();
    const TemporaryFolder folder;
    folder.write("fill.comp", kFill);
    folder.write("lib/value.glsl", "float value() { return 1.0; }\n");
    ShaderLibrary library(ShaderSource::fromDirectory(folder.path()), {{"EXTRA", "0.0"}});
    library.compute("fill.comp");
    std::filesystem::remove(folder / "lib/value.glsl");
    CHECK(library.reload().errors.size() == 1);
    folder.write("lib/value.glsl", "float value() { return 1.0; }\n");
    CHECK(library.reload().errors.empty());
}

TEST_CASE("a raster program is reloaded from either of its files") {
    testContext();
    const GlCheck check;
    const TemporaryFolder folder;
    folder.write("a.vert", "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n");
    folder.write("a.frag", "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(0); }\n");
    ShaderLibrary library(ShaderSource::fromDirectory(folder.path()));
    RasterProgram& program = library.raster("a.vert", "a.frag");
    CHECK(&program == &library.raster("a.vert", "a.frag"));
    folder.write("a.frag", "#version 450 core\nout vec4 c;\nvoid main() { c = 1; }\n");
    const auto report = library.reload();
    REQUIRE(report.errors.size() == 1);
    CHECK(report.errors.front().starts_with("a.frag:3: "));
    folder.write("a.frag", "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(1); }\n");
    CHECK(library.reload().reloaded == 1);
}

TEST_CASE("a shader that was never there, or never compiled, is an error at once") {
    testContext();
    const TemporaryFolder folder;
    folder.write("bad.comp", "#version 450 core\nvoid main() { x = 1; }\n");
    ShaderLibrary library(ShaderSource::fromDirectory(folder.path()));
    CHECK_THROWS_AS(library.compute("bad.comp"), Error);
    CHECK_THROWS_AS(library.compute("bad.comp"), Error); // it was not kept
    CHECK_THROWS_AS(library.compute("none.comp"), Error);
}

TEST_CASE("what the executable carries compiles to the same programs as the source folder") {
    const GlCheck check;
    const GlInfo info = glInfo(testContext());
    ShaderLibrary embedded(ShaderSource::embedded(),
                           info.softwareRasterizer ? Defines{{"FETCH_BY_IMAGE", "1"}} : Defines{});
    CHECK(embedded.common() == testShaders().common());
    CHECK(embedded.reload().reloaded == 0);
}
