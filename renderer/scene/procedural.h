// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <string_view>
#include <vector>

namespace afterglow {

struct SceneInfo {
    std::string_view name;
    std::string_view description; ///< one line
};

/// Returns the scenes that are made in code, in the order in which to show them.
std::vector<SceneInfo> proceduralScenes();

/// Makes one of them; the same scene, bit for bit, every time. Throws UsageError for a name that is
/// none of them.
Scene makeProceduralScene(std::string_view name);

// The scenes, one function each. All lights shine from their front only and are named after their
// nodes.

/// Makes the Cornell box, 0.556 m wide, 0.549 m high, 0.559 m deep, open towards +Z at z = 0.
/// Lights: "key", warm, in the ceiling, and "fill", cool and smaller, on the right wall.
Scene makeCornell();

/// Makes a vaulted hall of 36 x 12 m between two rows of fluted columns; more than 100,000
/// triangles. Lights: "key", a warm window on the left; "fill", a cool one at the end; "lantern
/// near", "lantern middle", "lantern far"; and "behind wall", in a sealed room of which the hall
/// sees nothing. The node "mover" floats through the first bays, through the shadow of a column, in
/// a loop of 12 s.
Scene makeHall();

/// Makes two rooms, x in [-2.5, 2.5], 2.8 m high, with a doorway between them (z = -4.0 to -4.2).
/// The camera is in the first, which has a polished floor of roughness 0.12, spheres of gold, glaze
/// and mirror, and the lights "key", in the ceiling, and "sign", on the far wall, which the floor
/// mirrors. The light "next room" reaches it only from surfaces of the second room. The node "door"
/// shuts the doorway and slides away by 1.2 m along X; the node "screen" is red where it faces +Z
/// and white behind, and turns. No ambient light.
Scene makeGallery();

/// Makes a scene of fewer than 100 triangles: a floor of 4 x 4 m at y = 0, a wall at z = -2, a box
/// and the light "key", 1 x 1 m at y = 2.5, centered, facing down, of radiance 12.
Scene makeTiny();

/// Makes "tiny" with the box as the node "mover": it slides 1.6 m to and fro along X, in 4 s.
Scene makeMoving();

/// Makes a scene for irradiance in closed form. A floor of 20 x 20 m at y = 0, centered, of albedo
/// 0.5, and the light "key": x and z in [-0.5, 0.5] at y = 2, facing down, of radiance 10. No
/// ambient light.
Scene makeRect();

/// Makes a scene for a penumbra in closed form. A floor as in "rect"; the light "key": x and z in
/// [-0.2, 0.2] at y = 2, facing down, of radiance 50; an occluder without thickness at y = 1: x in
/// [0, 10], z in [-10, 10]. From the floor at (px, 0, pz) the part of the light with x < -px is
/// seen: all of it where px <= -0.2, none of it where px >= 0.2. No ambient light.
Scene makeEdge();

/// Makes two sealed rooms of 4 x 3 x 4 m with 0.2 m of wall between them (|x| < 0.1). The camera
/// and the light "key" are in the left one, x in [-4.1, -0.1]; the light "behind wall" is in the
/// right one.
Scene makeRooms();

} // namespace afterglow
