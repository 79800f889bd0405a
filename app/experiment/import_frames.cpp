// SPDX-License-Identifier: MIT
#include "app/experiment/import_frames.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/image/color.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kNames{"signal", "lit", "color",
                                                 "display"}; // by Quantity

std::string endingOf(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return ending;
}

bool isPng(const fs::path& file) {
    return endingOf(file) == ".png";
}

/// "denoised_0007" is of frame 7.
std::optional<int> frameIn(const std::string& stem) {
    const std::size_t begin = stem.find_last_not_of("0123456789") + 1; // npos + 1 is 0
    int frame = 0;
    const auto [end, error] =
        std::from_chars(stem.data() + begin, stem.data() + stem.size(), frame);
    if (error != std::errc())
        return std::nullopt;
    return frame;
}

/// What may be frames of this quantity, in the order of their names.
std::set<fs::path> picturesIn(const fs::path& folder, std::optional<Quantity> quantity) {
    std::set<fs::path> files;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const fs::path& file = entry->path();
        const std::string ending = endingOf(file);
        const bool isFloat = ending == ".exr" || ending == ".pfm";
        const bool fits = !quantity ? isFloat || isPng(file)
                                    : (*quantity == Quantity::Display ? isPng(file) : isFloat);
        if (fits)
            files.insert(file);
    }
    if (error)
        throw InputError(folder.string() + ": cannot be read: " + error.message());
    return files;
}

std::vector<fs::path> framesIn(const fs::path& folder, std::optional<Quantity> quantity,
                               int frames) {
    std::map<int, fs::path> found;
    for (const fs::path& file : picturesIn(folder, quantity)) {
        const std::optional<int> frame = frameIn(file.stem().string());
        if (!frame || *frame >= frames)
            continue;
        const auto [other, isNew] = found.emplace(*frame, file);
        if (!isNew)
            throw InputError(file.string() + ": this is frame " + std::to_string(*frame) +
                             ", and so is " + other->second.filename().string());
    }
    const std::string wanted =
        quantity == Quantity::Display ? ".png" : (quantity ? ".exr or .pfm" : ".exr, .pfm or .png");
    for (int frame = 0; frame < frames; ++frame)
        if (!found.contains(frame))
            throw InputError(folder.string() + ": frame " + std::to_string(frame) +
                             " is missing: of 0 to " + std::to_string(frames - 1) + " it has " +
                             std::to_string(found.size()) + " as " + wanted);
    std::vector<fs::path> files;
    for (auto& [frame, file] : found)
        files.push_back(std::move(file));
    return files;
}

/// The inverse of shaders/post/tonemap.comp: y (x (2.43 x + 0.59) + 0.14) = x (2.51 x + 0.03) is
/// quadratic in x, and has one solution that is not negative, since y <= 1.
float linearOf(std::uint8_t display) {
    const double y = decodeSrgb(display / 255.0);
    const double a = 2.51 - 2.43 * y, b = 0.03 - 0.59 * y, c = -0.14 * y;
    return float((std::sqrt(b * b - 4.0 * a * c) - b) / (2.0 * a));
}

Image<glm::vec4> linearOf(const Image<glm::u8vec4>& display) {
    std::array<float, 256> linear{};
    for (std::size_t value = 0; value < linear.size(); ++value)
        linear[value] = linearOf(std::uint8_t(value));
    Image<glm::vec4> result(display.size());
    std::ranges::transform(display.pixels(), result.pixels().begin(), [&](const glm::u8vec4& p) {
        return glm::vec4(linear[p.r], linear[p.g], linear[p.b], 0.0f);
    });
    return result;
}

Image<glm::u8vec4> opaque(Image<glm::u8vec4> image) {
    for (glm::u8vec4& pixel : image.pixels())
        pixel.a = 255;
    return image;
}

