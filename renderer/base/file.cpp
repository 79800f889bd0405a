// SPDX-License-Identifier: MIT
#include "renderer/base/file.h"

#include "renderer/base/error.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <unistd.h>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::string reason(int code) {
    return std::generic_category().message(code);
}

} // namespace

std::string readFile(const fs::path& path, std::size_t maxBytes) {
    const auto refuse = [&](const std::string& cause) {
        throw InputError(path.string() + ": " + cause);
    };
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found) {
        refuse("there is no such file");
    }
    if (code) {
        refuse("cannot be read: " + code.message());
    }
    if (fs::is_directory(status)) {
        refuse("is a folder, not a file");
    }
    if (!fs::is_regular_file(status)) {
        refuse("is not a regular file");
    }
    const std::uintmax_t size = fs::file_size(path, code);
    if (code) {
        refuse("cannot be read: " + code.message());
    }
    if (size > maxBytes) {
        refuse("is larger than " + std::to_string(maxBytes) + " bytes");
    }
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        refuse("cannot be read: " + reason(errno));
    }
    std::string bytes(std::size_t(size), '\0');
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (std::ferror(file.get())) {
        refuse("cannot be read: " + reason(errno));
    }
    bytes.resize(count);
    return bytes;
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
    // The name is this process's and this call's own, so writers side by side do not meet.
    static std::atomic<unsigned> calls{0};
    fs::path temporary = path;
    temporary += ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(calls++);

    const auto fail = [&](int code) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw Error(path.string() + ": cannot be written: " + reason(code));
    };
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) {
        fail(errno);
    }
    errno = 0;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int writeCode = errno;
    // Closing flushes, so a full disk may only show here.
    const bool closed = std::fclose(file) == 0;
    if (!written) {
        fail(writeCode);
    }
    if (!closed) {
        fail(errno);
    }
    std::error_code code;
    fs::rename(temporary, path, code);
    if (code) {
        fail(code.value());
    }
}

} // namespace afterglow
