// SPDX-License-Identifier: MIT
#include "app/workbench/frame_recorder.h"

#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxRecordings = 10000;
constexpr std::string_view kLog = "ffmpeg.log"; // in the recording's folder

std::string framesText(int frames) {
    return std::to_string(frames) + (frames == 1 ? " frame" : " frames");
}

fs::path videoOf(const fs::path& folder) {
    return folder.string() + ".mp4";
}
/// What ffmpeg writes; it gets its name when it is whole.
fs::path partOf(const fs::path& folder) {
    return folder.string() + ".mp4.part";
}

/// A new folder afterglow-NNNN, with the first number that neither a folder nor a video has.
fs::path makeFolder(const fs::path& parent) {
    std::error_code error;
    fs::create_directories(parent, error);
    for (int number = 1; !error && number < kMaxRecordings; ++number) {
        const fs::path folder = parent / fmt::format("afterglow-{:04}", number);
        std::error_code ignored;
        if (!fs::exists(videoOf(folder), ignored) && fs::create_directory(folder, error))
            return folder;
    }
    throw Error(parent.string() + ": no folder for a recording can be made: " +
                (error ? error.message() : "all numbers are taken"));
}

/// Relative folders of PATH are left out: what lies in the current one is nobody's program.
std::optional<fs::path> findProgram(const std::string& name, const std::string& searchPath) {
    for (std::size_t begin = 0; begin <= searchPath.size();) {
        const std::size_t end = std::min(searchPath.find(':', begin), searchPath.size());
        const fs::path program = fs::path(searchPath.substr(begin, end - begin)) / name;
        std::error_code ignored;
        if (program.is_absolute() && fs::is_regular_file(program, ignored) &&
            ::access(program.c_str(), X_OK) == 0)
            return program;
        begin = end + 1;
    }
    return std::nullopt;
}

/// Frames are sRGB; players expect the matrix of BT.709. Chroma is shared by 2x2 pixels, so odd
/// sizes get a black column or row. The frames are named relative to their folder, because ffmpeg
/// would read a "%" in the path as a number.
std::vector<std::string> arguments(const fs::path& folder, int framesPerSecond, bool fallback) {
    std::vector<std::string> list{
        "ffmpeg",
        "-hide_banner",
        "-nostdin",
        "-y",
        "-framerate",
        std::to_string(framesPerSecond),
        "-start_number",
        "0",
        "-i",
        "frame_%05d.png",
        "-vf",
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
        "-pix_fmt",
        "yuv420p",
        "-colorspace",
        "bt709",
        "-color_primaries",
        "bt709",
        "-color_trc",
        "iec61966-2-1",
        "-color_range",
        "tv"};
    const auto add = [&](std::initializer_list<const char*> more) {
        list.insert(list.end(), more.begin(), more.end());
    };
    if (fallback)
        add({"-c:v", "mpeg4", "-q:v", "2"});
    else
        add({"-c:v", "libx264", "-crf", "16", "-preset", "fast"});
    add({"-movflags", "+faststart", "-f", "mp4"});
    list.push_back("../" + partOf(folder).filename().string());
    return list;
}

/// A list for posix_spawn() that is freed at the end of the scope.
struct SpawnActions {
    SpawnActions() { posix_spawn_file_actions_init(&actions); }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    posix_spawn_file_actions_t actions;
};

/// Starts a program in a folder; what it says is appended to the log there. Error if it cannot be
/// started.
pid_t spawn(const fs::path& program, const std::vector<std::string>& arguments,
            const fs::path& folder) {
    const std::string log = (folder / kLog).string();
    SpawnActions files;
    posix_spawn_file_actions_addopen(&files.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files.actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(&files.actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&files.actions, folder.c_str());
    std::vector<char*> pointers;
    for (const std::string& argument : arguments)
        pointers.push_back(const_cast<char*>(argument.c_str())); // only read
    pointers.push_back(nullptr);
    pid_t process = 0;
    if (const int code = posix_spawn(&process, program.c_str(), &files.actions, nullptr,
                                     pointers.data(), environ))
        throw Error(program.string() + ": cannot be started: " + std::strerror(code));
    return process;
}

std::string pathOfProcess() {
    const char* path = std::getenv("PATH");
    return path ? path : "";
}

} // namespace

FrameRecorder::FrameRecorder() : FrameRecorder(pathOfProcess()) {}

FrameRecorder::FrameRecorder(std::string searchPath) : searchPath_(std::move(searchPath)) {}

