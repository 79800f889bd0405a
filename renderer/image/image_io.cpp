// SPDX-License-Identifier: MIT
#include "renderer/image/image_io.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>

#include <stb_image.h>
#include <stb_image_write.h>
#include <tinyexr.h>

static_assert(std::endian::native == std::endian::little, "EXR and PFM are written as they lie");

namespace afterglow {

namespace fs = std::filesystem;

namespace {

/// Larger pictures are not ours: a file that claims one is broken.
constexpr int kMaxEdge = 65536;

/// The decoders count in ints.
constexpr std::size_t kMaxBytes = std::size_t(1) << 30;

void requirePixels(glm::ivec2 size, const char* who) {
    if (size.x <= 0 || size.y <= 0) {
        throw std::logic_error(std::string(who) + ": an empty picture cannot be written");
    }
}

[[noreturn]] void refuse(const fs::path& path, const std::string& cause) {
    throw InputError(path.string() + ": " + cause);
}

void requireSaneSize(const fs::path& path, std::int64_t width, std::int64_t height) {
    // A picture of kMaxEdge by kMaxEdge would not fit either: 2^28 pixels are four GiB of floats.
    if (width <= 0 || height <= 0 || width > kMaxEdge || height > kMaxEdge ||
        width * height > (std::int64_t(1) << 28)) {
        refuse(path,
               "has an impossible size, " + std::to_string(width) + " x " + std::to_string(height));
    }
}

/// The structures of tinyexr, which are freed however a function ends.
struct Exr {
    EXRHeader header;
    EXRImage image;
    Exr() {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    ~Exr() {
        FreeEXRImage(&image);
        FreeEXRHeader(&header);
    }
    Exr(const Exr&) = delete;
    Exr& operator=(const Exr&) = delete;
};

std::string takeMessage(const char* message) {
    if (!message) {
        return "an unknown fault";
    }
    std::string text = message;
    FreeEXRErrorMessage(message);
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(" .") + 1);
    return text;
}

std::vector<std::string> usualNames(int channels) {
    switch (channels) {
    case 1: return {"Y"};
    case 2: return {"X", "Y"};
    case 3: return {"R", "G", "B"};
    case 4: return {"R", "G", "B", "A"};
    default: throw std::logic_error("writeExr: a picture has one to four channels");
    }
}

} // namespace

void writePng(const fs::path& path, const Image<glm::u8vec4>& image) {
    requirePixels(image.size(), "writePng");
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   std::size_t(size));
    };
    const glm::ivec2 size = image.size();
    if (!stbi_write_png_to_func(append, &bytes, size.x, size.y, 4, image.pixels().data(),
                                size.x * 4)) {
        throw Error(path.string() + ": the picture is too large for a PNG");
    }
    writeFileAtomically(path, bytes);
}

Image<glm::u8vec4> readPng(const fs::path& path) {
    const std::string bytes = readFile(path, kMaxBytes);
    static constexpr unsigned char kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (bytes.size() < 8 || std::memcmp(bytes.data(), kSignature, 8) != 0) {
        refuse(path, "is not a PNG");
    }
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    glm::ivec2 size(0);
    int channels = 0;
    if (!stbi_info_from_memory(data, int(bytes.size()), &size.x, &size.y, &channels)) {
        refuse(path, std::string("is not a whole PNG: ") + stbi_failure_reason());
    }
    requireSaneSize(path, size.x, size.y);
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, int(bytes.size()), &size.x, &size.y, &channels, 4), std::free);
    if (!pixels) {
        refuse(path, std::string("is not a whole PNG: ") + stbi_failure_reason());
    }
    Image<glm::u8vec4> image(size);
    std::memcpy(image.pixels().data(), pixels.get(), image.pixels().size_bytes());
    return image;
}

