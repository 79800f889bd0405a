// SPDX-License-Identifier: MIT
#include "app/commands/arguments.h"

#include "renderer/base/error.h"
#include "renderer/pipeline/settings.h"

#include <charconv>
#include <optional>

namespace afterglow {

namespace {

template <class T>
std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

std::string quoted(std::string_view text) {
    return "'" + std::string(text) + "'";
}

std::string shortest(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

} // namespace

glm::ivec2 parseSize(std::string_view option, std::string_view text) {
    const auto cross = text.find('x');
    const auto fail = [&](const std::string& why) {
        throw UsageError(std::string(option) + " " + std::string(text) + ": " + why);
    };
    if (cross == std::string_view::npos)
        fail("expected WIDTHxHEIGHT in pixels, such as 1280x720");
    const auto width = number<std::int64_t>(text.substr(0, cross));
    const auto height = number<std::int64_t>(text.substr(cross + 1));
    if (!width || !height)
        fail("expected WIDTHxHEIGHT in pixels, such as 1280x720");
    if (*width < 1 || *height < 1)
        fail("both sides must be at least 1 pixel");
    if (*width > kMaxEdge || *height > kMaxEdge)
        fail("no side may be longer than " + std::to_string(kMaxEdge) + " pixels");
    if (*width * *height > kMaxPixels)
        fail("more than " + std::to_string(kMaxPixels >> 20) + " x 2^20 pixels");
    return {int(*width), int(*height)};
}

std::int64_t parseWhole(std::string_view option, std::string_view text, std::int64_t min,
                        std::int64_t max) {
    const auto value = number<std::int64_t>(text);
    if (!value || *value < min || *value > max)
        throw UsageError(std::string(option) + ": expected a whole number from " +
                         std::to_string(min) + " to " + std::to_string(max) + ", found " +
                         quoted(text));
    return *value;
}

double parseNumber(std::string_view option, std::string_view text, double min, double max) {
    const auto value = number<double>(text);
    if (!value || !(*value >= min && *value <= max))
        throw UsageError(std::string(option) + ": expected a number from " + shortest(min) +
                         " to " + shortest(max) + ", found " + quoted(text));
    return *value;
}

std::vector<std::string> parseList(std::string_view option, std::string_view text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const auto end = std::min(text.find(',', begin), text.size());
        if (end == begin)
            throw UsageError(std::string(option) +
                             ": expected names with commas between them, found " + quoted(text));
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::pair<std::string, std::string> parseAssignment(std::string_view option,
                                                    std::string_view text) {
    const auto sign = text.find('=');
    if (sign == std::string_view::npos || sign == 0 || sign + 1 == text.size())
        throw UsageError(std::string(option) + ": expected KEY=VALUE, found " + quoted(text));
    return {std::string(text.substr(0, sign)), std::string(text.substr(sign + 1))};
}

LightEvent parseLightEvent(std::string_view option, std::string_view text) {
    auto [light, value] = parseAssignment(option, text);
    LightEvent event{.light = light, .on = true, .power = 1.0f};
    if (const auto at = value.rfind('@'); at != std::string::npos) {
        event.frame = int(parseWhole(std::string(option) + " " + std::string(text) + ": frame",
                                     std::string_view(value).substr(at + 1), 0, 1'000'000));
        value.erase(at);
    }
    if (value == "off" || value == "on") {
        event.on = value == "on";
        return event;
    }
    event.power = number<float>(value);
    if (!event.power || !(*event.power >= 0.0f && *event.power <= 1e6f))
        throw UsageError(std::string(option) + ": expected NAME=on, NAME=off or NAME=POWER (0 to " +
                         "1000000), each with @FRAME or without, found " + quoted(text));
    return event;
}

std::size_t cameraIndex(const Scene& scene, std::string_view name) {
    if (name.empty())
        return 0;
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].name == name)
            return i;
        known.push_back(scene.cameras[i].name);
    }
    throw UsageError(scene.name + ": " + unknownName("camera", name, known));
}

} // namespace afterglow
