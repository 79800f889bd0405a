// SPDX-License-Identifier: MIT
#include "renderer/gl/device_memory.h"

#include "renderer/base/error.h"
#include "renderer/gl/errors.h"

#include <array>
#include <fstream>
#include <string>
#include <string_view>

namespace afterglow {
namespace {

// Of the two extensions' headers.
constexpr GLenum kNvxCurrentAvailable = 0x9049; // kB
constexpr GLenum kAtiTextureFree = 0x87FC;      // four numbers, the first: kB in all

bool hasExtension(std::string_view wanted) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (wanted == reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))))
            return true;
    return false;
}

std::optional<std::size_t> systemMemory() {
    std::ifstream file("/proc/meminfo");
    std::string word;
    std::size_t kilobytes = 0;
    while (file >> word)
        if (word == "MemAvailable:" && file >> kilobytes)
            return kilobytes * 1024;
    return {};
}

} // namespace

std::optional<std::size_t> availableMemory(bool softwareRasterizer) {
    if (softwareRasterizer)
        return systemMemory();
    if (hasExtension("GL_NVX_gpu_memory_info")) {
        GLint kilobytes = 0;
        glGetIntegerv(kNvxCurrentAvailable, &kilobytes);
        return std::size_t(kilobytes) * 1024;
    }
    if (hasExtension("GL_ATI_meminfo")) {
        std::array<GLint, 4> kilobytes{};
        glGetIntegerv(kAtiTextureFree, kilobytes.data());
        return std::size_t(kilobytes[0]) * 1024;
    }
    return {};
}

void requireMemory(std::size_t bytes, const std::string& purpose, bool softwareRasterizer) {
    const std::optional<std::size_t> available = availableMemory(softwareRasterizer);
    if (available && bytes > *available)
        throw Error(purpose + " need " + mebibytes(bytes) + ", and " + mebibytes(*available) +
                    " are there");
}

} // namespace afterglow
