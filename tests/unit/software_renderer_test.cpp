// SPDX-License-Identifier: MIT
#include "renderer/gl/context.h"

#include <string>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("a software renderer is known by its name, also below another driver") {
    for (const char* const renderer :
         {"llvmpipe (LLVM 15.0.6, 256 bits)", "LLVMPIPE", "softpipe", "Google SwiftShader",
          "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader)",
          "Microsoft Basic Render Driver", "D3D12 (Microsoft Basic Render Driver)",
          "zink (llvmpipe (LLVM 15.0.6, 256 bits))",
          "zink Vulkan 1.3(llvmpipe (LLVM 17.0.6, 256 bits) (MESA_LLVMPIPE))",
          "virgl (LLVMPIPE (LLVM 15.0.7 256 bits))", "SWR (LLVM 10.0.0, 256 bits)", "swr"}) {
        CAPTURE(std::string(renderer));
        CHECK(isSoftwareRenderer(renderer));
    }
}

TEST_CASE("a GPU is no software renderer, even if its driver uses LLVM or runs on another") {
    for (const char* const renderer :
         {"NVIDIA H100 80GB HBM3/PCIe", "NVIDIA GeForce RTX 3060/PCIe/SSE2",
          "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 15.0.7, DRM 3.49, 6.1.0)",
          "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "NV167", "Apple M1",
          "zink Vulkan 1.3(AMD Radeon RX 6600 (RADV NAVI23) (MESA_RADV))",
          "D3D12 (NVIDIA GeForce RTX 3060)", "V3D 4.2", "CrosswrapGPU", ""}) {
        CAPTURE(std::string(renderer));
        CHECK_FALSE(isSoftwareRenderer(renderer));
    }
}
