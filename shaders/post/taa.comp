#version 450 core
// SPDX-License-Identifier: MIT

// Temporal anti-aliasing: every frame looks through another point of each pixel, and this pass
// averages the frames where their surfaces went. Karis 2014, "High-Quality Temporal Supersampling":
// motion of the nearest surface around, YCoCg, weights by luminance. Salvi 2016, "An Excursion in
// Temporal Supersampling": the history is clipped to the variance of this frame around the pixel.
// Departure: the average of the first frames is a plain mean, so that a still picture is that of
// all its points after one cycle.

#include "lib/color.glsl"
#include "lib/exposure.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "shared/post_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    TaaParams params;
};

Float4Texture(color); // of this frame, linear
Float4Texture(guides);
Float4Texture(motion);
Float4Texture(history); // rgb; a: frames in it

writeonly uniform image2D resolved; // likewise

const float kLeastExtent = 1e-5; // of the box that a history is clipped to
const float kLeastShare = 1e-4;  // 1 / (1 + exposed luminance) of the brightest color that is kept

float factor; // of radiance

// Bounded: a color as it counts in the average. Its luminance is below 1.
vec3 weigh(vec3 c) {
    return params.weighted != 0 ? factor * c / (1.0 + factor * luminance(c)) : c;
}

vec3 unweigh(vec3 c) {
    return params.weighted != 0 ? c / (factor * max(1.0 - luminance(c), kLeastShare)) : c;
}

vec3 toYCoCg(vec3 c) {
    return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * (c.r - c.b),
                0.5 * c.g - 0.25 * (c.r + c.b));
}

// The motion of the nearest surface in 3x3 pixels: an edge moves with what is in front. The pixel
// itself wins a tie, then the first one.
vec4 motionAround(ivec2 p) {
    ivec2 last = frame.size - 1, nearest = p;
    float center = fetch(guides, p).w;
    float least = center > 0.0 ? center : 1e30;
    for (int y = max(p.y - 1, 0); y <= min(p.y + 1, last.y); ++y)
        for (int x = max(p.x - 1, 0); x <= min(p.x + 1, last.x); ++x) {
            float depth = fetch(guides, ivec2(x, y)).w;
            bool isNearer = depth > 0.0 && depth < least;
            nearest = isNearer ? ivec2(x, y) : nearest;
            least = isNearer ? depth : least;
        }
    return fetch(motion, nearest); // of background: no motion, w = 0
}

// The weight of a texel at a distance, in texels.
float catmullRom(float away) {
    float x = abs(away);
    return x < 1.0 ? 1.0 + x * x * (1.5 * x - 2.5) : 2.0 + x * (x * (2.5 - 0.5 * x) - 4.0);
}

// 4x4 texels around a place, pixel centers at integers; kept within the range of the 2x2 in the
// middle. Of a place at a center one texel is all: what does not move is not filtered.
vec3 historyAt(vec2 place) {
    ivec2 last = frame.size - 1;
    ivec2 base = ivec2(floor(place));
    vec2 part = place - vec2(base);
    ivec2 from = ivec2(part.x > 0.0 ? -1 : 0, part.y > 0.0 ? -1 : 0);
    ivec2 to = ivec2(part.x > 0.0 ? 2 : 0, part.y > 0.0 ? 2 : 0);
    vec3 sum = vec3(0.0), low = vec3(1e30), high = vec3(-1e30);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            vec3 c = weigh(fetch(history, clamp(base + ivec2(x, y), ivec2(0), last)).rgb);
            vec2 away = abs(vec2(x, y) - part);
            sum += catmullRom(away.x) * catmullRom(away.y) * c;
            bool isInner = max(away.x, away.y) < 1.0;
            low = isInner ? min(low, c) : low;
            high = isInner ? max(high, c) : high;
        }
    return clamp(sum, low, high);
}

// Mean and standard deviation of this frame in 3x3 pixels, in YCoCg. Sums are of differences to the
// center, which lose no digits where all are alike.
void around(ivec2 p, vec3 center, out vec3 mean, out vec3 deviation) {
    ivec2 last = frame.size - 1;
    vec3 sum = vec3(0.0), squares = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last);
            vec3 d = toYCoCg(weigh(fetch(color, q).rgb) - center);
            sum += d;
            squares += d * d;
        }
    vec3 shift = sum / 9.0;
    mean = toYCoCg(center) + shift;
    deviation = sqrt(max(squares / 9.0 - shift * shift, 0.0));
}

// Moves a color towards the middle of the box until it is in it.
vec3 clipped(vec3 c, vec3 mean, vec3 deviation) {
    vec3 middle = vec3(mean.x - mean.z + mean.y, mean.x + mean.z, mean.x - mean.z - mean.y);
    vec3 away = abs(toYCoCg(c) - mean) / (params.clip * deviation + kLeastExtent);
    float most = max(max(away.x, away.y), away.z);
    return most > 1.0 ? middle + (c - middle) / most : c;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    factor = exposureOf(params.exposure);
    vec3 newest = fetch(color, p).rgb;
    vec4 moved = motionAround(p);
    vec2 place = vec2(p) + moved.xy;
    ivec2 texel = ivec2(floor(place + 0.5));
    bool isInside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, frame.size));
    bool mayHave = frame.historyValid != 0u && moved.w != 0.0 && isInside;
    float frames = mayHave ? fetch(history, texel).a : 0.0;
    if (!mayHave)
        place = vec2(p);

    vec3 center = weigh(newest), mean, deviation;
    around(p, center, mean, deviation);
    vec3 before = clipped(historyAt(place), mean, deviation);
    float alpha = max(params.blend, 1.0 / (frames + 1.0));
    vec3 blended = unweigh(before + alpha * (center - before));
    imageStore(resolved, p, vec4(frames > 0.0 ? blended : newest, frames + 1.0));
}
