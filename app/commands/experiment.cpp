#include "app/commands/experiment.h"

#include "app/experiment/runner.h"

#include <cstdio>

namespace afterglow {

void runExperimentCommand(const ExperimentOptions& options, HiddenContextFactory hiddenContext) {
    Experiment experiment = loadExperiment(options.experiment);
    if (options.size)
        experiment.size = *options.size;
    if (options.samples)
        experiment.referenceSamples = *options.samples;
    if (options.frames) {
        std::vector<LightEvent> events = experiment.timeline.events();
        std::erase_if(events,
                      [&](const LightEvent& event) { return event.frame >= *options.frames; });
        experiment.timeline = Timeline(*options.frames, std::move(events));
    }
    const OutputFolder folder(options.out);
    Headless headless(options.context, hiddenContext);
    headless.resize(experiment.size);
    const ExperimentResult result =
        runExperiment(experiment, headless.renderer, headless.gl, folder);

    std::printf("%s: %s\n%s, %dx%d, %d frames, on %s\n\n%s\n", experiment.name.c_str(),
                experiment.description.c_str(), headless.renderer.scene().name.c_str(),
                experiment.size.x, experiment.size.y, experiment.frames(),
                headless.gl.renderer.c_str(), tableOf(result).c_str());
    double residual = 0.0;
    for (const ReferenceResult& reference : result.references)
        residual = std::max(residual, reference.residual);
    std::printf("references: %d samples a pixel, residual RMSE at most %.5f\ncontact sheet: %s\n",
                experiment.referenceSamples, residual, result.contactSheet.c_str());
}

} // namespace afterglow
