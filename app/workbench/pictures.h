// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/oracle_view.h"
#include "app/workbench/pass_capture.h"
#include "app/workbench/view_state.h"
#include "renderer/passes/debug_view_pass.h"
#include "renderer/passes/difference_pass.h"
#include "renderer/pipeline/renderer.h"

#include <optional>
#include <string>

namespace afterglow {

/// How what a pane shows is shown; see Workbench::legend().
struct PictureLegend {
    std::string name, meaning;
    std::string note;                    ///< why it is not what was asked for
    std::optional<ImageDisplay> display; ///< empty: the tone-mapped picture
};

/// Turns what the state asks to see into pictures of the panes, RGBA8.
class Pictures {
public:
    explicit Pictures(ShaderLibrary& shaders);

    struct Sources {
        Renderer& renderer;
        const ViewState& state;
        const PassCapture& passes;
        OracleView& oracle;
    };
    /// Null where the pane did not run in the last frame.
    const GpuTexture* of(const Sources& from, std::size_t pane);
    PictureLegend legendOf(const Sources& from, std::size_t pane) const;
    /// Whatever was shown has changed: there is a new frame.
    void changed() { ++version_; }
    std::size_t bytes() const;

private:
    /// What a pane shows: an image and the way to show it, or the picture.
    struct Choice {
        const GpuTexture* image = nullptr; ///< null: the picture
        gpu::DebugViewParams params{};
        PictureLegend legend;

        void show(const AovSource& source, const ImageDisplay& display, glm::ivec2 picture);
    };
    struct Slot {
        GpuTexture picture;
        std::uint64_t version = 0;
        const GpuTexture* image = nullptr;
        gpu::DebugViewParams params{};
    };
    Choice choiceFor(const Sources& from, std::size_t pane) const;
    Choice imageChoice(const Sources& from, std::size_t pane) const;
    Choice passChoice(const Sources& from) const;
    /// The two images of a difference, and how the result is shown.
    struct Subtraction {
        Choice shown;
        const GpuTexture *first = nullptr, *second = nullptr;
    };
    Subtraction subtractionFor(const Sources& from) const;
    const GpuTexture* difference(const Sources& from);
    const GpuTexture* mapped(const Sources& from, Slot& slot, const GpuTexture& image,
                             const gpu::DebugViewParams& params);

    DebugViewPass debugView_;
    DifferencePass difference_;
    std::array<Slot, kFilterStates + 1> slots_; ///< the last is the difference
    GpuTexture differences_;
    std::uint64_t version_ = 1;
};

/// The pictures of the panes as they are laid out, at their own size: what is saved and recorded.
/// `pictures` by pane; where one is empty there is black, and nothing if all are.
Image<glm::u8vec4> composed(const Panes& panes,
                            const std::array<Image<glm::u8vec4>, kFilterStates>& pictures);

} // namespace afterglow
