// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// Parameter blocks of the denoising passes. Meaning, range, unit and source of each value that a
// user can set stand in renderer/pipeline/settings.cpp.

// Widths of the edge-stopping functions. Schied et al. 2017, section 4.4, equations 3 to 5.
struct EdgeStopping {
    float sigmaLuminance; // in standard deviations of the local luminance
    float sigmaNormal;    // exponent of the cosine between normals
    float sigmaDepth;     // in multiples of the depth change that the local slope predicts
    int step;             // distance between taps in pixels (or strata): 1, 2, 4, ...
};

// Fetches of lambda, known per stratum, at a pixel.
const int kLambdaNearest = 0;
const int kLambdaBilinear = 1;
const int kLambdaMax = 2;   // the largest of the 3x3 strata around
const int kLambdaLight = 3; // the mean of the 3x3 strata around, weighted by their light

// Laws by which the history length follows alpha.
const int kHistoryEffective = 0; // 1/N' = (1 - a)^2 / N + a^2: the effective sample count, exact
const int kHistoryFrames = 1;    // N' = N + 1: lambda is ignored, as in Q2VKPT
const int kHistoryPower = 2;     // N (1 - lambda)^10 before the blend, N' = N + 1; as in Q2RTX

// Where the lambda of a pixel comes from.
const int kLambdaFromNothing = 0;  // 0 everywhere
const int kLambdaFromGradient = 1; // of the strata, fetched as lambdaFetch says
const int kLambdaFromRange = 2;    // how far the history is outside the raw luminance around

// Uses of lambda.
const int kLambdaBlends = 0; // alpha' = (1 - lambda) alpha + lambda; Schied et al. 2018
const int kLambdaCuts = 1;   // the history length is cut, and alpha follows from it; as in NRD
const int kLambdaCounts = 2; // a change takes samples from the history; filter `counted`

struct TemporalParams {
    float alpha;           // weight of the newest frame where nothing changed
    float alphaMoments;    // the same for the moments
    float maxHistory;      // frames
    float depthTolerance;  // in multiples of the depth change that the local slope predicts
    float normalTolerance; // least cosine between a surface's normals in two frames
    int lambdaFetch;
    int historyLaw;
    int lambdaSource;
    int lambdaUse;
    float percentileSlope; // of lambda over the distance from the range, in widths of the range
    float clampSigmas;     // standard deviations of the raw signal that a history may be off
    int clampRadius;       // pixels around, in which they are measured; negative: no clamp
    // With kLambdaCounts:
    float reactivity;           // pixels that the spatial filter averages afterwards
    float historyDuringChange;  // samples; the most that a history counts for then
    float historyBetweenPixels; // samples; likewise, where it is interpolated
    int countReusedOnce;        // 1: a reused sample that is in the history adds nothing
};

struct PercentileParams {
    float lowPercentile; // both in [0, 1]
    float highPercentile;
    float unused0, unused1;
};

// Values of a gradient sample: with its sign, or its size.
const int kGradientSigned = 0;
const int kGradientAbsolute = 1;

// Steps of the iterations that reconstruct the gradient.
const int kStridesDouble = 0; // 1, 2, 4, ...: a-trous; Schied et al. 2018
const int kStridesLinear = 1; // 1, 2, 3, ...: as in NRD

struct GradientParams {
    float deltaFloor;  // where the filtered Delta is below it, lambda is 0; radiance
    float forceLambda; // in [0, 1]: this lambda everywhere; negative: measured
    int magnitude;
    float unused0;
};

// Quantities whose relative change is lambda.
const int kChangeOfLuminance = 0;
const int kChangeOfChannels = 1; // the largest of the channels' changes

struct ChangeParams {
    float deltaFloor;  // as in GradientParams
    float forceLambda; // as in GradientParams
    int over;
    int scaleHistory; // 1: a history is scaled where one factor explains the change
    float scaleDoubt; // kappa: how much what the factor does not explain speaks against it
    float unused0, unused1, unused2;
};

struct VarianceParams {
    float sigmaNormal; // of the spatial estimate
    float sigmaDepth;
    float minHistory;        // frames; below it the variance is estimated in space
    float varianceExponent;  // p: the variance is that of one sample times N^-p
    float shortHistoryBoost; // b: times 1 + b / N^2
    float unused0, unused1, unused2;
};

// Constants of the search for a history. The rest of it can be set.
const float kLeastWeight = 0.01;   // of the valid taps together
const float kDepthEpsilon = 0.005; // of the depth, added to the tolerance
const float kBetweenPixels = 1e-3; // least distance from a pixel of what is between pixels

// Why a pixel has no history, in the fourth channel of the control image.
const int kHistoryKept = 0;
const int kHistoryNone = 1;      // there is no previous frame
const int kHistoryOffScreen = 2; // the surface was outside the picture
const int kHistoryInstance = 3;  // another instance was seen there
const int kHistoryDepth = 4;
const int kHistoryNormal = 5;

// Fates of the surface sample that a stratum of the frame before offered as a gradient
// sample.
const uint kFateNone = 0u;       // there was no frame before, or no samples are carried
const uint kFateCarried = 1u;    // it is the sample of the stratum where it landed
const uint kFateBackground = 2u; // there was no surface
const uint kFateWasSample = 3u;  // it was a gradient sample itself
const uint kFateOffScreen = 4u;
const uint kFateInstance = 5u; // another instance is seen where it landed
const uint kFateDepth = 6u;    // the same instance is seen there, at another depth
const uint kFateLostRace = 7u; // another sample has that stratum
const uint kFateCount = 8u;

SHARED_END
