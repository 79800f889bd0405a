// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/scene.h"

#include <vector>

namespace afterglow::test {

/// Makes a scene of everything that paths tell apart: metals of roughness 0, 0.05, 0.3 and 1,
/// glossy dielectrics and something between, a mirrored instance, a moving one, faces of one side
/// and of two, bright surroundings. Lights: "key" faces down above a small shade; "fan", of two
/// sides and bent, turns; "turned away", in a mirrored instance, shows the camera and half of the
/// scene its back; "spare" is there to be switched off. All lamps reflect, too. Less than 300
/// triangles.
Scene makeGlossy();

/// Makes a floor of 8 x 8 m at y = 0 of one material, under the light "key" of radiance 10, 2 x 2 m
/// at y = 2, which the camera sees in it if it is smooth. The surroundings have radiance 0.05.
Scene makeGlossyFloor(float metallic, float roughness);

/// Makes a room without surroundings whose only light, "key", is behind a screen: what the camera
/// sees of the room gets light from other surfaces alone.
Scene makeScreenedLamp();

/// Makes a row of floors at y = 0, 1 m wide each, of these materials, under white surroundings of
/// radiance 1 and nothing else: no surface sees another, and the light "key" lies below. Floor i
/// is instance i, from left to right.
Scene makeFurnace(const std::vector<Material>& floors);

} // namespace afterglow::test
