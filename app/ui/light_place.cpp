#include "app/ui/light_place.h"

#include "app/ui/edit.h"
#include "scene/keyframes.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace bounce {

namespace {

std::string name_of(const Light& light, size_t index) {
    return light.name.empty() ? "light " + std::to_string(index + 1) : light.name;
}

/// What is not zero by rounding alone would be shown as -0.000.
glm::vec3 clean(glm::vec3 v) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(v[i]) < 1e-6f) v[i] = 0;
    }
    return v;
}

void put(Scene& scene, int index, const LightPlace& place, float time) {
    Node& node = scene.nodes[size_t(index)];
    glm::dmat4 parent(1);
    if (node.parent >= 0) parent = file_matrices(scene, time)[size_t(node.parent)];
    const glm::dmat4 inverse = glm::inverse(parent);
    node.translation = glm::dvec3(inverse * glm::dvec4(place.position, 1));
    node.rotation = look_rotation(glm::dmat3(inverse) * glm::dvec3(place.direction), true);
    // A light shines the same at any scale.
    node.scale = glm::dvec3(1);
    node.has_matrix = false;
}

/// Lights and nodes before and after a change are one step of undo.
void change_lights(PanelContext& context, const std::string& what, const std::function<void(Scene&)>& change) {
    struct Lights {
        std::vector<Light> lights;
        std::vector<Node> nodes;
        int chosen;
    };
    Session& session = context.session;
    UiState& ui = context.ui;
    const auto now = [&] { return Lights{session.shot().scene.lights, session.shot().scene.nodes, ui.chosen_light}; };
    const Lights before = now();
    change(session.shot().scene);
    const Lights after = now();
    const auto set = [&session, &ui](const Lights& value) {
        session.shot().scene.lights = value.lights;
        session.shot().scene.nodes = value.nodes;
        ui.chosen_light = value.chosen;
        if (value.chosen >= 0) ui.chosen_object = -1;
        session.scene_edited();
        ui.redraw();
    };
    set(after);
    context.undo.push({what, [set, before] { set(before); }, [set, after] { set(after); }});
}

void append(PanelContext& context, const std::string& what, Light light, const LightPlace& place) {
    const float time = context.session.time();
    change_lights(context, what, [&](Scene& scene) {
        if (light.name.empty()) light.name = "light " + std::to_string(scene.lights.size() + 1);
        Node node;
        node.name = light.name;
        node.light = int(scene.lights.size());
        scene.lights.push_back(light);
        scene.nodes.push_back(node);
        put(scene, int(scene.nodes.size()) - 1, place, time);
        context.ui.chosen_light = node.light;
        context.ui.chosen_object = -1;
    });
}

/// From the camera, in the file's coordinates.
LightPlace view_place(const Session& session, double share_of_diagonal) {
    const LoadedSpace& space = session.shot().scene.space;
    const Camera camera = session.camera();
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const float distance = float(share_of_diagonal) * std::max(session.facts().bounds.diagonal(), 1e-3f);
    const glm::dvec3 origin = space.to_file(camera.position), ahead = space.to_file(camera.position + forward);
    return {space.to_file(camera.position + distance * forward), glm::vec3(glm::normalize(ahead - origin))};
}

/// Lights a white surface a third of the scene's diagonal away to a radiance of about 1.
float useful_intensity(const Session& session, LightType type) {
    if (type == LightType::directional) return 3;
    const float metres = float(session.shot().scene.space.unit) * session.facts().bounds.diagonal() / 3;
    return 3.14159f * std::max(metres * metres, 1e-6f);
}

Light new_light(const Session& session, LightType type) {
    Light light;
    light.type = type;
    light.intensity = glm::vec3(useful_intensity(session, type));
    light.inner_cone = glm::radians(25.0f);
    light.outer_cone = glm::radians(35.0f);
    return light;
}

} // namespace

int node_of_light(const Scene& scene, size_t light) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].light == int(light)) return int(i);
    }
    return -1;
}

std::optional<LightPlace> place_of_light(const Session& session, size_t light) {
    const Scene& scene = session.shot().scene;
    const int node = light < scene.lights.size() ? node_of_light(scene, light) : -1;
    if (node < 0) return std::nullopt;
    const glm::dmat4 world = file_matrices(scene, session.time())[size_t(node)];
    return LightPlace{glm::dvec3(world[3]), clean(glm::vec3(-glm::normalize(glm::dvec3(world[2]))))};
}

bool is_driven(const Scene& scene, size_t light) {
    const int node = node_of_light(scene, light);
    return node >= 0 && scene.nodes[size_t(node)].dynamic;
}

void move_light(PanelContext& context, size_t light, const LightPlace& place) {
    Session& session = context.session;
    Scene& scene = session.shot().scene;
    const int index = node_of_light(scene, light);
    if (index < 0 || is_driven(scene, light) || glm::length(place.direction) < 1e-4f) return;
    const Node before = scene.nodes[size_t(index)];
    put(scene, index, place, session.time());
    const Node moved = std::exchange(scene.nodes[size_t(index)], before);
    edit(context, name_of(scene.lights[light], light) + ": place", before, moved,
         [&session, &ui = context.ui, node = size_t(index)](const Node& value) {
             if (node >= session.shot().scene.nodes.size()) return;
             session.shot().scene.nodes[node] = value;
             session.scene_edited();
             ui.redraw();
         });
}

void open_cone(PanelContext& context, size_t light, const Light& before, float outer_cone) {
    Light after = before;
    after.outer_cone = std::clamp(outer_cone, glm::radians(0.5f), glm::radians(90.0f));
    after.inner_cone = before.inner_cone * (after.outer_cone / before.outer_cone);
    edit(context, name_of(before, light) + ": cone", before, after,
         [&session = context.session, &ui = context.ui, light](const Light& value) {
             if (light >= session.shot().scene.lights.size()) return;
             session.shot().scene.lights[light] = value;
             session.scene_edited();
             ui.redraw();
         });
}

void add_light(PanelContext& context, LightType type) {
    append(context, "add a light", new_light(context.session, type), view_place(context.session, 0.15));
}

void add_headlight(PanelContext& context) {
    Light light = new_light(context.session, LightType::spot);
    light.name = "headlight";
    light.inner_cone = glm::radians(50.0f);
    light.outer_cone = glm::radians(70.0f);
    append(context, "add a headlight", light, view_place(context.session, 0));
}

void duplicate_light(PanelContext& context, size_t light) {
    const std::optional<LightPlace> place = place_of_light(context.session, light);
    if (!place) return;
    LightPlace beside = *place;
    beside.position.x +=
        0.05 * double(context.session.facts().bounds.diagonal()) * context.session.shot().scene.space.unit;
    Light copy = context.session.shot().scene.lights[light];
    copy.name = (copy.name.empty() ? "light" : copy.name) + " copy";
    append(context, "duplicate a light", copy, beside);
}

void delete_light(PanelContext& context, size_t light) {
    change_lights(context, "delete a light", [&](Scene& scene) {
        scene.lights.erase(scene.lights.begin() + long(light));
        for (Node& node : scene.nodes) {
            if (node.light == int(light)) node.light = -1;
            if (node.light > int(light)) --node.light;
        }
        context.ui.chosen_light = -1;
    });
}

} // namespace bounce
