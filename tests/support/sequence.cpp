// SPDX-License-Identifier: MIT
#include "tests/support/sequence.h"

#include "tests/support/gl_fixture.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow::test {

Sequence::Sequence(Scene scene, glm::ivec2 size, Settings initial)
    : settings(initial), lights(scene.lights.size()), camera(cameraAt(scene, poseAt(scene, 0.0))),
      renderer_(testShaders(), glInfo(testContext())) {
    renderer_.setScene(std::move(scene));
    renderer_.resize(size);
}

FrameInput Sequence::input() const {
    return {.camera = camera,
            .seconds = secondsPerFrame * double(frame_),
            .frame = frame_,
            .seed = seed,
            .lights = lights};
}

std::uint32_t Sequence::next() {
    renderer_.render(input(), settings);
    return frame_++;
}

void Sequence::run(int frames) {
    for (int i = 0; i < frames; ++i)
        next();
}

LightState& Sequence::light(std::string_view name) {
    const auto& all = renderer_.scene().lights;
    const auto found = std::ranges::find(all, name, &Light::name);
    if (found == all.end())
        throw std::logic_error("no light named " + std::string(name));
    return lights[std::size_t(found - all.begin())];
}

void Sequence::allLightsOffBut(std::string_view name) {
    for (LightState& state : lights)
        state.on = false;
    light(name).on = true;
}

Image<glm::vec4> Sequence::reference(int samples) {
    FrameInput moment = input();
    moment.seconds = secondsPerFrame * double(frame_ == 0 ? 0 : frame_ - 1);
    renderer_.beginReference(moment, settings);
    renderer_.addReferenceSamples(samples);
    renderer_.finishReference();
    return signal();
}

Settings settingsOf(Filter filter, Signal signal) {
    Settings settings = defaultSettings(filter);
    settings.lighting.signal = int(signal);
    return settings;
}

} // namespace afterglow::test