void writeExr(const fs::path& path, const Image<glm::vec4>& image,
              const std::vector<std::string>& names) {
    requirePixels(image.size(), "writeExr");
    if (names.empty() || names.size() > 4 ||
        std::set<std::string>(names.begin(), names.end()).size() != names.size()) {
        throw std::logic_error("writeExr: one to four channels with names of their own");
    }
    // The format wants its channels in alphabetical order.
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return names[a] < names[b]; });

    const std::size_t count = image.pixels().size();
    std::vector<std::vector<float>> planes(names.size(), std::vector<float>(count));
    std::vector<unsigned char*> planePointers;
    std::vector<EXRChannelInfo> channels(names.size());
    std::vector<int> types(names.size(), TINYEXR_PIXELTYPE_FLOAT);
    for (std::size_t c = 0; c < names.size(); ++c) {
        for (std::size_t i = 0; i < count; ++i) {
            planes[c][i] = image.pixels()[i][int(order[c])];
        }
        planePointers.push_back(reinterpret_cast<unsigned char*>(planes[c].data()));
        std::memset(&channels[c], 0, sizeof channels[c]);
        const std::string& name = names[order[c]];
        if (name.empty() || name.size() >= sizeof channels[c].name) {
            throw std::logic_error("writeExr: a channel name has 1 to 255 letters");
        }
        std::memcpy(channels[c].name, name.data(), name.size());
    }

    // Not an Exr: all it points to is ours and not tinyexr's to free.
    EXRHeader header;
    InitEXRHeader(&header);
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    header.num_channels = int(names.size());
    header.channels = channels.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = types.data();
    EXRImage exr;
    InitEXRImage(&exr);
    exr.num_channels = int(names.size());
    exr.images = planePointers.data();
    exr.width = image.size().x;
    exr.height = image.size().y;

    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&exr, &header, &memory, &message);
    const std::unique_ptr<unsigned char, void (*)(void*)> owner(memory, std::free);
    if (size == 0) {
        throw Error(path.string() + ": cannot be made an EXR: " + takeMessage(message));
    }
    writeFileAtomically(path, {reinterpret_cast<const char*>(memory), size});
}

void writeExr(const fs::path& path, const Image<glm::vec4>& image, int channels) {
    writeExr(path, image, usualNames(channels));
}

Image<glm::vec4> readExr(const fs::path& path, const std::vector<std::string>& names) {
    const std::string bytes = readFile(path, kMaxBytes);
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    EXRVersion version;
    if (ParseEXRVersionFromMemory(&version, data, bytes.size()) != TINYEXR_SUCCESS) {
        refuse(path, "is not an EXR");
    }
    if (version.multipart || version.non_image || version.tiled) {
        refuse(path, "is an EXR of several parts, of deep data or of tiles, none of which is read");
    }
    Exr exr;
    const char* message = nullptr;
    if (ParseEXRHeaderFromMemory(&exr.header, &version, data, bytes.size(), &message) !=
        TINYEXR_SUCCESS) {
        refuse(path, "is not a whole EXR: " + takeMessage(message));
    }
    const EXRBox2i window = exr.header.data_window;
    requireSaneSize(path, std::int64_t(window.max_x) - window.min_x + 1,
                    std::int64_t(window.max_y) - window.min_y + 1);
    for (int c = 0; c < exr.header.num_channels; ++c) {
        const int type = exr.header.pixel_types[c];
        if (type != TINYEXR_PIXELTYPE_FLOAT && type != TINYEXR_PIXELTYPE_HALF) {
            refuse(path,
                   std::string("channel ") + exr.header.channels[c].name + " does not hold floats");
        }
        exr.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    // Should loading fail, tinyexr frees as many planes as are counted here, and counts them too
    // late.
    exr.image.num_channels = exr.header.num_channels;
    if (LoadEXRImageFromMemory(&exr.image, &exr.header, data, bytes.size(), &message) !=
        TINYEXR_SUCCESS) {
        // It has given back what it had, but does not say so.
        InitEXRImage(&exr.image);
        refuse(path, "is not a whole EXR: " + takeMessage(message));
    }

    const auto find = [&](const std::string& name) {
        for (int c = 0; c < exr.header.num_channels; ++c) {
            if (name == exr.header.channels[c].name) {
                return c;
            }
        }
        return -1;
    };
    std::vector<int> sources; // the file's channel of each component, or -1
    for (const std::string& name : names.empty() ? usualNames(4) : names) {
        sources.push_back(find(name));
        if (!names.empty() && sources.back() < 0) {
            refuse(path, "has no channel named " + name);
        }
    }
    if (names.empty() && std::all_of(sources.begin(), sources.end(), [](int c) { return c < 0; })) {
        sources.resize(std::size_t(std::min(4, exr.header.num_channels)));
        std::iota(sources.begin(), sources.end(), 0);
    }
    if (sources.size() > 4) {
        throw std::logic_error("readExr: a pixel has room for four channels");
    }

    Image<glm::vec4> image({exr.image.width, exr.image.height}, glm::vec4(0, 0, 0, 1));
    for (std::size_t c = 0; c < sources.size(); ++c) {
        if (sources[c] < 0) {
            continue;
        }
        const auto* plane = reinterpret_cast<const float*>(exr.image.images[sources[c]]);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            image.pixels()[i][int(c)] = plane[i];
        }
    }
    return image;
}

