// SPDX-License-Identifier: MIT
// Timeline::staged: motions of a timeline as tracks of the scene.

#include "app/scenario/timeline.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <algorithm>

#include <glm/gtx/matrix_decompose.hpp>

namespace afterglow {
namespace {

/// Writes the tracks of one scene. A node's tracks are made when it first moves.
class Stage {
public:
    Stage(Scene& scene, double rate, std::string_view owner)
        : scene_(scene), rate_(rate), owner_(owner), own_(scene.tracks.size()) {}

    void move(std::uint32_t node, int frame, int until, glm::vec3 translation) {
        key(node, Track::Path::Translation, frame, until, {translation, 0.0f});
    }
    void turn(std::uint32_t node, int frame, int until, glm::quat rotation) {
        key(node, Track::Path::Rotation, frame, until,
            {rotation.x, rotation.y, rotation.z, rotation.w});
    }
    /// Returns how the node is turned after all motions so far.
    glm::quat rotationOf(std::uint32_t node) {
        const glm::vec4 q = trackOf(node, Track::Path::Rotation).values.back();
        return {q.w, q.x, q.y, q.z};
    }
    /// Returns the place of the node after all motions so far.
    glm::vec3 translationOf(std::uint32_t node) {
        return glm::vec3(trackOf(node, Track::Path::Translation).values.back());
    }

private:
    // A node with a matrix is not animated: here it gets the parts of its matrix instead.
    void takeApart(Node& node) {
        if (!node.matrix)
            return;
        glm::vec3 skew;
        glm::vec4 perspective;
        glm::decompose(*node.matrix, node.scale, node.rotation, node.translation, skew,
                       perspective);
        node.matrix.reset();
    }

    Track& trackOf(std::uint32_t node, Track::Path path) {
        const auto found = std::ranges::find_if(
            scene_.tracks, [&](const Track& t) { return t.node == node && t.path == path; });
        Node& target = scene_.nodes[node];
        if (std::size_t(found - scene_.tracks.begin()) < own_)
            throw InputError(std::string(owner_) + ": timeline: '" + target.name +
                             "' is animated by the scene itself; it cannot be moved as well");
        if (found != scene_.tracks.end())
            return *found;
        takeApart(target);
        const glm::quat& q = target.rotation;
        scene_.tracks.push_back(
            {.node = node,
             .path = path,
             .interpolation = Track::Interpolation::Linear,
             .times = {0.0},
             .values = {path == Track::Path::Rotation ? glm::vec4(q.x, q.y, q.z, q.w)
                                                      : glm::vec4(target.translation, 0.0f)}});
        return scene_.tracks.back();
    }

    void key(std::uint32_t node, Track::Path path, int frame, int until, glm::vec4 value) {
        Track& track = trackOf(node, path);
        if (frame == 0 && until == 1) { // how the scene is set up
            track.values.back() = value;
            return;
        }
        const double start = std::max(0, frame - 1) / rate_, end = (until - 1) / rate_;
        if (start > track.times.back()) {
            track.times.push_back(start);
            track.values.push_back(track.values.back());
        }
        track.times.push_back(end);
        track.values.push_back(value);
    }

    Scene& scene_;
    double rate_;
    std::string_view owner_;
    std::size_t own_; ///< tracks that the scene came with
};

template <class Items, class NameOf>
std::size_t indexOf(const Items& items, std::string_view name, const std::string& kind,
                    std::string_view owner, NameOf nameOf) {
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (nameOf(items[i]) == name)
            return i;
        known.push_back(nameOf(items[i]));
    }
    throw InputError(std::string(owner) + ": timeline: " + unknownName(kind, name, known));
}

} // namespace

Scene Timeline::staged(Scene scene, double rate, bool animated, std::string_view owner) const {
    if (!animated)
        scene.tracks.clear();
    const auto nameOf = [](const auto& item) -> std::string_view { return item.name; };
    const auto of = " of the scene " + scene.name;
    Stage stage(scene, rate, owner);
    for (const TimelineEvent& event : events_) {
        if (const auto* light = std::get_if<LightEvent>(&event)) {
            if (light->light != "*")
                indexOf(scene.lights, light->light, "light" + of, owner, nameOf);
        } else if (const auto* motion = std::get_if<NodeMotion>(&event)) {
            const auto node =
                std::uint32_t(indexOf(scene.nodes, motion->node, "node" + of, owner, nameOf));
            const auto turned = glm::angleAxis(glm::radians(motion->turn), glm::vec3(0, 1, 0));
            if (motion->by != glm::vec3(0.0f) || motion->turn == 0.0f)
                stage.move(node, motion->frame, motion->until,
                           stage.translationOf(node) + motion->by);
            if (motion->turn != 0.0f)
                stage.turn(node, motion->frame, motion->until, stage.rotationOf(node) * turned);
        } else {
            const auto& move = std::get<CameraMove>(event);
            const std::uint32_t node = scene.cameras.at(0).node;
            if (scene.nodes[node].parent >= 0)
                throw InputError(std::string(owner) + ": timeline: the camera of the scene " +
                                 scene.name + " hangs on another node and cannot be moved");
            const Camera view = lookAt(move.eye, move.target);
            stage.move(node, move.frame, move.until, view.position);
            stage.turn(node, move.frame, move.until, view.orientation);
        }
    }
    return scene;
}

} // namespace afterglow
