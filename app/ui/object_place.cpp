#include "app/ui/object_place.h"

#include "app/ui/edit.h"
#include "core/problem.h"
#include "scene/keyframes.h"
#include "scene/loaded_space.h"
#include "scene/scene_formats.h"

#include <algorithm>
#include <cmath>

namespace bounce {

namespace {

const Node& node_of_object(const Shot& shot, size_t object) {
    return shot.scene.nodes[size_t(shot.object_nodes[object])];
}

std::string plain_name(const Node& node) {
    return scene_format_of(node.name) ? std::filesystem::path(node.name).stem().string() : node.name;
}

bool is_usable(const glm::dvec3& scale) {
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(scale[i]) || std::abs(scale[i]) < 1e-6 || std::abs(scale[i]) > 1e9) return false;
    return true;
}

} // namespace

ObjectPlace place_of_object(const Session& session, size_t object) {
    const Node& node = node_of_object(session.shot(), object);
    ObjectPlace place{node.translation, node.rotation, node.scale};
    if (node.path.empty()) return place;
    const PathKey key = node.path.at(session.time());
    place.position = key.position;
    if (key.has_target) place.rotation = glm::dquat(look_rotation(key.target - key.position, false));
    return place;
}

ObjectFreedom freedom_of_object(const Shot& shot, size_t object) {
    const Path& path = node_of_object(shot, object).path;
    return {path.empty(), path.empty() || !path.keys.front().has_target};
}

std::string name_of_object(const Shot& shot, size_t object) {
    const std::string name = plain_name(node_of_object(shot, object));
    int same = 0, before = 0;
    for (size_t i = 0; i < shot.object_nodes.size(); ++i) {
        if (plain_name(node_of_object(shot, i)) != name) continue;
        ++same;
        before += i < object;
    }
    return same > 1 ? name + " " + std::to_string(before + 1) : name;
}

void move_object(PanelContext& context, size_t object, const ObjectPlace& place) {
    Session& session = context.session;
    Shot& shot = session.shot();
    if (object >= shot.object_nodes.size()) return;
    const size_t index = size_t(shot.object_nodes[object]);
    const ObjectFreedom free = freedom_of_object(shot, object);
    const Node before = shot.scene.nodes[index];
    Node after = before;
    if (free.move) after.translation = place.position;
    if (free.turn) after.rotation = place.rotation;
    after.scale = place.scale;
    try {
        if (!is_usable(place.scale)) throw Error("invalid scale: expected numbers other than 0");
        shot.scene.nodes[index] = after;
        check_placement(shot.scene, session.time());
    } catch (const std::exception& problem) {
        shot.scene.nodes[index] = before;
        return context.ui.say(name_of_object(shot, object) + ": " + problem_text(problem), true);
    }
    shot.scene.nodes[index] = before;
    edit(context, name_of_object(shot, object) + ": place", before, after,
         [&session, &ui = context.ui, index](const Node& value) {
             if (index >= session.shot().scene.nodes.size()) return;
             session.shot().scene.nodes[index] = value;
             session.scene_edited();
             ui.redraw();
         });
}

} // namespace bounce
