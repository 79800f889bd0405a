// SPDX-License-Identifier: MIT
#include "renderer/gl/gpu_timer.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {
namespace {

// Numbers of a frame's queries: first its own two, then two for each scope.
constexpr std::size_t kFrameBegin = 0, kFrameEnd = 1;
constexpr std::size_t beginOf(std::size_t scope) {
    return 2 * scope + 2;
}
constexpr std::size_t endOf(std::size_t scope) {
    return 2 * scope + 3;
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

double millisecondsBetween(const GlObject<QueryKind>& begin, const GlObject<QueryKind>& end) {
    GLuint64 from = 0, to = 0; // nanoseconds
    glGetQueryObjectui64v(begin.id(), GL_QUERY_RESULT, &from);
    glGetQueryObjectui64v(end.id(), GL_QUERY_RESULT, &to);
    return to > from ? double(to - from) * 1e-6 : 0.0;
}

void add(std::vector<GpuTimer::Entry>& entries, std::string_view name, double milliseconds) {
    const auto entry = std::ranges::find(entries, name, &GpuTimer::Entry::name);
    if (entry != entries.end())
        entry->milliseconds += milliseconds;
    else
        entries.push_back({std::string(name), milliseconds});
}

} // namespace

GpuTimer::GpuTimer(bool softwareRasterizer) : software_(softwareRasterizer) {}

void GpuTimer::setEnabled(bool enabled) {
    enabled_ = enabled;
    if (!enabled)
        newest_.scopes.clear();
}

void GpuTimer::beginFrame() {
    if (inFrame_)
        throw std::logic_error("a timer's frame begins before the last one has ended");
    inFrame_ = true;
    recordsScopes_ = enabled_;
    ++frameNumber_;
    if (software_) {
        thisFrame_ = {.frame = frameNumber_, .scopes = {}};
        glFinish();
        frameStart_ = Clock::now();
        return;
    }
    Frame& frame = frames_[current_];
    if (frame.pending)
        collect(frame); // as many frames late as there are places: ready, or nearly
    frame.number = frameNumber_;
    frame.names.clear();
    stamp(kFrameBegin);
}

void GpuTimer::endFrame() {
    if (!inFrame_)
        return;
    inFrame_ = recordsScopes_ = false;
    if (software_) {
        glFinish();
        thisFrame_.milliseconds = millisecondsSince(frameStart_);
        publish(std::move(thisFrame_));
        return;
    }
    stamp(kFrameEnd);
    frames_[current_].pending = true;
    current_ = (current_ + 1) % kFramesInFlight;
    // Oldest first, so that the newest that is ready comes last.
    for (std::size_t i = 0; i < kFramesInFlight; ++i) {
        Frame& frame = frames_[(current_ + i) % kFramesInFlight];
        if (!frame.pending)
            continue;
        if (!isReady(frame))
            break;
        collect(frame);
    }
}

const GpuTimer::FrameTimes& GpuTimer::finish() {
    for (std::size_t i = 0; i < kFramesInFlight; ++i)
        if (Frame& frame = frames_[(current_ + i) % kFramesInFlight]; frame.pending)
            collect(frame);
    return newest_;
}

void GpuTimer::beginScope(std::string_view name) {
    if (inScope_)
        throw std::logic_error("a timer's scopes do not nest: " + std::string(name) + " inside " +
                               scopeName_);
    inScope_ = true;
    scopeName_ = name;
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(name.size()), name.data());
    if (!recordsScopes_)
        return;
    if (software_) {
        glFinish();
        scopeStart_ = Clock::now();
    } else {
        Frame& frame = frames_[current_];
        frame.names.emplace_back(name);
        stamp(beginOf(frame.names.size() - 1));
    }
}

void GpuTimer::endScope() {
    if (recordsScopes_ && software_) {
        glFinish();
        add(thisFrame_.scopes, scopeName_, millisecondsSince(scopeStart_));
    } else if (recordsScopes_) {
        stamp(endOf(frames_[current_].names.size() - 1));
    }
    glPopDebugGroup();
    inScope_ = false;
}

void GpuTimer::stamp(std::size_t query) {
    auto& queries = frames_[current_].queries;
    while (queries.size() <= query)
        queries.push_back(GlObject<QueryKind>::create("timer", GLenum(GL_TIMESTAMP)));
    glQueryCounter(queries[query].id(), GL_TIMESTAMP);
}

bool GpuTimer::isReady(const Frame& frame) const {
    GLint ready = 0;
    glGetQueryObjectiv(frame.queries[kFrameEnd].id(), GL_QUERY_RESULT_AVAILABLE, &ready);
    return ready != 0;
}

// Waits for the frame's end, unless it is ready.
void GpuTimer::collect(Frame& frame) {
    const auto& q = frame.queries;
    FrameTimes times{.frame = frame.number,
                     .milliseconds = millisecondsBetween(q[kFrameBegin], q[kFrameEnd]),
                     .scopes = {}};
    for (std::size_t i = 0; i < frame.names.size(); ++i)
        add(times.scopes, frame.names[i], millisecondsBetween(q[beginOf(i)], q[endOf(i)]));
    frame.pending = false;
    publish(std::move(times));
}

void GpuTimer::publish(FrameTimes times) {
    newest_ = std::move(times);
    if (!enabled_)
        newest_.scopes.clear();
}

} // namespace afterglow
