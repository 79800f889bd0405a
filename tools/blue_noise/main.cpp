// SPDX-License-Identifier: MIT
// Makes the blue-noise tile that ships in assets/noise:
//
//     blue_noise assets/noise/blue_noise_128.pgm
//
// The tile is a function of the edge and the seed alone; a test makes it again and compares.

#include "tools/blue_noise/blue_noise.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

int main(int argc, char** argv) {
    constexpr int kEdge = 128;
    constexpr std::uint32_t kSeed = 1;
    if (argc != 2) {
        std::fprintf(stderr, "usage: blue_noise FILE.pgm\n");
        return 2;
    }
    try {
        const std::string bytes =
            afterglow::writePgm16(afterglow::spreadRanks(afterglow::makeBlueNoise(kEdge, kSeed)));
        std::ofstream file(argv[1], std::ios::binary);
        file.write(bytes.data(), std::streamsize(bytes.size()));
        file.close();
        if (!file) {
            std::fprintf(stderr, "blue_noise: %s: cannot be written\n", argv[1]);
            return 1;
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "blue_noise: %s\n", error.what());
        return 1;
    }
    return 0;
}
