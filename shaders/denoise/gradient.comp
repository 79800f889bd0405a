#version 450 core
// SPDX-License-Identifier: MIT

// The temporal gradient at the sample of each stratum: the same surface point, shaded with the same
// random numbers, now and one frame ago. Schied et al. 2018, section 4.2.
// A stratum without a sample holds (0, 0): it adds nothing to numerator and denominator alike.
// With EXTRA_SAMPLES the sample was not shaded in the picture, but beside it.
// With INSPECT the output is one stratum's GradientFindings; see lib/inspect.glsl.

#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/inspect.glsl"
#include "shared/denoise_params.h"
#include "shared/instrument_params.h"

Inspectable(GradientFindings);
layout(std140, binding = kPassBlock) uniform Params {
    GradientParams params;
};

Float4Texture(raw);         // a: luminance
Float4Texture(previousRaw); // of the frame before
Uint4Texture(samples);      // y: place in the stratum + 1; z: source pixel
Float4Texture(guides);
#ifdef EXTRA_SAMPLES
Float4Texture(sampleRaw); // per stratum; a: luminance
#endif

#ifndef INSPECT
writeonly uniform image2D gradient; // delta, Delta, mean luminance, variance of luminance
#endif

void main() {
    ivec2 s = texelToCompute();
    if (any(greaterThanEqual(s, sizeOf(samples))))
        return;
    ivec2 first = s * int(kStratumSize);
    ivec2 last = sizeOf(raw) - 1;

    vec2 change = vec2(0.0);
    uvec4 carried = fetch(samples, s);
    if (carried.y != 0u) {
#ifdef EXTRA_SAMPLES
        float now = fetch(sampleRaw, s).a;
#else
        uint place = carried.y - 1u;
        float now = fetch(raw, first + ivec2(place % kStratumSize, place / kStratumSize)).a;
#endif
        float before = fetch(previousRaw, unpackPixel(carried.z)).a;
        NOTE(now, now);
        NOTE(before, before);
        float difference = now - before;
        change = vec2(params.magnitude == kGradientAbsolute ? abs(difference) : difference,
                      max(now, before));
    }

    float values[9];
    int count = 0;
    float sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 p = first + ivec2(i % 3, i / 3);
        if (any(greaterThan(p, last)) || fetch(guides, p).w == 0.0)
            continue;
        values[count] = fetch(raw, p).a;
        sum += values[count];
        ++count;
    }
    float mean = count == 0 ? 0.0 : sum / float(count);
    float variance = 0.0;
    for (int i = 0; i < count; ++i)
        variance += (values[i] - mean) * (values[i] - mean) / float(count);

#ifdef INSPECT
    findings.gradient = vec4(change, mean, variance);
#else
    imageStore(gradient, s, vec4(change, mean, variance));
#endif
}
