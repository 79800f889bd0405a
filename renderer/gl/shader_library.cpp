// SPDX-License-Identifier: MIT
#include "renderer/gl/shader_library.h"

#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/gl/embedded_shaders.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace afterglow {

namespace {

std::string joined(const std::vector<std::string>& files) {
    std::string names;
    for (const std::string& file : files)
        names += (names.empty() ? "" : " + ") + file;
    return names;
}

std::string allText(const std::vector<ExpandedShader>& stages) {
    std::string text;
    for (const ExpandedShader& stage : stages)
        text += stage.text;
    return text;
}

template <class Program>
Program make(const std::string& name, const std::vector<ExpandedShader>& stages) {
    if constexpr (std::is_same_v<Program, ComputeProgram>)
        return ComputeProgram(name, stages[0]);
    else
        return RasterProgram(name, stages[0], stages[1]);
}

} // namespace

ShaderLibrary::ShaderLibrary(ShaderSource source, Defines common)
    : source_(std::move(source)), common_(std::move(common)) {}

bool ShaderLibrary::fetchesByImage() const {
    return std::ranges::any_of(common_,
                               [](const auto& define) { return define.first == "FETCH_BY_IMAGE"; });
}

std::vector<ExpandedShader> ShaderLibrary::expand(const std::vector<std::string>& files,
                                                  const Defines& defines) const {
    Defines all = common_;
    all.insert(all.end(), defines.begin(), defines.end());
    std::vector<ExpandedShader> stages;
    for (const std::string& file : files)
        stages.push_back(source_.expand(file, all));
    return stages;
}

template <class Program>
Program& ShaderLibrary::get(Entries<Program>& entries, std::vector<std::string> files,
                            const Defines& defines) {
    std::string key = joined(files);
    for (const auto& [macro, value] : defines)
        key += "\n" + macro + " " + value;
    const auto found = entries.find(key);
    if (found != entries.end())
        return *found->second.program;

    const std::vector<ExpandedShader> stages = expand(files, defines);
    auto program = std::make_unique<Program>(make<Program>(joined(files), stages));
    Program& result = *program;
    entries.emplace(std::move(key), Entry<Program>{std::move(files), defines, allText(stages), "",
                                                   std::move(program)});
    return result;
}

ComputeProgram& ShaderLibrary::compute(std::string_view name, const Defines& defines) {
    return get(compute_, {std::string(name)}, defines);
}

RasterProgram& ShaderLibrary::raster(std::string_view vertexName, std::string_view fragmentName) {
    return get(raster_, {std::string(vertexName), std::string(fragmentName)}, {});
}

template <class Program>
void ShaderLibrary::reload(Entries<Program>& entries, ReloadReport& report) {
    for (auto& [key, entry] : entries) {
        const std::string tried = std::exchange(entry.tried, {}); // a missing file is tried again
        try {
            const std::vector<ExpandedShader> stages = expand(entry.files, entry.defines);
            entry.tried = allText(stages);
            // Texts are compared, not times: a file may be saved twice within one tick of the
            // clock.
            if (entry.tried != tried) {
                *entry.program = make<Program>(joined(entry.files), stages);
                entry.error.clear();
                ++report.reloaded;
            }
        } catch (const Error& error) {
            entry.error = error.what();
        }
        if (!entry.error.empty() && !std::ranges::count(report.errors, entry.error))
            report.errors.push_back(entry.error);
    }
}

ShaderLibrary::ReloadReport ShaderLibrary::reload() {
    ReloadReport report;
    if (source_.isEmbedded())
        return report;
    reload(compute_, report);
    reload(raster_, report);
    return report;
}

std::string ShaderLibrary::fingerprint(std::span<const std::string_view> folders) const {
    const auto isShader = [&](std::string_view name) {
        return (name.ends_with(".comp") || name.ends_with(".vert") || name.ends_with(".frag")) &&
               std::ranges::any_of(
                   folders, [&](std::string_view folder) { return name.starts_with(folder); });
    };
    Hash hash;
    // A folder of shaders has the same files as the executable that was built from it.
    for (const EmbeddedFile& file : embeddedFiles())
        if (isShader(file.name)) {
            hash.addList(file.name);
            hash.addList(source_.expand(file.name, common_).text);
        }
    return hash.hex();
}

ShaderLibrary makeShaderLibrary(const GlInfo& info,
                                const std::optional<std::filesystem::path>& folder) {
    Defines common;
    if (info.softwareRasterizer)
        common.emplace_back("FETCH_BY_IMAGE", "1");
    if (folder) {
        if (!std::filesystem::is_directory(*folder))
            throw InputError(folder->string() + ": there is no such folder of shaders");
        return ShaderLibrary(ShaderSource::fromDirectory(*folder), std::move(common));
    }
#ifdef AFTERGLOW_SHADER_DIR
    if (std::filesystem::is_directory(AFTERGLOW_SHADER_DIR))
        return ShaderLibrary(ShaderSource::fromDirectory(AFTERGLOW_SHADER_DIR), std::move(common));
#endif
    return ShaderLibrary(ShaderSource::embedded(), std::move(common));
}

} // namespace afterglow
