// SPDX-License-Identifier: MIT
#include "app/workbench/frame_recorder.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/image/image_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/warnings.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;
namespace fs = std::filesystem;

namespace {

const glm::ivec2 kSize{61, 37};

Image<glm::u8vec4> gray(int value, glm::ivec2 size = kSize) {
    return Image<glm::u8vec4>(size, glm::u8vec4(value, value, value, 255));
}

void record(FrameRecorder& recorder, const fs::path& folder, int frames) {
    recorder.start(folder, kSize, 25);
    for (int i = 0; i < frames; ++i)
        recorder.add(gray(40 * i));
    recorder.stop();
}

/// All messages until ffmpeg is done; half a minute is more than any machine needs.
std::vector<RecorderMessage> messagesOf(FrameRecorder& recorder) {
    std::vector<RecorderMessage> messages;
    for (int i = 0; i < 3000; ++i) {
        while (auto message = recorder.poll())
            messages.push_back(*message);
        if (!recorder.isEncoding())
            return messages;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("ffmpeg does not end");
    return messages;
}

std::string pathOfProcess() {
    const char* path = std::getenv("PATH");
    return path ? path : "";
}

bool isInstalled(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

std::string outputOf(const std::string& command) {
    std::string text;
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    REQUIRE(pipe);
    char part[256];
    while (std::fgets(part, sizeof part, pipe))
        text += part;
    ::pclose(pipe);
    return text;
}

/// A program of that name that does what the lines of a shell script say.
void writeProgram(const TemporaryFolder& folder, const std::string& name,
                  const std::string& lines) {
    const fs::path file = folder.write(name, "#!/bin/sh\n" + lines);
    fs::permissions(file, fs::perms::owner_all);
}

} // namespace

TEST_CASE("a recording is a folder of frames and a video of even size that shows them all") {
    if (!isInstalled("ffmpeg") || !isInstalled("ffprobe")) {
        MESSAGE("ffmpeg is not installed");
        return;
    }
    const TemporaryFolder folder;
    const fs::path place = folder / "100%d takes"; // nothing that ffmpeg may read as a number
    FrameRecorder recorder;
    record(recorder, place, 5);
    const auto messages = messagesOf(recorder);
    REQUIRE(messages.size() == 2);
    const fs::path frames = place / "afterglow-0001", video = place / "afterglow-0001.mp4";
    CHECK(messages[0].text == frames.string() + ": 5 frames recorded");
    CHECK_FALSE(messages[1].isError);
    CHECK(messages[1].text.starts_with(video.string() + ": 5 frames"));
    for (int i = 0; i < 5; ++i)
        CHECK(readPng(frames / ("frame_0000" + std::to_string(i) + ".png"))({7, 7}) ==
              gray(40 * i)({7, 7}));
    CHECK(outputOf("ffprobe -v error -count_frames -select_streams v -show_entries "
                   "stream=width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 '" +
                   video.string() + "'") == "62,38,yuv420p,25/1,5\n");
    CHECK_FALSE(fs::exists(place / "afterglow-0001.mp4.part"));

    // What is seen in it is what was recorded: the last frame, to the steps of the codec.
    REQUIRE(std::system(("ffmpeg -v error -sseof -0.05 -i '" + video.string() + "' -frames:v 1 '" +
                         (folder / "last.png").string() + "'")
                            .c_str()) == 0);
    CHECK(std::abs(int(readPng(folder / "last.png")({30, 18}).r) - 160) <= 4);
}

TEST_CASE("without ffmpeg a recording is its frames, and the message says so") {
    const TemporaryFolder folder;
    const fs::path frames = folder / "afterglow-0001";
    FrameRecorder recorder((folder / "nothing").string() + "::relative");
    record(recorder, folder.path(), 2);
    const auto messages = messagesOf(recorder);
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].text ==
          frames.string() +
              ": 2 frames recorded; there is no ffmpeg in PATH to make a video of them");
    CHECK_FALSE(messages[0].isError);
    CHECK(fs::exists(frames / "frame_00001.png"));
    CHECK_FALSE(fs::exists(frames / "frame_00002.png"));
    CHECK_FALSE(fs::exists(folder / "afterglow-0001.mp4"));
}

TEST_CASE("where H.264 fails the video is MPEG-4, and where that fails the log says why") {
    const TemporaryFolder folder;
    // The last argument is the file to write; libx264 is not known.
    const std::string choosy = "for last; do :; done\n"
                               "case \" $* \" in *libx264*) echo no libx264; exit 1;; esac\n";
    writeProgram(folder, "choosy/ffmpeg", choosy + "echo video > \"$last\"\n");
    writeProgram(folder, "broken/ffmpeg",
                 choosy + "echo half > \"$last\"; echo no mpeg4; exit 1\n");
    {
        FrameRecorder recorder((folder / "nothing").string() + ":" + (folder / "choosy").string());
        record(recorder, folder / "a", 1);
        const auto messages = messagesOf(recorder);
        REQUIRE(messages.size() == 2);
        CHECK(messages[1].text.starts_with((folder / "a/afterglow-0001.mp4").string() +
                                           ": 1 frame, as MPEG-4, since H.264 failed: "));
        CHECK_FALSE(messages[1].isError);
        CHECK(readFile(folder / "a/afterglow-0001.mp4") == "video\n");
    }
    {
        FrameRecorder recorder((folder / "broken").string());
        record(recorder, folder / "b", 1);
        const auto messages = messagesOf(recorder);
        REQUIRE(messages.size() == 2);
        const fs::path log = folder / "b/afterglow-0001/ffmpeg.log";
        CHECK(messages[1].isError);
        CHECK(messages[1].text.ends_with("it says why in " + log.string()));
        CHECK(readFile(log) == "no libx264\nno mpeg4\n");
        CHECK_FALSE(fs::exists(folder / "b/afterglow-0001.mp4"));
        CHECK_FALSE(fs::exists(folder / "b/afterglow-0001.mp4.part"));
        CHECK(fs::exists(folder / "b/afterglow-0001/frame_00000.png"));
    }
}

