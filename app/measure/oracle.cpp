// SPDX-License-Identifier: MIT
#include "app/measure/oracle.h"

#include "renderer/resources/render_targets.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afterglow {
namespace {

void requireSizes(bool equal) {
    if (!equal)
        throw std::logic_error("the images of an oracle must have one size");
}

/// Over the pixels of a stratum that count.
struct StratumSums {
    double change = 0.0, greater = 0.0; ///< now - before, and the greater of the two
    int pixels = 0;
};

constexpr double kRight = 1e-4; ///< a history is right if it is off by less than this part of it

} // namespace

StrataTruth idealLambda(const Image<float>& now, const Image<float>& before, const Mask& counts,
                        float floor) {
    requireSizes(now.size() == before.size() && now.size() == counts.size());
    Image<StratumSums> strata(strataOf(now.size()));
    for (int y = 0; y < now.size().y; ++y)
        for (int x = 0; x < now.size().x; ++x) {
            const glm::ivec2 p{x, y};
            if (counts(p) == 0)
                continue;
            StratumSums& sums = strata(p / 3);
            sums.change += double(now(p)) - double(before(p));
            sums.greater += std::max(now(p), before(p));
            ++sums.pixels;
        }
    StrataTruth truth{Image<float>(strata.size()), Mask(strata.size())};
    for (std::size_t i = 0; i < strata.pixels().size(); ++i) {
        const StratumSums& sums = strata.pixels()[i];
        if (sums.greater > double(floor) * sums.pixels) {
            truth.lit.pixels()[i] = 1;
            truth.lambda.pixels()[i] = float(std::min(1.0, std::abs(sums.change) / sums.greater));
        }
    }
    return truth;
}

Image<float> idealAlpha(const Image<float>& history, const Image<float>& truth,
                        const Image<float>& variance, const Mask& hasHistory) {
    requireSizes(history.size() == truth.size() && history.size() == variance.size() &&
                 history.size() == hasHistory.size());
    Image<float> alpha(history.size(), 1.0f);
    for (std::size_t i = 0; i < alpha.pixels().size(); ++i) {
        if (hasHistory.pixels()[i] == 0)
            continue;
        const double error = double(history.pixels()[i]) - double(truth.pixels()[i]);
        const double e2 = error * error, s2 = std::max(0.0f, variance.pixels()[i]);
        // Without noise the last bits of an average would decide between 0 and 1.
        const double rounding = kRight * std::max(history.pixels()[i], truth.pixels()[i]);
        alpha.pixels()[i] = std::abs(error) > rounding ? float(e2 / (e2 + s2)) : 0.0f;
    }
    return alpha;
}

Agreement compareWeights(const Image<float>& weight, const Image<float>& ideal,
                         const Mask& counts) {
    requireSizes(weight.size() == ideal.size() && weight.size() == counts.size());
    Agreement result;
    double squares = 0.0, n = 0.0;
    for (std::size_t i = 0; i < weight.pixels().size(); ++i) {
        if (counts.pixels()[i] == 0)
            continue;
        const double w = weight.pixels()[i], best = ideal.pixels()[i];
        result.mean += w;
        result.idealMean += best;
        squares += (w - best) * (w - best);
        n += 1.0;
    }
    if (n == 0.0)
        return {};
    result.mean /= n;
    result.idealMean /= n;
    result.bias = result.mean - result.idealMean;
    result.rmse = std::sqrt(squares / n);
    return result;
}

Detection detect(const Image<float>& lambda, const Image<float>& ideal, const Mask& counts) {
    requireSizes(lambda.size() == ideal.size() && lambda.size() == counts.size());
    double taken = 0.0, changed = 0.0, found = 0.0, still = 0.0, stillSum = 0.0;
    for (std::size_t i = 0; i < lambda.pixels().size(); ++i) {
        if (counts.pixels()[i] == 0)
            continue;
        const bool isTaken = lambda.pixels()[i] >= kChanged, is = ideal.pixels()[i] >= kChanged;
        taken += isTaken;
        changed += is;
        found += isTaken && is;
        if (ideal.pixels()[i] == 0.0f) {
            still += 1.0;
            stillSum += lambda.pixels()[i];
        }
    }
    const auto share = [](double part, double whole) {
        return whole > 0.0 ? std::optional(part / whole) : std::nullopt;
    };
    return {share(found, taken), share(found, changed), share(stillSum, still)};
}

} // namespace afterglow