FrameRecorder::~FrameRecorder() {
    using Clock = std::chrono::steady_clock;
    constexpr auto kPatience = std::chrono::seconds(15);
    stop();
    const auto end = Clock::now() + kPatience;
    while (isEncoding() && Clock::now() < end) {
        reap();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    for (const Encoding& encoding : encodings_) {
        ::kill(encoding.process, SIGKILL);
        ::waitpid(encoding.process, nullptr, 0);
        std::error_code ignored;
        fs::remove(partOf(encoding.recording.folder), ignored);
        say(encoding.recording.folder.string() + ": the video was not finished; the frames are",
            true);
    }
    for (const RecorderMessage& message : messages_)
        log(message.isError ? LogLevel::Warning : LogLevel::Info, message.text);
}

void FrameRecorder::start(const fs::path& folder, glm::ivec2 size, int framesPerSecond,
                          std::optional<int> frames) {
    if (recording_)
        throw std::logic_error("a recording is going on");
    if (size.x < 1 || size.y < 1 || framesPerSecond < 1 || frames.value_or(1) < 1)
        throw std::logic_error("a recording has a size, a rate and a length");
    // Absolute, since the current folder of ffmpeg is another.
    recording_ = Recording{makeFolder(fs::absolute(folder)), size, framesPerSecond, frames};
}

void FrameRecorder::add(const Image<glm::u8vec4>& frame) {
    if (!recording_)
        return;
    Recording& recording = *recording_;
    if (frame.size() != recording.size) {
        say(fmt::format("the picture changed from {}x{} to {}x{}: the recording has ended",
                        recording.size.x, recording.size.y, frame.size().x, frame.size().y),
            true);
        stop();
        return;
    }
    try {
        writePng(recording.folder / fmt::format("frame_{:05}.png", recording.written), frame);
    } catch (const Error& error) {
        // Where a frame does not fit, no video will.
        say(std::string(error.what()) + "; the recording has ended, " +
                framesText(recording.written) + " before are in " + recording.folder.string(),
            true);
        recording_.reset();
        return;
    }
    if (++recording.written == recording.frames)
        stop();
}

void FrameRecorder::stop() {
    if (!recording_)
        return;
    const Recording recording = *recording_;
    recording_.reset();
    if (recording.written == 0) {
        std::error_code ignored;
        fs::remove(recording.folder, ignored);
        say("nothing was recorded");
        return;
    }
    const std::string text =
        recording.folder.string() + ": " + framesText(recording.written) + " recorded";
    if (const auto ffmpeg = findProgram("ffmpeg", searchPath_)) {
        say(text);
        startEncoding({recording, *ffmpeg});
    } else {
        say(text + "; there is no ffmpeg in PATH to make a video of them");
    }
}

std::optional<RecorderMessage> FrameRecorder::poll() {
    reap();
    if (messages_.empty())
        return std::nullopt;
    RecorderMessage message = std::move(messages_.front());
    messages_.pop_front();
    return message;
}

int FrameRecorder::framesWritten() const {
    return recording_ ? recording_->written : 0;
}

std::optional<int> FrameRecorder::framesLeft() const {
    if (!recording_ || !recording_->frames)
        return std::nullopt;
    return *recording_->frames - recording_->written;
}

void FrameRecorder::say(std::string text, bool isError) {
    messages_.push_back({std::move(text), isError});
}

void FrameRecorder::startEncoding(Encoding encoding) {
    const Recording& recording = encoding.recording;
    try {
        encoding.process =
            spawn(encoding.ffmpeg,
                  arguments(recording.folder, recording.framesPerSecond, encoding.fallback),
                  recording.folder);
        encodings_.push_back(encoding);
    } catch (const Error& error) {
        say(error.what(), true);
    }
}

void FrameRecorder::reap() {
    std::vector<std::pair<Encoding, int>> ended;
    std::erase_if(encodings_, [&](const Encoding& encoding) {
        int status = 0;
        const pid_t process = ::waitpid(encoding.process, &status, WNOHANG);
        if (process == 0)
            return false;
        ended.emplace_back(encoding, process == encoding.process ? status : -1);
        return true;
    });
    for (const auto& [encoding, status] : ended)
        encoded(encoding, status);
}

void FrameRecorder::encoded(Encoding encoding, int status) {
    const fs::path& folder = encoding.recording.folder;
    const fs::path video = videoOf(folder);
    std::error_code error;
    if (status != -1 && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        fs::rename(partOf(folder), video, error);
        if (error)
            say(video.string() + ": cannot be written: " + error.message(), true);
        else
            say(video.string() + ": " + framesText(encoding.recording.written) +
                (encoding.fallback ? ", as MPEG-4, since H.264 failed: " + (folder / kLog).string()
                                   : std::string()));
        return;
    }
    fs::remove(partOf(folder), error);
    if (encoding.fallback) {
        say(video.string() + ": ffmpeg could not make it; it says why in " +
                (folder / kLog).string(),
            true);
        return;
    }
    encoding.fallback = true;
    startEncoding(encoding);
}

} // namespace afterglow
