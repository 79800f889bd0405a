// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/json_reader.h"
#include "app/scenario/timeline.h"
#include "app/scenario/variant.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// A measurement, described completely: run twice, it gives the same bytes on the same machine.
/// Time is frame / rate. In a file, "name", "scene", "frames" and "variants" are required; what
/// else is left out has the value given here.
struct Experiment {
    std::string name;        ///< letters, digits, "-", "_" and ".": names the folder of its results
    std::string description; ///< one line
    std::string scene;       ///< the name of a scene made in code, or the path of a file
    glm::ivec2 size{320, 320}; ///< pixels, each in [1, 16384]
    double rate = 60.0;        ///< frames per second, in (0, 1000]
    std::uint32_t seed = 1;
    Signal signal = Signal::Both;
    bool animated = false;         ///< whether the scene's own tracks play
    std::vector<Variant> variants; ///< to be compared: at least one, names unique
    Timeline timeline;             ///< knows the number of frames, in [1, 100000]
    int referenceSamples = 1024;   ///< per pixel of a reference, in [1, 1048576]
    int settledWindow =
        16; ///< the last frames of a stretch, over which settled values are averaged

    int frames() const { return timeline.frames(); }
    double seconds(int frame) const { return frame / rate; }
};

/// Reads an experiment from the text of its file. `source` is the file's name: every InputError
/// begins with it and names the place inside:
///
///     light-off.json: timeline[0].frame: expected a whole number >= 0, found "x"
///
/// A scene that is a path (it holds a "/" or ends in .gltf or .glb) is relative to the file's
/// folder.
Experiment parseExperiment(std::string_view text, std::string_view source);
/// Returns the experiment that is a part of another file, such as experiment.json of a run.
Experiment readExperiment(const JsonReader& json);

/// Returns the text of a file that says the same, with everything spelled out.
std::string toJson(const Experiment& experiment);

struct ExperimentInfo {
    std::string name, description;
};

/// Returns the experiments that come with the program, in alphabetical order.
std::vector<ExperimentInfo> builtInExperiments();

/// Reads a built-in experiment by its name, or a file: what holds a "/" or ends in .json is always
/// a file. An unknown name is a UsageError that suggests the nearest known one; a file that cannot
/// be read, or is not an experiment, is an InputError.
Experiment loadExperiment(std::string_view nameOrPath);

/// Returns the timeline without the events from that frame on. What moves by then goes on moving.
Timeline shortened(const Timeline& timeline, int frames);

} // namespace afterglow