void requireGood(const fs::path& file, const Image<glm::vec4>& image, glm::ivec2 size) {
    const auto text = [](glm::ivec2 v, const char* between) {
        return std::to_string(v.x) + between + std::to_string(v.y);
    };
    if (image.size() != size)
        throw InputError(file.string() + ": is " + text(image.size(), "x") +
                         "; the exported frames are " + text(size, "x"));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::vec4& pixel = image({x, y});
            if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y) || !std::isfinite(pixel.z))
                throw InputError(file.string() + ": pixel (" + text({x, y}, ", ") +
                                 ") holds a value that is not finite");
        }
}

} // namespace

std::string_view nameOf(Quantity quantity) {
    return kNames[std::size_t(quantity)];
}

Quantity quantityFromName(std::string_view name) {
    const auto found = std::ranges::find(kNames, name);
    if (found == kNames.end())
        throwUnknownName("quantity", name, kNames);
    return Quantity(found - kNames.begin());
}

ImportedFrames::ImportedFrames(std::string variant, const fs::path& folder,
                               std::optional<Quantity> quantity, glm::ivec2 size, int frames)
    : variant_(std::move(variant)), size_(size), files_(framesIn(folder, quantity, frames)) {
    quantity_ = quantity.value_or(isPng(files_[0]) ? Quantity::Display : Quantity::Signal);
    for (int frame = 0; frame < frames; ++frame) {
        const fs::path& file = files_[std::size_t(frame)];
        if (isPng(file) != isPng(files_[0]))
            throw InputError(file.string() + ": PNG and linear frames cannot be mixed, and " +
                             files_[0].filename().string() + " is of the other kind");
        read(frame);
    }
}

Image<glm::vec4> ImportedFrames::read(int frame) const {
    const fs::path& file = files_[std::size_t(frame)];
    const Image<glm::vec4> image = isPng(file)                ? linearOf(readPng(file))
                                   : endingOf(file) == ".pfm" ? readPfm(file)
                                                              : readExr(file, {"R", "G", "B"});
    requireGood(file, image, size_);
    return image;
}

FrameImages ImportedFrames::show(int frame, Renderer& renderer, const Settings& settings) const {
    const Image<glm::vec4> given = read(frame);
    const auto albedo = renderer.targets().surfaces.albedo.read<glm::vec4>();
    const auto emission = renderer.targets().surfaces.emission.read<glm::vec4>();
    const Mask foreground = foregroundOf(renderer);

    Image<glm::vec4> lit(size_), signal(size_);
    for (std::size_t i = 0; i < given.pixels().size(); ++i) {
        glm::vec3 value = given.pixels()[i];
        if (quantity_ == Quantity::Signal) {
            signal.pixels()[i] = glm::vec4(value, 0.0f);
            continue;
        }
        if (foreground.pixels()[i] == 0)
            continue;
        if (quantity_ != Quantity::Lit)
            value -= glm::vec3(emission.pixels()[i]);
        if (quantity_ == Quantity::Display)
            value = glm::max(value, 0.0f);
        lit.pixels()[i] = glm::vec4(value, 0.0f);
        for (int channel = 0; channel < 3; ++channel)
            if (const float reflected = albedo.pixels()[i][channel]; reflected > 0.0f)
                signal.pixels()[i][channel] = value[channel] / reflected;
    }
    // Of several signals the first stands for their sum.
    std::vector<Image<glm::vec4>> signals(renderer.signals().size(), Image<glm::vec4>(size_));
    signals[0] = std::move(signal);
    renderer.showReference(signals, settings);
    FrameImages images = readFrame(renderer, false);
    if (quantity_ != Quantity::Signal)
        images.lit = std::move(lit);
    if (quantity_ == Quantity::Display)
        images.display = opaque(readPng(files_[std::size_t(frame)]));
    return images;
}

nlohmann::ordered_json ImportedFrames::describe() const {
    nlohmann::ordered_json json = {{"quantity", nameOf(quantity_)}};
    for (const fs::path& file : files_)
        json["files"].push_back(file.filename().string());
    return json;
}

} // namespace afterglow
