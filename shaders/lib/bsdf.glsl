// SPDX-License-Identifier: MIT
// The surface model of glTF's factors: a GGX lobe over a Lambertian one. Walter et al. 2007; Heitz
// 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2).
//
// Departure from glTF 2.0, appendix B: the diffuse lobe gets what the specular one leaves on the
// whole, and not what it leaves for one half vector, which gives back more light than came at
// grazing angles.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "shared/path.h"

Float2Texture(specularAlbedo); // over roughness and cosine: factor of F0, and what is added

const float kPi = 3.14159265358979;

struct Bsdf {
    vec3 normal, geometric, view; // unit length, on one side
    vec3 diffuse, specular;       // albedos of the two lobes
    vec3 f0;
    float alpha;     // of GGX
    float cosView;   // normal . view
    float pSpecular; // the probability with which a direction is of the specular lobe
};

// Albedo of the specular lobe for F0 = 0 and what F0 adds, bilinearly between texels that stand for
// 0 to 1 with both ends.
vec2 specularTerms(float roughness, float cosView) {
    vec2 place = clamp(vec2(roughness, cosView), 0.0, 1.0) * (float(kAlbedoTableSize) - 1.0);
    ivec2 low = ivec2(place), high = min(low + 1, int(kAlbedoTableSize) - 1);
    vec2 t = place - vec2(low);
    return mix(
        mix(fetch(specularAlbedo, low).xy, fetch(specularAlbedo, ivec2(high.x, low.y)).xy, t.x),
        mix(fetch(specularAlbedo, ivec2(low.x, high.y)).xy, fetch(specularAlbedo, high).xy, t.x),
        t.y);
}

// `least` is the least alpha that a surface is taken to have.
Bsdf makeBsdf(vec3 normal, vec3 geometric, vec3 view, vec3 baseColor, float metallic,
              float roughness, float least) {
    Bsdf b;
    b.normal = normal;
    b.geometric = geometric;
    // A view from below the shading normal's horizon is moved to it.
    b.view = normalize(view + normal * max(0.0, kLeastCosine - dot(normal, view)));
    b.cosView = max(dot(normal, b.view), kLeastCosine);
    b.alpha = max(max(roughness * roughness, kLeastAlpha), least);
    b.f0 = mix(vec3(kDielectricF0), baseColor, metallic);
    vec2 terms = specularTerms(b.alpha == least ? sqrt(least) : roughness, b.cosView);
    b.specular = b.f0 * terms.x + terms.y;
    b.diffuse = (1.0 - metallic) * baseColor * (1.0 - b.specular);
    float diffuse = luminance(b.diffuse), specular = luminance(b.specular);
    b.pSpecular = clamp(specular / max(diffuse + specular, 1e-20), 0.1, 0.9);
    b.pSpecular = diffuse > 0.0 ? (specular > 0.0 ? b.pSpecular : 0.0) : 1.0;
    return b;
}

float smithRoot(float cosine, float alpha) {
    return sqrt(cosine * cosine * (1.0 - alpha * alpha) + alpha * alpha);
}

struct Scattering {
    vec3 diffuse, specular; // the two lobes, 1/sr
    float pdf;              // of the direction, 1/sr
};

// Of light that comes from `light`; 0 where that lies below the surface.
Scattering scatter(Bsdf b, vec3 light) {
    float cosLight = dot(b.normal, light);
    if (cosLight <= 0.0 || dot(b.geometric, light) <= 0.0)
        return Scattering(vec3(0.0), vec3(0.0), 0.0);
    vec3 middle = normalize(b.view + light);
    float cosMiddle = clamp(dot(b.normal, middle), 0.0, 1.0);
    float a2 = b.alpha * b.alpha;
    // sin^2 by the cross product: 1 - cos^2 has no digits left near the peak of a smooth lobe.
    vec3 across = cross(b.normal, middle);
    float spread = a2 * cosMiddle * cosMiddle + dot(across, across);
    float density = a2 / (kPi * spread * spread);
    float rootView = smithRoot(b.cosView, b.alpha), rootLight = smithRoot(cosLight, b.alpha);
    float visibility = 0.5 / (cosLight * rootView + b.cosView * rootLight);
    float grazing = 1.0 - clamp(dot(middle, light), 0.0, 1.0);
    float grazing2 = grazing * grazing;
    vec3 fresnel = b.f0 + (1.0 - b.f0) * (grazing2 * grazing2 * grazing);
    // Visible normals: G1 D / (4 cosView), with G1 = 2 cosView / (cosView + root).
    float pdfSpecular = density / (2.0 * (b.cosView + rootView));
    return Scattering(b.diffuse / kPi, fresnel * (density * visibility),
                      b.pSpecular * pdfSpecular + (1.0 - b.pSpecular) * cosLight / kPi);
}

// A direction with that density. `tangent` is orthogonal to the normal.
vec3 sampleDirection(Bsdf b, vec3 tangent, float lobe, vec2 u) {
    vec3 bitangent = cross(b.normal, tangent);
    float radius = sqrt(u.x), angle = 2.0 * kPi * u.y;
    vec2 disk = radius * vec2(cos(angle), sin(angle));
    vec3 local;
    if (lobe < b.pSpecular) {
        // Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4).
        vec3 view = vec3(dot(b.view, tangent), dot(b.view, bitangent), b.cosView);
        vec3 stretched = normalize(vec3(b.alpha * view.xy, view.z));
        float flat2 = dot(stretched.xy, stretched.xy);
        vec3 t1 = flat2 > 0.0 ? vec3(-stretched.y, stretched.x, 0.0) * inversesqrt(flat2)
                              : vec3(1.0, 0.0, 0.0);
        vec3 t2 = cross(stretched, t1);
        float s = 0.5 * (1.0 + stretched.z);
        disk.y = (1.0 - s) * sqrt(max(0.0, 1.0 - disk.x * disk.x)) + s * disk.y;
        vec3 bulge = disk.x * t1 + disk.y * t2 + sqrt(max(0.0, 1.0 - dot(disk, disk))) * stretched;
        vec3 middle = normalize(vec3(b.alpha * bulge.xy, max(0.0, bulge.z)));
        local = 2.0 * dot(view, middle) * middle - view;
    } else {
        local = vec3(disk, sqrt(max(0.0, 1.0 - u.x)));
    }
    return normalize(local.x * tangent + local.y * bitangent + local.z * b.normal);
}
