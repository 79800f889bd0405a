// SPDX-License-Identifier: MIT
#include "tests/support/random_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "renderer/image/color.h"
#include "shared/bindings.h"

namespace afterglow {
namespace {

constexpr int kStratum = int(gpu::kStratumSize);

/// Numbers from a seed, the same with every standard library.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}

    float uniform() { return float(engine_() >> 8) * 0x1p-24f; } ///< [0, 1)
    float uniform(float from, float to) { return from + (to - from) * uniform(); }
    bool chance(float probability) { return uniform() < probability; }
    int below(int count) { return int(engine_() % std::uint32_t(count)); }
    std::uint32_t bits() { return std::uint32_t(engine_()); }
    glm::vec3 inCube(float extent) { // one draw a statement: their order is part of the seed
        const float x = uniform(-extent, extent);
        const float y = uniform(-extent, extent);
        const float z = uniform(-extent, extent);
        return {x, y, z};
    }
    /// Returns a multiple of 1/32, so that sums with pixel coordinates and bilinear weights are
    /// exact.
    float thirtySeconds(int extent) { return float(below(2 * 32 * extent + 1) - 32 * extent) / 32; }

private:
    std::mt19937 engine_;
};

/// A rectangle of the picture that shows one plane.
struct Shape {
    glm::vec2 least, most; ///< pixels
    glm::vec3 normal;
    float depth; ///< meters at the top left corner of the picture
    glm::vec2 slope;
    glm::vec2 motion; ///< pixels, to the previous frame
    float depthMotion;
    glm::vec3 color;
};

glm::vec3 normalFacingViewer(Dice& dice) {
    return glm::normalize(glm::vec3(0.0f, 0.0f, 1.3f) + dice.inCube(1.0f));
}

std::vector<Shape> randomShapes(Dice& dice, glm::ivec2 size) {
    const glm::vec2 extent(size);
    std::vector<Shape> shapes;
    for (int i = 0; i < 6; ++i) {
        Shape s;
        const float centerX = dice.uniform(), centerY = dice.uniform();
        const float halfX = dice.uniform(0.1f, 0.5f), halfY = dice.uniform(0.1f, 0.5f);
        s.least = extent * glm::vec2(centerX - halfX, centerY - halfY);
        s.most = extent * glm::vec2(centerX + halfX, centerY + halfY);
        s.normal = normalFacingViewer(dice);
        s.depth = dice.uniform(2.0f, 20.0f);
        // Steep enough to matter beside the 1e-3 z of the depth weight, never below a third of z.
        const glm::vec2 steepest = glm::min(glm::vec2(0.02f), 0.3f / extent) * s.depth;
        s.slope.x = dice.uniform(-1.0f, 1.0f) * steepest.x;
        s.slope.y = dice.uniform(-1.0f, 1.0f) * steepest.y;
        if (i == 1 || i == 4) // faces the viewer: only the part relative to the depth is left
            s.slope = glm::vec2(0.0f);
        s.motion.x = dice.thirtySeconds(3);
        s.motion.y = dice.thirtySeconds(3);
        if (i % 3 == 0)
            s.motion = glm::vec2(0.0f); // static: the tap is the pixel itself
        s.depthMotion = dice.uniform(-0.05f, 0.05f) * s.depth;
        s.color = glm::vec3(0.6f) + dice.inCube(0.5f);
        shapes.push_back(s);
    }
    return shapes;
}

/// Returns the topmost shape at pixel p, of those moved by `time` times their motion.
std::optional<int> shapeAt(const std::vector<Shape>& shapes, glm::vec2 p, float time) {
    for (int i = int(shapes.size()) - 1; i >= 0; --i) {
        const Shape& s = shapes[std::size_t(i)];
        const glm::vec2 q = p - time * s.motion + 0.5f;
        if (q.x >= s.least.x && q.y >= s.least.y && q.x < s.most.x && q.y < s.most.y)
            return i;
    }
    return {};
}

glm::uvec4 visibilityOf(Dice& dice, int shape) {
    const float u = dice.uniform(), v = (1.0f - u) * dice.uniform();
    return {std::uint32_t(shape) + 1, dice.bits() % 1000, std::bit_cast<std::uint32_t>(u),
            std::bit_cast<std::uint32_t>(v)};
}

/// Returns the normal of `s`, a little bumpy: within 0.06 rad.
glm::vec3 bumpyNormal(Dice& dice, const Shape& s) {
    return glm::normalize(s.normal + dice.inCube(0.06f / std::sqrt(3.0f)));
}

/// Returns noise of a path tracer at one sample: shadow, light, now and then a bright one.
glm::vec4 noisyRadiance(Dice& dice, const Shape& s) {
    const float level = dice.chance(0.2f)    ? 0.0f
                        : dice.chance(0.05f) ? dice.uniform(2.0f, 5.0f)
                                             : dice.uniform(0.5f, 1.5f);
    const glm::vec3 c = level * glm::max(glm::vec3(0.0f), s.color + dice.inCube(0.1f));
    return {c, luminance(c)};
}

glm::vec4 randomMoments(Dice& dice, float level) {
    const float lengths[] = {0, 1, 2, 3, 4, 10};
    const float mean = level * dice.uniform(0.5f, 1.5f);
    const float spread = dice.uniform(-0.05f, 0.5f); // below 0: rounding does that, too
    return {mean, mean * mean + spread, lengths[dice.below(6)], 0.0f};
}

/// Returns the light that a sample with the light `now` had in the frame before.
glm::vec3 changedLight(Dice& dice, glm::vec3 now, bool isSame) {
    if (isSame)
        return now;
    switch (dice.below(9)) {
    case 0: return glm::vec3(0.0f);
    case 1: return now * 1.0005f + 5e-7f; // too little to count, also where it was black
    case 2: return now * 1.002f + 2e-6f;  // just enough
    case 3: return {now.b, now.r, now.g};
    case 4: return now * (glm::vec3(1.0f) + dice.inCube(0.5f));
    case 5: return glm::vec3(0.6f) + dice.inCube(0.5f);
    case 6: return now * glm::vec3(1.0f, 1.0f, 0.5f);
    default: return now * dice.uniform(0.0f, 2.0f); // one factor for all channels
    }
}

/// Returns E, v, scale and weight of a stratum whose light has changed by `lambda`.
glm::vec4 randomChange(Dice& dice, float lambda) {
    const float kind = dice.uniform();
    // What a factor does not explain: nothing of it, all of it, or a part. Never nothing of a
    // change to or from black: a small E beside 1.0001 - lambda is nothing that 32 bits can hold.
    const float left = kind < 0.2f && lambda < 0.9f ? 0.0f
                       : kind < 0.4f                ? 1.0f
                                                    : dice.uniform(0.1f, 1.0f);
    const float scale = dice.chance(0.2f) ? 1.0f : dice.uniform(0.0f, 2.0f);
    const float variance = dice.chance(0.2f) ? 0.0f : dice.uniform(0.0f, 6.0f);
    const float weight = dice.chance(0.3f) ? 0.0f : dice.uniform(0.0f, 2.0f);
    return {lambda * lambda * left, variance, lambda > 0.0f ? scale : 1.0f, weight};
}

struct LightPair {
    glm::vec4 before; ///< light, and how much of a sample there is
    glm::vec3 now, products;
};

/// Returns the sum of a few samples with a weight, as filtered light pairs hold it.
LightPair randomLightPair(Dice& dice) {
    LightPair sum{};
    if (dice.chance(0.1f))
        return sum; // no sample around
    const int count = 1 + dice.below(3);
    const float weight = (dice.chance(0.3f) ? 1.0f : dice.uniform(0.05f, 0.9f)) / float(count);
    const float level = dice.chance(0.1f) ? 1e-4f : dice.chance(0.1f) ? 0.0f : 1.0f;
    const int kind = dice.below(6);
    const float factor = dice.uniform(0.0f, 4.0f);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = level * (glm::vec3(0.6f) + dice.inCube(0.5f));
        const glm::vec3 other = level * (glm::vec3(0.6f) + dice.inCube(0.5f));
        const glm::vec3 b = kind == 0   ? a
                            : kind == 1 ? a * factor
                            : kind == 2 ? glm::vec3(a.g, a.b, a.r)
                            : kind == 3 ? glm::vec3(0.0f)
                                        : other;
        const glm::vec3 was = kind == 4 ? glm::vec3(0.0f) : a;
        sum.before += weight * glm::vec4(was, 1.0f);
        sum.now += weight * b;
        sum.products += weight * glm::vec3(glm::dot(was, was), glm::dot(was, b), glm::dot(b, b));
    }
    return sum;
}

