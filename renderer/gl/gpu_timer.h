#pragma once

#include "renderer/gl/object.h"

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// How long each part of a frame took, in the order of the parts. Every scope is also a debug
/// group, so that frame debuggers show the same names.
///
/// On a GPU: timestamps, read a few frames late so that nobody waits. On a software rasterizer,
/// whose queries read 0: glFinish() and a clock, which makes the frame somewhat slower while
/// enabled.
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
    /// From here to the end of the Scope. One inside another is std::logic_error. Outside a frame,
    /// or disabled, it is a debug group and nothing else.
    [[nodiscard]] Scope scope(std::string_view name) { return Scope(*this, name); }

    void setEnabled(bool enabled); ///< from the next frame on; off at first
    bool enabled() const { return enabled_; }

    void beginFrame();
    void endFrame();

    struct Entry {
        std::string name;
        double milliseconds;
    };
    /// The newest frame whose times are known; scopes of one name are summed, where the first
    /// stood.
    const std::vector<Entry>& lastFrame() const { return lastFrame_; }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t kFramesInFlight = 4;

    /// The scopes of one frame with their queries. Queries are kept for the next frame in this
    /// place.
    struct Frame {
        std::vector<std::string> names;
        std::vector<GlObject<QueryKind>> queries; ///< begin and end of each scope
        bool pending = false;
    };

    void beginScope(std::string_view name);
    void endScope();
    void stamp(std::size_t query);
    bool isReady(const Frame& frame) const;
    void collect(Frame& frame);
    void add(std::string_view name, double milliseconds);

    bool software_;
    bool enabled_ = false, recording_ = false, inScope_ = false;
    std::vector<Entry> lastFrame_, thisFrame_;
    Clock::time_point scopeStart_;
    std::string scopeName_;
    std::array<Frame, kFramesInFlight> frames_;
    std::size_t current_ = 0;
};

} // namespace afterglow
