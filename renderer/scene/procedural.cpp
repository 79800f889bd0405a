// SPDX-License-Identifier: MIT
#include "renderer/scene/procedural.h"

#include "renderer/base/error.h"

#include <string>

namespace afterglow {

namespace {

struct Entry {
    SceneInfo info;
    Scene (*make)();
};

constexpr Entry kScenes[] = {
    {{"hall", "a vaulted hall with columns, soft shadows, six lights and a floating object"},
     makeHall},
    {{"cornell", "the Cornell box with a warm and a cool light"}, makeCornell},
    {{"gallery",
      "two rooms with a door, a polished floor, metals, and a lamp seen by its bounce alone"},
     makeGallery},
    {{"rooms", "two rooms with a wall between them and a light in each"}, makeRooms},
    {{"moving", "a box that slides to and fro under a light"}, makeMoving},
    {{"tiny", "a floor, a wall, a box and a light"}, makeTiny},
    {{"rect", "a floor under a square light: irradiance in closed form"}, makeRect},
    {{"edge", "a straight edge under a square light: a penumbra in closed form"}, makeEdge},
};

} // namespace

std::vector<SceneInfo> proceduralScenes() {
    std::vector<SceneInfo> infos;
    for (const Entry& entry : kScenes) {
        infos.push_back(entry.info);
    }
    return infos;
}

Scene makeProceduralScene(std::string_view name) {
    for (const Entry& entry : kScenes) {
        if (entry.info.name == name) {
            return entry.make();
        }
    }
    throw UsageError("there is no scene named " + std::string(name));
}

} // namespace afterglow
