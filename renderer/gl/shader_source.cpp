// SPDX-License-Identifier: MIT
#include "renderer/gl/shader_source.h"

#include "renderer/base/error.h"
#include "renderer/gl/embedded_shaders.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

namespace afterglow {

namespace {

using Loader = std::function<std::optional<std::string>(const std::string&)>;

std::string_view takeLine(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    return line;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

class Expander {
public:
    Expander(const Loader& load, const Defines& defines) : load_(load), defines_(defines) {}

    ExpandedShader run(std::string_view name, std::string_view text) {
        add(std::string(name), text);
        return std::move(result_);
    }

private:
    void add(std::string name, std::string_view text) {
        const std::size_t file = result_.files.size();
        result_.files.push_back(std::move(name));
        for (int number = 1; !text.empty(); ++number) {
            const std::string_view line = takeLine(text);
            if (line.starts_with("#pragma once"))
                continue;
            if (line.starts_with("#include \"")) {
                include(line, file, number);
                continue;
            }
            put(line, file, number);
            if (file == 0 && line.starts_with("#version"))
                for (const auto& [macro, value] : defines_)
                    put("#define " + macro + " " + value, file, number);
        }
    }

    void include(std::string_view line, std::size_t file, int number) {
        const std::string where = result_.files[file] + ":" + std::to_string(number);
        line.remove_prefix(std::string_view("#include \"").size());
        const std::size_t quote = line.find('"');
        if (quote == std::string_view::npos)
            throw Error(where + ": an include without its closing quote");
        const std::string name(line.substr(0, quote));
        if (std::ranges::count(result_.files, name))
            return;
        const std::optional<std::string> text = load_(name);
        if (!text)
            throw Error(where + ": there is no shader file " + name);
        add(name, *text);
    }

    void put(std::string_view line, std::size_t file, int number) {
        result_.text += line;
        result_.text += '\n';
        result_.lines.push_back({file, number});
    }

    const Loader& load_;
    const Defines& defines_;
    ExpandedShader result_;
};

/// The line number that a driver's message begins with, and the message after it.
struct Located {
    std::optional<int> line;
    std::string_view message;
};
Located splitMessage(std::string_view message) {
    message = trimmed(message);
    for (const std::string_view prefix : {"ERROR: ", "WARNING: "})
        if (message.starts_with(prefix))
            message.remove_prefix(prefix.size());
    // 0:43(9): text | 0(43) : text | 0:43: text; the 0 is the only string that we give.
    const auto number = [&](std::size_t from, int& value) {
        const char* begin = message.data() + from;
        const auto [end, error] = std::from_chars(begin, message.data() + message.size(), value);
        return error == std::errc() ? std::size_t(end - message.data()) : 0;
    };
    int line = 0;
    if (!message.starts_with("0:") && !message.starts_with("0("))
        return {std::nullopt, message};
    const std::size_t end = number(2, line);
    const std::size_t colon = message.find(':', end);
    if (end == 0 || colon == std::string_view::npos)
        return {std::nullopt, message};
    return {line, trimmed(message.substr(colon + 1))};
}

bool isError(std::string_view line) {
    return line.find("error") != std::string_view::npos ||
           line.find("ERROR") != std::string_view::npos;
}

/// Removes "error: ", "error C1008: " or "error(#143) ", which every line of the log has.
std::string_view withoutSeverity(std::string_view message) {
    if (!message.starts_with("error"))
        return message;
    const bool numbered = message.starts_with("error(");
    const std::size_t end = message.find(numbered ? ") " : ": ");
    if (end != std::string_view::npos && end < 16)
        message.remove_prefix(end + 2);
    return message;
}

} // namespace

std::string ExpandedShader::locate(int line) const {
    if (line < 1 || std::size_t(line) > lines.size())
        return name();
    const Line& origin = lines[std::size_t(line) - 1];
    return files[origin.file] + ":" + std::to_string(origin.number);
}

std::string describeCompileError(const ExpandedShader& shader, std::string_view log) {
    std::vector<std::string_view> errors, others;
    for (std::string_view rest = log; !rest.empty();) {
        const std::string_view line = trimmed(takeLine(rest));
        if (line.empty())
            continue;
        // A count such as "ERROR: 2 compilation errors" says nothing of its own.
        if (isError(line) && line.find("compilation errors") == std::string_view::npos)
            errors.push_back(line);
        else
            others.push_back(line);
    }
    if (errors.empty())
        errors = others;
    if (errors.empty())
        return shader.name() + ": does not compile, and the driver does not say why";
    const Located first = splitMessage(errors.front());
    std::string text = first.line ? shader.locate(*first.line) : shader.name();
    text += ": ";
    text += withoutSeverity(first.message);
    // One mistake makes several messages on its line, such as a list of candidates.
    std::set<std::optional<int>> lines;
    for (const std::string_view error : errors)
        lines.insert(splitMessage(error).line);
    if (lines.size() > 1)
        text += " (and errors on " + std::to_string(lines.size() - 1) +
                (lines.size() == 2 ? " more line)" : " more lines)");
    return text;
}

ShaderSource ShaderSource::fromDirectory(std::filesystem::path root) {
    if (!std::filesystem::is_directory(root))
        throw InputError(root.string() + " is not a directory of shaders");
    ShaderSource source;
    source.root_ = std::move(root);
    return source;
}

std::optional<std::string> ShaderSource::load(const std::string& name) const {
    if (isEmbedded()) {
        const std::optional<std::string_view> bytes = embeddedFile(name);
        return bytes ? std::optional<std::string>(*bytes) : std::nullopt;
    }
    std::ifstream file(root_ / name, std::ios::binary);
    if (!file)
        return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

ExpandedShader ShaderSource::expand(std::string_view name, const Defines& defines) const {
    const std::optional<std::string> text = load(std::string(name));
    if (!text)
        throw Error("there is no shader file " + std::string(name) + " in " +
                    (isEmbedded() ? "the executable" : root_.string()));
    return expandText(name, *text, defines);
}

ExpandedShader ShaderSource::expandText(std::string_view name, std::string_view text,
                                        const Defines& defines) const {
    const Loader loader = [this](const std::string& file) { return load(file); };
    return Expander(loader, defines).run(name, text);
}

} // namespace afterglow
