#include "renderer/gl/gpu_timer.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {

GpuTimer::GpuTimer(bool softwareRasterizer) : software_(softwareRasterizer) {}

void GpuTimer::setEnabled(bool enabled) {
    enabled_ = enabled;
    if (!enabled)
        lastFrame_.clear();
}

void GpuTimer::beginFrame() {
    if (recording_)
        throw std::logic_error("a timer's frame begins before the last one has ended");
    recording_ = enabled_;
    thisFrame_.clear();
    if (!recording_ || software_)
        return;
    Frame& frame = frames_[current_];
    if (frame.pending)
        collect(frame); // as many frames late as there are places: ready, or nearly
    frame.names.clear();
}

void GpuTimer::endFrame() {
    if (!recording_)
        return;
    recording_ = false;
    if (software_) {
        if (enabled_)
            lastFrame_ = std::move(thisFrame_);
        return;
    }
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

void GpuTimer::beginScope(std::string_view name) {
    if (inScope_)
        throw std::logic_error("a timer's scopes do not nest: " + std::string(name) + " inside " +
                               scopeName_);
    inScope_ = true;
    scopeName_ = name;
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(name.size()), name.data());
    if (!recording_)
        return;
    if (software_) {
        glFinish();
        scopeStart_ = Clock::now();
    } else {
        Frame& frame = frames_[current_];
        frame.names.emplace_back(name);
        stamp(2 * frame.names.size() - 2);
    }
}

void GpuTimer::endScope() {
    if (recording_ && software_) {
        glFinish();
        add(scopeName_,
            std::chrono::duration<double, std::milli>(Clock::now() - scopeStart_).count());
    } else if (recording_) {
        stamp(2 * frames_[current_].names.size() - 1);
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
    if (frame.names.empty())
        return true;
    GLint ready = 0;
    glGetQueryObjectiv(frame.queries[2 * frame.names.size() - 1].id(), GL_QUERY_RESULT_AVAILABLE,
                       &ready);
    return ready != 0;
}

void GpuTimer::collect(Frame& frame) {
    thisFrame_.clear();
    for (std::size_t i = 0; i < frame.names.size(); ++i) {
        GLuint64 begin = 0, end = 0; // nanoseconds
        glGetQueryObjectui64v(frame.queries[2 * i].id(), GL_QUERY_RESULT, &begin);
        glGetQueryObjectui64v(frame.queries[2 * i + 1].id(), GL_QUERY_RESULT, &end);
        add(frame.names[i], double(end - begin) * 1e-6);
    }
    frame.pending = false;
    if (enabled_)
        lastFrame_ = std::move(thisFrame_);
}

void GpuTimer::add(std::string_view name, double milliseconds) {
    const auto entry = std::ranges::find(thisFrame_, name, &Entry::name);
    if (entry != thisFrame_.end())
        entry->milliseconds += milliseconds;
    else
        thisFrame_.push_back({std::string(name), milliseconds});
}

} // namespace afterglow
