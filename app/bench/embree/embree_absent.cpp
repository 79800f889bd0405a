// SPDX-License-Identifier: MIT
// Replaces embree_scene.cpp in a program that is built without Embree.

#include "app/bench/embree_scene.h"

#include "renderer/base/error.h"

namespace afterglow {

namespace {

[[noreturn]] void refuse() {
    throw Error("this program was built without Embree (Debian: libembree-dev)");
}

} // namespace

struct EmbreeScene::Impl {};

bool EmbreeScene::isThere() {
    return false;
}

EmbreeScene::EmbreeScene(std::span<const gpu::BvhTriangle>, unsigned) {
    refuse();
}
EmbreeScene::~EmbreeScene() = default;

double EmbreeScene::buildMilliseconds() const {
    refuse();
}
void EmbreeScene::trace(std::span<const ListedRay>, bool, std::span<std::uint8_t>) const {
    refuse();
}
double EmbreeScene::sahCost(std::span<const Aabb>, unsigned) {
    refuse();
}

} // namespace afterglow
