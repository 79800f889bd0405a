// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/image/image_io.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include <unistd.h>

using namespace afterglow;
namespace fs = std::filesystem;

namespace {

const glm::ivec2 kSize(61, 37);

/// Floats of every size, infinities and NaN among them.
Image<glm::vec4> someFloats() {
    std::mt19937 random(3);
    Image<glm::vec4> image(kSize);
    for (glm::vec4& pixel : image.pixels()) {
        for (int c = 0; c < 4; ++c) {
            pixel[c] = std::ldexp(float(random()) / 4294967296.0f - 0.5f, int(random() % 60) - 30);
        }
    }
    image({0, 0}).x = std::numeric_limits<float>::infinity();
    image({1, 0}).y = std::numeric_limits<float>::quiet_NaN();
    image({2, 0}).z = -0.0f;
    image({3, 0}).x = std::numeric_limits<float>::denorm_min();
    return image;
}

Image<glm::u8vec4> someBytes() {
    std::mt19937 random(4);
    Image<glm::u8vec4> image(kSize);
    for (glm::u8vec4& pixel : image.pixels()) {
        const auto bits = std::uint32_t(random());
        std::memcpy(&pixel, &bits, 4);
    }
    return image;
}

bool sameBits(float a, float b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

std::size_t filesIn(const fs::path& folder) {
    return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

template <class Read>
std::string faultOf(Read read, const fs::path& path, const std::string& bytes) {
    writeFileAtomically(path, bytes);
    const std::string message = messageOf<InputError>([&] { read(path); });
    CHECK((message.empty() || message.starts_with(path.string() + ": ")));
    CHECK(message.find('\n') == std::string::npos);
    return message;
}

} // namespace

TEST_CASE("a PNG gives back every byte that was written, alpha 0 included") {
    const TemporaryFolder folder;
    const Image<glm::u8vec4> image = someBytes();
    writePng(folder / "a.png", image);
    const Image<glm::u8vec4> back = readPng(folder / "a.png");
    REQUIRE(back.size() == image.size());
    CHECK(std::memcmp(back.pixels().data(), image.pixels().data(), image.pixels().size_bytes()) ==
          0);
}

TEST_CASE("an EXR gives back every bit of one to four channels") {
    const TemporaryFolder folder;
    const Image<glm::vec4> image = someFloats();
    for (int channels = 1; channels <= 4; ++channels) {
        CAPTURE(channels);
        writeExr(folder / "a.exr", image, channels);
        const Image<glm::vec4> back = readExr(folder / "a.exr");
        REQUIRE(back.size() == image.size());
        int different = 0;
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            for (int c = 0; c < 4; ++c) {
                const float expected = c < channels ? image.pixels()[i][c] : (c == 3 ? 1.0f : 0.0f);
                different += !sameBits(back.pixels()[i][c], expected);
            }
        }
        CHECK(different == 0);
    }
}

TEST_CASE("the channels of an EXR go by their names") {
    const TemporaryFolder folder;
    Image<glm::vec4> image({2, 1}, {1, 2, 3, 4});
    writeExr(folder / "a.exr", image, {"motion.y", "motion.x", "age"});
    CHECK(readExr(folder / "a.exr", {"age", "motion.x", "motion.y"})({1, 0}) ==
          glm::vec4(3, 2, 1, 1));
    CHECK(readExr(folder / "a.exr", {"motion.y"})({1, 0}) == glm::vec4(1, 0, 0, 1));
    CHECK(messageOf<InputError>([&] { readExr(folder / "a.exr", {"R"}); }) ==
          (folder / "a.exr").string() + ": has no channel named R");
    CHECK_THROWS_AS(writeExr(folder / "a.exr", image, {"R", "R"}), std::logic_error);
    CHECK_THROWS_AS(writeExr(folder / "a.exr", image, 5), std::logic_error);
}

TEST_CASE("a PFM gives back every bit of one or three channels") {
    const TemporaryFolder folder;
    const Image<glm::vec4> image = someFloats();
    for (const int channels : {1, 3}) {
        CAPTURE(channels);
        writePfm(folder / "a.pfm", image, channels);
        const Image<glm::vec4> back = readPfm(folder / "a.pfm");
        REQUIRE(back.size() == image.size());
        int different = 0;
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                different +=
                    !sameBits(back.pixels()[i][c], image.pixels()[i][channels == 3 ? c : 0]);
            }
        }
        CHECK(different == 0);
    }
}

