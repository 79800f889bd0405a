// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

namespace afterglow::test {

/// Makes a scene of everything that paths tell apart: metals of roughness 0, 0.05, 0.3 and 1,
/// glossy dielectrics and something between, a mirrored instance, a moving one, faces of one side
/// and of two, bright surroundings. Lights: "key" faces down above a small shade; "fan", of two
/// sides and bent, turns; "turned away", in a mirrored instance, shows the camera and half of the
/// scene its back; "spare" is there to be switched off. All lamps reflect, too. Less than 300
/// triangles.
Scene makeGlossy();

/// Makes a floor of 8 x 8 m at y = 0 of one material, under the light "key" of radiance 10, 1 x 1 m
/// at y = 2, which the camera sees in it if it is smooth. The surroundings have radiance 0.2.
Scene makeGlossyFloor(float metallic, float roughness);

/// Makes a room without surroundings whose only light, "key", is behind a screen: what the camera
/// sees of the room gets light from other surfaces alone.
Scene makeScreenedLamp();

} // namespace afterglow::test
