// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/meter.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// What the frames of another denoiser show. Linear but for the last.
enum class Quantity {
    Signal, ///< the denoised signal, without albedo: in the place of `raw`
    Lit,    ///< signal times albedo
    Color,  ///< signal times albedo, plus emission
    Display ///< color as this program writes it in PNG: tone-mapped, sRGB, eight bits
};
std::string_view nameOf(Quantity quantity);       ///< signal, lit, color, display
Quantity quantityFromName(std::string_view name); ///< UsageError names the nearest known

/// The frames that another program has made of exported ones, for one external variant: files
/// NAME0007.exr, .pfm or .png, whose last digits are the frame. Other files in the folder, and
/// frames beyond the last one, do not count.
class ImportedFrames {
public:
    /// Finds and reads every frame. Without a quantity PNG is Display and all else Signal.
    /// InputError names the file, or the folder and the frame, where one is missing or is there
    /// twice, has another size, or holds a value that is not finite.
    ImportedFrames(std::string variant, const std::filesystem::path& folder,
                   std::optional<Quantity> quantity, glm::ivec2 size, int frames);

    const std::string& variant() const { return variant_; }
    Quantity quantity() const { return quantity_; }

    /// The frame in the place of what a filter would have made of the frame that the renderer has
    /// just rendered; the renderer then shows it. `lit` is the frame's own, so that light on black
    /// surfaces counts as the error that it is; `display` is made by the renderer, or the frame
    /// itself if it is a display image.
    ///
    /// Of Display, `lit` has the steps of eight bits, and color above 7.24, where the tone curve
    /// ends, is lost: what is left after emission is taken away is no less than 0.
    FrameImages show(int frame, Renderer& renderer, const Settings& settings) const;

    nlohmann::ordered_json describe() const; ///< quantity and names of files

private:
    Image<glm::vec4> read(int frame) const;

    std::string variant_;
    Quantity quantity_ = Quantity::Signal;
    glm::ivec2 size_;
    std::vector<std::filesystem::path> files_; ///< by frame
};

} // namespace afterglow
