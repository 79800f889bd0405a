// SPDX-License-Identifier: MIT
// Textures and buffers that are read one texel at a time, declared and read in one spelling:
//
//     Float4Texture(radiance);                            // at file scope
//     vec4 center = fetch(radiance, p);                   // p: ivec2, inside the texture
//     ivec2 size = sizeOf(radiance);
//     Uint4Buffer(nodes);
//     uvec4 node = fetchBuffer(nodes, 3);
//     int count = lengthOf(nodes);                        // texels of 16 bytes
//
// A software rasterizer loads from images 1.6 times faster than it fetches through samplers; a GPU
// may have only 8 images in a shader, and caches samplers better. FETCH_BY_IMAGE, from the shader
// library, chooses. fetch() gives what texelFetch() gives: for FloatTexture (x, 0, 0, 1), and so
// on.
//
// Depth textures cannot be images: declare those as sampler2D.

#pragma once

#ifdef FETCH_BY_IMAGE

#define Float4Texture(name) layout(rgba32f) readonly uniform image2D name
#define Float2Texture(name) layout(rg32f) readonly uniform image2D name
#define FloatTexture(name) layout(r32f) readonly uniform image2D name
#define Uint4Texture(name) layout(rgba32ui) readonly uniform uimage2D name
#define Uint2Texture(name) layout(rg32ui) readonly uniform uimage2D name
#define UintTexture(name) layout(r32ui) readonly uniform uimage2D name
#define Uint4Buffer(name) layout(rgba32ui) readonly uniform uimageBuffer name
#define UintBuffer(name) layout(r32ui) readonly uniform uimageBuffer name

#define fetch(name, p) imageLoad(name, p)
#define fetchBuffer(name, index) imageLoad(name, index)
#define sizeOf(name) imageSize(name)
#define lengthOf(name) imageSize(name)

#else

#define Float4Texture(name) uniform sampler2D name
#define Float2Texture(name) uniform sampler2D name
#define FloatTexture(name) uniform sampler2D name
#define Uint4Texture(name) uniform usampler2D name
#define Uint2Texture(name) uniform usampler2D name
#define UintTexture(name) uniform usampler2D name
#define Uint4Buffer(name) uniform usamplerBuffer name
#define UintBuffer(name) uniform usamplerBuffer name

#define fetch(name, p) texelFetch(name, p, 0)
#define fetchBuffer(name, index) texelFetch(name, index)
#define sizeOf(name) textureSize(name, 0)
#define lengthOf(name) textureSize(name)

#endif
