// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/program.h"
#include "renderer/gl/shader_source.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// Programs by the names of their files. Each is compiled when it is first asked for; the reference
/// stays good for the life of the library, over reload() too.
class ShaderLibrary {
public:
    /// `common` defines go to every program, before its own.
    explicit ShaderLibrary(ShaderSource source, Defines common = {});

    /// Returns "denoise/atrous.comp", compiled once for each set of defines. Throws Error when it
    /// does not compile.
    ComputeProgram& compute(std::string_view name, const Defines& defines = {});
    RasterProgram& raster(std::string_view vertexName, std::string_view fragmentName);

    struct ReloadReport {
        int reloaded = 0; ///< programs replaced by this call
        std::vector<std::string>
            errors; ///< of all programs whose files do not compile as they stand
    };
    /// Compiles the programs whose files are not as they were. One that does not compile stays as
    /// it was, and its error is in every report until its files are mended. Nothing to do when
    /// embedded.
    ReloadReport reload();

    /// Returns a hash of the texts, as they stand now, of all shaders whose names begin with one of
    /// these ("lighting/"), with all that they include and the common defines. Throws Error where
    /// one includes a file that is not there.
    std::string fingerprint(std::span<const std::string_view> folders) const;

    const ShaderSource& source() const { return source_; }
    const Defines& common() const { return common_; }
    /// Returns whether textures are images in its programs: see shaders/lib/fetch.glsl.
    bool fetchesByImage() const;

private:
    template <class Program>
    struct Entry {
        std::vector<std::string> files; ///< one a stage
        Defines defines;
        std::string tried; ///< the text that was last compiled, or failed to
        std::string error; ///< empty unless that failed
        std::unique_ptr<Program> program;
    };
    template <class Program>
    using Entries = std::map<std::string, Entry<Program>>;

    template <class Program>
    Program& get(Entries<Program>& entries, std::vector<std::string> files, const Defines& defines);
    template <class Program>
    void reload(Entries<Program>& entries, ReloadReport& report);
    std::vector<ExpandedShader> expand(const std::vector<std::string>& files,
                                       const Defines& defines) const;

    ShaderSource source_;
    Defines common_;
    Entries<ComputeProgram> compute_;
    Entries<RasterProgram> raster_;
};

/// Makes a library of the shaders of a folder; without one, of the source folder in a build for
/// development that still finds it, else of those of the executable. Throws InputError for a folder
/// that is not there. Defines FETCH_BY_IMAGE where that is the faster way to read a texture: see
/// shaders/lib/fetch.glsl.
ShaderLibrary makeShaderLibrary(const GlInfo& info,
                                const std::optional<std::filesystem::path>& folder = {});

} // namespace afterglow