TEST_CASE("a PFM's first row of bytes is the bottom of the picture") {
    const TemporaryFolder folder;
    Image<glm::vec4> image({1, 2});
    image({0, 1}).x = 1.0f;
    writePfm(folder / "a.pfm", image, 1);
    CHECK(readFile(folder / "a.pfm") == std::string("Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\0\0", 20));
}

TEST_CASE("the same picture makes the same bytes") {
    const TemporaryFolder folder;
    for (const char* name : {"a", "b"}) {
        writePng(folder / (std::string(name) + ".png"), someBytes());
        writeExr(folder / (std::string(name) + ".exr"), someFloats(), 4);
        writePfm(folder / (std::string(name) + ".pfm"), someFloats(), 3);
    }
    for (const char* kind : {".png", ".exr", ".pfm"}) {
        CHECK(readFile(folder / (std::string("a") + kind)) ==
              readFile(folder / (std::string("b") + kind)));
    }
}

TEST_CASE("a picture that is cut off or is none is refused, with its name") {
    const TemporaryFolder folder;
    writePng(folder / "a.png", someBytes());
    writeExr(folder / "a.exr", someFloats(), 3);
    writePfm(folder / "a.pfm", someFloats(), 3);
    const auto png = [](const fs::path& p) { readPng(p); };
    const auto exr = [](const fs::path& p) { readExr(p); };
    const auto pfm = [](const fs::path& p) { readPfm(p); };
    CHECK(faultOf(png, folder / "b.png", "GIF89a") ==
          (folder / "b.png").string() + ": is not a PNG");
    CHECK(faultOf(exr, folder / "b.exr", "GIF89a") ==
          (folder / "b.exr").string() + ": is not an EXR");
    CHECK(faultOf(pfm, folder / "b.pfm", "P6 1 1 255\n") ==
          (folder / "b.pfm").string() + ": is not a PFM");
    CHECK(faultOf(pfm, folder / "b.pfm", "PF\n-3 4\n-1.0\n").find("impossible size, -3 x 4") !=
          std::string::npos);
    CHECK(faultOf(pfm, folder / "b.pfm", "PF\n60000 60000\n-1.0\n").find("impossible size") !=
          std::string::npos);
    CHECK(faultOf(pfm, folder / "b.pfm", "PF\n1 1\n1.0\n123456789012").find("big-endian") !=
          std::string::npos);
    for (const int percent : {1, 10, 50, 90}) {
        CAPTURE(percent);
        const auto part = [&](const char* name) {
            const std::string whole = readFile(folder / name);
            return whole.substr(0, whole.size() * std::size_t(percent) / 100);
        };
        CHECK(faultOf(png, folder / "b.png", part("a.png")) != "");
        CHECK(faultOf(exr, folder / "b.exr", part("a.exr")) != "");
        CHECK(faultOf(pfm, folder / "b.pfm", part("a.pfm")) != "");
    }
    CHECK(messageOf<InputError>([&] { readPng(folder / "none.png"); }) ==
          (folder / "none.png").string() + ": there is no such file");
    CHECK(messageOf<InputError>([&] { readPng(folder.path()); }) ==
          folder.path().string() + ": is a folder, not a file");
}

TEST_CASE("a file that cannot be written says why, and leaves nothing behind") {
    const TemporaryFolder folder;
    const Image<glm::u8vec4> image({2, 2});
    CHECK(messageOf<Error>([&] { writePng(folder / "none/a.png", image); }) ==
          (folder / "none/a.png").string() + ": cannot be written: No such file or directory");
    fs::create_directory(folder / "taken.png");
    CHECK(messageOf<Error>([&] { writePng(folder / "taken.png", image); }) ==
          (folder / "taken.png").string() + ": cannot be written: Is a directory");
    CHECK(filesIn(folder.path()) == 1);
    CHECK_THROWS_AS(writePng(folder / "empty.png", Image<glm::u8vec4>()), std::logic_error);
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("a file that is replaced is never half of either") {
    const TemporaryFolder folder;
    const fs::path path = folder / "a.txt";
    writeFileAtomically(path, "the old text, which is longer");
    // The old file stays whole for whoever has it open: the new one is another file.
    fs::create_hard_link(path, folder / "open.txt");
    writeFileAtomically(path, "new");
    CHECK(readFile(path) == "new");
    CHECK(readFile(folder / "open.txt") == "the old text, which is longer");
    CHECK(filesIn(folder.path()) == 2);
    writeFileAtomically(path, "");
    CHECK(readFile(path).empty());
    CHECK(messageOf<InputError>([&] { readFile(folder / "open.txt", 5); }) ==
          (folder / "open.txt").string() + ": is larger than 5 bytes");
}