void writePfm(const fs::path& path, const Image<glm::vec4>& image, int channels) {
    requirePixels(image.size(), "writePfm");
    if (channels != 1 && channels != 3) {
        throw std::logic_error("writePfm: a PFM has one channel or three");
    }
    const glm::ivec2 size = image.size();
    // A negative scale says little endian. Rows go from the bottom to the top.
    std::string bytes = std::string(channels == 3 ? "PF\n" : "Pf\n") + std::to_string(size.x) +
                        " " + std::to_string(size.y) + "\n-1.0\n";
    for (int y = size.y - 1; y >= 0; --y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::vec4 pixel = image({x, y});
            bytes.append(reinterpret_cast<const char*>(&pixel), sizeof(float) * channels);
        }
    }
    writeFileAtomically(path, bytes);
}

Image<glm::vec4> readPfm(const fs::path& path) {
    const std::string bytes = readFile(path, kMaxBytes);
    char kind = 0;
    int width = 0, height = 0, length = 0;
    float scale = 0.0f;
    // The header ends with exactly one white-space character; the pixels may begin with another.
    if (std::sscanf(bytes.c_str(), "P%c %d %d %f%n", &kind, &width, &height, &scale, &length) !=
            4 ||
        (kind != 'F' && kind != 'f') || scale == 0.0f) {
        refuse(path, "is not a PFM");
    }
    if (scale > 0.0f) {
        refuse(path, "is a PFM of big-endian numbers, which is not read");
    }
    requireSaneSize(path, width, height);
    const int channels = kind == 'F' ? 3 : 1;
    const std::size_t start = std::size_t(length) + 1;
    const std::size_t need = std::size_t(width) * std::size_t(height) * channels * sizeof(float);
    if (bytes.size() < start + need) {
        refuse(path, "ends early: a PFM of " + std::to_string(width) + " x " +
                         std::to_string(height) + " has " + std::to_string(need) +
                         " bytes of pixels");
    }
    Image<glm::vec4> image({width, height}, glm::vec4(1.0f));
    const char* next = bytes.data() + start;
    for (int y = height - 1; y >= 0; --y) {
        for (int x = 0; x < width; ++x) {
            glm::vec4& pixel = image({x, y});
            std::memcpy(&pixel, next, sizeof(float) * channels);
            if (channels == 1) {
                pixel.y = pixel.z = pixel.x;
            }
            next += sizeof(float) * channels;
        }
    }
    return image;
}

} // namespace afterglow
