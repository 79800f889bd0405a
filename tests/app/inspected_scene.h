// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/inspection.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow::test {

inline constexpr glm::ivec2 kInspectedSize{61, 37};

/// Reads the facts of a pixel of the last frame, and waits for them.
inline PixelFacts pixelFacts(Renderer& renderer, std::size_t state, glm::ivec2 pixel,
                             std::size_t signal = 0, ShaderLibrary& shaders = testShaders()) {
    PixelQuery query(shaders);
    PixelReadback readback;
    query.ask(renderer, state, pixel, signal, readback);
    readback.finish();
    return query.answer(readback);
}

inline Inspection inspect(Renderer& renderer, std::size_t state, glm::ivec2 pixel,
                          std::size_t signal = 0) {
    return inspectionOf(pixelFacts(renderer, state, pixel, signal), renderer.scene(), state,
                        signal);
}

inline const InspectedValue* find(const Inspection& inspection, std::string_view group,
                                  std::string_view name) {
    for (const InspectedGroup& g : inspection.groups)
        if (g.title == group)
            for (const InspectedValue& value : g.values)
                if (value.name == name)
                    return &value;
    return nullptr;
}

inline bool hasGroup(const Inspection& inspection, std::string_view title) {
    return std::ranges::any_of(inspection.groups,
                               [&](const InspectedGroup& g) { return g.title == title; });
}

inline bool tells(const Inspection& inspection, std::string_view words) {
    return std::ranges::any_of(inspection.story, [&](const std::string& sentence) {
        return sentence.find(words) != std::string::npos;
    });
}

inline std::string storyText(const Inspection& inspection) {
    std::string text;
    for (const std::string& sentence : inspection.story)
        text += sentence + "\n";
    return text;
}

inline Settings withSamples(Filter filter, SamplePlacement placement) {
    Settings settings = settingsOf(filter);
    settings.lighting.gradientSamples = int(placement);
    return settings;
}

/// Frames of a scene in which all moves: its bodies, the camera, and the light goes out.
struct InspectedScene {
    explicit InspectedScene(std::string_view scene, glm::ivec2 size = kInspectedSize,
                            ShaderLibrary& shaders = testShaders())
        : renderer(shaders, glInfo(testContext())) {
        renderer.setScene(makeProceduralScene(scene));
        renderer.resize(size);
        camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
        lights.resize(renderer.scene().lights.size());
    }
    /// With the camera moved to its right by so many meters.
    void render(std::span<const FilterRun> runs, float right = 0.0f) {
        camera.position += camera.orientation * glm::vec3(right, 0.0f, 0.0f);
        renderer.render({.camera = camera,
                         .seconds = double(frame) * secondsPerFrame,
                         .frame = frame,
                         .seed = 3,
                         .lights = lights},
                        frameSettings, runs);
        ++frame;
    }
    void render(const Settings& settings, float right = 0.0f) {
        frameSettings = settings;
        const FilterRun run{0, settings};
        render({&run, 1}, right);
    }

    FrameSettings frameSettings;
    Renderer renderer;
    Camera camera;
    std::vector<LightState> lights;
    double secondsPerFrame = 1.0 / 15.0;
    std::uint32_t frame = 0;
};

/// Every so many pixels in x and in y.
inline std::vector<glm::ivec2> pixelsOf(glm::ivec2 size, int stride) {
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < size.y; y += stride)
        for (int x = 0; x < size.x; x += stride)
            pixels.emplace_back(x, y);
    return pixels;
}

} // namespace afterglow::test
