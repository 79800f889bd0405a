// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace afterglow {

/// What the recorder has to say to the person at the window.
struct RecorderMessage {
    std::string text;
    bool isError = false;
};

/// Writes frames as they are shown into a folder of their own, afterglow-NNNN/frame_00000.png and
/// so on, and lets ffmpeg, where there is one, make afterglow-NNNN.mp4 of them beside it: H.264, or
/// MPEG-4 where that fails. ffmpeg runs beside the program; more than one recording can be in its
/// hands. What goes wrong after start() is told by poll().
class FrameRecorder {
public:
    /// `searchPath`: the folders in which ffmpeg is looked for, as in PATH.
    FrameRecorder();
    explicit FrameRecorder(std::string searchPath);
    /// Ends the recording and waits for ffmpeg, for a quarter of a minute at most; then it is
    /// killed, and the frames remain.
    ~FrameRecorder();
    FrameRecorder(const FrameRecorder&) = delete;
    FrameRecorder& operator=(const FrameRecorder&) = delete;

    /// Begins a recording inside `folder`, which is made where it is missing; with `frames`, it
    /// ends by itself after so many. Error if the folder cannot be made or written to.
    /// std::logic_error if one is going on, or for numbers that are not positive.
    void start(const std::filesystem::path& folder, glm::ivec2 size, int framesPerSecond,
               std::optional<int> frames = {});

    /// Writes a frame, if a recording is going on. A frame of another size, or one that cannot be
    /// written, ends it; what is there stays.
    void add(const Image<glm::u8vec4>& frame);

    /// Ends the recording, if one is going on, and hands it to ffmpeg.
    void stop();

    /// To be called now and then. One message at a time, the oldest first.
    std::optional<RecorderMessage> poll();

    bool isRecording() const { return recording_.has_value(); }
    bool isEncoding() const { return !encodings_.empty(); }
    int framesWritten() const; ///< of the recording that is going on; else 0
    std::optional<int> framesLeft() const;

private:
    struct Recording {
        std::filesystem::path folder; ///< afterglow-NNNN
        glm::ivec2 size;
        int framesPerSecond;
        std::optional<int> frames; ///< after which it ends
        int written = 0;
    };
    struct Encoding {
        Recording recording;
        std::filesystem::path ffmpeg;
        bool fallback = false; ///< whether this is the second try
        pid_t process = 0;
    };

    void say(std::string text, bool isError = false);
    void startEncoding(Encoding encoding);
    /// Looks after those that have ended.
    void reap();
    void encoded(Encoding encoding, int status);

    std::string searchPath_;
    std::optional<Recording> recording_;
    std::vector<Encoding> encodings_;
    std::deque<RecorderMessage> messages_;
};

} // namespace afterglow
