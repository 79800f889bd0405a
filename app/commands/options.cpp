// SPDX-License-Identifier: MIT
#include "app/commands/options.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <algorithm>
#include <charconv>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace afterglow {

namespace {

constexpr int kMaxEdge = 16384;                       // pixels along one side of an image
constexpr std::int64_t kMaxPixels = 64 * 1024 * 1024; // of one image

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 2 wrong usage, 3 bad input file, 4 no OpenGL 4.5 context to be had, "
    "130 interrupted, 1 anything else.";

/// A number that is the whole text; empty if it is not.
template <class T>
std::optional<T> parse(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

[[noreturn]] void refuse(const std::string& expected, const std::string& found) {
    throw UsageError(fmt::format("expected {}, found '{}'", expected, found));
}

template <class T>
Kind<T> wholeNumberOf(std::int64_t min, std::int64_t max, std::string word) {
    return {std::move(word), [=](const std::string& text) {
                const auto value = parse<std::int64_t>(text);
                if (!value || *value < min || *value > max)
                    refuse(fmt::format("a whole number from {} to {}", min, max), text);
                return T(*value);
            }};
}

} // namespace

Kind<std::string> anyText(std::string word) {
    return {std::move(word), [](const std::string& text) { return text; }};
}

Kind<int> wholeNumber(int min, int max, std::string word) {
    return wholeNumberOf<int>(min, max, std::move(word));
}

Kind<std::uint32_t> seedNumber() {
    return wholeNumberOf<std::uint32_t>(0, 0xffffffff, "S");
}

Kind<double> number(double min, double max, std::string word) {
    return {std::move(word), [=](const std::string& text) {
                const auto value = parse<double>(text);
                if (!value || !(*value >= min && *value <= max))
                    refuse(fmt::format("a number from {} to {}", min, max), text);
                return *value;
            }};
}

Kind<glm::ivec2> imageSize() {
    return {"WxH", [](const std::string& text) {
                const std::size_t cross = std::min(text.find('x'), text.size());
                const auto width = parse<std::int64_t>(text.substr(0, cross));
                const auto height =
                    parse<std::int64_t>(text.substr(std::min(cross + 1, text.size())));
                if (!width || !height)
                    refuse("WIDTHxHEIGHT in pixels, such as 1280x720", text);
                if (std::min(*width, *height) < 1 || std::max(*width, *height) > kMaxEdge)
                    refuse(fmt::format("sides of 1 to {} pixels", kMaxEdge), text);
                if (*width * *height > kMaxPixels)
                    refuse(fmt::format("at most {} x 2^20 pixels", kMaxPixels >> 20), text);
                return glm::ivec2(*width, *height);
            }};
}

Kind<Assignment> assignment() {
    return {"KEY=VALUE", [](const std::string& text) {
                const std::size_t sign = text.find('=');
                if (sign == text.npos || sign == 0 || sign + 1 == text.size())
                    refuse("KEY=VALUE", text);
                return Assignment(text.substr(0, sign), text.substr(sign + 1));
            }};
}

Kind<std::string> oneOf(std::string kind, std::vector<std::string> names) {
    return {"NAME", [kind = std::move(kind), names = std::move(names)](const std::string& text) {
                if (std::ranges::find(names, text) == names.end())
                    throw UsageError(unknownName(kind, text, {names.begin(), names.end()}));
                return text;
            }};
}

std::vector<std::string> partsOf(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (end == begin)
            refuse("names with commas between them", text);
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::string defaultText(const std::string& value) {
    return value.empty() ? "" : " [" + value + "]";
}

std::string defaultText(glm::ivec2 value) {
    return fmt::format(" [{}x{}]", value.x, value.y);
}

/// An option, and what takes each of its texts.
struct Options::Entry {
    CLI::Option* option;
    Take take;
};

Options::Options(CLI::App& app) : app_(app) {
    app_.allow_extras(); // command_line.cpp explains them
    app_.get_formatter()->column_width(32);
}

Options::~Options() = default;

void Options::addText(const std::string& names, const std::string& word, const std::string& help,
                      Count count, Take take) {
    CLI::Option* option = app_.add_option(names, CLI::callback_t(), help);
    const bool isPlace = option->get_positional();
    option->type_name(word);
    option->required(count == Count::Required || (isPlace && count == Count::Any));
    if (count == Count::Any || count == Count::Optional)
        option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if ((count == Count::Any && isPlace) || count == Count::Optional)
        option->expected(-1); // at least one where there is any
    if (count == Count::Two)
        option->expected(2);
    entries_.push_back({option, std::move(take)});
}

void Options::addFlag(const std::string& name, bool& value, const std::string& help) {
    app_.add_flag(name, value, help);
}

void Options::exclude(const std::string& name, std::initializer_list<const char*> others) {
    for (const char* other : others)
        app_.get_option(name)->excludes(app_.get_option(other));
}

void Options::need(const std::string& name, const std::string& other) {
    app_.get_option(name)->needs(app_.get_option(other));
}

void Options::check(std::function<void()> check) {
    checks_.push_back(std::move(check));
}

void Options::setFooter(const std::string& text) {
    app_.footer(text + "\n\n" + kExitCodes);
}

void Options::read() const {
    for (const Entry& entry : entries_)
        for (const std::string& text : entry.option->results())
            try {
                entry.take(text);
            } catch (const UsageError& error) {
                throw UsageError(entry.option->get_name() + ": " + error.what());
            }
    for (const auto& check : checks_)
        check();
}

} // namespace afterglow
