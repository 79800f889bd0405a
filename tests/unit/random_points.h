// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

#include <glm/glm.hpp>

namespace afterglow::test {

/// Numbers and points that look random and are the same in every run.
class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}

    double unit() { return double(engine_()) / 4294967296.0; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    glm::dvec3 inCube(double half) {
        return {between(-half, half), between(-half, half), between(-half, half)};
    }
    int below(int end) { return int(unit() * end); }

private:
    std::mt19937 engine_;
};

} // namespace afterglow::test
