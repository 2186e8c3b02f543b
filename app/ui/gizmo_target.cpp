#include "app/ui/edit.h"
#include "app/ui/gizmo.h"
#include "app/ui/light_place.h"
#include "app/ui/object_place.h"
#include "scene/turn.h"

#include <algorithm>

namespace bounce {

namespace {

std::optional<GizmoTarget> light_target(PanelContext context, size_t index) {
    const Scene& scene = context.session.shot().scene;
    const std::optional<LightPlace> place = place_of_light(context.session, index);
    if (!place) return std::nullopt;
    const Light& light = scene.lights[index];
    GizmoTarget target;
    if (light.type != LightType::directional) target.position = place->position;
    if (light.type != LightType::point) target.direction = place->direction;
    if (light.type == LightType::spot) {
        target.cone = light.outer_cone;
        target.open = [context, index, light](float cone) mutable { open_cone(context, index, light, cone); };
    }
    if (is_driven(scene, index)) return target;
    target.move = [context, index, moved = *place](const glm::dvec3& position) mutable {
        moved.position = position;
        move_light(context, index, moved);
    };
    target.turn = [context, index, moved = *place](const glm::vec3& direction) mutable {
        moved.direction = direction;
        move_light(context, index, moved);
    };
    return target;
}

std::optional<GizmoTarget> object_target(PanelContext context, size_t index) {
    const ObjectPlace place = place_of_object(context.session, index);
    const glm::dvec3 front = place.rotation * glm::dvec3(0, 0, 1); // of a glTF asset
    const ObjectFreedom free = freedom_of_object(context.session.shot(), index);
    GizmoTarget target;
    target.position = place.position;
    target.direction = glm::vec3(front);
    if (free.move)
        target.move = [context, index, moved = place](const glm::dvec3& position) mutable {
            moved.position = position;
            move_object(context, index, moved);
        };
    if (free.turn)
        target.turn = [context, index, place, front](const glm::vec3& direction) mutable {
            ObjectPlace turned = place;
            turned.rotation =
                glm::normalize(turn_between(front, glm::normalize(glm::dvec3(direction))) * place.rotation);
            move_object(context, index, turned);
        };
    return target;
}

} // namespace

std::optional<GizmoTarget> gizmo_target(PanelContext& context) {
    const Shot& shot = context.session.shot();
    const int light = context.ui.chosen_light, object = context.ui.chosen_object;
    if (light >= 0 && light < int(shot.scene.lights.size())) return light_target(context, size_t(light));
    if (object >= 0 && object < int(shot.object_nodes.size())) return object_target(context, size_t(object));
    return std::nullopt;
}

} // namespace bounce
