#pragma once

#include "app/experiment/experiment.h"
#include "app/experiment/output.h"
#include "app/experiment/response.h"

namespace afterglow {

/// What one event did to one variant.
struct EventResult {
    int frame = 0;
    ResponseSummary response{};
    double noiseAfter = 0.0; ///< mean over the kNoiseFrames frames from the event on
    std::optional<int>
        noiseSettles{}; ///< frames until the noise is within 10 % of its settled value
};
constexpr int kNoiseFrames = 16;

/// One variant over the whole timeline. Errors are of the linear luminance of `color`, that is of
/// the filtered signal times albedo plus emission, before tone mapping, over the pixels that show a
/// surface.
struct VariantResult {
    std::string name;
    std::vector<double> rmse{}, relMse{};          ///< one a frame, against the frame's reference
    std::vector<std::optional<double>> response{}; ///< one a frame; none before the first event
    std::vector<EventResult> events{};             ///< those that change the picture
    double rmseSettled = 0.0;                      ///< mean over the settled window
    double flicker = 0.0;                          ///< over the settled window
    FrameClock clock{};
};

/// The converged picture of the frames [first, end).
struct ReferenceResult {
    int first = 0, end = 0;
    double residual = 0.0; ///< the RMSE that it still has itself; see Convergence
    double milliseconds = 0.0;
};

struct ExperimentResult {
    std::vector<ReferenceResult> references;
    int settledFirst = 0, settledEnd = 0; ///< the settled window
    std::vector<VariantResult> variants;
    std::filesystem::path contactSheet;
};

/// Runs every variant over the timeline, from frame 0 and with the same seed. Writes
/// DIR/<variant>/frame_0000.png, DIR/reference/frame_0000.png, contact_sheet.png, metrics.csv,
/// experiment.json and, last, summary.json. The renderer's scene and size are set by this.
///
/// The settled window is the last Experiment::settledWindow frames of the first stretch in which
/// there is light and nothing changes.
ExperimentResult runExperiment(const Experiment& experiment, Renderer& renderer, const GlInfo& gl,
                               const OutputFolder& folder);

/// summary.json. Numbers that were never reached are null. Where the picture changes more than
/// once, the numbers of a variant are those of the first event, and "events" lists all.
nlohmann::ordered_json summaryOf(const Experiment& experiment, const ExperimentResult& result);

/// The same as lines to be read.
std::string tableOf(const ExperimentResult& result);

} // namespace afterglow
