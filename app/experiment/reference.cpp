#include "app/experiment/reference.h"

#include "renderer/image/color.h"
#include "renderer/image/metrics.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace afterglow {

Mask foregroundOf(const Renderer& renderer) {
    const auto guides = renderer.targets().guides.current().read<glm::vec4>();
    Mask mask(guides.size());
    for (std::size_t i = 0; i < guides.pixels().size(); ++i)
        mask.pixels()[i] = guides.pixels()[i].w > 0.0f;
    return mask;
}

Image<float> litLuminance(const Renderer& renderer) {
    const auto signal = renderer.filteredSignal().read<glm::vec4>();
    const auto albedo = renderer.targets().albedo.read<glm::vec4>();
    Image<float> lit(signal.size());
    for (std::size_t i = 0; i < lit.pixels().size(); ++i)
        lit.pixels()[i] = luminance(glm::vec3(signal.pixels()[i]) * glm::vec3(albedo.pixels()[i]));
    return lit;
}

Convergence converge(Renderer& renderer, const FrameInput& input, const Settings& settings,
                     int samples, const std::function<void(int)>& advanced) {
    using Clock = std::chrono::steady_clock;
    constexpr int kPortion = 8; // small enough that progress moves, and counters do not overflow
    Convergence result;
    const auto start = Clock::now();
    std::uint32_t counted = 0;
    int done = 0;
    renderer.beginReference(input, settings);
    const auto addUpTo = [&](int target) {
        while (done < target) {
            const int portion = std::min(kPortion, target - done);
            renderer.addReferenceSamples(portion);
            done += portion;
            // The device counts in 32 bits over the whole image.
            const auto now = std::uint32_t(renderer.readStats().rays);
            result.rays += std::uint32_t(now - counted);
            counted = now;
            if (advanced)
                advanced(portion);
        }
    };

    Image<float> half;
    if (samples > 1) {
        addUpTo(samples / 2);
        renderer.finishReference();
        half = litLuminance(renderer);
    }
    addUpTo(samples);
    result.display = &renderer.finishReference();
    glFinish();
    result.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    result.lit = litLuminance(renderer);

    // With n samples of which m are in the first half, mean(n) - mean(m) = (1 - m/n) (mean of the
    // rest - mean(m)), whose variance is s^2 (1/m - 1/n); that of mean(n) is s^2 / n.
    const Mask foreground = foregroundOf(renderer);
    if (samples > 1 && countOf(foreground) > 0) {
        const double n = samples, m = samples / 2;
        result.residual = rmse(half, result.lit, &foreground) / std::sqrt(n / m - 1.0);
    }
    return result;
}

} // namespace afterglow
