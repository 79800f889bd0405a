#version 450 core
// SPDX-License-Identifier: MIT

// The temporal gradient at the sample of each stratum: the same surface point, shaded with the same
// random numbers, now and one frame ago. Schied et al. 2018, section 4.2.
// A stratum without a sample holds (0, 0): it adds nothing to numerator and denominator alike.
// With CHANNELS its light is kept by channel, and how many strata have changed is counted: "Change
// of light" in docs/pipeline.md. With EXTRA_SAMPLES the sample was not shaded in the picture, but
// beside it. With INSPECT the output is one stratum's GradientFindings; see lib/inspect.glsl.

#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/inspect.glsl"
#include "shared/denoise_params.h"
#include "shared/instrument_params.h"

Inspectable(GradientFindings);
#ifndef CHANNELS
layout(std140, binding = kPassBlock) uniform Params {
    GradientParams params;
};
#endif

Float4Texture(raw);         // a: luminance
Float4Texture(previousRaw); // of the frame before
Uint4Texture(samples);      // y: place in the stratum + 1; z: source pixel
Float4Texture(guides);
#ifdef EXTRA_SAMPLES
Float4Texture(sampleRaw); // per stratum; a: luminance
#endif

#ifdef CHANNELS
writeonly uniform image2D before;       // rgb: light of the sample before; a: 1 where there is one
writeonly uniform image2D now;          // rgb: its light now; a: mean luminance of the stratum
writeonly uniform image2D products;     // before . before, before . now, now . now, variance
layout(r32ui) uniform uimage2D changed; // one texel: strata whose light has changed

const float kLeastChange = 1e-3; // relative
#elif !defined(INSPECT)
writeonly uniform image2D gradient; // delta, Delta, mean luminance, variance of luminance
#endif

struct LightPair {
    vec4 before, now; // a: luminance
    bool isThere;
};

LightPair lightOfSample(ivec2 s) {
    uvec4 carried = fetch(samples, s);
    if (carried.y == 0u)
        return LightPair(vec4(0.0), vec4(0.0), false);
#ifdef EXTRA_SAMPLES
    vec4 light = fetch(sampleRaw, s);
#else
    uint place = carried.y - 1u;
    vec4 light =
        fetch(raw, s * int(kStratumSize) + ivec2(place % kStratumSize, place / kStratumSize));
#endif
    return LightPair(fetch(previousRaw, unpackPixel(carried.z)), light, true);
}

// Mean and variance of the luminance of a stratum's surfaces.
vec2 statisticsOf(ivec2 s) {
    ivec2 first = s * int(kStratumSize);
    ivec2 last = sizeOf(raw) - 1;
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
    return vec2(mean, variance);
}

void main() {
    ivec2 s = texelToCompute();
    if (any(greaterThanEqual(s, sizeOf(samples))))
        return;
    LightPair pair = lightOfSample(s);
    vec2 statistics = statisticsOf(s);
#ifdef CHANNELS
    vec3 larger = max(pair.before.rgb, pair.now.rgb);
    if (any(greaterThan(abs(pair.now.rgb - pair.before.rgb), kLeastChange * (larger + 1e-3))))
        imageAtomicAdd(changed, ivec2(0), 1u);
    imageStore(before, s, vec4(pair.before.rgb, float(pair.isThere)));
    imageStore(now, s, vec4(pair.now.rgb, statistics.x));
    imageStore(products, s,
               vec4(dot(pair.before.rgb, pair.before.rgb), dot(pair.before.rgb, pair.now.rgb),
                    dot(pair.now.rgb, pair.now.rgb), statistics.y));
#else
    NOTE(now, pair.now.a);
    NOTE(before, pair.before.a);
    float difference = pair.now.a - pair.before.a;
    vec2 change = vec2(params.magnitude == kGradientAbsolute ? abs(difference) : difference,
                       max(pair.now.a, pair.before.a));
#ifdef INSPECT
    findings.gradient = vec4(change, statistics);
#else
    imageStore(gradient, s, vec4(change, statistics));
#endif
#endif
}
