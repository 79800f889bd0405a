// SPDX-License-Identifier: MIT
#include "renderer/base/hash.h"

#include <cstdio>

namespace afterglow {

void Hash::add(std::span<const std::byte> bytes) {
    // The prime is 2^88 + 0x13b. In 64-bit halves, modulo 2^128:
    //   (high, low) * 0x13b + (low << 24, 0)
    constexpr std::uint64_t kPrimeLow = 0x13b;
    std::uint64_t high = high_, low = low_;
    for (const std::byte byte : bytes) {
        low ^= std::uint64_t(byte);
        const std::uint64_t lower = (low & 0xffffffffu) * kPrimeLow;
        const std::uint64_t upper = (low >> 32) * kPrimeLow + (lower >> 32);
        high = high * kPrimeLow + (upper >> 32) + (low << 24);
        low = (upper << 32) | (lower & 0xffffffffu);
    }
    high_ = high;
    low_ = low;
}

std::string Hash::hex() const {
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(high_),
                  static_cast<unsigned long long>(low_));
    return text;
}

} // namespace afterglow
