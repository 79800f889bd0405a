// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/embedded_shaders.h"
#include "renderer/gl/shader_source.h"
#include "tests/support/message_of.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// Shaders in a folder that is gone with its test.
class ShaderFolder {
public:
    ShaderFolder& write(const std::string& name, const std::string& text) {
        folder_.write(name, text);
        return *this;
    }
    ShaderSource source() const { return ShaderSource::fromDirectory(folder_.path()); }

private:
    TemporaryFolder folder_;
};

std::string fileText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> locations(const ExpandedShader& shader) {
    std::vector<std::string> all;
    for (int line = 1; line <= int(shader.lines.size()); ++line)
        all.push_back(shader.locate(line));
    return all;
}

} // namespace

TEST_CASE("each included file appears once, where it is first asked for") {
    ShaderFolder folder;
    folder
        .write("a.comp", "#version 450 core\n#include \"lib/b.glsl\"\n#include \"lib/c.glsl\"\na\n")
        .write("lib/b.glsl", "#pragma once\n#include \"lib/c.glsl\"\nb\n")
        .write("lib/c.glsl",
               "#pragma once\n\n#include \"lib/b.glsl\"\nc"); // no line end, and a circle
    const ExpandedShader shader = folder.source().expand("a.comp");
    CHECK(shader.text == "#version 450 core\n\nc\nb\na\n");
    CHECK(shader.files == std::vector<std::string>{"a.comp", "lib/b.glsl", "lib/c.glsl"});
    CHECK(locations(shader) == std::vector<std::string>{"a.comp:1", "lib/c.glsl:2", "lib/c.glsl:4",
                                                        "lib/b.glsl:3", "a.comp:4"});
    CHECK(shader.locate(0) == "a.comp");
    CHECK(shader.locate(6) == "a.comp");
}

TEST_CASE("defines follow the version line and do not move the lines after it") {
    ShaderFolder folder;
    folder.write("a.comp", "// a comment\n#version 450 core\nlast\n");
    const ExpandedShader shader = folder.source().expand("a.comp", {{"ONE", "1"}, {"TWO", ""}});
    CHECK(shader.text == "// a comment\n#version 450 core\n#define ONE 1\n#define TWO \nlast\n");
    CHECK(shader.locate(3) == "a.comp:2");
    CHECK(shader.locate(5) == "a.comp:3");
}

TEST_CASE("only an include at the start of a line is one") {
    ShaderFolder folder;
    folder.write("a.comp", "// #include \"none.glsl\"\n#include <cstdint>\r\nlast\r\n");
    CHECK(folder.source().expand("a.comp").text ==
          "// #include \"none.glsl\"\n#include <cstdint>\nlast\n");
}

TEST_CASE("a file that is not there is named, and the line that asks for it") {
    ShaderFolder folder;
    folder.write("a.comp", "#include \"lib/b.glsl\"\n")
        .write("lib/b.glsl", "\n#include \"lib/none.glsl\"\n");
    folder.write("open.comp", "#include \"lib\n");
    const ShaderSource source = folder.source();
    CHECK(messageOf<Error>([&] { source.expand("a.comp"); }) ==
          "lib/b.glsl:2: there is no shader file lib/none.glsl");
    CHECK(messageOf<Error>([&] {
              source.expand("none.comp");
          }).starts_with("there is no shader file none.comp in /"));
    CHECK(messageOf<Error>([&] { source.expand("open.comp"); }) ==
          "open.comp:1: an include without its closing quote");
    CHECK(messageOf<Error>([] { ShaderSource::embedded().expand("none.comp"); }) ==
          "there is no shader file none.comp in the executable");
    CHECK(messageOf<Error>([] { ShaderSource::fromDirectory("/none/at/all"); }) ==
          "/none/at/all is not a directory of shaders");
}

TEST_CASE("a compiler's message is led back to its file, whichever driver wrote it") {
    ShaderFolder folder;
    folder.write("a.comp", "#version 450 core\n#include \"lib/bad.glsl\"\nvoid main() {}\n")
        .write("lib/bad.glsl", "\n\nbad\n");
    const ExpandedShader shader = folder.source().expand("a.comp", {{"X", "1"}});
    REQUIRE(shader.locate(5) == "lib/bad.glsl:3");
    const auto describe = [&](const char* log) { return describeCompileError(shader, log); };
    CHECK(describe("0:5(9): error: no function with name 'dott'\n") ==
          "lib/bad.glsl:3: no function with name 'dott'"); // Mesa
    CHECK(describe("0(5) : error C1008: undefined variable \"dott\"\n") ==
          "lib/bad.glsl:3: undefined variable \"dott\""); // NVIDIA
    CHECK(describe("ERROR: 0:5: 'dott' : no matching overloaded function found\n") ==
          "lib/bad.glsl:3: 'dott' : no matching overloaded function found"); // others
    CHECK(describe("0:5: error(#143) Undeclared identifier: dott\n") ==
          "lib/bad.glsl:3: Undeclared identifier: dott"); // AMD
    CHECK(describe("0:3(1): warning: unused\n0:5(9): error: first\n0:5(9): error:    "
                   "candidate\n0:6(1): error: second\n") ==
          "lib/bad.glsl:3: first (and errors on 1 more line)");
    CHECK(describe("ERROR: 0:6: x\nERROR: 1 compilation errors.  No code generated.\n") ==
          "a.comp:3: x");
    CHECK(describe("error: unresolved reference to function `f'\n") ==
          "a.comp: unresolved reference to function `f'");
    CHECK(describe("something else\n") == "a.comp: something else");
    CHECK(describe("") == "a.comp: does not compile, and the driver does not say why");
}

TEST_CASE("the executable carries every shader, byte by byte, and nothing else") {
    const std::filesystem::path root = sourceDir() / "shaders";
    const std::set<std::string> kinds{".comp", ".vert", ".frag", ".glsl", ".h"};
    std::set<std::string> onDisk, carried;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
        if (kinds.contains(entry.path().extension().string()))
            onDisk.insert(entry.path().lexically_relative(root).generic_string());
    for (const EmbeddedFile& file : embeddedFiles()) {
        const std::string name(file.name);
        CAPTURE(name);
        if (name.starts_with("noise/")) {
            CHECK(file.bytes == fileText(root / "../assets" / name));
            continue;
        }
        carried.insert(name);
        CHECK(file.bytes == fileText(root / name));
    }
    CHECK(carried == onDisk);
    CHECK(embeddedFile("lib/fetch.glsl").has_value());
    CHECK_FALSE(embeddedFile("lib/none.glsl").has_value());
}

TEST_CASE("every shader expands to the same text from the executable as from the source folder") {
    const ShaderSource folder = ShaderSource::fromDirectory(sourceDir() / "shaders");
    for (const EmbeddedFile& file : embeddedFiles()) {
        if (!file.name.ends_with(".comp") && !file.name.ends_with(".vert") &&
            !file.name.ends_with(".frag"))
            continue;
        CAPTURE(file.name);
        const ExpandedShader carried = ShaderSource::embedded().expand(file.name);
        const ExpandedShader fresh = folder.expand(file.name);
        CHECK(carried.text == fresh.text);
        CHECK(carried.files == fresh.files);
        CHECK(carried.text.starts_with("#version 450"));
    }
}
