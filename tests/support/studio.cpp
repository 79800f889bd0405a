// SPDX-License-Identifier: MIT
#include "tests/support/studio.h"

#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <utility>

namespace afterglow::test {

Studio::Studio(Scene scene, glm::ivec2 size, Signal signal)
    : settings(settingsOf(Filter::None, signal)), allOn(scene.lights.size()),
      camera(cameraAt(scene, poseAt(scene, 0.0))), renderer(testShaders(), glInfo(testContext())) {
    renderer.setScene(std::move(scene));
    renderer.resize(size);
}

FrameInput Studio::at(double seconds, const std::vector<LightState>& lights) const {
    return {.camera = camera, .seconds = seconds, .frame = 0, .seed = 5, .lights = lights};
}

Image<glm::vec4> Studio::reference(const FrameInput& seen, const FrameInput& world, int samples) {
    renderer.beginReference(seen, world, settings);
    renderer.addReferenceSamples(samples);
    renderer.finishReference();
    return renderer.filteredSignal().read<glm::vec4>();
}

} // namespace afterglow::test
