// SPDX-License-Identifier: MIT
#include "renderer/image/pgm.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <string>

namespace afterglow {
namespace {

/// Takes the header of a PGM apart: numbers between white space and comments.
class PgmHeader {
public:
    PgmHeader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

    [[noreturn]] void fail(const std::string& cause) const {
        throw InputError(std::string(name_) + ": " + cause);
    }

    void magic() {
        if (bytes_.substr(0, 2) != "P5")
            fail("not a binary PGM: it does not begin with P5");
        at_ = 2;
    }

    int number(const char* what, int least, int most) {
        skipSpace();
        const std::size_t start = at_;
        int value = 0;
        while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9' && value <= most)
            value = value * 10 + (bytes_[at_++] - '0');
        if (at_ == start)
            fail(std::string("the header has no ") + what);
        if (value < least || value > most)
            fail(std::string("the ") + what + " is not between " + std::to_string(least) + " and " +
                 std::to_string(most));
        return value;
    }

    /// Returns the bytes after the one white space that ends the header.
    std::string_view rest() {
        if (at_ >= bytes_.size() || !isSpace(bytes_[at_]))
            fail("the header does not end in white space");
        return bytes_.substr(at_ + 1);
    }

private:
    static bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    void skipSpace() {
        while (at_ < bytes_.size() && (isSpace(bytes_[at_]) || bytes_[at_] == '#')) {
            if (bytes_[at_] == '#')
                at_ = std::min(bytes_.find('\n', at_), bytes_.size());
            else
                ++at_;
        }
    }

    std::string_view bytes_, name_;
    std::size_t at_ = 0;
};

} // namespace

Image<std::uint16_t> readPgm16(std::string_view bytes, std::string_view name) {
    constexpr int kMostEdge = 16384;
    PgmHeader header(bytes, name);
    header.magic();
    const int width = header.number("width", 1, kMostEdge);
    const int height = header.number("height", 1, kMostEdge);
    header.number("greatest value", 256, 65535); // below 256 a pixel would be one byte
    const std::string_view data = header.rest();

    const std::size_t wanted = 2 * std::size_t(width) * std::size_t(height);
    if (data.size() != wanted)
        header.fail("has " + std::to_string(data.size()) + " bytes of pixels; " +
                    std::to_string(width) + " x " + std::to_string(height) + " pixels need " +
                    std::to_string(wanted));
    Image<std::uint16_t> image({width, height});
    std::size_t i = 0;
    for (std::uint16_t& value : image.pixels()) {
        value = std::uint16_t((std::uint8_t(data[i]) << 8) | std::uint8_t(data[i + 1]));
        i += 2;
    }
    return image;
}

} // namespace afterglow
