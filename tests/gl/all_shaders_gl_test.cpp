// SPDX-License-Identifier: MIT
// Every shader, in both ways of fetching textures, through this driver and through Khronos' own
// compiler: drivers accept different mistakes.

#include "tests/support/gl_fixture.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace afterglow;

namespace {

struct Variant {
    std::string name;
    Defines defines;
};

std::vector<Variant> allVariants() {
    std::vector<Variant> variants;
    const std::filesystem::path root = sourceDir() / "shaders";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension();
        if (extension != ".comp" && extension != ".vert" && extension != ".frag")
            continue;
        const std::string name = std::filesystem::relative(entry.path(), root).generic_string();
        std::vector<Defines> defines{{}};
        if (name.find("atrous") != std::string::npos)
            defines = {{{"KERNEL_RADIUS", "1"}},
                       {{"KERNEL_RADIUS", "2"}},
                       {{"KERNEL_RADIUS", "2"}, {"NORMAL_SQUARINGS", "7"}}};
        if (name == "denoise/temporal.comp" || name == "denoise/gradient.comp")
            defines = {{}, {{"INSPECT", "1"}}};
        if (name == "denoise/temporal.comp")
            defines.push_back({{"FOR_PLAN", "1"},
                               {"LAMBDA_SOURCE", "0"},
                               {"LAMBDA_FETCH", "0"},
                               {"LAMBDA_USE", "0"},
                               {"HISTORY_LAW", "0"},
                               {"CLAMP_RADIUS", "-1"}});
        if (name == "lighting/rays.comp" || name == "lighting/trace.comp")
            defines = {{{"SHADOWS", "1"}, {"FIRST", "1"}},
                       {{"AMBIENT_OCCLUSION", "1"}},
                       {{"AMBIENT_OCCLUSION", "1"}, {"FIRST", "1"}}};
        if (name == "lighting/trace.comp")
            for (const char* kind : {"SHADOWS", "PENDING"})
                defines.push_back({{kind, "1"}, {"SIGNALS", "2"}});
        if (name.starts_with("lighting/path_"))
            defines = {
                {{"PATH_DIVISION", "0"}}, {{"PATH_DIVISION", "1"}}, {{"PATH_DIVISION", "2"}}};
        if (name == "bench/rays.comp")
            defines = {{{"PRIMARY", "1"}}, {{"BOUNCE", "1"}}, {{"BOUNCE_SHADOW", "1"}}};
        if (name == "post/debug_view.comp")
            defines = {{{"SOURCE", "Float4Texture"}},
                       {{"SOURCE", "Uint4Texture"}, {"SOURCE_IS_INTEGER", "1"}}};
        if (name == "post/tonemap.comp")
            defines = {{},
                       {{"TONE_MAPPER", "1"}},
                       {{"TONE_MAPPER", "2"}},
                       {{"TONE_MAPPER", "3"}, {"AUTO_EXPOSURE", "1"}}};
        if (name == "post/taa.comp")
            defines = {{}, {{"AUTO_EXPOSURE", "1"}}};
        for (Defines& d : defines) {
            variants.push_back({name, d});
            d.emplace_back("FETCH_BY_IMAGE", "1");
            variants.push_back({name, d});
        }
    }
    return variants;
}

} // namespace

TEST_CASE("every shader is valid GLSL 4.50 to the reference compiler") {
    const ShaderSource source = ShaderSource::fromDirectory(sourceDir() / "shaders");
    const TemporaryFolder folder;
    REQUIRE_MESSAGE(std::system("glslangValidator --version > /dev/null 2>&1") == 0,
                    "glslangValidator is missing; third_party/install.sh --tests installs it");
    int checked = 0;
    for (const Variant& variant : allVariants()) {
        CAPTURE(variant.name);
        const std::filesystem::path file =
            folder / ("shader" + std::filesystem::path(variant.name).extension().string());
        std::ofstream(file) << source.expand(variant.name, variant.defines).text;
        CHECK(std::system(("glslangValidator " + file.string() + " > " + (folder / "log").string() +
                           " 2>&1 || { cat " + (folder / "log").string() + "; false; }")
                              .c_str()) == 0);
        ++checked;
    }
    CHECK(checked > 30);
}

TEST_CASE("every compute shader compiles in both ways of fetching textures") {
    const GlCheck noGlMessages;
    testContext();
    ShaderLibrary library(ShaderSource::fromDirectory(sourceDir() / "shaders"));
    for (const Variant& variant : allVariants())
        if (variant.name.ends_with(".comp")) {
            CAPTURE(variant.name);
            CHECK_NOTHROW(library.compute(variant.name, variant.defines));
        }
}
