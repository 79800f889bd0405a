// SPDX-License-Identifier: MIT
#include "renderer/scene/gltf_container.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxFileBytes = std::size_t(1) << 31;

std::uint32_t word(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= std::uint32_t(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
    }
    return value;
}

GltfContainer splitBinary(const fs::path& path, std::string_view bytes) {
    const auto refuse = [&](const std::string& cause) {
        throw InputError(path.string() + ": " + cause);
    };
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    if (bytes.size() < kHeader) {
        refuse("is cut off: a binary glTF begins with 12 bytes, it has " +
               std::to_string(bytes.size()));
    }
    if (word(bytes, 4) != 2) {
        refuse("is glTF version " + std::to_string(word(bytes, 4)) + "; version 2 is needed");
    }
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size()) {
        refuse("is cut off: it promises " + std::to_string(length) + " bytes and has " +
               std::to_string(bytes.size()));
    }
    GltfContainer parts;
    std::size_t offset = kHeader;
    for (int chunk = 0; offset < length; ++chunk) {
        if (length - offset < kChunkHeader ||
            length - offset - kChunkHeader < word(bytes, offset)) {
            refuse("chunk " + std::to_string(chunk) + " reaches beyond the end of the file");
        }
        const std::size_t size = word(bytes, offset);
        const std::uint32_t kind = word(bytes, offset + 4);
        const std::string_view content = bytes.substr(offset + kChunkHeader, size);
        if ((chunk == 0) != (kind == kJson)) {
            refuse("its first chunk, and no other, must be JSON");
        }
        if (chunk == 0) {
            parts.json = content;
        } else if (chunk == 1 && kind == kBinary) {
            parts.binary = content;
        }
        offset += kChunkHeader + size;
    }
    if (parts.json.empty()) {
        refuse("has no JSON in it");
    }
    return parts;
}

/// Replaces %20 and the like. RFC 3986, section 2.1.
std::string decodePercent(std::string_view text) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0) {
            throw std::invalid_argument("has a % that two hexadecimal digits do not follow");
        }
        decoded += char(16 * digit(text[i + 1]) + digit(text[i + 2]));
        i += 2;
    }
    return decoded;
}

} // namespace

std::string forMessage(std::string_view text) {
    constexpr std::size_t kLongest = 400;
    std::string line(text.substr(0, kLongest));
    std::replace_if(
        line.begin(), line.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    while (!line.empty() && line.back() == ' ') {
        line.pop_back();
    }
    return line + (text.size() > kLongest ? "..." : "");
}

GltfContainer readGltfContainer(const fs::path& path) {
    std::string bytes = readFile(path, kMaxFileBytes);
    if (bytes.empty()) {
        throw InputError(path.string() + ": is empty");
    }
    if (bytes.starts_with("glTF")) {
        return splitBinary(path, bytes);
    }
    if (path.extension() == ".glb") {
        throw InputError(path.string() + ": is not a binary glTF: it does not begin with \"glTF\"");
    }
    const std::size_t first =
        bytes.find_first_not_of(" \t\r\n", bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    if (first == std::string::npos || bytes[first] != '{') {
        throw InputError(path.string() +
                         ": is not glTF: it is neither a JSON object nor binary glTF");
    }
    return {std::move(bytes), std::nullopt};
}

fs::path resolveGltfUri(const fs::path& sceneFile, std::string_view uri) {
    // A scheme is letters, digits, '+', '-', '.' before a colon. RFC 3986, section 3.1.
    const std::size_t colon = uri.find(':');
    if (colon != std::string_view::npos &&
        uri.substr(0, colon).find('/') == std::string_view::npos) {
        throw std::invalid_argument("has the scheme " + forMessage(uri.substr(0, colon + 1)) +
                                    " but only files beside the scene are read");
    }
    const std::string name = decodePercent(uri);
    if (name.empty() || name.find('\0') != std::string::npos) {
        throw std::invalid_argument("does not name a file");
    }
    const fs::path relative(name);
    if (relative.is_absolute() || name.starts_with('\\')) {
        throw std::invalid_argument("is an absolute path; only files beside the scene are read");
    }
    if (std::any_of(relative.begin(), relative.end(),
                    [](const fs::path& p) { return p == ".."; })) {
        throw std::invalid_argument("leaves the folder of the scene");
    }
    std::error_code code;
    const fs::path folder = fs::canonical(
        sceneFile.parent_path().empty() ? fs::path(".") : sceneFile.parent_path(), code);
    if (code) {
        throw std::invalid_argument("cannot be found: " + code.message());
    }
    const fs::path file = fs::weakly_canonical(folder / relative, code);
    if (code) {
        throw std::invalid_argument("cannot be found: " + code.message());
    }
    if (std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first !=
        folder.end()) {
        throw std::invalid_argument("leaves the folder of the scene by a symbolic link");
    }
    return file;
}

std::vector<unsigned char> decodeDataUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
        throw std::invalid_argument("is a data URI, but not in base64");
    }
    static const std::array<std::int8_t, 256> kDigits = [] {
        std::array<std::int8_t, 256> digits;
        digits.fill(-1);
        const std::string_view alphabet =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (std::size_t i = 0; i < alphabet.size(); ++i) {
            digits[static_cast<unsigned char>(alphabet[i])] = std::int8_t(i);
        }
        return digits;
    }();
    std::string_view text = uri.substr(comma + 1);
    for (int i = 0; i < 2 && text.ends_with('='); ++i) {
        text.remove_suffix(1);
    }
    std::vector<unsigned char> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = kDigits[static_cast<unsigned char>(c)];
        if (digit < 0) {
            throw std::invalid_argument("is a data URI whose base64 is damaged");
        }
        bits = (bits << 6) | std::uint32_t(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> count));
        }
    }
    if (count == 6) {
        throw std::invalid_argument("is a data URI whose base64 is cut off");
    }
    return bytes;
}

} // namespace afterglow