const glm::vec4 kGarbage{50.0f, 70.0f, 60.0f, 3.0f};
const glm::vec4 kBackground{0.0f, 0.0f, 1.0f, 0.0f}; // only the depth says so

} // namespace

RandomFrame::RandomFrame(glm::ivec2 pixels, std::uint32_t seed)
    : size(pixels), strata((pixels + kStratum - 1) / kStratum), visibility(size),
      previousVisibility(size), guides(size), previousGuides(size), slope(size), motion(size),
      raw(size), previousRaw(size), previousColor(size), previousMoments(size), lambda(strata),
      change(strata), accumulated(size), moments(size), signal(size), samples(strata),
      gradient(strata), strataGuides(strata), strataSlope(strata), before(strata), now(strata),
      products(strata) {
    Dice dice(seed);
    for (glm::vec4& pixel : previousRaw.pixels())
        pixel = kGarbage;
    const std::vector<Shape> shapes = randomShapes(dice, size);
    const auto depthAt = [](const Shape& s, glm::vec2 p) { return s.depth + glm::dot(s.slope, p); };

    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 p{x, y};
            std::optional<int> shape = shapeAt(shapes, p, 0.0f);
            if (!shape || dice.chance(0.03f)) {
                accumulated(p) = moments(p) = signal(p) = kGarbage;
                guides(p) = kBackground;
                continue;
            }
            const Shape& s = shapes[std::size_t(*shape)];
            visibility(p) = visibilityOf(dice, *shape);
            const float depth = depthAt(s, p);
            guides(p) =
                glm::vec4(bumpyNormal(dice, s), depth * (1 + dice.uniform(-1.5e-3f, 1.5e-3f)));
            slope(p).x = s.slope.x * dice.uniform(1.0f, 1.3f);
            slope(p).y = s.slope.y * dice.uniform(1.0f, 1.3f);
            motion(p) = glm::vec4(s.motion, depth + s.depthMotion, 1.0f);
            if (dice.chance(0.03f))
                motion(p).w = 0.0f;
            else if (dice.chance(0.04f)) {
                motion(p).x = dice.thirtySeconds(2 * size.x);
                motion(p).y = dice.thirtySeconds(2 * size.y);
                const glm::vec2 origin = glm::vec2(p) + glm::vec2(motion(p)) - s.motion;
                motion(p).z = depthAt(s, origin) + s.depthMotion;
            }
            raw(p) = noisyRadiance(dice, s);
            accumulated(p) = glm::vec4(glm::vec3(noisyRadiance(dice, s)), 0.0f);
            moments(p) = randomMoments(dice, luminance(s.color));
            signal(p) = noisyRadiance(dice, s);
            signal(p).a = dice.chance(0.2f) ? 0.0f : dice.uniform(0.0f, 0.2f);
        }

    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 p{x, y};
            std::optional<int> shape = shapeAt(shapes, p, 1.0f);
            if (!shape || dice.chance(0.03f)) {
                previousColor(p) = previousMoments(p) = kGarbage;
                previousGuides(p) = kBackground;
                continue;
            }
            const Shape& s = shapes[std::size_t(*shape)];
            previousVisibility(p) = visibilityOf(dice, *shape);
            float depth = depthAt(s, glm::vec2(p) - s.motion) + s.depthMotion;
            depth *= 1 + dice.uniform(-1.5e-3f, 1.5e-3f);
            glm::vec3 normal = bumpyNormal(dice, s);
            if (dice.chance(0.08f)) // another part of the same instance, well behind this one
                depth *= dice.uniform(1.7f, 2.5f);
            else if (dice.chance(0.08f)) // facing elsewhere
                normal = glm::normalize(glm::cross(normal, dice.inCube(1.0f)));
            previousGuides(p) = glm::vec4(normal, depth);
            previousColor(p) = noisyRadiance(dice, s);
            previousMoments(p) = randomMoments(dice, luminance(s.color));
        }

    for (int y = 0; y < strata.y; ++y)
        for (int x = 0; x < strata.x; ++x) {
            const glm::ivec2 s{x, y};
            lambda(s) = dice.chance(0.3f) ? 0.0f : dice.chance(0.15f) ? 1.0f : dice.uniform();

            std::vector<glm::ivec2> foreground;
            for (int k = 0; k < kStratum * kStratum; ++k) {
                const glm::ivec2 p = kStratum * s + glm::ivec2(k % kStratum, k / kStratum);
                if (guides.contains(p) && guides(p).w != 0.0f)
                    foreground.push_back(p);
            }
            if (foreground.empty()) {
                gradient(s) = glm::vec4(-70.0f, 50.0f, 60.0f, 3.0f); // more change than light
                strataGuides(s) = kBackground;
                continue;
            }
            const glm::ivec2 p = foreground[std::size_t(dice.below(int(foreground.size())))];
            if (dice.chance(0.7f)) {
                const float then = raw(p).a * (dice.chance(0.3f) ? 1.0f : dice.uniform(0, 2.0f));
                const glm::ivec2 landing = p - kStratum * s;
                // Somewhere else: the source of each stratum is in the one opposite to it.
                const glm::ivec2 source = size - 1 - p;
                previousRaw(source).a = then;
                samples(s) = {dice.bits(), std::uint32_t(1 + landing.x + kStratum * landing.y),
                              std::uint32_t(source.x) | std::uint32_t(source.y) << 16, 0};
            }
            if (dice.chance(0.7f)) {
                const float b = dice.uniform(0.0f, 2.0f), a = dice.uniform(0.0f, 2.0f);
                gradient(s).x = b - a;
                gradient(s).y = std::max(b, a);
            }
            gradient(s).z = dice.uniform(0.2f, 2.0f);
            gradient(s).w = dice.chance(0.2f) ? 0.0f : dice.uniform(0.0f, 0.5f);
            strataGuides(s) = guides(p);
            strataSlope(s) = slope(p);
        }
    addChangeOfLight(seed);
}

