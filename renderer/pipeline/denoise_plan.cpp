#include "renderer/pipeline/denoise_plan.h"

#include <algorithm>

namespace afterglow {

DenoisePlan makePlan(Filter filter, const DenoiserSettings& settings) {
    const bool accumulate = filter != Filter::None;
    const bool spatial = filter == Filter::Svgf || filter == Filter::Asvgf;
    const bool adaptive = filter == Filter::Asvgf;
    const int atrous = spatial ? settings.atrousIterations : 0;
    return {.accumulate = accumulate,
            .carrySamples = adaptive || settings.alwaysCarrySamples != 0,
            .useLambda = adaptive,
            .gradientIterations = adaptive ? settings.gradientIterations : 0,
            .atrousIterations = atrous,
            .feedbackIteration = std::min(settings.feedbackIteration, atrous)};
}

} // namespace afterglow
