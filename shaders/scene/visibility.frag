#version 450 core
// SPDX-License-Identifier: MIT

uniform uint instance;

layout(location = 0) out uvec2 ids; // instance + 1, triangle in its mesh; cleared to 0: background

void main() {
    ids = uvec2(instance + 1u, uint(gl_PrimitiveID));
}