void RandomFrame::addChangeOfLight(std::uint32_t seed) {
    Dice dice(seed ^ 0x5bd1e995u); // of its own: the other images stay what they are
    for (int y = 0; y < strata.y; ++y)
        for (int x = 0; x < strata.x; ++x) {
            const glm::ivec2 s{x, y};
            change(s) = randomChange(dice, lambda(s));
            if (strataGuides(s).w == 0.0f) {
                before(s) = glm::vec4(50.0f, 70.0f, 60.0f, 1.0f);
                now(s) = glm::vec4(70.0f, 50.0f, 60.0f, 60.0f);
                products(s) = glm::vec4(12e3f, 11e3f, 13e3f, 3.0f);
                if (x % 2 == 0) // light without a sample
                    before(s) = glm::vec4(0.0f);
                continue;
            }
            const LightPair pair = randomLightPair(dice);
            before(s) = pair.before;
            now(s) = glm::vec4(pair.now, gradient(s).z);
            products(s) = glm::vec4(pair.products, gradient(s).w);
            if (samples(s).y == 0)
                continue;
            const int landing = int(samples(s).y) - 1;
            const glm::ivec2 p = kStratum * s + glm::ivec2(landing % kStratum, landing / kStratum);
            const glm::ivec2 source(int(samples(s).z & 0xffffu), int(samples(s).z >> 16));
            glm::vec4& previous = previousRaw(source);
            const bool isSame = previous.a == raw(p).a && (raw(p).a > 0.0f || dice.chance(0.4f));
            previous = glm::vec4(changedLight(dice, raw(p), isSame), previous.a);
        }
}

} // namespace afterglow
