// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/object.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// Measures the time of a frame and, if enabled, of each of its passes. Every scope is also a debug
/// group, so that frame debuggers show the same names.
///
/// On a GPU: timestamps, read a few frames late so that nobody waits. On a software rasterizer,
/// whose queries read 0: glFinish() and a clock, around the frame and, while enabled, around each
/// scope, which makes the frame somewhat slower.
class GpuTimer {
public:
    explicit GpuTimer(bool softwareRasterizer);

    class Scope {
    public:
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope() { timer_.endScope(); }

    private:
        friend GpuTimer;
        Scope(GpuTimer& timer, std::string_view name) : timer_(timer) { timer.beginScope(name); }
        GpuTimer& timer_;
    };
    /// Begins a scope that lasts to the end of the Scope. One inside another is std::logic_error.
    /// Outside a frame, or disabled, it is a debug group and nothing else.
    [[nodiscard]] Scope scope(std::string_view name) { return Scope(*this, name); }

    void setEnabled(bool enabled); ///< the times of scopes, from the next frame on; off at first
    bool enabled() const { return enabled_; }

    void beginFrame();
    void endFrame();

    struct Entry {
        std::string name;
        double milliseconds;
    };
    struct FrameTimes {
        std::uint64_t frame = 0;   ///< the first frame of this timer is 1; 0: none is known
        double milliseconds = 0.0; ///< of the device, from beginFrame() to endFrame()
        /// In the order of the frame; those of one name are summed, where the first stood. Empty
        /// unless enabled.
        std::vector<Entry> scopes;
    };
    /// Returns the newest frame whose times are known.
    const FrameTimes& newest() const { return newest_; }
    /// Returns the frame that ended last. Waits until the device has finished it.
    const FrameTimes& finish();

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t kFramesInFlight = 4;

    /// The scopes of one frame with their queries. Queries are kept for the next frame in this
    /// place.
    struct Frame {
        std::uint64_t number = 0;
        std::vector<std::string> names;
        std::vector<GlObject<QueryKind>> queries; ///< begin and end of the frame, of each scope
        bool pending = false;
    };

    void beginScope(std::string_view name);
    void endScope();
    void stamp(std::size_t query);
    bool isReady(const Frame& frame) const;
    void collect(Frame& frame);
    void publish(FrameTimes times);

    bool software_;
    bool enabled_ = false, inFrame_ = false, recordsScopes_ = false, inScope_ = false;
    std::uint64_t frameNumber_ = 0; ///< of the frame that began last
    FrameTimes newest_, thisFrame_;
    Clock::time_point frameStart_, scopeStart_;
    std::string scopeName_;
    std::array<Frame, kFramesInFlight> frames_;
    std::size_t current_ = 0;
};

} // namespace afterglow
