// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace afterglow {

using Defines = std::vector<std::pair<std::string, std::string>>; ///< name, value; in order

/// One text for the driver, and where each of its lines comes from. There is no #line in it:
/// drivers lose the file number in some messages, so the numbers they give are looked up here.
struct ExpandedShader {
    struct Line {
        std::size_t file; ///< index into files
        int number;       ///< from 1
    };

    std::string text;
    std::vector<std::string> files; ///< the shader, then what it includes, in order of appearance
    std::vector<Line> lines;        ///< of the text, in order

    const std::string& name() const { return files.front(); }
    /// Returns "lib/bad.glsl:3" for a line of the text, counted from 1; the shader's name if there
    /// is none.
    std::string locate(int line) const;
};

/// Returns the first error of a driver's log in one line, "lib/bad.glsl:3: no function with name
/// 'dott'", and how many more there are. Understands Mesa (0:43(9)), NVIDIA (0(43)) and the older
/// 0:43:.
std::string describeCompileError(const ExpandedShader& shader, std::string_view log);

/// The source of shader text: a directory while developing, the executable once installed.
class ShaderSource {
public:
    static ShaderSource fromDirectory(std::filesystem::path root);
    static ShaderSource embedded() { return ShaderSource(); }

    bool isEmbedded() const { return root_.empty(); }

    /// Returns the file with all that it includes: `#include "path from the root"` at the start of
    /// a line, each file once. Drops `#pragma once`. The defines follow the #version line. It does
    /// not evaluate conditions: an include inside an #ifdef is included all the same. Throws Error
    /// for a file that is not there, naming the line that asks for it.
    ExpandedShader expand(std::string_view name, const Defines& defines = {}) const;

    /// Does the same for a text that is not a file of the source but includes some; `name` is for
    /// messages.
    ExpandedShader expandText(std::string_view name, std::string_view text,
                              const Defines& defines = {}) const;

private:
    ShaderSource() = default;
    std::optional<std::string> load(const std::string& name) const;

    std::filesystem::path root_; ///< empty: the embedded files
};

} // namespace afterglow
