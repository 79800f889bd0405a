#version 450 core
// SPDX-License-Identifier: MIT

// One instance into the visibility buffer. Burns and Hunt 2013, "The Visibility Buffer".

#include "lib/frame.glsl"

layout(location = 0) in vec3 position; // object space, meters

uniform mat4 worldFromObject;

void main() {
    gl_Position = frame.clipFromWorld * (worldFromObject * vec4(position, 1.0));
    // Moves a pixel's jittered place to its center.
    gl_Position.xy += gl_Position.w * frame.jitter * vec2(-2.0, 2.0) / vec2(frame.size);
}
