#include "graph/frame_constants.h"

#include "scene/camera_ray.h"
#include "scene/near_plane.h"

#include <cmath>
#include <map>

namespace bounce {

void set_camera(FrameConstants& c, const Camera& camera, glm::ivec2 resolution, float scene_diagonal) {
    glm::mat3 basis = camera_basis(camera.position, camera.target, camera.up);
    c.camera_position = camera.position;
    c.camera_right = basis[0];
    c.camera_up = basis[1];
    c.camera_forward = basis[2];
    c.resolution = resolution;
    c.aspect = float(resolution.x) / float(resolution.y);
    c.tan_half_vfov = std::tan(0.5f * camera.vfov);
    c.near_plane = camera.near_plane > 0 ? camera.near_plane : smallest_near_plane(scene_diagonal);

    glm::mat3 rotation = glm::transpose(glm::mat3(basis[0], basis[1], -basis[2]));
    c.view = glm::mat4(rotation);
    c.view[3] = glm::vec4(rotation * -camera.position, 1);
    // Infinite far plane, reversed depth (near / distance), and y turned over so that row 0 is the top of the picture.
    float f = 1.0f / c.tan_half_vfov;
    c.projection = glm::mat4(0);
    c.projection[0][0] = f / c.aspect;
    c.projection[1][1] = -f;
    c.projection[2][3] = -1;
    c.projection[3][2] = c.near_plane;
    c.view_projection = c.projection * c.view;
    c.inverse_view_projection = glm::mat4(glm::inverse(glm::dmat4(c.view_projection)));
}

using Getter = ParameterValue (*)(const FrameConstants&);
static const std::map<std::string, Getter>& getters() {
    static const std::map<std::string, Getter> table = {
        {"camera_position", [](const FrameConstants& c) -> ParameterValue { return c.camera_position; }},
        {"camera_right", [](const FrameConstants& c) -> ParameterValue { return c.camera_right; }},
        {"camera_up", [](const FrameConstants& c) -> ParameterValue { return c.camera_up; }},
        {"camera_forward", [](const FrameConstants& c) -> ParameterValue { return c.camera_forward; }},
        {"time", [](const FrameConstants& c) -> ParameterValue { return c.time; }},
        {"delta_time", [](const FrameConstants& c) -> ParameterValue { return c.delta_time; }},
        {"tan_half_vfov", [](const FrameConstants& c) -> ParameterValue { return c.tan_half_vfov; }},
        {"near_plane", [](const FrameConstants& c) -> ParameterValue { return c.near_plane; }},
        {"aspect", [](const FrameConstants& c) -> ParameterValue { return c.aspect; }},
        {"scene_min", [](const FrameConstants& c) -> ParameterValue { return c.scene_min; }},
        {"scene_max", [](const FrameConstants& c) -> ParameterValue { return c.scene_max; }},
        {"scene_diagonal", [](const FrameConstants& c) -> ParameterValue { return c.scene_diagonal; }},
        {"environment_radiance", [](const FrameConstants& c) -> ParameterValue { return c.environment_radiance; }},
        {"environment_map", [](const FrameConstants& c) -> ParameterValue { return c.environment_map; }},
        {"resolution", [](const FrameConstants& c) -> ParameterValue { return glm::vec2(c.resolution); }},
        {"frame_index", [](const FrameConstants& c) -> ParameterValue { return c.frame_index; }},
        {"light_count", [](const FrameConstants& c) -> ParameterValue { return c.light_count; }},
        {"diffuse_only", [](const FrameConstants& c) -> ParameterValue { return c.diffuse_only; }},
        {"material_model", [](const FrameConstants& c) -> ParameterValue { return c.material_model; }},
        {"normal_maps", [](const FrameConstants& c) -> ParameterValue { return c.normal_maps; }},
        {"pre_exposure", [](const FrameConstants& c) -> ParameterValue { return c.pre_exposure; }},
        {"shadow_view_count", [](const FrameConstants& c) -> ParameterValue { return c.shadow_view_count; }},
    };
    return table;
}

std::optional<ParameterValue> frame_constant(const FrameConstants& constants, const std::string& name) {
    auto found = getters().find(name);
    if (found == getters().end()) return std::nullopt;
    return found->second(constants);
}

std::vector<std::string> frame_constant_names() {
    std::vector<std::string> names;
    for (const auto& [name, getter] : getters())
        names.push_back(name);
    return names;
}

} // namespace bounce
