// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/gpu_timer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/shader_source.h"
#include "renderer/gl/texture.h"

#include <array>
#include <initializer_list>
#include <span>
#include <string>

namespace afterglow {

/// Hears what each pass of a frame has made, right after the pass and before the next one.
class PassListener {
public:
    virtual ~PassListener() = default;
    /// `pass` is the name the timer has, too. What was made is changed by later passes.
    virtual void passDone(std::string_view pass, std::span<const GpuTexture* const> made) = 0;
};

/// From its beginning to its end: times a pass, names it for debuggers, and tells the listener.
class PassScope {
public:
    PassScope(GpuTimer& timer, PassListener* listener, std::string name,
              std::initializer_list<const GpuTexture*> made)
        : report_(listener, std::move(name), made), scope_(timer.scope(report_.name)) {}
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

private:
    static constexpr std::size_t kMostMade = 6;
    struct Report {
        Report(PassListener* to, std::string pass, std::initializer_list<const GpuTexture*> from);
        ~Report();
        Report(const Report&) = delete;
        Report& operator=(const Report&) = delete;

        PassListener* listener;
        std::string name;
        std::array<const GpuTexture*, kMostMade> made{};
        std::size_t count = 0;
    };

    Report report_; // after the timer's scope has ended: it is the first member
    GpuTimer::Scope scope_;
};

/// What every pass may use.
struct FrameContext {
    GpuTimer& timer;
    PassListener* listener = nullptr;
    std::string prefix{}; ///< of the names of passes, where the same ones run more than once
    const GpuBuffer* uniforms = nullptr; ///< shared/frame.h; of passes that need no frame none

    /// The frame's uniform block, for a dispatch.
    Binding block() const;

    /// The same for the passes of one signal; empty: there is only one.
    FrameContext forSignal(std::string_view name) const {
        FrameContext context = *this;
        if (!name.empty())
            context.prefix += std::string(name) + " ";
        return context;
    }

    [[nodiscard]] PassScope pass(std::string_view name,
                                 std::initializer_list<const GpuTexture*> made) const {
        return PassScope(timer, listener, prefix + std::string(name), made);
    }
};

/// The taps of an a-trous iteration.
enum class Kernel {
    B3Spline5x5, ///< Schied et al. 2017
    Box3x3       ///< the faster one of Schied et al. 2018
};

/// Returns what selects the kernel and the exponent of the normals in a shader: see
/// shaders/lib/kernel.glsl and shaders/lib/edge_stopping.glsl. A power of two from 1 to 1024 is a
/// constant, since a cosine is squared faster, and more exactly, than it is raised to any power.
Defines definesOf(Kernel kernel, float sigmaNormal);

} // namespace afterglow
