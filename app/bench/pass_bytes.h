// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/program.h"
#include "renderer/passes/frame_context.h"

#include <map>
#include <string>

namespace afterglow {

class Renderer;

/// Counts the least number of bytes that each pass of a frame moves, while this lives: each image
/// that a dispatch reads once, each that it writes once, of a list of rays those that are listed.
///
/// Left out are the buffers of the scene, of which a pass reads what its pixels need, and of the
/// raster pass all but the images that it makes.
class PassBytes final : public PassListener, public DispatchListener {
public:
    /// Frames of this renderer are listened to.
    explicit PassBytes(Renderer& renderer);
    ~PassBytes() override;
    PassBytes(const PassBytes&) = delete;
    PassBytes& operator=(const PassBytes&) = delete;

    void dispatched(std::span<const Binding> reads, std::span<const Binding> writes) override;
    void passDone(std::string_view pass, std::span<const GpuTexture* const> made) override;

    /// By the name of the pass, of all frames so far.
    const std::map<std::string, double, std::less<>>& bytes() const { return bytes_; }

private:
    Renderer& renderer_;
    double open_ = 0.0; ///< of the pass that has not ended
    bool dispatches_ = false;
    std::map<std::string, double, std::less<>> bytes_;
};

/// Returns the bytes of what is bound, as PassBytes counts them.
double bytesOf(std::span<const Binding> bindings);

} // namespace afterglow