TEST_CASE("a real ffmpeg makes a video with the encoder of last resort, too") {
    if (!isInstalled("ffmpeg") || !isInstalled("ffprobe")) {
        MESSAGE("ffmpeg is not installed");
        return;
    }
    const TemporaryFolder folder;
    writeProgram(folder, "ffmpeg",
                 "case \" $* \" in *libx264*) exit 1;; esac\nPATH='" + pathOfProcess() +
                     "'; exec ffmpeg \"$@\"\n");
    FrameRecorder recorder(folder.path().string());
    record(recorder, folder / "a", 3);
    REQUIRE(messagesOf(recorder).size() == 2);
    CHECK(outputOf("ffprobe -v error -count_frames -select_streams v -show_entries "
                   "stream=codec_name,width,height,nb_read_frames -of csv=p=0 '" +
                   (folder / "a/afterglow-0001.mp4").string() + "'") == "mpeg4,62,38,3\n");
}

TEST_CASE("each recording takes the first number that is free") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "afterglow-0001");
    folder.write("afterglow-0002.mp4", "");
    const Warnings quiet;
    FrameRecorder recorder("");
    record(recorder, folder.path(), 1);
    record(recorder, folder.path(), 1);
    CHECK(fs::exists(folder / "afterglow-0003/frame_00000.png"));
    CHECK(fs::exists(folder / "afterglow-0004/frame_00000.png"));
    CHECK_FALSE(fs::exists(folder / "afterglow-0002"));
}

TEST_CASE("a recording of so many frames ends by itself") {
    const TemporaryFolder folder;
    FrameRecorder recorder("");
    recorder.start(folder.path(), kSize, 60, 3);
    CHECK(recorder.framesLeft() == 3);
    recorder.add(gray(0));
    recorder.add(gray(1));
    CHECK(recorder.isRecording());
    CHECK(recorder.framesWritten() == 2);
    CHECK(recorder.framesLeft() == 1);
    recorder.add(gray(2));
    CHECK_FALSE(recorder.isRecording());
    CHECK_FALSE(recorder.framesLeft());
    recorder.add(gray(3)); // nobody records
    CHECK(messagesOf(recorder).size() == 1);
    CHECK(fs::exists(folder / "afterglow-0001/frame_00002.png"));
    CHECK_FALSE(fs::exists(folder / "afterglow-0001/frame_00003.png"));
}

TEST_CASE("a picture of another size ends a recording, and what is there stays") {
    const TemporaryFolder folder;
    FrameRecorder recorder("");
    recorder.start(folder.path(), kSize, 60);
    recorder.add(gray(0));
    recorder.add(gray(0, {80, 45}));
    CHECK_FALSE(recorder.isRecording());
    const auto messages = messagesOf(recorder);
    REQUIRE(messages.size() == 2);
    CHECK(messages[0].isError);
    CHECK(messages[0].text == "the picture changed from 61x37 to 80x45: the recording has ended");
    CHECK(fs::exists(folder / "afterglow-0001/frame_00000.png"));
    CHECK_FALSE(fs::exists(folder / "afterglow-0001/frame_00001.png"));
}

TEST_CASE("a frame that cannot be written ends a recording with one message") {
    const TemporaryFolder folder;
    FrameRecorder recorder("");
    recorder.start(folder.path(), kSize, 60);
    recorder.add(gray(0));
    fs::create_directory(folder / "afterglow-0001/frame_00001.png"); // in its place
    recorder.add(gray(1));
    recorder.add(gray(2));
    CHECK_FALSE(recorder.isRecording());
    const auto messages = messagesOf(recorder);
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].isError);
    CHECK(messages[0].text.starts_with((folder / "afterglow-0001/frame_00001.png").string() +
                                       ": cannot be written: "));
    CHECK(messages[0].text.ends_with("; the recording has ended, 1 frame before are in " +
                                     (folder / "afterglow-0001").string()));
    CHECK(fs::exists(folder / "afterglow-0001/frame_00000.png"));
}

TEST_CASE("a recording without frames leaves nothing behind") {
    const TemporaryFolder folder;
    FrameRecorder recorder;
    record(recorder, folder.path(), 0);
    CHECK(fs::is_empty(folder.path()));
    const auto messages = messagesOf(recorder);
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].text == "nothing was recorded");
}

TEST_CASE("a recording that cannot begin is refused") {
    const TemporaryFolder folder;
    const Warnings quiet;
    FrameRecorder recorder("");
    CHECK_THROWS_AS(recorder.start(folder.write("file", ""), kSize, 60), Error);
    CHECK_FALSE(recorder.isRecording());
    CHECK_THROWS_AS(recorder.start(folder.path(), {0, 37}, 60), std::logic_error);
    recorder.start(folder.path(), kSize, 60);
    CHECK_THROWS_AS(recorder.start(folder.path(), kSize, 60), std::logic_error);
}

TEST_CASE("the end of the program ends a recording and waits for its video") {
    const TemporaryFolder folder;
    writeProgram(folder, "ffmpeg", "for last; do :; done\nsleep 0.2\necho video > \"$last\"\n");
    {
        const Warnings quiet;
        FrameRecorder recorder(folder.path().string());
        recorder.start(folder / "a", kSize, 60);
        recorder.add(gray(0));
    }
    CHECK(readFile(folder / "a/afterglow-0001.mp4") == "video\n");
}
