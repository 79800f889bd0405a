// SPDX-License-Identifier: MIT
#include "app/experiment/export_frames.h"

#include "app/base/machine.h"
#include "app/experiment/run_files.h"
#include "app/measure/truth.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kAccount = "export.json";
constexpr std::array kAovs{"raw", "albedo", "emission", "normal", "depth", "motion"};
constexpr std::string_view kPreviousDepth = "previous_depth";

Json rowsOf(const glm::mat4& m) {
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row)
        rows.push_back(
            {shortest(m[0][row]), shortest(m[1][row]), shortest(m[2][row]), shortest(m[3][row])});
    return rows;
}

Json describe(const Camera& camera, float aspect) {
    const glm::vec3& p = camera.position;
    const glm::quat& q = camera.orientation;
    return {{"position", {shortest(p.x), shortest(p.y), shortest(p.z)}},
            {"orientation", {shortest(q.w), shortest(q.x), shortest(q.y), shortest(q.z)}},
            {"vertical_fov", shortest(camera.lens.verticalFov)},
            {"near", shortest(camera.lens.near)},
            {"far", std::isinf(camera.lens.far) ? Json(nullptr) : Json(shortest(camera.lens.far))},
            {"view_from_world", rowsOf(camera.viewFromWorld())},
            {"clip_from_view", rowsOf(camera.clipFromView(aspect))}};
}

Json describe(const AovInfo& aov) {
    return {{"channels", aov.channels}, {"meaning", aov.meaning}};
}

Json conventions() {
    return {
        {"pixels", "row 0 is the top; the center of pixel (x, y), counted from 0, is at "
                   "(x + 0.5, y + 0.5)"},
        {"signal", "raw is one frame's noise, linear, without albedo: "
                   "lit = raw * albedo, color = lit + emission, per channel; of several signals "
                   "(raw_shadows, raw_ao) lit is the sum"},
        {"background", "depth 0: there is no surface, and nothing is measured"},
        {"depth", "distance along the view axis, meters"},
        {"motion", "in the frame before, what (x + 0.5, y + 0.5) shows was at "
                   "(x + 0.5, y + 0.5) + motion: pixels, x to the right, y down"},
        {"previous_depth", "the depth which that surface had in the frame before, from where the "
                           "camera was then; 0: none, it was not before the camera"},
        {"world", "right-handed, meters"},
        {"view", "the camera looks along -z, x to the right, y up"},
        {"orientation", "quaternion [w, x, y, z] that turns view space into world space"},
        {"matrices", "lists of rows, for column vectors: view = view_from_world * (x, y, z, 1)"},
        {"clip", "x to the right, y up; depth is 1 at the near plane and 0 at the far plane or at "
                 "infinity; pixel = ((0.5 + 0.5 x / w) width, (0.5 - 0.5 y / w) height)"},
        {"vertical_fov", "radians"},
        {"pfm", "three channels, or one; two are given a third of zeros. Rows go from the bottom "
                "to the top, as that format has them"},
        {"tonemap", "display = srgb(clamp(x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), 0, 1)) "
                    "with x = color, per channel"}};
}

/// The third channel of the motion texture, 0 where the fourth says that there was nothing to see.
Image<glm::vec4> previousDepth(const Renderer& renderer) {
    auto image = renderer.targets().surfaces.motion.read<glm::vec4>();
    for (glm::vec4& pixel : image.pixels())
        pixel = glm::vec4(pixel.w > 0.0f ? pixel.z : 0.0f, 0.0f, 0.0f, 0.0f);
    return image;
}

} // namespace

void exportFrames(const Experiment& experiment, const StagedRun& run, Renderer& renderer,
                  const GlInfo& gl, const std::vector<const AovInfo*>& more,
                  const std::string& format, const OutputFolder& folder, Progress& progress) {
    std::vector<const AovInfo*> aovs;
    for (const char* name : kAovs)
        aovs.push_back(&aovByName(name));
    for (const AovInfo* aov : more)
        if (std::ranges::find(aovs, aov) == aovs.end())
            aovs.push_back(aov);
    fs::remove(folder.path() / kAccount); // it says that all others are there

    const Settings settings = settingsOf(variantOf(Filter::None), experiment.signal);
    const float aspect = float(experiment.size.x) / float(experiment.size.y);
    Json frames = Json::array();
    renderer.setScene(run.scene);
    renderer.resize(experiment.size);
    for (int frame = 0; frame < experiment.frames(); ++frame) {
        const FrameInput input = inputAt(experiment, run.plan, frame);
        renderer.render(input, settings);
        for (const AovInfo* aov : aovs)
            writeAov(folder, format, renderer, *aov, frame);
        folder.writeFloat(frameStem(kPreviousDepth, frame), format, previousDepth(renderer), "Y");
        frames.push_back({{"frame", frame},
                          {"seconds", input.seconds},
                          {"camera", describe(input.camera, aspect)}});
        progress.advance(1.0, "frame " + std::to_string(frame + 1) + " of " +
                                  std::to_string(experiment.frames()));
    }

    Json files = Json::object();
    const auto signals = renderer.signals();
    for (const AovInfo* aov : aovs)
        for (std::size_t i = 0; i < (aov->perSignal ? signals.size() : 1); ++i)
            files[fileStem(*aov, signals[i], signals.size())] = describe(*aov);
    files[std::string(kPreviousDepth)] = {
        {"channels", "Y"}, {"meaning", "depth of the surface a frame ago, meters; 0 is none"}};
    folder.writeJson(kAccount, {{"program", "afterglow"},
                                {"version", version()},
                                {"commit", commit()},
                                {"command", "render --export"},
                                {"gl", describe(gl)},
                                {"experiment", parseJson(toJson(experiment))},
                                {"conventions", conventions()},
                                {"format", format},
                                {"files", files},
                                {"frames", frames}});
}

Experiment readExport(const fs::path& folder) {
    const fs::path file = folder / kAccount;
    const JsonDocument document(readFile(file), file.string());
    const auto experiment = document.root().find("experiment");
    if (!experiment)
        throw InputError(file.string() + ": \"experiment\" is missing; afterglow render --export "
                                         "makes such a file");
    return readExperiment(*experiment);
}

} // namespace afterglow
